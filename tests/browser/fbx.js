// FBX in the page: a character and its motions in one drop, and out again.

import assert from "node:assert/strict";
import { FIXTURES, dropAndWait, keep, test } from "./harness.js";
import { loaded } from "./gltf_files.js";

const FILES = ["walking", "walker", "waving"].map((name) => `${FIXTURES}fbx/${name}.fbx`);

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
