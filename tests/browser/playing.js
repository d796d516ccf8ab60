// Time: it advances, it can be scrubbed, and the same time is the same picture. Keys, and the transport in the DOM.

import assert from "node:assert/strict";
import { CENTRE, atRest, call, keep, settled, state, test, until } from "./harness.js";
import { difference, picture } from "./picture.js";

test("time advances, with events, and pauses", {}, async (page) => {
  await page.evaluate(() => {
    globalThis.heard = [];
    for (const type of ["timeupdate", "play", "pause"]) bindpose.addEventListener(type, () => heard.push(type));
  });
  const first = (await state(page)).timeSecs;
  await until(page, ({ timeSecs }) => Math.abs(timeSecs - first) > 0.05);
  await call(page, "pause");
  const { timeSecs, playing } = await state(page);
  assert.equal(playing, false);
  await page.waitForTimeout(300);
  assert.equal((await state(page)).timeSecs, timeSecs, "paused time stands still");
  await call(page, "play");
  await until(page, (now) => now.timeSecs !== timeSecs);
  const heard = await page.evaluate(() => [...new Set(heard)].sort());
  assert.deepEqual(heard, ["pause", "play", "timeupdate"]);
});

test("scrubbing moves pixels, and the same time is the same picture", {}, async (page) => {
  await call(page, "pause");
  const [first] = (await state(page)).model.clips;
  await call(page, "selectClip", first.name);
  await settled(page);
  const at = async (part) => {
    await call(page, "seek", first.startSecs + part * (first.endSecs - first.startSecs));
    return picture(page);
  };
  const [one, other, again] = [await at(0.2), await at(0.6), await at(0.2)];
  assert.ok(difference(one, other) > 0.005, `${difference(one, other)} of the pixels moved`);
  assert.equal(again.digest, one.digest, "to the last bit");
});

test("seeking stays inside the clip", {}, async (page) => {
  await call(page, "pause");
  const { clip, model } = await state(page);
  const { startSecs, endSecs } = model.clips.find(({ name }) => name === clip);
  for (const [asked, expected] of [[-5, startSecs], [1e9, endSecs]]) {
    await call(page, "seek", asked);
    const { timeSecs } = await state(page);
    assert.ok(Math.abs(timeSecs - expected) < 1e-4, `${asked} became ${timeSecs}, not ${expected}`);
  }
  await call(page, "seek", (startSecs + endSecs) / 2);
  const { timeSecs } = await state(page);
  await call(page, "seek", NaN);
  assert.equal((await state(page)).timeSecs, timeSecs, "a time that is no number changes nothing");
});

test("a clip is chosen by its name; a name that is not there changes nothing", {}, async (page) => {
  const { model } = await state(page);
  await call(page, "selectClip", model.clips[1].name);
  await until(page, ({ clip }) => clip === model.clips[1].name);
  await call(page, "selectClip", "no such clip");
  assert.equal((await state(page)).clip, model.clips[1].name);
});

/** Presses keys in the viewer, the way a person does after a click into the view. */
async function focusView(page) {
  await page.mouse.click(...CENTRE);
  await settled(page);
}

test("the keys do what they say", {}, async (page) => {
  await focusView(page);
  await page.keyboard.press("Space");
  await until(page, ({ playing }) => !playing);
  await page.keyboard.press("Home");
  const { clip, model } = await state(page);
  const { startSecs, endSecs } = model.clips.find(({ name }) => name === clip);
  await until(page, ({ timeSecs }) => Math.abs(timeSecs - startSecs) < 1e-4);
  await page.keyboard.press("ArrowRight");
  await until(page, ({ timeSecs }) => timeSecs > startSecs + 1e-4);
  const frame = (await state(page)).timeSecs - startSecs;
  await page.keyboard.press("Shift+ArrowRight");
  await until(page, ({ timeSecs }) => timeSecs > startSecs + frame * 1.5);
  const eleven = (await state(page)).timeSecs - startSecs;
  assert.ok(Math.abs(eleven - Math.min(11 * frame, endSecs - startSecs)) < frame / 2, `${eleven} is not eleven of ${frame}`);
  await page.keyboard.press("ArrowLeft");
  await until(page, ({ timeSecs }) => timeSecs < startSecs + eleven - 1e-4);
  await page.keyboard.press("End");
  await until(page, ({ timeSecs }) => Math.abs(timeSecs - endSecs) < 1e-4);
  await page.keyboard.press("c");
  await until(page, (now) => now.clip !== clip);
  await page.keyboard.press("Shift+C");
  await until(page, (now) => now.clip === clip);
});

