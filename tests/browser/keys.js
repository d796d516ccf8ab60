// Every key does what the table behind `?` says, in the order of that table: what is asked for is read from the state.

import assert from "node:assert/strict";
import { atRest, call, drag, settled, state, test, until } from "./harness.js";
import { decoded, difference, picture } from "./picture.js";
import { GROUND } from "./widgets.js";

/** So too in a window so small that this GPU of software draws many frames a second: there are many keys. */
const SMALL = { viewport: { width: 360, height: 300 } };
/** Ground beside the figure there. */
const SMALL_GROUND = [50, 150];

/** Gives the view the keyboard, with a click that selects nothing. */
async function focusView(page, ground = SMALL_GROUND) {
  await page.mouse.click(...ground);
  await settled(page);
}

/** Presses the keys of a table, one after the other, and waits until the state is what the table says of each. */
async function presses(page, table) {
  let before = await state(page);
  for (const [key, words, holds] of table) {
    await page.keyboard.press(key);
    before = await until(page, (now) => holds(now, before)).catch((error) => {
      throw new Error(`${key}: ${words}`, { cause: error });
    });
  }
  return before;
}

const near = (one, other, tolerance = 1e-3) => Math.abs(one - other) <= tolerance;

/** Whether the time is that of a frame: the clips of the sample have 30 in a second and begin at 0. */
const atFrame = (frame) => ({ timeSecs }) => near(30 * timeSecs, frame);
const range = (first, last) => ({ rangeSecs }) => near(30 * rangeSecs?.[0], first) && near(30 * rangeSecs?.[1], last);

test("the keys for time", SMALL, async (page) => {
  await focusView(page);
  await call(page, "selectClip", "Walk");
  const { model } = await state(page);
  const names = model.clips.map(({ name }) => name);
  const walk = names.indexOf("Walk");
  const { startSecs, endSecs, keysPerSec } = model.clips[walk];
  assert.deepEqual([startSecs, Math.round(endSecs * keysPerSec), keysPerSec], [0, 32, 30], "the clip that the table is made for");
  await presses(page, [
    ["Space", "plays", ({ playing, backward }) => playing && !backward],
    ["Space", "pauses", ({ playing }) => !playing],
    ["Shift+Space", "plays backward", ({ playing, backward }) => playing && backward],
    ["Space", "pauses that too", ({ playing }) => !playing],
    ["End", "last frame", atFrame(32)],
    ["Home", "first frame", atFrame(0)],
    ["ArrowRight", "one frame on", atFrame(1)],
    ["Period", "and with the period", atFrame(2)],
    ["Shift+ArrowRight", "ten frames on", atFrame(12)],
    ["Shift+Period", "and with the period", atFrame(22)],
    ["ArrowLeft", "one frame back", atFrame(21)],
    ["Comma", "and with the comma", atFrame(20)],
    ["Shift+ArrowLeft", "ten frames back", atFrame(10)],
    ["Shift+Comma", "and with the comma", atFrame(0)],
    ["ArrowUp", "the next key: there is one in each frame", atFrame(1)],
    ["ArrowDown", "the key before", atFrame(0)],
    ["Shift+ArrowRight", "ten frames on", atFrame(10)],
    ["i", "the range begins here", range(10, 32)],
    ["Shift+ArrowRight", "ten frames on", atFrame(20)],
    ["o", "the range ends here", range(10, 20)],
    ["Home", "first frame of the range", atFrame(10)],
    ["End", "last frame of the range", atFrame(20)],
    ["Shift+I", "no range", ({ rangeSecs }) => rangeSecs === null],
    ["[", "slower", ({ speed }, before) => speed < before.speed],
    ["]", "faster", ({ speed }) => speed === 1],
    ["]", "faster", ({ speed }) => speed > 1],
    ["\\", "as the clip has it", ({ speed }) => speed === 1],
    ["l", "there and back", ({ loop }, before) => before.loop === "loop" && loop === "pingpong"],
    ["l", "once", ({ loop }) => loop === "once"],
    ["l", "and round again", ({ loop }) => loop === "loop"],
    ["c", "next clip", ({ clip }) => clip === names[walk + 1]],
    ["Shift+C", "previous clip", ({ clip }) => clip === "Walk"],
    ...names.slice(0, walk).reverse().map((name) => ["Shift+C", "the one before", ({ clip }) => clip === name]),
    ["Shift+C", "and round", ({ clip }) => clip === names.at(-1)],
  ]);
});

