// The page itself: it starts, on the backend that was asked for, in any window, and says so when it cannot.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { BACKEND, CENTRE, FOLDER, FOLDERS, LARGE, OUT, PAGE, SCRIPTS, atRest, call, keep, panicAtStart, programs, settled, state, test, until } from "./harness.js";
import { assertDrawn, coloursOnScreen, contactSheet, decoded, difference, picture } from "./picture.js";

test("the page opens the sample, draws it and logs no error", { draws: true, viewport: LARGE, own: true, fine: true, passes: true, motion: true }, async (page) => {
  const { model, playing, error } = await state(page);
  assert.equal(model.name, "figure.m3d");
  assert.ok(model.clips.length >= 2, "an idle and a walk at least");
  assert.equal(playing, true);
  assert.equal(error, null);
  assert.match(await page.title(), /^figure\.m3d · Bindpose$/);
  // A screenshot of what moves waits for many frames.
  await call(page, "pause");
  assertDrawn(await picture(page));
  await settled(page);
  await keep(page, "sample-dark");
  assert.ok((await coloursOnScreen(page)) > 200, "the canvas itself is not blank");
});

test("the sample opens with all of its maps", {}, async (page) => {
  assert.deepEqual((await state(page)).textures, { named: 2, missing: [], unreadable: [] });
});

test("the sample opens although one of its maps does not arrive", {
  expectErrors: true,
  prepare: (page) => page.route("**/figure_norm*.png", (route) => route.abort()),
}, async (page) => {
  const { model, error, textures } = await state(page);
  assert.equal(model.name, "figure.m3d");
  assert.equal(error, null);
  assert.deepEqual(textures, { named: 2, missing: ["figure_norm.dds"], unreadable: [] });
});

test("the light scheme is followed", { colorScheme: "light", viewport: LARGE, fine: true }, async (page) => {
  await call(page, "pause");
  await settled(page);
  await keep(page, "sample-light");
  assert.ok((await coloursOnScreen(page)) > 200);
});

test("a phone's screen works", { sharp: true, fine: true }, async (page) => {
  await call(page, "pause");
  await settled(page);
  await keep(page, "phone-dark");
  assert.ok((await coloursOnScreen(page)) > 200);
  const scrolls = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  assert.equal(scrolls, false, "nothing sticks out of the window");
  const canvas = await page.evaluate(() => [document.querySelector("canvas").width, innerWidth * devicePixelRatio]);
  assert.deepEqual(canvas, [780, 780], "the canvas has a pixel for each of the screen's");
  await page.emulateMedia({ colorScheme: "light" });
  await settled(page);
  await keep(page, "phone-light");
});

test("the canvas follows the window", { draws: true, fine: true }, async (page) => {
  await call(page, "pause");
  await page.setViewportSize({ width: 700, height: 500 });
  await page.waitForFunction(() => document.querySelector("canvas").width === 700);
  await settled(page);
  await keep(page, "resized");
  assert.ok((await coloursOnScreen(page)) > 200);
});

test("without a wish the page takes a backend by itself", { draws: true, query: "", bare: true }, async (page) => {
  await until(page, ({ model }) => model !== null);
  const { backend } = await state(page);
  // WebGPU on a GPU of software is taken only where it was asked for, and the browser under test has no other.
  assert.equal(backend, "webgl2");
  assert.deepEqual(await programs(page), [FOLDERS.full], "the adapter says that it is software, so nothing else was fetched before");
  assertDrawn(await picture(page));
});

