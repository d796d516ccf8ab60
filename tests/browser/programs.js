// Which of the two programs the page fetches, and how it goes from the smaller one to the full one. Only the run on WebGPU has both: elsewhere the
// full one stands in for the other.

import assert from "node:assert/strict";
import { COARSE, FOLDERS, SAMPLE, atRest, drag, drop, keep, programs, settled, state, test as eachTest, until } from "./harness.js";
import { copyOfSample } from "./opening.js";
import { assertDrawn, coloursOnScreen, picture } from "./picture.js";
import { CHEST, click, place } from "./widgets.js";

const test = (name, options, body) => eachTest(name, { only: "webgpu", ...options }, body);
const { full, webgpu } = FOLDERS;
const MAP = SAMPLE.replace(".m3d", "_diff.png");
const QUERY = `quality=full&scale=${COARSE}`;

/** For `prepare`: the GPU of software says that it is another one. What is asked of the adapter can be written anew. */
export const pretendGpu = ({ name = "", isFallbackAdapter = false, adapter = "real", device = "real" } = {}) => (page) =>
  page.addInitScript(({ name, isFallbackAdapter, adapter, device }) => {
    for (const [key, value] of Object.entries({ description: name, isFallbackAdapter })) {
      Object.defineProperty(GPUAdapterInfo.prototype, key, { get: () => value });
    }
    globalThis.adapters = adapter;
    const { requestAdapter } = GPU.prototype;
    GPU.prototype.requestAdapter = async function (...values) {
      return globalThis.adapters === "none" ? null : requestAdapter.apply(this, values);
    };
    const { requestDevice } = GPUAdapter.prototype;
    GPUAdapter.prototype.requestDevice = async function (...values) {
      if (device === "refused") throw new DOMException("no device today", "OperationError");
      globalThis.device = await requestDevice.apply(this, values);
      return globalThis.device;
    };
  }, { name, isFallbackAdapter, adapter, device });

/** Waits until a model is open; gives the state, and which programs were fetched on the way. */
async function opened(page, name = "figure.m3d") {
  const now = await until(page, ({ model, error }) => model?.name === name || error);
  assert.equal(now.error, null);
  return { ...now, fetched: await programs(page) };
}

test("the program for WebGPU alone says by a name that it has no WebGL2", { own: true }, async (page) => {
  assert.deepEqual(await programs(page), [webgpu]);
  const refusals = await page.evaluate(async (folder) => {
    const { Viewer } = await import(`${folder}bindpose.js`);
    const canvas = document.createElement("canvas");
    document.body.append(canvas);
    const told = {};
    // On its own `auto` comes to WebGL2 too, since the adapter is software.
    for (const backend of ["webgl2", "auto"]) {
      const viewer = new Viewer({}, () => {});
      told[backend] = await viewer.start(canvas, { backend }).then(() => null, ({ name, message }) => [name, message]);
      viewer.free();
    }
    return told;
  }, webgpu);
  assert.deepEqual(refusals.webgl2, ["WebGl2Missing", "WebGL2, which this program lacks, is needed, since it was asked for"]);
  assert.equal(refusals.auto[0], "WebGl2Missing");
  assert.match(refusals.auto[1], /^WebGL2, which this program lacks, is needed, since WebGPU is not to be had: its adapter is software/);
});

test("with a GPU the page fetches the program for WebGPU alone, and nothing else", { query: `?${QUERY}`, bare: true, prepare: pretendGpu() }, async (page) => {
  const { backend, fetched } = await opened(page);
  assert.equal(backend, "webgpu");
  assert.deepEqual(fetched, [webgpu]);
  assertDrawn(await picture(page));
  await settled(page);
  assert.ok((await coloursOnScreen(page)) > 200);
  const told = await page.evaluate(() => ({ ...document.getElementById("program").dataset }));
  assert.ok(Number(told.webgpu) < Number(told.full), `${told.webgpu} bytes are announced, and ${told.full}`);
  const [size] = await page.evaluate(() => performance.getEntriesByType("resource").filter(({ name }) => name.endsWith(".wasm")).map(({ decodedBodySize }) => decodedBodySize));
  assert.equal(size, Number(told.webgpu), "as many as came");
});

