// Several viewers on one page, each a handle of its own. The page has none of the ids of the real one.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { BACKEND, FIXTURES, FOLDER, SAMPLE, call, drop, keep, settled, state, test, until } from "./harness.js";
import { assertDrawn, decoded, difference, picture } from "./picture.js";

const PAGE_OF_TWO = `<!doctype html><title>Two viewers</title>
<style>body { margin: 0; display: flex } section { position: relative; width: 480px; height: 500px } canvas { width: 100%; height: 100% }</style>
<section><canvas></canvas></section><section><canvas></canvas></section>`;
/** The middle of each viewer. */
const PLACES = [[240, 230], [720, 230]];

/** A page with two canvases, which counts the listeners of its own and the frames that wait. */
async function pageOfTwo(page) {
  await page.route("**/two.html", (route) => route.fulfill({ contentType: "text/html", body: PAGE_OF_TWO }));
  await page.addInitScript(() => {
    globalThis.listeners = [];
    const { addEventListener, removeEventListener } = EventTarget.prototype;
    EventTarget.prototype.addEventListener = function (type, listener, ...rest) {
      globalThis.listeners.push({ target: this ?? globalThis, type, listener });
      return addEventListener.call(this, type, listener, ...rest);
    };
    EventTarget.prototype.removeEventListener = function (type, listener, ...rest) {
      const target = this ?? globalThis;
      const at = globalThis.listeners.findIndex((one) => one.target === target && one.type === type && one.listener === listener);
      if (at >= 0) globalThis.listeners.splice(at, 1);
      return removeEventListener.call(this, type, listener, ...rest);
    };
    globalThis.waiting = new Set();
    const { requestAnimationFrame, cancelAnimationFrame } = globalThis;
    globalThis.requestAnimationFrame = (frame) => {
      const id = requestAnimationFrame((...values) => {
        globalThis.waiting.delete(id);
        frame(...values);
      });
      globalThis.waiting.add(id);
      return id;
    };
    globalThis.cancelAnimationFrame = (id) => {
      globalThis.waiting.delete(id);
      cancelAnimationFrame(id);
    };
  });
}

/** Makes the two viewers; `viewers[n]` has the handle, its `bindpose` and what it told of. */
function makeViewers(page) {
  return page.evaluate(async ([backend, folder]) => {
    const [{ default: init, Viewer }, { createApi }, { takeDrops }] = await Promise.all(
      [`${folder}bindpose.js`, "/web/api.js", "/web/drop.js"].map((address) => import(address)),
    );
    await init({ module_or_path: fetch(`${folder}bindpose_bg.wasm`) });
    globalThis.viewers = [];
    for (const section of document.querySelectorAll("section")) {
      const { bindpose, attach, give, emit } = createApi();
      const handle = new Viewer({ renderScale: 0.25 }, emit);
      takeDrops(section, { receive: (files) => give(files, "open"), refuse: console.error, openModel: () => "", show: () => {} });
      await handle.start(section.querySelector("canvas"), { backend });
      attach(handle);
      globalThis.viewers.push({ handle, bindpose, attach });
    }
  }, [BACKEND, FOLDER]);
}

/** Has the harness ask this viewer from now on. */
const ask = (page, which) => page.evaluate((which) => void (globalThis.bindpose = globalThis.viewers[which].bindpose), which);

async function stateOf(page, which) {
  await ask(page, which);
  return state(page);
}

/** How much of the page's is in use: listeners of each canvas, of document and window, inputs of viewers, waiting frames. */
const inUse = (page) =>
  page.evaluate(() => {
    const of = (...targets) => globalThis.listeners.filter(({ target }) => targets.includes(target)).length;
    return {
      canvases: Array.from(document.querySelectorAll("canvas"), (canvas) => of(canvas)),
      page: of(document, globalThis),
      inputs: document.querySelectorAll("input").length,
      frames: globalThis.waiting.size,
    };
  });

/** A canvas as it is on screen. */
const onScreen = async (page, which) => decoded(page, await page.locator("canvas").nth(which).screenshot());

