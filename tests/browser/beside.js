// Bindpose beside three.js: one model, pose, camera and size, in one run of one browser. `cargo xtask pictures` runs this and writes
// assets/beside/; MODELS, a list of files with colons between them, gives others, which are written to tests/browser/out/. A folder is one
// model with its maps.

import { mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";
import { OUT, atRest, call, running, state, test, until } from "./harness.js";

const FOLDER = fileURLToPath(new URL("../../assets/beside/", import.meta.url));
const LIBRARY = fileURLToPath(new URL("node_modules/three/", import.meta.url));
const SIZE = { width: 1440, height: 900 };
/** Vertical, as the studio's first view has it. */
const FIELD_OF_VIEW_DEGREES = 30;

mkdirSync(FOLDER, { recursive: true });

/** What three.js' own viewers do: its room as the environment, its neutral tone map, exposure 1. */
const drawWithThree = async ({ glb, camera, size, fieldOfView, clip, time }) => {
  const THREE = await import("/three/build/three.module.js");
  const { GLTFLoader } = await import("/three/examples/jsm/loaders/GLTFLoader.js");
  const { RoomEnvironment } = await import("/three/examples/jsm/environments/RoomEnvironment.js");
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(size.width, size.height, false);
  renderer.toneMapping = THREE.NeutralToneMapping;
  renderer.toneMappingExposure = 1;
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xe6e8ec);
  scene.environment = new THREE.PMREMGenerator(renderer).fromScene(new RoomEnvironment(), 0.04).texture;
  const bytes = Uint8Array.from(atob(glb), (letter) => letter.charCodeAt(0)).buffer;
  const { scene: model, animations } = await new GLTFLoader().parseAsync(bytes, "");
  scene.add(model);
  if (clip !== null && animations[clip]) {
    const mixer = new THREE.AnimationMixer(model);
    mixer.clipAction(animations[clip]).play();
    mixer.setTime(time);
  }
  // Ours is a left-handed world: z points away from the viewer.
  const { target, distance, yawRadians: yaw, pitchRadians: pitch } = camera;
  const forward = [Math.sin(yaw) * Math.cos(pitch), -Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)];
  const mirrored = (place) => new THREE.Vector3(place[0], place[1], -place[2]);
  const eye = mirrored(target.map((value, axis) => value - forward[axis] * distance));
  const view = new THREE.PerspectiveCamera(fieldOfView, size.width / size.height, distance / 100, distance * 100);
  view.position.copy(eye);
  view.lookAt(mirrored(target));
  renderer.render(scene, view);
  return renderer.domElement.toDataURL("image/jpeg", 0.9).split(",")[1];
};

const filesOf = (path) => (statSync(path).isDirectory() ? readdirSync(path).map((name) => join(path, name)) : [path]);

const open = (page, files) => page.evaluate(async (files) => {
  const bytes = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  await bindpose.open(files.map(({ name, base64 }) => ({ name, bytes: bytes(base64) })));
}, files);

/** Draws both and writes one picture with ours on the left. */
async function beside(page, folder, name) {
  await call(page, "pause");
  await atRest(page);
  const { camera, model, clip: shown, timeSecs: time } = await state(page);
  const { glb, ours } = await page.evaluate(async (size) => {
    const base64 = (bytes) => btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
    const { bytes } = await bindpose.export({ format: "glb" });
    const picture = await bindpose.snapshot({ ...size, light: "studio", samples: 16 });
    return { glb: base64(bytes), ours: base64(new Uint8Array(await picture.arrayBuffer())) };
  }, SIZE);
  const other = await page.context().newPage();
  await other.route("**/three/**", (route) => {
    const path = join(LIBRARY, new URL(route.request().url()).pathname.slice("/three/".length));
    const body = readFileSync(path, "utf8").replaceAll(/from 'three'/g, "from '/three/build/three.module.js'");
    return route.fulfill({ contentType: "text/javascript", body });
  });
  await other.route("**/beside.html", (route) => route.fulfill({ contentType: "text/html", body: "<!doctype html><title>three.js</title>" }));
  await other.goto(new URL("beside.html", process.env.PAGE).href);
  const clip = shown === null ? null : model.clips.findIndex(({ name }) => name === shown);
  const theirs = await other.evaluate(drawWithThree, { glb, camera, size: SIZE, fieldOfView: FIELD_OF_VIEW_DEGREES, clip, time });
  const both = await other.evaluate(
    async ([ours, theirs, { width, height }]) => {
      const canvas = Object.assign(document.createElement("canvas"), { width, height: height / 2 });
      const context = canvas.getContext("2d");
      for (const [index, source] of [`data:image/png;base64,${ours}`, `data:image/jpeg;base64,${theirs}`].entries()) {
        const image = Object.assign(new Image(), { src: source });
        await image.decode();
        context.drawImage(image, (index * width) / 2, 0, width / 2, height / 2);
      }
      return canvas.toDataURL("image/jpeg", 0.88).split(",")[1];
    },
    [ours, theirs, SIZE],
  );
  await other.close();
  writeFileSync(`${folder}${name}.jpg`, Buffer.from(both, "base64"));
}