test("nothing is drawn while nothing changes, neither the picture nor the panels", { draws: true }, async (page) => {
  await call(page, "pause");
  await page.mouse.move(480, 60);
  await atRest(page);
  const seconds = await page.evaluate(async (backend) => {
    const [type, name] = backend === "webgpu" ? [GPUQueue, "submit"] : [WebGL2RenderingContext, "flush"];
    const real = type.prototype[name];
    let submissions = 0;
    type.prototype[name] = function (...values) {
      submissions += 1;
      return real.apply(this, values);
    };
    bindpose.seek(0.5);
    const seconds = [];
    // A slow device draws the other time a moment later, and later still what the panels show is told to the elements of the page.
    while ((Math.max(...seconds) <= 0 || seconds.at(-1) > 0) && seconds.length < 20) {
      submissions = 0;
      await new Promise((done) => setTimeout(done, 1000));
      seconds.push(submissions);
    }
    type.prototype[name] = real;
    return seconds;
  }, BACKEND);
  assert.ok(Math.max(...seconds) > 0, "what is drawn is counted");
  assert.equal(seconds.at(-1), 0, `what the GPU was given in each second: ${seconds}`);
  const { framesRendered } = await state(page);
  await page.waitForTimeout(1000);
  assert.equal((await state(page)).framesRendered, framesRendered, "frames drawn in a second of rest");
});

test("under reduced motion the sample waits on its first frame", { own: true }, async (page) => {
  const { playing, timeSecs } = await state(page);
  assert.equal(playing, false);
  assert.equal(timeSecs, 0);
});

test("a snapshot is a PNG of the asked size", { draws: true }, async (page) => {
  await call(page, "pause");
  const ground = await picture(page, { width: 300, height: 170 });
  assert.deepEqual([ground.width, ground.height], [300, 170]);
  assertDrawn(ground);
  assert.equal(ground.clear, 0);
  const clear = await picture(page, { width: 300, height: 170, transparent: true });
  assert.ok(clear.clear > 0.3 && clear.clear < 0.99, `${clear.clear} of the pixels are transparent`);
  const odd = await picture(page, { width: 33, height: 1025 });
  assert.deepEqual([odd.width, odd.height], [33, 1025]);
});

test("P saves a picture, named after what it shows", { fine: true }, async (page) => {
  await call(page, "pause");
  await page.mouse.click(...CENTRE);
  const [saved] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("p")]);
  assert.match(saved.suggestedFilename(), /^figure-\w+-\d+\.png$/);
  const bytes = readFileSync(await saved.path());
  assert.deepEqual([...bytes.subarray(1, 4)], [..."PNG"].map((letter) => letter.charCodeAt(0)));
  const { width, height } = page.viewportSize();
  assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [width, height]);
});

test("a contact sheet has pictures of the clip while the page goes on", { draws: true }, async (page) => {
  await call(page, "pause");
  const sheet = await contactSheet(page, { width: 300, height: 200, columns: 2, rows: 2 });
  writeFileSync(`${OUT}${BACKEND}-contact-sheet.png`, sheet.png);
  assert.deepEqual([sheet.width, sheet.height], [300, 200]);
  assertDrawn(sheet);
  assert.equal((await contactSheet(page, { width: 300, height: 200, columns: 2, rows: 2 })).digest, sheet.digest, "the same again");
  const round = await contactSheet(page, { width: 300, height: 200, columns: 2, rows: 2, turntable: true, transparent: true });
  assert.ok(round.clear > 0.3 && round.clear < 0.99, `${round.clear} of the pixels are transparent`);
  assert.ok(difference(sheet, round) > 0.2);

  const { moved, refused, cancelled } = await page.evaluate(async () => {
    const failed = (promise) => promise.then(() => null, ({ name, message }) => ({ name, message }));
    bindpose.play();
    const before = bindpose.state().framesRendered;
    await bindpose.contactSheet({ width: 300, height: 200, columns: 3, rows: 2 });
    const moved = bindpose.state().framesRendered - before;
    bindpose.pause();
    const refused = await failed(bindpose.contactSheet({ width: 100, height: 50, columns: 8, rows: 8 }));
    const abort = new AbortController();
    const cancelled = failed(bindpose.contactSheet({ signal: abort.signal }));
    abort.abort();
    return { moved, refused, cancelled: await cancelled };
  });
  assert.ok(moved >= 2, `${moved} frames of the window meanwhile`);
  assert.match(refused.message, /no room for 8 × 8 pictures/);
  assert.equal(cancelled.name, "AbortError");
});

