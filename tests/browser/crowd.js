// Several instances of the model: asked for by scripts and by the address, drawn, selected with the mouse.

import assert from "node:assert/strict";
import { BACKEND, atRest, call, keep, settled, state, test, until } from "./harness.js";
import { difference, picture } from "./picture.js";

/** What no panel covers in a window of 960 × 600, with the sample open. */
const FREE = { left: 270, top: 70, right: 930, bottom: 500 };

/** Shows this crowd and waits until nothing moves. */
async function crowd(page, wanted) {
  await call(page, "setCrowd", wanted);
  return atRest(page);
}

/** The model alone, on nothing. */
const figures = (page, size) => picture(page, { ...size, transparent: true, overlays: [] });

/** The surface of what is drawn. It does not change when the camera steps back. */
const ink = ({ clear }, { camera }) => (1 - clear) * camera.distance ** 2;

test("a crowd is as scripts ask for it", {}, async (page) => {
  const crowdAfter = async (wanted) => (await crowd(page, wanted)).crowd;
  assert.deepEqual((await state(page)).crowd, { count: 1, seed: 1, selected: 0 });
  assert.deepEqual(await crowdAfter({ count: 3, seed: 7 }), { count: 3, seed: 7, selected: 0 });
  assert.deepEqual(await crowdAfter({ selected: 2 }), { count: 3, seed: 7, selected: 2 }, "what is left out stays");
  assert.deepEqual(await crowdAfter({ selected: 3 }), { count: 3, seed: 7, selected: 2 }, "there is no such instance");
  assert.deepEqual(await crowdAfter({ count: 5, selected: 4 }), { count: 5, seed: 7, selected: 4 });
  assert.deepEqual((await crowdAfter({ count: -3 })).count, 1);
  const reset = await page.evaluate(() => (bindpose.setCrowd({ count: 2 }), bindpose.reset()));
  assert.deepEqual(reset.crowd, { count: 1, seed: 1, selected: 0 });
});

test("the address asks for a crowd", { query: `?backend=${BACKEND}&quality=full&scale=0.2&crowd=3&seed=7` }, async (page) => {
  assert.deepEqual((await state(page)).crowd, { count: 3, seed: 7, selected: 0 });
  await page.evaluate(() => (bindpose.setCrowd({ count: 2, seed: 1 }), bindpose.reset()));
  assert.deepEqual((await state(page)).crowd, { count: 3, seed: 7, selected: 0 }, "and so does a page that begins anew");
});

test("an address that makes no sense asks for one", { query: `?backend=${BACKEND}&quality=full&scale=0.2&crowd=many&seed=-1` }, async (page) => {
  assert.deepEqual((await state(page)).crowd, { count: 1, seed: 1, selected: 0 });
});

test("three instances are drawn, each seed has its own, and one is what was there before", { draws: true }, async (page) => {
  await call(page, "pause");
  await call(page, "seek", 0.4);
  const alone = await atRest(page);
  const [whole, figure] = [await picture(page), await figures(page)];
  const three = await crowd(page, { count: 3, seed: 1 });
  const first = await figures(page);
  assert.ok(ink(first, three) > 1.5 * ink(figure, alone), `${ink(figure, alone)} of one, ${ink(first, three)} of three`);
  assert.ok(three.cost.vertices > 2 * alone.cost.vertices, `${alone.cost.vertices} vertices of one, ${three.cost.vertices} of three`);
  await keep(page, "crowd-3");
  await crowd(page, { seed: 2 });
  assert.ok(difference(first, await figures(page)) > 0.005, "another seed, another crowd");
  await crowd(page, { seed: 1 });
  assert.equal((await figures(page)).digest, first.digest, "the same seed, the same crowd");
  await crowd(page, { count: 1 });
  assert.equal((await figures(page)).digest, figure.digest, "one again");
  assert.equal((await picture(page)).digest, whole.digest, "on its ground");
});

