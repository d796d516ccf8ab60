// What moves by itself: the camera after a drag, on the turntable, in flight; and what is left out when that is too slow.

import assert from "node:assert/strict";
import { BACKEND, atRest, call, settled, state, test, until } from "./harness.js";
import { assertGolden, difference, picture } from "./picture.js";
import { GROUND, click } from "./widgets.js";

/** A window so small that this GPU of software draws several frames a second. */
const SMALL = { viewport: { width: 360, height: 300 }, motion: true };

/**
 * Lets the page's clock run so much slower than real time that its frames look quick to it: a drag that is let go is
 * judged by its last 80 ms, and no frame of this GPU is that short. `clock.catchUp()` ends that.
 */
function slowClock(page) {
  return page.addInitScript(() => {
    const now = performance.now.bind(performance);
    let [rate, since, at] = [1 / 16, 0, 0];
    performance.now = () => at + rate * (now() - since);
    globalThis.clock = { catchUp: () => ([rate, at, since] = [1, performance.now(), now()]) };
  });
}

/** Throws the view round, and gives the camera at the moment when the mouse had let go, and at rest. */
async function flick(page) {
  await call(page, "pause");
  await atRest(page);
  await page.mouse.move(150, 150);
  await page.mouse.down();
  for (let x = 160; x <= 230; x += 10) {
    await page.mouse.move(x, 150);
    await settled(page);
  }
  await page.mouse.up();
  await settled(page);
  const { camera } = await state(page);
  await page.evaluate(() => clock.catchUp());
  return { released: camera.yawRadians, rested: (await atRest(page)).camera.yawRadians };
}

test("a view that is let go in a drag turns on and comes to rest", { ...SMALL, prepare: slowClock }, async (page) => {
  const { released, rested } = await flick(page);
  assert.ok(Math.abs(rested - released) > 0.01, `from ${released} to ${rested} radians`);
});

test("a picture at rest becomes the mean of as many as are asked for, and then none is drawn", {
  query: `?backend=${BACKEND}&quality=full&scale=0.3&samples=12`,
}, async (page) => {
  await call(page, "pause");
  const clip = { x: 300, y: 60, width: 400, height: 440 };
  const { framesRendered } = await until(page, ({ look }) => look.samples === 12);
  await settled(page);
  const rested = await page.screenshot({ clip });
  await page.waitForTimeout(600);
  const still = await state(page);
  assert.deepEqual([still.framesRendered, still.look.samples], [framesRendered, 12]);
  assert.ok((await page.screenshot({ clip })).equals(rested), "nothing changes any more");
  await call(page, "seek", 0.3);
  await until(page, (now) => now.framesRendered > framesRendered && now.look.samples === 12);
  const [few, many] = [await picture(page, { samples: 1 }), await picture(page)];
  const differs = difference(few, many, { tolerance: 24 });
  assert.ok(few.digest !== many.digest && differs < 0.05, `${differs} of the pixels differ by more than 24`);
  // A device that draws with its CPU does so only when it is asked.
  await call(page, "setQuality", "full", { samples: 0 });
  await call(page, "seek", 0.4);
  await page.waitForTimeout(600);
  assert.equal((await state(page)).look.samples, 1);
  await assert.rejects(call(page, "setQuality", "full", { samples: -1 }), /setQuality/);
});

test("under reduced motion it stays where it was let go", {
  ...SMALL,
  motion: false,
  prepare: slowClock,
}, async (page) => {
  const { released, rested } = await flick(page);
  assert.equal(rested, released);
});

test("the turntable turns the view until it is stopped", { motion: true }, async (page) => {
  await call(page, "pause");
  const { camera } = await atRest(page);
  await click(page, "turntable");
  const turned = ({ yawRadians }) => Math.abs(Math.sin((yawRadians - camera.yawRadians) / 2));
  await until(page, (now) => turned(now.camera) > 0.05);
  await click(page, "turntable");
  const stopped = await atRest(page);
  assert.equal(stopped.camera.pitchRadians, camera.pitchRadians);
  assert.equal(stopped.camera.distance, camera.distance);
  assert.equal(stopped.playing, false);
});

test("with the right button held WASD and QE fly, each its own way, and letting go ends it", {}, async (page) => {
  await call(page, "pause");
  const { yawRadians: yaw, pitchRadians: pitch } = (await atRest(page)).camera;
  const ahead = [Math.sin(yaw) * Math.cos(pitch), -Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)];
  const right = [Math.cos(yaw), 0, -Math.sin(yaw)];
  const [back, left, up, down] = [ahead.map((at) => -at), right.map((at) => -at), [0, 1, 0], [0, -1, 0]];
  for (const [key, way] of Object.entries({ w: ahead, s: back, a: left, d: right, e: up, q: down })) {
    const before = (await state(page)).camera;
    const flown = ({ target }) => target.map((at, axis) => at - before.target[axis]);
    await page.mouse.move(...GROUND);
    await page.mouse.down({ button: "right" });
    await page.keyboard.down(key);
    await until(page, ({ camera }) => Math.hypot(...flown(camera)) > 0.05);
    await page.keyboard.up(key);
    await page.mouse.up({ button: "right" });
    const after = (await atRest(page)).camera;
    assert.deepEqual([after.yawRadians, after.pitchRadians, after.distance], [yaw, pitch, before.distance]);
    const along = flown(after).reduce((sum, at, axis) => sum + at * way[axis], 0);
    assert.ok(along > 0.99 * Math.hypot(...flown(after)), `${key}: ${flown(after)} is along ${way}`);
  }
});

test("a moving picture has less detail where the device is slow; at rest, and when saved, it has all", {
  draws: true,
  fine: true,
  passes: true,
  motion: true,
}, async (page) => {
  const still = async () => {
    await call(page, "pause");
    await call(page, "selectClip", "Walk");
    await call(page, "seek", 0.25);
    // A moment after the last motion, one more frame is drawn.
    await page.waitForTimeout(500);
    await atRest(page);
    return page.screenshot({ clip: { x: 380, y: 60, width: 200, height: 440 } });
  };
  const full = await still();
  assert.equal((await state(page)).look.lowered, null, "all detail was asked for");
  await call(page, "setQuality", "auto");
  await call(page, "play");
  // A GPU made of software begins with half of the width and height.
  const { look } = await until(page, ({ look }) => look.lowered !== null);
  assert.ok(look.lowered.scale <= 0.5, JSON.stringify(look.lowered));
  assert.equal(look.passes.reflections, "drawn", "never left out");
  await call(page, "setQuality", "low");
  const low = await until(page, ({ look }) => look.lowered.occlusion === "off");
  assert.equal(low.look.passes.ao, "too slow");
  await page.waitForTimeout(300);
  assert.ok((await still()).equals(full), "at rest it is the same picture");
  await assertGolden(page, "studio", await picture(page, { width: 192, height: 144, light: "studio" }));
});