test("a contact sheet is saved from the panel, which says how far it is, and is cancelled there", { viewport: LARGE, fine: true }, async (page) => {
  await call(page, "pause");
  const press = async (name) => {
    await page.getByRole("button", { name }).focus();
    await page.keyboard.press("Enter");
  };
  await press(/^Picture…/);
  const save = page.getByRole("button", { name: "Save contact sheet" });
  await save.waitFor({ state: "attached" });
  const saving = page.waitForEvent("download");
  await press("Save contact sheet");
  // The same element with another name: the focus stays.
  assert.match(await page.evaluate(() => document.activeElement.getAttribute("aria-label") ?? document.activeElement.textContent), /Cancel|Save/);
  const progress = page.getByRole("progressbar", { name: "Pictures drawn" });
  await progress.waitFor({ state: "attached" });
  await keep(page, "contact-sheet-progress");
  const saved = await saving;
  assert.match(saved.suggestedFilename(), /^figure-\w+-sheet\.png$/);
  const bytes = readFileSync(await saved.path());
  writeFileSync(`${OUT}${BACKEND}-contact-sheet-saved.png`, bytes);
  assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [LARGE.width, LARGE.height]);

  await save.waitFor({ state: "attached" });
  await press("Save contact sheet");
  await page.getByRole("button", { name: "Cancel the contact sheet" }).waitFor({ state: "attached" });
  await press("Cancel the contact sheet");
  await save.waitFor({ state: "attached" });
  await page.keyboard.press("Escape");
});

test("a print that the browser begins has the view without the panels, and the panels are there again", { draws: true, fine: true }, async (page) => {
  await call(page, "pause");
  await atRest(page);
  const { width, height } = page.viewportSize();
  const before = await page.screenshot();
  const view = await picture(page, { width, height });
  // What a print does, with a look at the paper.
  const copied = await page.evaluate(() => {
    dispatchEvent(new Event("beforeprint"));
    return document.querySelector("#print canvas").toDataURL().split(",")[1];
  });
  await page.emulateMedia({ media: "print" });
  await keep(page, "print");
  assert.match(await page.textContent("#print p"), /^figure\.m3d · .* triangles, \d+ bones$/);
  assert.equal(await page.isVisible("#print canvas"), true);
  assert.equal(await page.isVisible("#view"), false);
  await page.emulateMedia({ media: "screen" });
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  const paper = await decoded(page, Buffer.from(copied, "base64"));
  assert.ok(difference(view, paper) < 0.01, `${difference(view, paper)} of the pixels differ from the view`);
  await settled(page);
  const after = await decoded(page, await page.screenshot());
  assert.ok(difference(await decoded(page, before), after) < 0.001, "the window is as before");
  assert.ok(difference(paper, after) > 0.2, "with its panels");
});

test("programs may call before the viewer is there", {
  bare: true,
  prepare: (page) =>
    page.addInitScript(() => {
      addEventListener("DOMContentLoaded", () => {
        globalThis.early = bindpose.ready.then(() => "ready");
        bindpose.pause();
        globalThis.earlyState = bindpose.state();
      });
    }),
}, async (page) => {
  assert.equal(await page.evaluate(() => globalThis.early), "ready");
  assert.equal(await page.evaluate(() => globalThis.earlyState.model), null);
});

test("the shell is painted before the viewer arrives", {
  viewport: LARGE,
  bare: true,
  prepare: (page) =>
    page.route("**/*_bg.wasm", async (route) => {
      // A page that was closed meanwhile, since something failed, has said why by then.
      await page.waitForFunction(() => globalThis.letWasmThrough).catch(() => {});
      await route.continue().catch(() => {});
    }),
}, async (page) => {
  await page.waitForSelector("#open-files");
  assert.equal((await page.evaluate(() => bindpose.state())).model, null);
  await keep(page, "shell-dark");
  await page.emulateMedia({ colorScheme: "light" });
  await keep(page, "shell-light");
  await page.setViewportSize({ width: 360, height: 640 });
  await keep(page, "shell-narrow");
  await page.evaluate(() => (globalThis.letWasmThrough = true));
  await until(page, ({ model }) => model !== null);
});