for (const [words, gpu] of Object.entries({
  "without an adapter": pretendGpu({ adapter: "none" }),
  "with an adapter of software": pretendGpu({ isFallbackAdapter: true }),
  "without WebGPU, as in a context that is not secure": (page) => page.addInitScript(() => Object.defineProperty(navigator, "gpu", { value: undefined })),
  "with adapters that cannot be asked for": (page) => page.addInitScript(() => (GPU.prototype.requestAdapter = () => Promise.reject(new Error("no")))),
})) {
  test(`${words} the page fetches the full program, and nothing else`, { query: `?${QUERY}`, bare: true, prepare: gpu }, async (page) => {
    const { backend, fetched } = await opened(page);
    assert.equal(backend, "webgl2");
    assert.deepEqual(fetched, [full]);
  });
}

test("an address that asks for WebGL2 gets the full program, whatever GPU there is", {
  query: `?backend=webgl2&${QUERY}`,
  bare: true,
  prepare: pretendGpu(),
}, async (page) => {
  const { backend, fetched } = await opened(page);
  assert.equal(backend, "webgl2");
  assert.deepEqual(fetched, [full]);
});

test("an address that asks for WebGPU gets its program, and no other way to draw where that fails", {
  query: `?backend=webgpu&${QUERY}`,
  bare: true,
  expectErrors: true,
  prepare: pretendGpu({ device: "refused" }),
}, async (page) => {
  await page.waitForSelector("#fault:not([hidden])");
  assert.match(await page.textContent("#fault-words"), /WebGPU was asked for and did not work/);
  assert.match(await page.textContent("#fault-details"), /^WebGPU: .*no device today/s);
  assert.deepEqual(await programs(page), [webgpu]);
});

test("a GPU that gives no device brings the full program, and what was dropped and asked for before is not lost", {
  query: `?${QUERY}`,
  bare: true,
  prepare: async (page) => {
    await pretendGpu({ device: "refused" })(page);
    await page.route("**/*_bg.wasm", async (route) => {
      await page.waitForFunction(() => globalThis.letWasmThrough).catch(() => {});
      await route.continue().catch(() => {});
    });
  },
}, async (page) => {
  const { path } = copyOfSample("early.m3d");
  await page.waitForFunction(() => globalThis.bindpose);
  await page.evaluate(() => {
    // A command waits for the viewer too.
    bindpose.setQuality("low");
    globalThis.pending = bindpose.snapshot({ width: 40, height: 30 }).then(({ type }) => type, ({ message }) => message);
  });
  await drop(page, [path]);
  await page.waitForFunction(() => /early\.m3d opens/.test(document.getElementById("progress-words").textContent));
  await page.evaluate(() => (globalThis.letWasmThrough = true));
  const { backend, fetched, look } = await opened(page, "early.m3d");
  assert.equal(backend, "webgl2");
  assert.deepEqual(fetched, [webgpu, full]);
  assert.equal(look.quality, "low");
  assert.equal(await page.evaluate(() => globalThis.pending), "image/png");
  assert.equal((await page.$$("#view canvas")).length, 1);
  assert.equal((await page.$$("#view canvas + input")).length, 1, "one viewer listens");
  await page.waitForFunction(() => document.getElementById("shell").hidden);
  await settled(page);
  await keep(page, "fallen-to-full");
  assert.ok((await coloursOnScreen(page)) > 200, "on the canvas that the first program was to have");
});

test("software that only the program knows by its name brings the full program", {
  query: `?${QUERY}`,
  bare: true,
  prepare: pretendGpu({ name: "llvmpipe (LLVM 19.1.7, 256 bits)" }),
}, async (page) => {
  const { backend, fetched } = await opened(page);
  assert.equal(backend, "webgl2");
  assert.deepEqual(fetched, [webgpu, full]);
});

test("a full program that does not arrive after the other one is said so", {
  query: `?${QUERY}`,
  bare: true,
  expectErrors: true,
  prepare: async (page) => {
    await pretendGpu({ device: "refused" })(page);
    await page.route(`**${full}bindpose_bg.wasm`, (route) => route.fulfill({ status: 503, body: "busy" }));
  },
}, async (page) => {
  await page.waitForSelector("#fault:not([hidden])");
  assert.match(await page.textContent("#fault-title"), /could not be loaded/);
  assert.match(await page.textContent("#fault-details"), /503/);
  assert.equal((await state(page)).error.code, "viewer-stopped");
});

/** Loses WebGPU for good. */
const loseWebGpu = (page) =>
  page.evaluate(() => {
    globalThis.adapters = "none";
    globalThis.device.destroy();
  });

/** The open model with all edits, as a file. */
const exported = (page) => page.evaluate(async () => Array.from(new Uint8Array(await crypto.subtle.digest("SHA-256", (await bindpose.export({ format: "glb" })).bytes))).join());

