// Time: it advances, it can be scrubbed, and the same time is the same picture.

import assert from "node:assert/strict";
import { atRest, call, drag, keep, settled, state, test, until } from "./harness.js";
import { difference, picture } from "./picture.js";
import { bounds, place, click, timeBar } from "./widgets.js";

test("time advances, with events, and pauses", { motion: true }, async (page) => {
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

test("scrubbing moves pixels, and the same time is the same picture", { draws: true }, async (page) => {
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
});

test("a clip is chosen by its name; a name that is not there changes nothing", {}, async (page) => {
  const { model } = await state(page);
  await call(page, "selectClip", model.clips[1].name);
  await until(page, ({ clip }) => clip === model.clips[1].name);
  await call(page, "selectClip", "no such clip");
  assert.equal((await state(page)).clip, model.clips[1].name);
});

/** Gives where a fraction of the clip is on the bar. */
async function barOf(page) {
  const { first, last, y } = timeBar(await bounds(page, "time"));
  return (fraction) => [first + fraction * (last - first), y];
}

/** The state when the time stands still: of a clip that plays, while the pointer holds it. */
async function held(page) {
  let before = await state(page);
  for (let round = 0; round < 20; round += 1) {
    await settled(page);
    const now = await state(page);
    if (now.timeSecs === before.timeSecs) return now;
    before = now;
  }
  throw new Error("the time goes on");
}

test("a drag on the bar carries the time, which goes on from there", { motion: true }, async (page) => {
  const { clip, model } = await state(page);
  const { startSecs, endSecs } = model.clips.find(({ name }) => name === clip);
  const fractionOf = ({ timeSecs }) => (timeSecs - startSecs) / (endSecs - startSecs);
  // The strip can be taken hold of once it was drawn.
  await settled(page);
  const onBar = await barOf(page);
  await page.mouse.move(...onBar(0.2));
  await page.mouse.down();
  for (const fraction of [0.4, 0.9, 0.3]) {
    await page.mouse.move(...onBar(fraction), { steps: 3 });
    // A point is a three hundredth of the clip.
    await until(page, (now) => Math.abs(fractionOf(now) - fraction) < 0.004);
    const now = await held(page);
    assert.ok(Math.abs(fractionOf(now) - fraction) < 0.004, `held at ${fraction}, the time stands at ${fractionOf(now)}`);
    assert.equal(now.playing, true, "the pointer holds the time; it is not paused");
  }
  await page.mouse.move(onBar(1)[0] + 200, onBar(1)[1]);
  await until(page, (now) => Math.abs(fractionOf(now) - 1) < 1e-4);
  await page.mouse.move(...onBar(0.5));
  await until(page, (now) => Math.abs(fractionOf(now) - 0.5) < 0.004);
  await page.mouse.up();
  await until(page, (now) => Math.abs(fractionOf(now) - 0.5) > 0.01);
  assert.equal((await state(page)).playing, true);
});

test("a click on the bar of a paused clip goes there and stays", {}, async (page) => {
  await page.mouse.click(...(await barOf(page))(0.75));
  const { timeSecs, playing } = await until(page, ({ timeSecs }) => timeSecs > 0);
  assert.equal(playing, false);
  const { model } = await state(page);
  assert.ok(Math.abs(timeSecs / model.clips[0].endSecs - 0.75) < 0.004, `${timeSecs} s`);
  await settled(page);
  assert.equal((await state(page)).timeSecs, timeSecs);
});

test("the ends of the range are dragged from frame to frame, and playing stays between them", {}, async (page) => {
  await call(page, "pause");
  await call(page, "selectClip", "Walk");
  // The bar becomes another one.
  await atRest(page);
  const frames = 32;
  const onBar = await barOf(page);
  await drag(page, await place(page, "range-out"), onBar(20.2 / frames));
  const within = (first, last) => ({ rangeSecs }) =>
    [first, last].every((frame, end) => Math.abs(30 * rangeSecs?.[end] - frame) < 1e-3);
  await until(page, within(0, 20));
  await drag(page, await place(page, "range-in"), onBar(9.8 / frames));
  const { rangeSecs } = await until(page, within(10, 20));
  await settled(page);
  await keep(page, "range");
  await page.evaluate(() => {
    globalThis.times = [];
    bindpose.addEventListener("timeupdate", ({ detail }) => times.push(detail.timeSecs));
  });
  await call(page, "play");
  await page.waitForFunction(() => times.length > 12);
  const times = await page.evaluate(() => times);
  const outside = times.filter((secs) => secs < rangeSecs[0] - 1e-4 || secs > rangeSecs[1] + 1e-4);
  assert.deepEqual(outside, [], `of ${times}`);
  await page.mouse.dblclick(...onBar((20 + 0.4) / frames));
  await until(page, ({ rangeSecs }) => rangeSecs === null);
});

test("calls that make no sense throw, say what they take, and change nothing", {}, async (page) => {
  const before = await state(page);
  const thrown = await page.evaluate(() => {
    const calls = {
      seek: [NaN, Infinity, "x", undefined],
      stepFrames: [1.5, NaN, "1"],
      setRangeStart: [NaN, {}],
      setRangeEnd: [-Infinity, "0.5"],
      setSpeed: [-3, 0, NaN, "fast"],
      setRenderScale: [0, NaN],
      setLoop: [5],
      selectClip: [undefined],
      setCrowd: [5, undefined, { count: 2.5 }, { count: "3" }, { count: 3, seed: -1 }, { seed: 2 ** 32 }, { count: 3, selected: NaN }],
    };
    const outcome = (name, value) => {
      try {
        bindpose[name](value);
        return `${name} took ${String(value)}`;
      } catch (error) {
        return `${error.name}: ${error.message}`;
      }
    };
    return Object.entries(calls).flatMap(([name, values]) => values.map((value) => outcome(name, value)));
  });
  assert.deepEqual(thrown, [
    "RangeError: seek takes a finite number of seconds, not NaN",
    "RangeError: seek takes a finite number of seconds, not Infinity",
    'TypeError: seek takes a finite number of seconds, not "x"',
    "TypeError: seek takes a finite number of seconds, not undefined",
    "RangeError: stepFrames takes a whole number, not 1.5",
    "RangeError: stepFrames takes a whole number, not NaN",
    'TypeError: stepFrames takes a whole number, not "1"',
    "RangeError: setRangeStart takes a finite number of seconds, not NaN",
    "TypeError: setRangeStart takes a finite number of seconds, not an object",
    "RangeError: setRangeEnd takes a finite number of seconds, not -Infinity",
    'TypeError: setRangeEnd takes a finite number of seconds, not "0.5"',
    "RangeError: setSpeed takes a finite number above 0, not -3",
    "RangeError: setSpeed takes a finite number above 0, not 0",
    "RangeError: setSpeed takes a finite number above 0, not NaN",
    'TypeError: setSpeed takes a finite number above 0, not "fast"',
    "RangeError: setRenderScale takes a finite number above 0, not 0",
    "RangeError: setRenderScale takes a finite number above 0, not NaN",
    "TypeError: setLoop takes a name, not 5",
    "TypeError: selectClip takes a name, not undefined",
    "TypeError: setCrowd takes an object, not 5",
    "TypeError: setCrowd takes an object, not undefined",
    "RangeError: setCrowd({count}) takes a whole number, not 2.5",
    'TypeError: setCrowd({count}) takes a whole number, not "3"',
    "RangeError: setCrowd({seed}) takes a whole number from 0 to 4294967295, not -1",
    "RangeError: setCrowd({seed}) takes a whole number from 0 to 4294967295, not 4294967296",
    "RangeError: setCrowd({selected}) takes a whole number from 0 to 4294967295, not NaN",
  ]);
  const { timeSecs, rangeSecs, speed, clip, look, crowd } = await state(page);
  assert.deepEqual(
    { timeSecs, rangeSecs, speed, clip, look, crowd },
    { timeSecs: before.timeSecs, rangeSecs: before.rangeSecs, speed: before.speed, clip: before.clip, look: before.look, crowd: before.crowd },
  );
  await call(page, "setSpeed", 100);
  assert.equal((await state(page)).speed, 4, "a speed that means something is clamped");
});

test("a clip is blended into another with the mouse, more and less, and no longer", {}, async (page) => {
  const { model } = await state(page);
  const alone = await picture(page);
  await click(page, "clips");
  await settled(page);
  await click(page, "blend-clip-1");
  const { blend } = await until(page, (now) => now.blend !== null);
  assert.deepEqual(blend, { clip: model.clips[1].name, share: 0.5 });
  await settled(page);
  await keep(page, "blend");
  const half = await picture(page);
  assert.ok(difference(alone, half) > 0.005, `${difference(alone, half)} of the pixels`);
  await drag(page, await place(page, "blend-weight"), await place(page, "blend-weight", 1));
  await until(page, (now) => now.blend?.share === 1);
  await settled(page);
  const whole = await picture(page);
  assert.ok(difference(half, whole) > 0.005, `${difference(half, whole)} of the pixels`);
  await click(page, "end-blend");
  await until(page, (now) => now.blend === null);
  await settled(page);
  assert.equal((await picture(page)).digest, alone.digest, "and nothing of it is left");
});
