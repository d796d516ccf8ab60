// Pictures for scripts, looked at in every way: both backends come to the committed ones, and no way is another one's.

import assert from "node:assert/strict";
import { FIXTURES, call, dropAndWait, settled, state, test } from "./harness.js";
import { assertDrawn, assertGolden, difference, picture } from "./picture.js";

const SIZE = { width: 192, height: 144 };
/** A ground of one colour keeps the committed files small. */
const PLAIN = { ...SIZE, background: "#30343c", overlays: [] };

const VIEW_MODES = ["base-color", "normal-map", "normal", "tangent", "uv", "roughness", "metallic", "material", "depth", "ao", "shadow"];

/** Under reduced motion nothing has moved before the picture: neither the clip nor the book's lights. */
const ALL_PASSES = { passes: true };

/** The sample in the middle of a step, as in every committed picture of it. */
export async function inStep(page) {
  await call(page, "pause");
  await call(page, "selectClip", "Walk");
  await call(page, "seek", 0.25);
  await settled(page);
}

test("both lights, alone and side by side", { ...ALL_PASSES, draws: true }, async (page) => {
  await inStep(page);
  const studio = await picture(page, { ...SIZE, light: "studio" });
  const book = await picture(page, { ...SIZE, light: "book" });
  const split = await picture(page, { ...SIZE, split: 0.5 });
  assert.ok(difference(studio, book) > 0.05, `${difference(studio, book)} of the pixels tell the lights apart`);
  // Four samples a pixel: the column where they meet belongs to both.
  const [left, right] = [{ columns: [0, 0.49] }, { columns: [0.51, 1] }];
  assert.equal(difference(split, book, { ...left, tolerance: 0 }), 0, "the book's light is on the left");
  assert.equal(difference(split, studio, { ...right, tolerance: 0 }), 0, "the studio is on the right");
  await assertGolden(page, "studio", studio);
  await assertGolden(page, "book", book);
});

test("every view mode shows something of its own", { ...ALL_PASSES, draws: true }, async (page) => {
  await inStep(page);
  const seen = { lit: await picture(page, { ...PLAIN, viewMode: "lit" }) };
  for (const mode of VIEW_MODES) {
    const drawn = await picture(page, { ...PLAIN, viewMode: mode });
    for (const [other, of] of Object.entries(seen)) {
      assert.ok(difference(drawn, of) > 0.02, `${mode} is not ${other}: ${difference(drawn, of)} of the pixels differ`);
    }
    await assertGolden(page, `mode-${mode}`, drawn);
    seen[mode] = drawn;
  }
});

test("every background, and lines over the model", { ...ALL_PASSES, draws: true }, async (page) => {
  await inStep(page);
  const backdrop = await picture(page, { ...SIZE, background: "backdrop" });
  const sky = await picture(page, { ...SIZE, background: "sky" });
  const coloured = await picture(page, { ...PLAIN, background: "#3060a0" });
  const nothing = await picture(page, { ...SIZE, background: "none" });
  const transparent = await picture(page, { ...SIZE, transparent: true });
  assert.ok(difference(backdrop, sky) > 0.3, "the sky is not the backdrop");
  assert.deepEqual([...coloured.pixels.subarray(0, 4)], [0x30, 0x60, 0xa0, 255], "a colour is that very colour");
  assert.equal(backdrop.clear, 0);
  assert.ok(nothing.clear > 0.3 && nothing.clear < 0.95, `${nothing.clear} of the pixels are clear`);
  assert.equal(transparent.digest, nothing.digest);
  await assertGolden(page, "sky", sky);
  await assertGolden(page, "nothing", nothing);

  const plain = await picture(page, PLAIN);
  for (const overlay of ["grid", "wireframe", "normals", "tangents", "bounds", "axes"]) {
    const drawn = await picture(page, { ...PLAIN, overlays: [overlay] });
    assert.ok(difference(drawn, plain) > 0.003, `${overlay}: ${difference(drawn, plain)} of the pixels differ`);
  }
  const lines = await picture(page, { ...PLAIN, viewMode: "material", overlays: ["wireframe", "bounds", "axes"] });
  await assertGolden(page, "lines", lines);
});

test("a model of the first book, in both lights", { ...ALL_PASSES, draws: true }, async (page) => {
  await dropAndWait(page, [`${FIXTURES}good/d3d11_static.m3d`]);
  // Its two triangles lie in the same place: the rounding of depths would decide which of them is seen.
  await page.evaluate(() => (location.hash = "hide=1"));
  await page.waitForFunction(() => bindpose.state().link.includes("hide=1"));
  await settled(page);
  const book = await picture(page, { ...PLAIN, light: "book" });
  const studio = await picture(page, { ...PLAIN, light: "studio" });
  assert.ok(difference(book, studio) > 0.02, `${difference(book, studio)} of the pixels tell the lights apart`);
  await assertGolden(page, "phong-book", book);
  await assertGolden(page, "phong-studio", studio);
});

test("what a script asks for changes the picture and not the page", { ...ALL_PASSES, draws: true }, async (page) => {
  await inStep(page);
  const { look } = await state(page);
  const before = await picture(page);
  assertDrawn(before);
  await picture(page, { light: "book", viewMode: "uv", background: "sky", split: 0.3, overlays: ["axes"] });
  assert.deepEqual((await state(page)).look, look);
  assert.equal((await picture(page)).digest, before.digest);
});

test("names that are none are refused with words", {}, async (page) => {
  const refused = (options) =>
    page.evaluate((options) => bindpose.snapshot(options).then(() => "drawn", (error) => error.message), options);
  for (const [options, words] of [
    [{ light: "sun" }, /^light has no such value/],
    [{ light: 3 }, /^light has no such value/],
    [{ viewMode: "Lit" }, /^viewMode has no such value/],
    [{ background: "#12345" }, /^background has no such value/],
    [{ split: 1.5 }, /^split must be a number from 0 to 1$/],
    [{ split: "half" }, /^split must be a number from 0 to 1$/],
    [{ overlays: "grid" }, /^overlays must be an array of names$/],
    [{ overlays: ["grid", "lines"] }, /^overlays must be an array of names$/],
    [{ width: 0 }, /^width must be a number from 1 to \d+$/],
    [{ height: 1e6 }, /^height must be a number from 1 to \d+$/],
  ]) {
    assert.match(await refused({ ...SIZE, ...options }), words, JSON.stringify(options));
  }
});
