// glTF in the page: as its file has it, as three.js poses it, and out again.

import assert from "node:assert/strict";
import { copyFileSync, mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { AnimationMixer, Vector3 } from "three";
import { loaded, trianglesOf, withoutPictures } from "./gltf_files.js";
import { FIXTURES, SAMPLE, SHARED, call, dropAndWait, keep, settled, state, test, unless, until } from "./harness.js";
import { assertGolden, difference, picture } from "./picture.js";
import { click } from "./widgets.js";

const BANNER = `${FIXTURES}gltf/banner.glb`;
const CESIUM_MAN = `${SHARED}gltf/models/CesiumMan.glb`;

/** What a file is to be in the page. */
const FILES = [
  { path: BANNER, clip: "Wave", clips: ["Wave", "Nod and spin"], bones: 5, triangles: 20, joint: "Middle" },
  { path: CESIUM_MAN, clip: "Anim_0", clips: ["Anim_0"], bones: 20, triangles: 4672, joint: "Skeleton_torso_joint_1" },
];

const SIZE = { width: 192, height: 144, background: "#30343c", overlays: [] };

/** The open model as the page exports it. */
async function exported(page, options) {
  const { name, base64, ...told } = await page.evaluate(async (options) => {
    const { name, bytes, changes, losses } = await bindpose.export(options);
    globalThis.written = { name, bytes };
    let letters = "";
    for (const byte of bytes) letters += String.fromCharCode(byte);
    return { name, base64: btoa(letters), changes, losses };
  }, options);
  return { name, bytes: Buffer.from(base64, "base64"), ...told };
}

/** Where three.js has the middle of each triangle of a file at a time of a clip: strips may begin with another corner. */
function posed(gltf, clip, secs) {
  const mixer = new AnimationMixer(gltf.scene);
  mixer.clipAction(gltf.animations.find(({ name }) => name === clip)).play();
  mixer.setTime(secs);
  gltf.scene.updateMatrixWorld(true);
  gltf.scene.traverse((object) => object.skeleton?.update());
  return trianglesOf(gltf).map(({ object, corners }) => {
    const places = corners.map((vertex) => object.localToWorld(object.getVertexPosition(vertex, new Vector3())));
    return places[0].add(places[1]).add(places[2]).divideScalar(3);
  });
}

/** The view at a time of a clip. */
async function drawnAt(page, clip, secs) {
  await call(page, "pause");
  await call(page, "selectClip", clip);
  await call(page, "seek", secs);
  await settled(page);
  return picture(page, SIZE);
}

test("glTF opens with its joints, clips and maps, and what is exported of it is posed and looks alike", { draws: true, passes: true }, async (page) => {
  for (const { path, clip, clips, bones, triangles, joint } of FILES) {
    const absent = path.startsWith(SHARED) && unless(path);
    if (absent) continue;
    const { outcome, model, textures, error } = await dropAndWait(page, [path]);
    assert.deepEqual([outcome, error], ["load", null], path);
    assert.deepEqual([model.name, model.clips.map(({ name }) => name), model.counts.bones, model.counts.triangles], [basename(path), clips, bones, triangles]);
    assert.deepEqual([textures.named > 0, textures.missing, textures.unreadable], [true, [], []], path);
    const drawn = await drawnAt(page, clip, 0.75);
    if (path === BANNER) await assertGolden(page, "gltf-banner", drawn);
    await click(page, "page-1");
    await page.getByRole("treeitem", { name: joint }).first().waitFor();
    await keep(page, `gltf-${basename(path, ".glb")}`);
    // The bones are drawn with their page, and not in the picture that this one is compared with.
    await click(page, "page-0");
    await until(page, ({ skeleton }) => !skeleton.bonesVisible);
    const { bytes } = await exported(page, { format: "glb" });
    const [source, again] = await Promise.all([readFileSync(path), bytes].map((bytes) => loaded(withoutPictures(bytes))));
    for (const secs of [0, 0.3, 0.75, 1.2, 1.9]) {
      const [expected, found] = [source, again].map((gltf) => posed(gltf, clip, secs));
      // One mesh of all triangles, in the file's order.
      assert.equal(found.length, expected.length, path);
      const furthest = Math.max(...expected.map((place, triangle) => place.distanceTo(found[triangle])));
      assert.ok(furthest < 1e-4, `${path} at ${secs} s: ${furthest} apart`);
    }
    await page.evaluate(() => bindpose.open([globalThis.written]));
    const { model: opened } = await state(page);
    assert.deepEqual([opened.clips.map(({ name }) => name), opened.counts.triangles], [clips, triangles]);
    const apart = difference(drawn, await drawnAt(page, clip, 0.75));
    assert.ok(apart < 0.002, `${path} looks otherwise when it is opened again: ${apart} of the pixels`);
  }
});

/** Numbers from 0 to 1, the same each time. */
function* chances(seed) {
  for (let state = seed; ; ) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    yield state / 2 ** 32;
  }
}

test("whatever is chosen for an export, the file opens again", {}, async (page) => {
  const plain = join(mkdtempSync(join(tmpdir(), "bindpose-")), "plain.m3d");
  copyFileSync(SAMPLE, plain);
  const numbers = chances(7);
  const chance = () => numbers.next().value;
  await dropAndWait(page, [plain]);
  const { model: before } = await state(page);
  for (let round = 0; round < 8; round += 1) {
    const format = ["glb", "d3d12", "d3d11"][Math.floor(chance() * 3)];
    const { name: clip, startSecs, endSecs } = before.clips[Math.floor(chance() * before.clips.length)];
    const length = endSecs - startSecs;
    const isAlone = chance() < 0.6;
    const options = { format, clips: isAlone ? [clip] : undefined };
    if (isAlone && chance() < 0.6) options.range = [startSecs + 0.2 * length, startSecs + (0.6 + 0.4 * chance()) * length];
    if (chance() < 0.5) options.closeLoop = 0.1;
    if (chance() < 0.5) options.reduce = 10 ** (-4 + 2 * chance());
    if (format !== "glb" && chance() < 0.5) options.forBook = true;
    const said = JSON.stringify(options);
    const { name, bytes } = await exported(page, options);
    // For the demo there are maps, though the model came without.
    const expected = format === "glb" ? "plain.glb" : `plain-${format}.${options.forBook ? "zip" : "m3d"}`;
    assert.equal(name, expected, said);
    // A .zip opens as the folder in it.
    const { error, model, textures } = await page.evaluate(async ({ name, base64 }) => {
      await bindpose.open([{ name, bytes: Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)) }]);
      return bindpose.state();
    }, { name, base64: bytes.toString("base64") });
    if (options.forBook) assert.deepEqual([textures.named > 0, textures.missing, textures.unreadable], [true, [], []], said);
    assert.equal(error, null, said);
    assert.deepEqual([model.clips.length, model.counts.triangles, model.counts.bones], [isAlone ? 1 : before.clips.length, before.counts.triangles, before.counts.bones], said);
    if (options.range) {
      const [{ startSecs, endSecs }] = model.clips;
      const found = endSecs - startSecs;
      assert.ok(Math.abs(found - (options.range[1] - options.range[0])) < 1e-4, `${said}: ${found}`);
    }
    await dropAndWait(page, [plain]);
  }
});