test("the keys for speed and loop", {}, async (page) => {
  await focusView(page);
  const speed = (await state(page)).speed;
  assert.equal(speed, 1);
  await page.keyboard.press("[");
  await until(page, ({ speed }) => speed < 1);
  await page.keyboard.press("]");
  await page.keyboard.press("]");
  await until(page, ({ speed }) => speed > 1);
  await page.keyboard.press("\\");
  await until(page, ({ speed }) => speed === 1);
  const loops = [];
  for (let press = 0; press < 3; press += 1) {
    const { loop } = await state(page);
    loops.push(loop);
    await page.keyboard.press("l");
    await until(page, (now) => now.loop !== loop);
  }
  assert.equal(new Set(loops).size, 3, loops.join(", "));
  assert.equal((await state(page)).loop, loops[0], "and round again");
});

test("the mouse orbits, the wheel zooms and F frames the model again", {}, async (page) => {
  await call(page, "pause");
  await focusView(page);
  const before = await picture(page);
  await page.mouse.move(...CENTRE);
  await page.mouse.down();
  await page.mouse.move(CENTRE[0] + 120, CENTRE[1] + 30, { steps: 6 });
  await page.mouse.up();
  await atRest(page);
  const orbited = await picture(page);
  assert.ok(difference(before, orbited) > 0.01, "a drag turns the view");
  for (let turn = 0; turn < 5; turn += 1) await page.mouse.wheel(0, -240);
  await settled(page);
  await settled(page);
  const zoomed = await picture(page);
  assert.ok(difference(orbited, zoomed) > 0.01, "the wheel zooms");
  await page.keyboard.press("f");
  await page.waitForTimeout(1000);
  const framed = await picture(page);
  assert.ok(difference(zoomed, framed) > 0.01, "F moves the camera back");
});

test("the transport is there for screen readers and moves with the viewer", {}, async (page) => {
  await page.focus("#transport-play");
  await page.keyboard.press("Space");
  await until(page, ({ playing }) => !playing);
  await settled(page);
  await keep(page, "transport-focused");
  assert.equal(await page.textContent("#transport-play"), "Play");
  const { model } = await state(page);
  await page.selectOption("#transport-clip", model.clips[1].name);
  await until(page, ({ clip }) => clip === model.clips[1].name);
  await page.focus("#transport-time");
  await page.keyboard.press("End");
  await until(page, ({ timeSecs }) => Math.abs(timeSecs - model.clips[1].endSecs) < 1e-3);
  assert.match(await page.getAttribute("#transport-time", "aria-valuetext"), /seconds$/);
});

test("Escape, then Tab leaves the viewer; Tab alone stays in it", {}, async (page) => {
  await focusView(page);
  const inside = () => page.evaluate(() => document.getElementById("view").contains(document.activeElement));
  assert.equal(await inside(), true);
  await page.keyboard.press("Tab");
  assert.equal(await inside(), true);
  await page.keyboard.press("Escape");
  for (let press = 0; press < 3 && (await inside()); press += 1) await page.keyboard.press("Tab");
  assert.equal(await inside(), false);
  assert.match(await page.evaluate(() => document.activeElement.id), /^transport-/);
});
