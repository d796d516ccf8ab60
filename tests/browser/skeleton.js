// Bones and skin by mouse: a bone is selected where it is drawn, its weights are coloured as the legend says.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { SAMPLE, atRest, dropAndWait, keep, settled, state, test, until } from "./harness.js";
import { decoded, difference, picture } from "./picture.js";
import { BONES, GROUND, bounds, click } from "./widgets.js";


/** Opens the page of bones, which clicks in the view are then about. The second click gives the view the keyboard and selects nothing. */
async function openSkeleton(page) {
  await atRest(page);
  await click(page, "page-1");
  await settled(page);
  await page.mouse.click(...GROUND);
}

/** Shows the page of bones, which draws them. */
async function showBones(page) {
  await openSkeleton(page);
  await until(page, ({ skeleton }) => skeleton.bonesVisible);
}

/** Clicks on a bone and waits until it is the one that is selected. */
async function selectBone(page, bone) {
  await page.mouse.click(...BONES[bone]);
  await until(page, ({ skeleton }) => skeleton.selected === Number(bone));
}

test("a click on a bone selects it, one beside all bones none, and Esc lets go", {}, async (page) => {
  await showBones(page);
  const plain = await picture(page);
  for (const bone of Object.keys(BONES)) {
    await selectBone(page, bone);
    await page.mouse.move(...GROUND);
    await settled(page);
    const marked = await picture(page);
    assert.ok(difference(plain, marked) > 0.0005, `bone ${bone} stands out: ${difference(plain, marked)} of the pixels`);
  }
  await keep(page, "bone-selected");
  await page.mouse.click(...GROUND);
  await until(page, ({ skeleton }) => skeleton.selected === null);
  const [bone] = Object.keys(BONES);
  await selectBone(page, bone);
  await page.keyboard.press("Escape");
  await until(page, ({ skeleton }) => skeleton.selected === null);
  await page.mouse.move(...GROUND);
  await settled(page);
  assert.equal((await picture(page)).digest, plain.digest);
});

test("in the model's page a click selects no bone", {}, async (page) => {
  await page.mouse.click(...Object.values(BONES)[0]);
  await atRest(page);
  assert.equal((await state(page)).skeleton.selected, null, "the click is about a subset");
});

/** The sample with weights that go evenly from none at the feet to all above the chest, in place of its stiff shells. */
function evenlyWeighted(bone) {
  const text = readFileSync(SAMPLE, "latin1");
  const weights = /(Position: \S+ (\S+) [^]*?)BlendWeights: .*\nBlendIndices: .*\n/g;
  return text.replace(weights, (_, before, height) => {
    const weight = Math.min(Math.max(height / 50 - 0.1, 0), 1).toFixed(3);
    return `${before}BlendWeights: ${weight} ${(1 - weight).toFixed(3)} 0 0\nBlendIndices: ${bone} 0 0 0\n`;
  });
}

/** The vertices of such a file in the world, 72 units high. */
function vertices(text) {
  const numbers = (words) => words.trim().split(/\s+/).map(Number);
  const vertex = /Position: (.*)\nTangent: .*\nNormal: (.*)\nTex-Coords: .*\nBlendWeights: (.*)\nBlendIndices: (.*)\n/g;
  return Array.from(text.matchAll(vertex), ([, position, normal, weights, bones]) => {
    const [weightsOfVertex, indices] = [numbers(weights), numbers(bones)];
    const weightOf = (bone) => weightsOfVertex.reduce((sum, weight, at) => sum + (indices[at] === bone ? weight : 0), 0);
    // Right-handed, as the exporters of the book leave it.
    const [at, towards] = [position, normal].map((words) => numbers(words)).map(([x, y, z]) => [-x, y, z]);
    return { position: at, normal: towards, weightOf };
  });
}

const dot = (one, other) => one.reduce((sum, at, axis) => sum + at * other[axis], 0);
const minus = (one, other) => one.map((at, axis) => at - other[axis]);

/**
 * Where a vertex of the bind pose is in a picture, in pixels; how far from the eye, along the view; and how much it faces the
 * eye. The world is left-handed, y up.
 */
function projected({ camera }, { width, height }, { position, normal }) {
  const [sinYaw, cosYaw] = [Math.sin(camera.yawRadians), Math.cos(camera.yawRadians)];
  const [sinPitch, cosPitch] = [Math.sin(camera.pitchRadians), Math.cos(camera.pitchRadians)];
  const forward = [sinYaw * cosPitch, -sinPitch, cosYaw * cosPitch];
  const right = [cosYaw, 0, -sinYaw];
  const up = [sinYaw * sinPitch, cosPitch, cosYaw * sinPitch];
  const eye = minus(camera.target, forward.map((at) => at * camera.distance));
  const seen = minus(position, eye);
  const depth = dot(seen, forward);
  // The camera sees a twelfth of a turn from bottom to top.
  const scale = height / (2 * Math.tan(Math.PI / 12) * depth);
  const facing = -dot(normal, seen) / (Math.hypot(...normal) * Math.hypot(...seen));
  return { x: width / 2 + scale * dot(seen, right), y: height / 2 - scale * dot(seen, up), depth, facing };
}

/**
 * Vertices that are plainly seen in a picture: they face the eye, nothing is in front of them, and around them the same side
 * has nearly the same weight.
 */