test("a viewer that does not arrive is said so, with a way on", {
  bare: true,
  expectErrors: true,
  prepare: (page) => page.route("**/*_bg.wasm", (route) => route.fulfill({ status: 503, body: "busy" })),
}, async (page) => {
  await page.waitForSelector("#fault:not([hidden])");
  assert.match(await page.textContent("#fault-title"), /could not be loaded/);
  assert.match(await page.textContent("#fault-details"), /503/);
  await keep(page, "fault-download");
  await page.unroute("**/*_bg.wasm");
  await page.click("#fault-actions button");
  await until(page, ({ model }) => model !== null);
});

test("a browser that is too old is told which are not", {
  bare: true,
  expectErrors: true,
  prepare: (page) => page.addInitScript(() => (WebAssembly.validate = () => false)),
}, async (page) => {
  await page.waitForSelector("#fault:not([hidden])");
  await keep(page, "fault-browser");
  assert.match(await page.textContent("#fault-words"), /Firefox 89/);
  const told = await page.evaluate(() => bindpose.ready.then(() => "it runs", ({ message }) => message));
  assert.match(told, /SIMD/, "programs hear of it too");
});

test("a browser without graphics is told which other way there is", {
  draws: true,
  query: `?backend=${BACKEND}`,
  bare: true,
  expectErrors: true,
  prepare: (page) =>
    page.addInitScript(() => {
      Object.defineProperty(navigator, "gpu", { value: undefined });
      const getContext = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return /webgl|webgpu/.test(kind) ? null : getContext.call(this, kind, ...rest);
      };
    }),
}, async (page) => {
  await page.waitForSelector("#fault:not([hidden])");
  await keep(page, "fault-gpu");
  const links = await page.$$eval("#fault-actions a", (links) => links.map(({ href }) => href));
  assert.deepEqual(links, [`${PAGE}?backend=webgl2`, `${PAGE}?backend=webgpu`]);
  assert.notEqual(await page.textContent("#fault-details"), "");
  assert.deepEqual(await programs(page), [FOLDER]);
});

test("a panic shows what happened and a way on", {
  bare: true,
  expectErrors: true,
  prepare: panicAtStart,
}, async (page) => {
  await page.waitForSelector("#fault:not([hidden])");
  assert.match(await page.textContent("#fault-title"), /stopped/);
  assert.equal(await page.textContent("#fault-details"), "index out of bounds");
  await keep(page, "fault-panic");
  await page.unroute(SCRIPTS);
  await page.click("#fault-actions button");
  await until(page, ({ model }) => model !== null);
});

test("after a panic programs hear of it, and calls end", { own: true, motion: true, expectErrors: true }, async (page) => {
  await page.evaluate(() => {
    globalThis.heard = [];
    bindpose.addEventListener("error", ({ detail }) => globalThis.heard.push(detail));
    // The viewer takes the time from it, and takes for granted that it is there: a real panic.
    Object.defineProperty(globalThis, "performance", { configurable: true, get: () => undefined });
    globalThis.pending = bindpose.snapshot({ width: 64, height: 64 }).then(() => "a picture", ({ message }) => message);
    bindpose.play();
  });
  await page.waitForSelector("#fault:not([hidden])");
  const { error, model } = await state(page);
  assert.equal(error.code, "viewer-stopped");
  assert.match(error.message, /Performance/);
  assert.equal(model, null);
  assert.deepEqual(await page.evaluate(() => JSON.parse(JSON.stringify(globalThis.heard))), [error], "told once");
  const outcomes = await page.evaluate(async () => {
    const told = (promise) => promise.then(() => "resolved", ({ message }) => message);
    for (const name of ["play", "pause", "nextKey", "clearRange"]) bindpose[name]();
    bindpose.seek(0.5);
    bindpose.selectClip("Take1");
    return {
      open: await told(bindpose.open([{ name: "a.m3d", bytes: new Uint8Array(1) }])),
      addClips: await told(bindpose.addClips([])),
      snapshot: await told(bindpose.snapshot()),
      ready: await told(bindpose.ready),
    };
  });
  const { message } = error;
  assert.deepEqual(outcomes, { open: message, addClips: message, snapshot: message, ready: "resolved" });
  assert.ok(["a picture", message].includes(await page.evaluate(() => globalThis.pending)), "what was asked before ends too");
  assert.deepEqual((await state(page)).error, error, "nothing was done to it meanwhile");
});