test("a frame says what it cost", { draws: true }, async (page) => {
  const { cost } = await crowd(page, { count: 3 });
  assert.ok(cost.cpuMs > 0 && cost.cpuMs < 60_000, `${cost.cpuMs} ms`);
  assert.ok(cost.vertices > 0 && cost.uploadedBytes > 0, JSON.stringify(cost));
  // WebGL2's clock would have to be waited for, so it is not asked.
  if (BACKEND === "webgl2") return assert.equal(cost.gpuMs, null);
  // The GPU answers some frames later.
  await call(page, "play");
  const { gpuMs } = (await until(page, (now) => now.cost.gpuMs)).cost;
  assert.deepEqual(Object.keys(gpuMs).sort(), ["ambientOcclusion", "contact", "geometry", "picture", "shadowMap"]);
  for (const ms of Object.values(gpuMs)) assert.ok(ms >= 0, JSON.stringify(gpuMs));
});

/** Where the bones are in the picture: the middle of what they change, as shares of its sides. */
async function bonesAt(page) {
  const pictures = [];
  for (const visible of [true, false]) {
    await page.keyboard.press("b");
    await until(page, ({ skeleton }) => skeleton.bonesVisible === visible);
    pictures.push(await picture(page));
  }
  const [shown, hidden] = pictures;
  let [count, sumX, sumY] = [0, 0, 0];
  for (let pixel = 0; pixel < shown.width * shown.height; pixel += 1) {
    const differs = [0, 1, 2].some((channel) => Math.abs(shown.pixels[4 * pixel + channel] - hidden.pixels[4 * pixel + channel]) > 8);
    if (!differs) continue;
    count += 1;
    sumX += (pixel % shown.width) / shown.width;
    sumY += Math.floor(pixel / shown.width) / shown.height;
  }
  assert.ok(count > 20, `${count} pixels of bones`);
  return [sumX / count, sumY / count];
}

/** Points in the window that are well inside of a figure and that no panel covers. */
async function pointsOnFigures(page) {
  const { width, height } = page.viewportSize();
  const { pixels } = await figures(page, { width, height });
  const isInk = (x, y) => pixels[4 * (y * width + x) + 3] > 0;
  const points = [];
  for (let y = FREE.top; y < FREE.bottom; y += 12) {
    for (let x = FREE.left; x < FREE.right; x += 12) {
      if ([-3, 0, 3].every((dy) => [-3, 0, 3].every((dx) => isInk(x + dx, y + dy)))) points.push([x, y]);
    }
  }
  return points;
}

test("a click on another figure selects it, and the bones are there", {}, async (page) => {
  await call(page, "pause");
  await crowd(page, { count: 3, seed: 1 });
  const points = await pointsOnFigures(page);
  assert.ok(points.length > 2, `${points.length} points on figures`);
  const first = await bonesAt(page);
  let selected = 0;
  for (const point of points) {
    await page.mouse.click(...point);
    await settled(page);
    ({ selected } = (await state(page)).crowd);
    if (selected !== 0) break;
  }
  assert.ok(selected !== 0, `clicks on ${points.length} points selected nothing but the first`);
  await atRest(page);
  const other = await bonesAt(page);
  assert.ok(Math.hypot(other[0] - first[0], other[1] - first[1]) > 0.03, `the bones of the first are at ${first}, those of ${selected} at ${other}`);
  await keep(page, "crowd-selected");

  await crowd(page, { selected: 0 });
  const again = await bonesAt(page);
  assert.ok(Math.hypot(again[0] - first[0], again[1] - first[1]) < 0.01, `${again}, not ${first}`);
});

test("many figures are drawn, and move", { draws: true, own: true, motion: true }, async (page) => {
  let before = await state(page);
  // Where a CPU draws, a frame of forty takes seconds.
  for (const count of process.env.BINDPOSE_CASES > 1 ? [10, 40] : [10]) {
    await call(page, "pause");
    const now = await crowd(page, { count, seed: 1 });
    assert.equal(now.crowd.count, count);
    assert.ok(now.cost.vertices > 2 * before.cost.vertices, `${now.cost.vertices} vertices of ${count}`);
    await keep(page, `crowd-${count}`);
    const { framesRendered, timeSecs } = now;
    await call(page, "play");
    await until(page, (later) => later.framesRendered >= framesRendered + 3 && later.timeSecs !== timeSecs);
    before = now;
  }
});
