// FBX in the page: a character and its motions in one drop, and out again.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { FIXTURES, SAMPLE, drop, dropAndWait, keep, state, test, until } from "./harness.js";
import { loaded } from "./gltf_files.js";

const FILES = ["walking", "walker", "waving"].map((name) => `${FIXTURES}fbx/${name}.fbx`);
const [WALKING, WALKER, WAVING] = FILES;

const namesOf = ({ model }) => model.clips.map(({ name }) => name);

/** How far the hands and the knees are apart at some moments of a clip, beside how far the head is from the hips: in any unit and space. */
const posed = (page, clip) =>
  page.evaluate((clip) => {
    const [HIPS, HEAD, HANDS, KNEES] = [1, 3, [5, 7], [9, 11]];
    const { startSecs, endSecs } = bindpose.state().model.clips.find(({ name }) => name === clip);
    const apart = ([one, other]) => {
      const [from, to] = [one, other].map((bone) => bindpose.boneToRoot(bone));
      return Math.hypot(...[12, 13, 14].map((axis) => from[axis] - to[axis]));
    };
    bindpose.pause();
    bindpose.selectClip(clip);
    return [0, 0.13, 0.3].flatMap((part) => {
      bindpose.seek(startSecs + part * (endSecs - startSecs));
      return [HANDS, KNEES].map((pair) => apart(pair) / apart([HIPS, HEAD]));
    });
  }, clip);

const furthest = (one, other) => Math.max(...one.map((span, index) => Math.abs(span - other[index])));

test("a character and its motions are one drop, and walk in place in what is exported", { draws: true }, async (page) => {
  const { model } = await dropAndWait(page, FILES);
  assert.deepEqual([model.name, model.clips.map(({ name }) => name)], ["walker.fbx", ["Scene", "walking", "waving"]]);
  assert.equal(await page.evaluate(() => bindpose.state().models?.length ?? 1), 2, "the motions are no models of the list");
  await keep(page, "fbx-walker");
  const exported = (options) =>
    page.evaluate(async (options) => {
      const { bytes, changes } = await bindpose.export({ format: "glb", clips: ["walking"], ...options });
      return { bytes: Array.from(bytes), changes: changes.map(({ code }) => code) };
    }, options);
  const far = {};
  for (const inPlace of [false, true]) {
    const { bytes, changes } = await exported({ inPlace });
    assert.equal(changes.includes("in-place"), inPlace);
    const { animations } = await loaded(Buffer.from(bytes));
    const track = animations[0].tracks.find(({ name }) => /Hips\.position$/.test(name));
    const places = [0, track.values.length - 3].map((at) => Array.from(track.values.slice(at, at + 3)));
    far[inPlace] = Math.hypot(...places[0].map((number, axis) => number - places[1][axis]));
  }
  assert.ok(far.false > 20 * far.true, JSON.stringify(far));
});

test("a motion that is dropped with Shift, or added by a program, joins the character that is open", {}, async (page) => {
  await dropAndWait(page, [WALKER]);
  const still = await posed(page, "Scene");
  await drop(page, [WALKING], { shift: true });
  const dropped = await until(page, ({ model }) => model.clips.length === 2);
  assert.deepEqual([dropped.model.name, namesOf(dropped), dropped.error], ["walker.fbx", ["Scene", "walking"], null]);
  const added = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    return bindpose.addClips([{ name: "waving.fbx", bytes }]);
  }, readFileSync(WAVING).toString("base64"));
  assert.deepEqual([added.model.name, namesOf(added), added.error], ["walker.fbx", ["Scene", "walking", "waving"], null]);
  for (const clip of ["walking", "waving"]) {
    const apart = furthest(await posed(page, clip), still);
    assert.ok(apart > 0.1, `${clip} poses the character: ${apart}`);
  }
  // Those of another skeleton do not.
  await drop(page, [SAMPLE], { shift: true });
  const { error, ...after } = await until(page, ({ error }) => error !== null);
  assert.deepEqual([error.code, namesOf(after)], ["clips-bones-differ", namesOf(added)]);
});

test("a character with its motions is written for the DirectX 12 book, whose program reads it, and moves as before", {}, async (page) => {
  const dropped = await dropAndWait(page, FILES);
  const moved = [await posed(page, "walking"), await posed(page, "waving")];
  assert.ok(furthest(...moved) > 0.1);
  const { name, changes } = await page.evaluate(async () => {
    const { name, bytes, changes } = await bindpose.export({ format: "d3d12", clips: ["walking", "waving"], forBook: true });
    await bindpose.open([{ name, bytes }]);
    return { name, changes: changes.map(({ code }) => code) };
  });
  // Plain maps come along, since the demo opens some.
  assert.equal(name, "walker-d3d12.zip");
  for (const code of ["clips-chosen", "clip-renamed", "maps-added"]) assert.ok(changes.includes(code), `${changes}`);
  const written = await state(page);
  assert.deepEqual([written.error, written.model.dialect, written.textures.missing], [null, "d3d12", []]);
  assert.deepEqual(namesOf(written), ["walking", "Take1"], "the demo plays what is watched");
  const countsOf = ({ model: { counts } }) => [counts.bones, counts.triangles];
  assert.deepEqual(countsOf(written), countsOf(dropped));
  const { reads, why } = written.book.d3d12;
  assert.deepEqual([reads, why], [true, null]);
  for (const [index, clip] of namesOf(written).entries()) {
    const apart = furthest(await posed(page, clip), moved[index]);
    assert.ok(apart < 1e-3, `${clip}: ${apart}`);
  }
});