test("two viewers live on one page, and when one is freed the other goes on", { draws: true, query: "two.html", bare: true, prepare: pageOfTwo }, async (page) => {
  const before = await inUse(page);
  await makeViewers(page);
  const started = await inUse(page);
  assert.equal(await page.evaluate(() => document.querySelector("canvas").parentElement.contains(document.activeElement)), true, "a start leaves the focus where it is");

  // Drops go to the one under the pointer.
  for (const [which, file] of [[0, SAMPLE], [1, `${FIXTURES}good/d3d12_skinned.m3d`]]) {
    await drop(page, [file], { at: PLACES[which] });
    await ask(page, which);
    await until(page, ({ model }) => model !== null);
    await call(page, "pause");
    await call(page, "seek", 0.25);
  }
  const [first, second] = [await stateOf(page, 0), await stateOf(page, 1)];
  assert.deepEqual([first.model.name, second.model.name], ["figure.m3d", "d3d12_skinned.m3d"]);
  assert.deepEqual([first.backend, second.backend], [BACKEND, BACKEND]);

  // Keys go to the one that has the focus.
  for (const which of [1, 0]) {
    await page.mouse.click(...PLACES[which]);
    await settled(page);
    await page.keyboard.press("x");
    await ask(page, which);
    await until(page, ({ look }) => look.overlays.includes("axes") !== first.look.overlays.includes("axes"));
    const { look } = await stateOf(page, 1 - which);
    assert.equal(look.overlays.includes("axes") !== first.look.overlays.includes("axes"), which === 0, "the other one heard nothing");
  }

  // Each draws its own model.
  await ask(page, 0);
  const figure = await picture(page);
  await ask(page, 1);
  const own = await picture(page);
  assertDrawn(figure);
  assert.ok(difference(figure, own) > 0.02, "two models, two pictures");
  await settled(page);
  await keep(page, "two-viewers");
  assert.ok((await onScreen(page, 0)).colours > 100, "the first canvas is drawn on");
  assert.ok((await onScreen(page, 1)).colours > 100, "the second canvas is drawn on");

  const both = await inUse(page);
  await page.evaluate(() => globalThis.viewers[0].handle.free());
  await settled(page);
  const one = await inUse(page);
  assert.ok(started.canvases[0] > 0);
  assert.equal(one.canvases[0], 0, "listeners of the canvas");
  assert.ok(started.page > before.page);
  assert.equal(both.page - one.page, (started.page - before.page) / 2, "half of those of document and window");
  assert.deepEqual([both.inputs, one.inputs], [2, 1]);
  assert.deepEqual([both.frames, one.frames], [2, 1]);

  // The other goes on: state, keys, frames, pictures.
  await ask(page, 1);
  assert.equal((await state(page)).model.name, "d3d12_skinned.m3d");
  assert.equal(difference(own, await picture(page)), 0, "the same picture as before");
  await page.mouse.click(...PLACES[1]);
  await settled(page);
  await page.keyboard.press("Space");
  const { framesRendered, timeSecs } = await until(page, ({ playing }) => playing);
  await until(page, (now) => now.framesRendered > framesRendered + 1 && now.timeSecs !== timeSecs);
  await call(page, "pause");
  await drop(page, [SAMPLE], { at: PLACES[1] });
  await until(page, ({ model }) => model.name === "figure.m3d");

  // A handle outlives its canvas.
  await call(page, "pause");
  await call(page, "seek", 0.25);
  await page.evaluate(async (backend) => {
    const [old] = document.querySelectorAll("section:last-child canvas");
    const fresh = document.createElement("canvas");
    const { handle } = globalThis.viewers[1];
    handle.stop();
    old.replaceWith(fresh);
    await handle.start(fresh, { backend });
  }, BACKEND);
  await settled(page);
  const { model, timeSecs: kept } = await state(page);
  assert.equal(model.name, "figure.m3d");
  assert.ok(Math.abs(kept - 0.25) < 1e-4);
  assert.ok((await onScreen(page, 1)).colours > 100, "the fresh canvas is drawn on");
  await keep(page, "one-of-two-viewers");
});
