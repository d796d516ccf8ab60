// Looking at the model by mouse and keys: lights, modes, lines, the divided picture, the surroundings, a sky.

import assert from "node:assert/strict";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { atRest, drag, drop, keep, settled, state, test, until } from "./harness.js";
import { difference, picture } from "./picture.js";
import { GROUND, place, click } from "./widgets.js";


/** Gives the view the keyboard, with a click that selects nothing. */
async function focusView(page) {
  await page.mouse.click(...GROUND);
  await settled(page);
}

/** Presses a key and waits until the look says what came of it. */
async function press(page, key, predicate) {
  await page.keyboard.press(key);
  return (await until(page, ({ look }) => predicate(look))).look;
}

test("V switches the light, and back to the same picture", { draws: true }, async (page) => {
  await focusView(page);
  const studio = await picture(page);
  await press(page, "v", ({ light }) => light === "book");
  const book = await picture(page);
  assert.ok(difference(studio, book) > 0.05, `${difference(studio, book)} of the pixels`);
  await atRest(page);
  await keep(page, "look-book");
  await press(page, "v", ({ light }) => light === "studio");
  // What the visor mirrors may have become finer meanwhile.
  const back = difference(studio, await picture(page));
  assert.ok(back < 0.02, `${back} of the pixels`);
});

test("T goes through the view modes and round again", { draws: true }, async (page) => {
  await focusView(page);
  const lit = await picture(page);
  const modes = [(await state(page)).look.viewMode];
  do {
    const { viewMode } = await press(page, "t", ({ viewMode }) => viewMode !== modes.at(-1));
    modes.push(viewMode);
  } while (modes.at(-1) !== "lit" && modes.length < 20);
  assert.equal(modes.length, 13, modes.join(", "));
  assert.equal(new Set(modes).size, 12);
  assert.equal((await picture(page)).digest, lit.digest);
  await press(page, "Shift+T", ({ viewMode }) => viewMode === modes.at(-2));
  assert.ok(difference(lit, await picture(page)) > 0.05);
  await atRest(page);
});

test("the keys for lines draw them and take them away", { draws: true }, async (page) => {
  await focusView(page);
  const before = await picture(page);
  for (const [key, overlay] of [["z", "wireframe"], ["n", "normals"], ["x", "axes"], ["g", "grid"]]) {
    const was = (await state(page)).look.overlays.includes(overlay);
    await press(page, key, ({ overlays }) => overlays.includes(overlay) !== was);
    const drawn = await picture(page);
    assert.ok(difference(before, drawn, { tolerance: 4 }) > 0.001, `${overlay}: ${difference(before, drawn)}`);
    await press(page, key, ({ overlays }) => overlays.includes(overlay) === was);
    assert.equal((await picture(page)).digest, before.digest, `${overlay} is gone again`);
  }
  await press(page, "z", ({ overlays }) => overlays.includes("wireframe"));
  await press(page, "n", ({ overlays }) => overlays.includes("normals"));
  await atRest(page);
  await keep(page, "look-lines");
});

test("Alt and a drag turn the surroundings, and the camera stays", { draws: true }, async (page) => {
  await focusView(page);
  const [before, { camera }] = [await picture(page), await state(page)];
  await page.keyboard.down("Alt");
  await drag(page, GROUND, [GROUND[0] - 150, GROUND[1]]);
  await page.keyboard.up("Alt");
  const after = await atRest(page);
  assert.deepEqual(after.camera, camera);
  const turned = await picture(page);
  assert.ok(difference(before, turned) > 0.02, `${difference(before, turned)} of the pixels`);
});

test("the picture is divided, and its handle moves where the lights meet", { draws: true, passes: true }, async (page) => {
  await click(page, "light");
  await settled(page);
  await click(page, "split");
  await until(page, ({ look }) => look.split === 0.5);
  await keep(page, "look-light-popover");
  await page.keyboard.press("Escape");
  await settled(page);
  const handle = await place(page, "split-handle");
  const target = [430, handle[1]];
  await drag(page, handle, target);
  const { split } = (await until(page, ({ look }) => look.split !== 0.5)).look;
  await atRest(page);
  assert.ok(Math.abs(split - target[0] / 960) < 0.01, `${split}`);
  const { split: at } = (await state(page)).look;
  const divided = await picture(page);
  const [book, studio] = [await picture(page, { light: "book" }), await picture(page, { light: "studio" })];
  const [left, right] = [{ columns: [0, at - 0.01], tolerance: 0 }, { columns: [at + 0.01, 1], tolerance: 0 }];
  assert.equal(difference(divided, book, left), 0, "the book's light is on the left");
  assert.equal(difference(divided, studio, right), 0, "the studio is on the right");
  for (const half of [left, right]) assert.ok(difference(book, studio, { ...half, tolerance: 8 }) > 0.02, "they differ there");
  await keep(page, "look-split");
});

test("a pass that is left out is missing in the picture", { draws: true, passes: true }, async (page) => {
  await click(page, "light");
  await settled(page);
  for (const pass of ["shadow", "reflections", "contact", "ao"]) {
    const before = await picture(page);
    assert.equal((await state(page)).look.passes[pass], "drawn");
    await click(page, pass);
    await until(page, ({ look }) => look.passes[pass] === "off");
    const without = await picture(page);
    assert.ok(difference(before, without, { tolerance: 2 }) > 0.002, `${pass}: ${difference(before, without, { tolerance: 2 })}`);
  }
  await atRest(page);
  await keep(page, "look-passes-off");
});

/** A cube map as a DDS file: six faces of one colour each (blue, green, red, alpha), uncompressed. */
function cubeMap(faces, side = 8) {
  const header = Buffer.alloc(128);
  header.write("DDS ", "latin1");
  const words = { 4: 124, 8: 0x100f, 12: side, 16: side, 20: side * 4, 76: 32, 80: 0x41, 88: 32, 108: 0x1008, 112: 0xfe00 };
  for (const [at, word] of Object.entries(words)) header.writeUInt32LE(word, Number(at));
  for (const [index, mask] of [0xff0000, 0xff00, 0xff, 0xff000000].entries()) header.writeUInt32LE(mask, 92 + 4 * index);
  const texels = faces.map((face) => Buffer.alloc(side * side * 4, Buffer.from(face)));
  return Buffer.concat([header, ...texels]);
}

test("a dropped cube map becomes the sky and lights the model", { draws: true }, async (page) => {
  await atRest(page);
  const before = await picture(page, { background: "none" });
  const file = join(mkdtempSync(join(tmpdir(), "bindpose-")), "evening.dds");
  const [red, grey] = [[0, 0, 255, 255], [128, 128, 128, 255]];
  writeFileSync(file, cubeMap([red, red, grey, grey, red, red]));
  await drop(page, [file]);
  await until(page, ({ look }) => look.background === "sky");
  await atRest(page);
  const { model, error } = await state(page);
  assert.equal(model.name, "figure.m3d");
  assert.equal(error, null);
  const sky = await picture(page);
  const [r, g, b] = sky.pixels.subarray(4 * (sky.width * (sky.height / 2) + 2));
  assert.ok(r > 2 * g && r > 2 * b, `the horizon is red: ${r}, ${g}, ${b}`);
  const lit = await picture(page, { background: "none" });
  assert.ok(difference(before, lit) > 0.02, `${difference(before, lit)} of the pixels are lit by it`);
  await keep(page, "look-sky");
});
