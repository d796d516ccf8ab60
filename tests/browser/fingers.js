// The view under fingers: one turns it, two move it and bring it nearer, and a finger on the bar carries the time.

import assert from "node:assert/strict";
import { atRest, call, keep, settled, state, test, turnPhone, until } from "./harness.js";
import { bounds, place, timeBar } from "./widgets.js";

const PHONE = { phone: true };
const STEPS = 6;

/** Puts fingers down where they begin, moves them together to where they end, and lifts them. */
async function fingers(page, ...ways) {
  const devtools = await page.context().newCDPSession(page);
  const send = (type, touchPoints) => devtools.send("Input.dispatchTouchEvent", { type, touchPoints });
  const at = (fraction) =>
    ways.map(([[fromX, fromY], [toX, toY]], id) => ({
      id,
      x: fromX + fraction * (toX - fromX),
      y: fromY + fraction * (toY - fromY),
    }));
  // One finger is always the first.
  for (let down = 1; down <= ways.length; down += 1) await send("touchStart", at(0).slice(0, down));
  for (let step = 1; step <= STEPS; step += 1) {
    await send("touchMove", at(step / STEPS));
    await settled(page);
  }
  await send("touchEnd", []);
  await devtools.detach();
  return atRest(page);
}

const near = (one, other, tolerance) => Math.abs(one - other) <= tolerance;
const apart = (one, other) => Math.hypot(...one.target.map((at, axis) => at - other.target[axis]));

test("a finger turns the view, two move it and bring it nearer", PHONE, async (page) => {
  const { camera: first } = await atRest(page);
  const { camera: turned, skeleton } = await fingers(page, [[120, 300], [220, 280]]);
  assert.ok(!near(turned.yawRadians, first.yawRadians, 0.1), "a finger turns the view");
  assert.ok(!near(turned.pitchRadians, first.pitchRadians, 0.01), "up and down too");
  assert.deepEqual([turned.distance, ...turned.target], [first.distance, ...first.target]);
  assert.equal(skeleton.selected, null, "a drag is no tap");

  const { camera: moved } = await fingers(page, [[120, 300], [180, 340]], [[220, 300], [280, 340]]);
  assert.ok(apart(moved, turned) > 0.05, "two fingers move the view");
  assert.ok(near(moved.distance, turned.distance, 0.02 * turned.distance), `${moved.distance} from ${turned.distance}`);
  assert.ok(near(moved.yawRadians, turned.yawRadians, 0.02), "and do not turn it");

  const { camera: close } = await fingers(page, [[170, 320], [110, 320]], [[220, 320], [280, 320]]);
  await keep(page, "pinched");
  assert.ok(close.distance < 0.7 * moved.distance, `apart, they bring it nearer: ${close.distance} from ${moved.distance}`);
  const { camera: far } = await fingers(page, [[110, 320], [170, 320]], [[280, 320], [220, 320]]);
  assert.ok(far.distance > 1.4 * close.distance, `together, farther: ${far.distance} from ${close.distance}`);
});

test("a finger on the bar carries the time", PHONE, async (page) => {
  const { first, last, y } = timeBar(await bounds(page, "time"));
  const { model } = await state(page);
  const [{ endSecs }] = model.clips;
  const middle = (first + last) / 2;
  const { timeSecs, playing } = await fingers(page, [[first, y], [middle, y]]);
  assert.ok(near(timeSecs, endSecs / 2, 0.05 * endSecs), `${timeSecs} of ${endSecs}`);
  assert.equal(playing, false);
  await call(page, "play");
  await until(page, (now) => now.timeSecs !== timeSecs);
});

test("on a phone that is turned on its side the model makes way for what is opened beside it", PHONE, async (page) => {
  const { camera: upright, model } = await atRest(page);
  await turnPhone(page, 844, 390);
  const { camera: low } = await until(page, ({ camera }) => camera.distance !== upright.distance);
  assert.ok(near(apart(low, upright), 0, 0.2 * upright.distance), "it is framed anew");
  // The mirror tells of the new layout after the camera has it; before, the control is still where the upright phone had it.
  await page.waitForFunction(() => document.querySelector("[data-control=dope-sheet]")?.getBoundingClientRect().bottom <= innerHeight);
  await page.touchscreen.tap(...(await place(page, "dope-sheet")));
  const { camera: beside } = await until(page, ({ camera }) => apart(camera, low) > 0.2 * low.distance);
  await atRest(page);
  await keep(page, "phone-on-its-side");
  const { first, last, y } = timeBar(await bounds(page, "time"));
  const { timeSecs, camera } = await fingers(page, [[first, y], [last, y]]);
  assert.ok(near(timeSecs, model.clips[0].endSecs, 0.02), `${timeSecs}`);
  assert.deepEqual(camera, beside, "the model stays where it is");
  await page.touchscreen.tap(...(await place(page, "dope-sheet")));
  await until(page, ({ camera }) => near(apart(camera, low), 0, 1e-3));
});

test("a device of two pixels to the point that the browser emulates has the page at its size", { own: true }, async (page) => {
  const devtools = await page.context().newCDPSession(page);
  await devtools.send("Emulation.setDeviceMetricsOverride", { width: 390, height: 844, deviceScaleFactor: 2, mobile: true });
  const more = page.locator("[data-control=more]");
  await more.waitFor({ state: "attached" });
  await atRest(page);
  const seen = await page.evaluate(() => [devicePixelRatio, document.querySelector("canvas").width, document.querySelector("canvas").height]);
  assert.deepEqual(seen, [2, 780, 1688]);
  const box = await more.boundingBox();
  assert.ok(box.x > 300 && box.x + box.width <= 390, `${JSON.stringify(box)} is at the right edge`);
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await page.getByRole("menuitem", { name: /^View mode/ }).waitFor({ state: "attached" });
});