test("the keys for bones and skin", { ...SMALL, draws: true }, async (page) => {
  await focusView(page);
  const before = await picture(page);
  await presses(page, [
    ["b", "bones", ({ skeleton }) => skeleton.bonesVisible],
    ["b", "no bones", ({ skeleton }) => !skeleton.bonesVisible],
    ["Shift+B", "bones with names", ({ skeleton }) => skeleton.bonesVisible && skeleton.labelsVisible],
    ["Shift+B", "no names", ({ skeleton }) => skeleton.bonesVisible && !skeleton.labelsVisible],
    ["b", "no bones again", ({ skeleton }) => !skeleton.bonesVisible],
    ["w", "weights", ({ skeleton }) => skeleton.skinView === "weight"],
    ["w", "the skin as it is", ({ skeleton }) => skeleton.skinView === null],
    ["k", "bind pose", ({ skeleton }) => skeleton.bindShare === 1],
    ["k", "the clip", ({ skeleton }) => skeleton.bindShare === 0],
  ]);
  // The view is framed again when a chip went.
  await atRest(page);
  // It is a rounding apart then.
  assert.ok(difference(await picture(page), before) < 0.001, "each takes away what it brought");
  for (const [key, fraction] of [["b", 0.001], ["w", 0.008], ["k", 0.008]]) {
    await page.keyboard.press(key);
    await settled(page);
    const drawn = await picture(page);
    assert.ok(difference(before, drawn) > fraction, `${key}: ${difference(before, drawn)} of the pixels`);
    await page.keyboard.press(key);
    await settled(page);
  }
});

test("the keys for the look", SMALL, async (page) => {
  await focusView(page);
  const overlay = (name) => ({ look }, before) => look.overlays.includes(name) !== before.look.overlays.includes(name);
  const twice = (key, name) => [[key, name, overlay(name)], [key, `${name} as before`, overlay(name)]];
  await presses(page, [
    ["t", "next view mode", ({ look }) => look.viewMode !== "lit"],
    ["Shift+T", "previous view mode", ({ look }) => look.viewMode === "lit"],
    ["v", "book light", ({ look }) => look.light === "book"],
    ["v", "studio light", ({ look }) => look.light === "studio"],
    ...twice("g", "grid"),
    ...twice("z", "wireframe"),
    ...twice("n", "normals"),
    ...twice("x", "axes"),
  ]);
});

/** Where the table of keys hangs from its button. */
const HELP = { x: 640, y: 60, width: 308, height: 400 };

test("the question mark shows the table, and again takes it away", {}, async (page) => {
  await focusView(page, GROUND);
  const shown = async () => {
    await atRest(page);
    return decoded(page, await page.screenshot({ clip: HELP }));
  };
  const without = await shown();
  await page.keyboard.press("?");
  assert.ok(difference(without, await shown()) > 0.5);
  await page.keyboard.press("?");
  assert.equal(difference(without, await shown()), 0);
  await page.keyboard.press("?");
  await settled(page);
  await page.keyboard.press("Escape");
  assert.equal(difference(without, await shown()), 0, "Esc too");
});

/** From where the camera looks, in radians; a whole turn more or less is the same. */
const from = (yaw, pitch) => ({ camera }) =>
  near(Math.sin((camera.yawRadians - yaw) / 2), 0) && near(camera.pitchRadians, pitch);
const sameView = ({ camera }, { camera: other }) =>
  ["yawRadians", "pitchRadians"].every((field) => near(camera[field], other[field])) &&
  near(camera.distance / other.distance, 1) &&
  camera.target.every((at, axis) => near(at / other.distance, other.target[axis] / other.distance));

test("the keys for the camera", SMALL, async (page) => {
  await focusView(page);
  const first = await state(page);
  const turned = ({ camera }) => Math.sin(camera.yawRadians - first.camera.yawRadians);
  const steep = ({ camera }) => Math.abs(camera.pitchRadians) > 1.5;
  await presses(page, [
    ["1", "front", from(0, 0)],
    ["1", "again: back", from(Math.PI, 0)],
    ["3", "right", from(Math.PI / 2, 0)],
    ["3", "again: left", from(-Math.PI / 2, 0)],
    ["7", "top", (now) => steep(now) && now.camera.pitchRadians > 0],
    ["7", "again: below", (now) => steep(now) && now.camera.pitchRadians < 0],
    ["9", "isometric", from(-Math.PI / 4, Math.atan(Math.SQRT1_2))],
    ["5", "orthographic", ({ camera }) => camera.orthographic],
    ["5", "perspective", ({ camera }) => !camera.orthographic],
    ["0", "as at first", (now) => sameView(now, first)],
    ["+", "nearer", ({ camera }) => camera.distance < 0.99 * first.camera.distance],
    ["-", "as far as before", ({ camera }) => near(camera.distance / first.camera.distance, 1)],
    ["Alt+ArrowLeft", "to its left", (now) => turned(now) > 0.05],
    ["Alt+ArrowRight", "back", (now) => near(turned(now), 0)],
    ["Alt+ArrowUp", "up", ({ camera }) => camera.pitchRadians > first.camera.pitchRadians + 0.05],
    ["Alt+Shift+ArrowUp", "the target moves up", ({ camera }) => camera.target[1] > first.camera.target[1]],
    ["0", "as at first again", (now) => sameView(now, first)],
  ]);
  assert.equal((await state(page)).timeSecs, first.timeSecs, "no frame was stepped");
});