/**
 * The chart of tests/gpu/chart.rs as glTF: balls of gold, red plastic, paper and blue cloth in seven roughnesses, and one of glass, on a dark
 * floor.
 */
function chart() {
  const [rings, sides] = [32, 48];
  const [positions, indices] = [[], []];
  for (let ring = 0; ring <= rings; ring += 1) {
    for (let side = 0; side <= sides; side += 1) {
      const [polar, azimuth] = [(Math.PI * ring) / rings, (2 * Math.PI * side) / sides];
      positions.push(Math.sin(polar) * Math.cos(azimuth), Math.cos(polar), Math.sin(polar) * Math.sin(azimuth));
      const [here, below] = [ring * (sides + 1) + side, (ring + 1) * (sides + 1) + side];
      if (ring < rings && side < sides) indices.push(here, here + 1, below, below, here + 1, below + 1);
    }
  }
  const [ball, ballIndices] = [positions.length / 3, indices.length];
  positions.push(-4, 0, -4, -4, 0, 4, 4, 0, 4, 4, 0, -4);
  const normals = [...positions.slice(0, 3 * ball), ...[0, 0, 0, 0].flatMap(() => [0, 1, 0])];
  indices.push(0, 1, 2, 0, 2, 3);
  const [places, bytes] = [new Float32Array([...positions, ...normals]), 4 * positions.length];
  const data = Buffer.concat([Buffer.from(places.buffer), Buffer.from(new Uint16Array(indices).buffer)]);
  const [materials, meshes, nodes] = [[], [], []];
  const add = (baseColorFactor, metallicFactor, roughnessFactor, translation, scale, rest = {}) => {
    const [first, mesh] = scale ? [0, materials.length] : [3, materials.length];
    materials.push({ pbrMetallicRoughness: { baseColorFactor, metallicFactor, roughnessFactor }, ...rest });
    meshes.push({ primitives: [{ attributes: { POSITION: first, NORMAL: first + 1 }, indices: first + 2, material: mesh }] });
    nodes.push({ mesh, translation, scale: Array(3).fill(scale || 1) });
  };
  add([0.07, 0.07, 0.07, 1], 0, 0.8, [0, 0, 0], 0);
  const rows = [[[1, 0.77, 0.34, 1], 1], [[0.4, 0.02, 0.015, 1], 0], [[0.9, 0.9, 0.9, 1], 0], [[0.02, 0.035, 0.09, 1], 0]];
  for (const [row, [color, metallic]] of rows.entries()) {
    for (const [column, roughness] of [0, 0.1, 0.2, 0.35, 0.5, 0.75, 1].entries()) add(color, metallic, roughness, [column - 3, 0.42, row - 1.6], 0.42);
  }
  add([0.75, 0.85, 0.85, 0.3], 0, 0.05, [0, 0.6, 2.6], 0.6, { alphaMode: "BLEND", doubleSided: true });
  const vectors = (first, count, min, max) => ({ bufferView: 0, byteOffset: 12 * first, componentType: 5126, count, type: "VEC3", min, max });
  const numbers = (first, count) => ({ bufferView: 1, byteOffset: 2 * first, componentType: 5123, count, type: "SCALAR" });
  return Buffer.from(JSON.stringify({
    asset: { version: "2.0" },
    buffers: [{ byteLength: data.length, uri: `data:application/octet-stream;base64,${data.toString("base64")}` }],
    bufferViews: [{ buffer: 0, byteLength: 2 * bytes }, { buffer: 0, byteOffset: 2 * bytes, byteLength: data.length - 2 * bytes }],
    accessors: [
      vectors(0, ball, [-1, -1, -1], [1, 1, 1]), vectors(ball + 4, ball), numbers(0, ballIndices),
      vectors(ball, 4, [-4, 0, -4], [4, 0, 4]), vectors(2 * ball + 4, 4), numbers(ballIndices, 6),
    ],
    materials, meshes, nodes,
    scenes: [{ nodes: [...nodes.keys()] }],
    scene: 0,
  }));
}

const WINDOW = { viewport: SIZE, colorScheme: "light", fine: true, passes: true, own: true };

test("the sample beside three.js", WINDOW, (page) => beside(page, FOLDER, "figure"));

test("the chart beside three.js", WINDOW, async (page) => {
  // A link to the file: one without would bring back the figure.
  await page.route("**/chart.gltf", (route) => route.fulfill({ body: chart() }));
  const address = new URL(page.url());
  address.searchParams.set("src", "chart.gltf");
  address.hash = "cam=-14,30,10.4,0,0.1,-0.2";
  await page.goto(address.href);
  await running(page);
  await until(page, ({ camera }) => Math.abs(camera.distance - 10.4) < 1e-3);
  await beside(page, FOLDER, "chart");
});

for (const path of process.env.MODELS?.split(":") ?? []) {
  test(`${basename(path)} beside three.js`, WINDOW, async (page) => {
    await open(page, filesOf(path).map((file) => ({ name: basename(file), base64: readFileSync(file, "base64") })));
    await beside(page, OUT, `beside-${basename(path)}`);
  });
}