test("where WebGPU is lost for good the full program goes on with what is open, edited and seen", { query: `?${QUERY}`, bare: true, prepare: pretendGpu() }, async (page) => {
  const { path } = copyOfSample("mine.m3d");
  await opened(page);
  await page.waitForFunction(() => document.getElementById("shell").hidden);
  await page.setInputFiles("#files", [path, MAP]);
  await opened(page, "mine.m3d");
  const clips = copyOfSample("walks.m3d");
  await page.setInputFiles("#clips", clips.path);
  await until(page, ({ model }) => model.clips.length > 4);
  await page.mouse.click(...CHEST);
  await atRest(page);
  await drag(page, await place(page, "roughness"), await place(page, "roughness", 0));
  await click(page, "page-1");
  await atRest(page);
  await page.mouse.dblclick(...(await place(page, "bone-1")));
  await atRest(page);
  await page.keyboard.type("Hips", { delay: 30 });
  await page.keyboard.press("Enter");
  await page.evaluate(() => {
    bindpose.selectClip("Run");
    bindpose.pause();
    bindpose.seek(0.25);
  });
  await atRest(page);
  const before = await until(page, ({ skeleton }) => skeleton.names[1] === "Hips");
  const file = await exported(page);
  // So that the name does not come from there.
  await page.evaluate(() => localStorage.clear());
  await loseWebGpu(page);
  await until(page, ({ backend, model }) => backend === "webgl2" && model?.name === "mine.m3d");
  const after = await until(page, ({ clip, skeleton }) => clip === "Run" && skeleton.names[1] === "Hips");
  assert.deepEqual(await programs(page), [webgpu, full]);
  const seen = ({ model, models, clip, timeSecs, playing, skeleton, look, camera }) => ({ ...model, opening: null, models, clip, timeSecs, playing, skeleton, light: look.light, camera });
  assert.deepEqual(seen(after), seen(before));
  assert.equal(await exported(page), file, "with the names and the edited material");
  assertDrawn(await picture(page));
  assert.equal((await page.$$("#view canvas")).length, 1);
  // It is as good as another: it opens, and takes the edit back.
  assert.ok(await page.evaluate(() => bindpose.undo()));
  assert.notEqual(await exported(page), file);
  await keep(page, "gone-on-with-webgl2");
});

test("what is given while the full program is on its way opens there, after what was open", { query: `?${QUERY}`, bare: true, prepare: pretendGpu() }, async (page) => {
  const [mine, theirs] = ["mine.m3d", "theirs.m3d"].map((name) => copyOfSample(name).path);
  await opened(page);
  await page.setInputFiles("#files", mine);
  await opened(page, "mine.m3d");
  const given = new Promise((done) =>
    page.route(`**${full}bindpose_bg.wasm`, async (route) => {
      await page.setInputFiles("#files", theirs);
      await page.evaluate(() => bindpose.setQuality("auto"));
      await route.continue();
      done();
    }),
  );
  await loseWebGpu(page);
  await given;
  const { backend, look, error } = await until(page, ({ model }) => model?.name === "theirs.m3d");
  assert.deepEqual([backend, look.quality, error], ["webgl2", "auto", null]);
});

test("where the full program does not arrive then, a link leads there, and says what was open", {
  query: `?${QUERY}`,
  bare: true,
  expectErrors: true,
  prepare: pretendGpu(),
}, async (page) => {
  const { path } = copyOfSample("mine.m3d");
  const { backend } = await opened(page);
  assert.equal(backend, "webgpu");
  await page.setInputFiles("#files", path);
  await opened(page, "mine.m3d");
  await page.route(`**${full}bindpose_bg.wasm`, (route) => route.fulfill({ status: 503, body: "busy" }));
  await loseWebGpu(page);
  await page.waitForSelector("#fault:not([hidden])");
  await keep(page, "fault-lost-for-good");
  assert.match(await page.textContent("#fault-title"), /graphics went away/);
  assert.match(await page.textContent("#fault-details"), /did not come back in 6 starts: WebGL2, which this program lacks/);
  await page.unrouteAll();
  await page.click("#fault-actions a:text('Use WebGL2')");
  const now = await until(page, ({ model }) => model !== null);
  assert.equal(now.backend, "webgl2");
  assert.deepEqual(await programs(page), [full]);
  await page.getByText(/^mine\.m3d was open: drop it again/).first().waitFor({ state: "attached" });
});