test("the browser does not go back in its history by Alt and an arrow", { ...SMALL, own: true }, async (page) => {
  await page.evaluate(() => history.pushState("there", ""));
  await focusView(page);
  await page.keyboard.press("Alt+ArrowLeft");
  await atRest(page);
  assert.equal(await page.evaluate(() => history.state), "there");
});

test("Ctrl+Z takes an edit back and Ctrl+Shift+Z does it again, as calls do", SMALL, async (page) => {
  await focusView(page);
  const { undo, redo } = await state(page);
  assert.deepEqual([undo, redo], [null, null]);
  await call(page, "setRangeStart", 0.2);
  await call(page, "setRangeEnd", 0.6);
  const { rangeSecs } = await until(page, (now) => now.undo === "set the range");
  await page.keyboard.press("Control+z");
  await until(page, (now) => now.redo === "set the range" && now.rangeSecs[1] > rangeSecs[1]);
  await page.keyboard.press("Control+z");
  await until(page, (now) => now.undo === null && now.rangeSecs === null);
  await page.keyboard.press("Control+Shift+z");
  await page.keyboard.press("Control+y");
  assert.deepEqual((await until(page, (now) => now.redo === null)).rangeSecs, rangeSecs);
  await call(page, "undo");
  await call(page, "undo");
  assert.equal((await state(page)).rangeSecs, null);
  await call(page, "redo");
  assert.equal((await state(page)).undo, "set the range");
});

test("the mouse orbits, pans and zooms, and F frames the model again", SMALL, async (page) => {
  await focusView(page);
  const first = await state(page);
  await drag(page, SMALL_GROUND, [SMALL_GROUND[0] + 50, SMALL_GROUND[1] - 20]);
  const orbited = await atRest(page);
  assert.ok(!near(orbited.camera.yawRadians, first.camera.yawRadians, 0.1), "a drag turns the view");
  assert.ok(!near(orbited.camera.pitchRadians, first.camera.pitchRadians, 0.05), "up and down too");
  assert.deepEqual(orbited.camera.target, first.camera.target);
  let before = orbited;
  for (const button of ["right", "middle"]) {
    await drag(page, SMALL_GROUND, [SMALL_GROUND[0] + 40, SMALL_GROUND[1] - 15], { button });
    const panned = await atRest(page);
    const { target, ...turn } = panned.camera;
    assert.deepEqual({ ...before.camera, target }, { ...turn, target }, `${button}: nothing turns`);
    assert.ok(target.some((at, axis) => !near(at, before.camera.target[axis], 0.05)), `${button}: the view moves`);
    before = panned;
  }
  await page.mouse.wheel(0, -240);
  const zoomed = await until(page, ({ camera }) => camera.distance < 0.8 * before.camera.distance);
  await atRest(page);
  await page.keyboard.press("f");
  const framed = await until(page, ({ camera }) => camera.distance > 1.1 * zoomed.camera.distance);
  assert.deepEqual(
    [framed.camera.yawRadians, framed.camera.pitchRadians],
    [orbited.camera.yawRadians, orbited.camera.pitchRadians],
    "from where it looked",
  );
  await page.keyboard.press("0");
  await until(page, (now) => sameView(now, first));
});

/** What has the keyboard: the canvas, the viewer's hidden input, or another control of the page by its id. */
function focused(page) {
  return page.evaluate(() => {
    const { id, localName, parentElement } = document.activeElement;
    return parentElement?.id === "view" ? localName : id || localName;
  });
}

test("while nothing has the focus keys go to the only viewer, and it gets the focus by those that it acts on", {}, async (page) => {
  await page.evaluate(() => document.activeElement?.blur());
  assert.equal(await focused(page), "body");
  await page.keyboard.press("F9");
  assert.equal(await focused(page), "body", "a key that the viewer has no use for changes nothing");
  await page.keyboard.press("Space");
  await until(page, ({ playing }) => playing);
  assert.equal(await focused(page), "canvas");
  await page.keyboard.press("Space");
  await until(page, ({ playing }) => !playing);

  await page.evaluate(() => document.activeElement.blur());
  await page.evaluate(() => bindpose.open([{ name: "bad.m3d", bytes: new Uint8Array([35, 10]) }]));
  await until(page, ({ error }) => error !== null);
  await page.keyboard.press("Escape");
  await until(page, ({ error }) => error === null);
});

test("the input for what is typed has a name and is passed over by Tab", {}, async (page) => {
  const inputs = await page.$$eval("#view canvas + input", (inputs) => inputs.map((input) => [input.tabIndex, input.ariaLabel]));
  assert.deepEqual(inputs, [[-1, "Text of the field in the 3D view"]]);
});