function plainlySeen(now, drawn, text, bone) {
  const all = vertices(text).map((vertex) => ({ weight: vertex.weightOf(bone), ...projected(now, drawn, vertex) }));
  return all.filter((vertex) => {
    if (vertex.facing < 0.85) return false;
    const around = all.filter(({ x, y }) => Math.hypot(x - vertex.x, y - vertex.y) < 2.5);
    const sameSide = around.filter(({ depth }) => depth < vertex.depth + 2.4);
    const alike = ({ weight, depth }) => Math.abs(weight - vertex.weight) < 0.25 && depth > vertex.depth - 1.2;
    return sameSide.length > 1 && sameSide.every(alike);
  });
}

const channels = ({ pixels, width }, x, y) => {
  const at = 4 * (Math.floor(y) * width + Math.floor(x));
  return [...pixels.subarray(at, at + 3)];
};

test("vertices have the colours that the legend has for their weights", { draws: true, fine: true }, async (page) => {
  const bone = 1;
  const even = evenlyWeighted(bone);
  const path = join(mkdtempSync(join(tmpdir(), "bindpose-")), "even.m3d");
  writeFileSync(path, even, "latin1");
  await dropAndWait(page, [path]);
  await showBones(page);
  await click(page, `bone-${bone}`);
  await until(page, ({ skeleton }) => skeleton.selected === bone);
  for (const key of ["w", "k", "b"]) await page.keyboard.press(key);
  const shown = ({ skeleton }) => skeleton.skinView === "weight" && skeleton.bindShare === 1 && !skeleton.bonesVisible;
  await until(page, shown);
  await page.mouse.move(...GROUND);
  const now = await atRest(page);
  await keep(page, "weights");
  // The colours begin 5 points below its upper edge.
  const { x, y, width } = await bounds(page, "legend-colours");
  const legend = await decoded(page, await page.screenshot({ clip: { x, y: y + 7, width, height: 3 } }));
  const drawn = await picture(page, { width: 480, height: 300, overlays: [] });
  const seen = plainlySeen(now, drawn, even, bone);

  // From none to all, and a few between them; what is between changes from pixel to pixel.
  for (const [weight, tolerance] of [[0, 4], [1, 4], [0.25, 60], [0.5, 60], [0.75, 60]]) {
    const of = seen.filter((vertex) => Math.abs(vertex.weight - weight) < 0.03);
    assert.ok(of.length >= 2, `${of.length} vertices with a weight of ${weight} are plainly seen`);
    const expected = channels(legend, weight * (legend.width - 1), 1);
    const far = of.map(({ x, y }) => Math.max(...minus(channels(drawn, x, y), expected).map(Math.abs)));
    const middle = far.sort((one, other) => one - other)[Math.floor(far.length / 2)];
    assert.ok(middle <= tolerance, `weight ${weight}: ${middle} of 255 from the legend's ${expected}, over ${of.length} vertices`);
  }
});

test("with the skin in colours a click selects the vertex that is there", {}, async (page) => {
  await openSkeleton(page);
  await settled(page);
  for (const key of ["w", "k", "b"]) await page.keyboard.press(key);
  await until(page, ({ skeleton }) => skeleton.skinView === "weight" && skeleton.bindShare === 1);
  await atRest(page);
  const place = [493, 240];
  await page.mouse.click(...place);
  const now = await until(page, ({ skeleton }) => skeleton.vertex !== null);
  await page.mouse.move(...GROUND);
  await atRest(page);
  await keep(page, "vertex-selected");
  const { x, y, facing } = projected(now, page.viewportSize(), vertices(readFileSync(SAMPLE, "latin1"))[now.skeleton.vertex]);
  assert.ok(Math.hypot(x - place[0], y - place[1]) < 12, `vertex ${now.skeleton.vertex} is at ${x}, ${y}`);
  assert.ok(facing > 0, "on the side that is seen");
  await page.keyboard.press("Escape");
  await until(page, ({ skeleton }) => skeleton.vertex === null);
});

test("F frames the bone that is selected, Shift+F the whole animation, and F without a selection the model", {}, async (page) => {
  await showBones(page);
  const { camera } = await state(page);
  const far = (one, other) => Math.hypot(...minus(one.target, other.target));
  await selectBone(page, "19");
  await page.keyboard.press("f");
  const close = await until(page, (now) => now.camera.distance < 0.7 * camera.distance);
  // The bone is an upper leg: below the middle of the figure, which is as high as two metres at most, and above its feet.
  const [, height] = close.camera.target;
  assert.ok(height > 0.4 && height < camera.target[1], `${close.camera.target}`);
  await page.keyboard.press("Shift+F");
  const wide = await until(page, (now) => now.camera.distance > 1.2 * close.camera.distance);
  assert.ok(far(wide.camera, camera) < 0.05 && Math.abs(wide.camera.distance / camera.distance - 1) < 0.02, JSON.stringify(wide.camera));
  await page.keyboard.press("Escape");
  await until(page, ({ skeleton }) => skeleton.selected === null);
  await page.keyboard.press("f");
  const { camera: whole } = await atRest(page);
  assert.ok(whole.distance > 1.2 * close.camera.distance, `${whole.distance}`);
  assert.deepEqual([whole.yawRadians, whole.pitchRadians], [camera.yawRadians, camera.pitchRadians], "from where it looked");
});

test("F2 names the bone that is selected", {}, async (page) => {
  const [bone] = Object.keys(BONES);
  await showBones(page);
  await selectBone(page, bone);
  await page.keyboard.press("F2");
  // The field takes the keyboard some frames after it was drawn; what is typed before is lost.
  await atRest(page);
  await atRest(page);
  await page.keyboard.type("left thigh", { delay: 30 });
  await page.keyboard.press("Enter");
  const { skeleton } = await until(page, ({ skeleton }) => skeleton.names[bone]);
  assert.deepEqual(skeleton.names, { [bone]: "left thigh" });
  assert.equal(skeleton.selected, Number(bone));
});
