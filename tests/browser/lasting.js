// What lasts: the session through a lost GPU, and memory through many loads.

import assert from "node:assert/strict";
import { existsSync, statSync } from "node:fs";
import { BACKEND, CENTRE, SAMPLE, SHARED, atRest, call, dropAndWait, keep, settled, state, test, until, withViewer } from "./harness.js";
import { coloursOnScreen, difference, picture } from "./picture.js";

/** Keeps what the page asks the browser for, so that a test can take it away again. */
function watchGpu(page) {
  return page.addInitScript(() => {
    globalThis.devices = [];
    if (globalThis.GPUAdapter) {
      const requestDevice = GPUAdapter.prototype.requestDevice;
      GPUAdapter.prototype.requestDevice = async function (...args) {
        const device = await requestDevice.apply(this, args);
        globalThis.devices.push(device);
        return device;
      };
    }
  });
}

/** Takes the GPU away from the running viewer. */
function loseGpu(page) {
  return page.evaluate((backend) => {
    globalThis.lostCanvas = document.querySelector("#view canvas");
    if (backend === "webgpu") {
      globalThis.devices.at(-1).destroy();
    } else {
      globalThis.lostCanvas.getContext("webgl2").getExtension("WEBGL_lose_context").loseContext();
    }
  }, BACKEND);
}

test("after the GPU was lost the model, the time and the camera are there again", {
  prepare: watchGpu,
  expectErrors: true,
}, async (page) => {
  const { model } = await state(page);
  await call(page, "pause");
  await call(page, "selectClip", model.clips[1].name);
  await call(page, "seek", 0.4);
  await page.mouse.move(...CENTRE);
  await page.mouse.down();
  await page.mouse.move(CENTRE[0] - 80, CENTRE[1] + 40, { steps: 5 });
  await page.mouse.up();
  await atRest(page);
  const before = await picture(page);
  for (const round of [1, 2]) {
    await loseGpu(page);
    await page.waitForFunction(() => document.querySelector("#view canvas") !== globalThis.lostCanvas);
    await until(page, ({ backend }) => backend === BACKEND);
    await settled(page);
    assert.equal(await page.isHidden("#fault"), true);
    const after = await state(page);
    assert.equal(after.model.name, model.name);
    assert.equal(after.clip, model.clips[1].name);
    assert.ok(Math.abs(after.timeSecs - 0.4) < 1e-4);
    assert.ok(difference(before, await picture(page)) < 0.001, `round ${round}: the same picture`);
    assert.ok((await coloursOnScreen(page)) > 200, "on the new canvas too");
  }
  await keep(page, "after-loss");
});

test("a GPU that goes away again and again ends in words", { prepare: watchGpu, expectErrors: true }, async (page) => {
  for (let round = 0; round < 6 && (await page.isHidden("#fault")); round += 1) {
    await loseGpu(page).catch(() => {});
    // The new canvas is there before its device: only a viewer that runs has something to lose.
    await page.waitForFunction(
      () =>
        !document.getElementById("fault").hidden ||
        (document.querySelector("#view canvas") !== globalThis.lostCanvas && bindpose.state().backend),
    );
  }
  assert.match(await page.textContent("#fault-title"), /graphics/);
  assert.equal((await page.$$("#fault-actions a")).length, 2);
  await keep(page, "fault-lost");
});

test("a GPU that goes away during the first start and does not come back ends in words", {
  bare: true,
  expectErrors: true,
  prepare: withViewer(`
    calls = 0;
    async start() {
      this.calls += 1;
      if (this.calls > 1) throw new Error("no device any more");
      this.onEvent("devicelost", { reason: "it was unplugged" });
      return new Promise(() => {});
    }`),
}, async (page) => {
  await page.waitForSelector("#fault:not([hidden])");
  assert.match(await page.textContent("#fault-title"), /graphics went away/);
  assert.match(await page.textContent("#fault-words"), /while it started/);
  assert.match(await page.textContent("#fault-details"), /no device any more/);
  assert.equal((await page.$$("#fault-actions a")).length, 2);
  assert.match((await state(page)).error.message, /no device any more/);
});

test("a start that was overtaken by another leaves nothing behind", {
  expectErrors: true,
  // The GPU goes away while the first start is under way, and that one comes to its end all the same, late.
  prepare: withViewer(`
    calls = 0;
    async start(...values) {
      this.calls += 1;
      if (this.calls > 1) return super.start(...values);
      const first = super.start(...values);
      this.onEvent("devicelost", { reason: "it was unplugged" });
      await first.catch(() => {});
      await new Promise((done) => setTimeout(done, 3000));
      globalThis.firstHasEnded = true;
      return { backend: "webgl2", adapter: "the one that is gone" };
    }`),
}, async (page) => {
  await page.waitForFunction(() => globalThis.firstHasEnded);
  await settled(page);
  assert.equal(await page.isHidden("#fault"), true);
  assert.equal((await page.$$("#view canvas")).length, 1);
  assert.equal((await page.$$("#view canvas + input")).length, 1, "one viewer listens");
  const { framesRendered } = await state(page);
  await call(page, "play");
  await until(page, (now) => now.framesRendered > framesRendered + 1);
  assert.ok((await coloursOnScreen(page)) > 200, "and draws on the canvas that is seen");
});

test("thirty loads in a row do not grow the memory", { own: true }, async (page) => {
  const soldier = `${SHARED}models/d3d12/soldier.m3d`;
  const path = existsSync(soldier) ? soldier : SAMPLE;
  await call(page, "pause");
  const megabytes = () =>
    page.evaluate(async () => {
      const { default: init } = await import("/pkg/bindpose.js");
      return (await init()).memory.buffer.byteLength / 1e6;
    });
  const sizes = [];
  for (let load = 0; load < 30; load += 1) {
    // Two models by turns: the same one again is a reload, which could be cheaper.
    const { outcome } = await dropAndWait(page, [load % 2 ? SAMPLE : path]);
    assert.equal(outcome, "load");
    sizes.push(await megabytes());
  }
  // The first loads find the high-water mark, gaps between old and new included; after that memory is used again.
  const files = statSync(path).size / 1e6;
  const words = `30 loads of files of up to ${files} MB left the memory at: ${sizes.map(Math.round).join(" ")} MB`;
  assert.ok(sizes.at(-1) - sizes[14] < 3 * files, words);
  assert.ok(sizes.at(-1) < sizes[0] + 5 * files, words);
});
