// <bindpose-viewer> is a guest on other people's pages: it takes no more than it needs, and gives it back.

import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { FOLDER, SAMPLE, keep, settled, test, withViewer } from "./harness.js";
import { held } from "./held.js";
import { FIGURE, SMALL, STRICT, hears, pageOf, seen } from "./notes.js";
import { GROUND, click, place, still } from "./widgets.js";

/** So often a viewer leaves its page and comes back; the longer checks do it fifty times. */
const ROUNDS = process.env.BINDPOSE_CASES > 1 ? 50 : 6;

/** What a viewer that left its page must leave behind none of. */
const COUNTED = [
  "HTMLCanvasElement", "HTMLInputElement", "WebGL2RenderingContext", "WebGLTexture", "GPUDevice", "GPUTexture",
  "jsEventListeners",
];

test("a page scrolls over a viewer until somebody turns to it; its controls are plain ones", pageOf(`<bindpose-viewer id="a" ${FIGURE} loop></bindpose-viewer><p style="height: 2000px">More</p>`), async (page) => {
  await hears(page, "a", "load");
  const [x, y] = [320, 200];
  const camera = async () => JSON.stringify(await page.evaluate(() => document.getElementById("a").state().camera));
  // It is framed in the first frame.
  await page.waitForFunction(() => document.getElementById("a").state().framesRendered > 0);
  await settled(page);
  const before = await camera();
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, 60);
  await page.waitForFunction(() => scrollY === 60);
  await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.equal((await seen(page, "a")).currentTime, 0, "its keys are its own only while it has the focus");
  assert.equal(await camera(), before);
  await page.evaluate(() => scrollTo(0, 0));
  await page.mouse.click(x, y);
  await page.mouse.wheel(0, -240);
  await page.waitForFunction((before) => JSON.stringify(document.getElementById("a").state().camera) !== before, before);
  assert.equal(await page.evaluate(() => scrollY), 0);
  await hears(page, "a", "camera-change");
  const control = (name) => page.getByRole("button", { name }).or(page.getByRole("slider", { name })).or(page.getByRole("combobox", { name }));
  await control("Clip").selectOption("Run");
  await control("Play").click();
  await hears(page, "a", "play");
  await hears(page, "a", "timeupdate", 3);
  await control("Pause").click();
  await hears(page, "a", "pause");
  await control("Time").fill("0.25");
  const { clip, currentTime, paused } = await seen(page, "a");
  assert.deepEqual([clip, paused], ["Run", true]);
  assert.ok(Math.abs(currentTime - 0.25) < 1e-3, `${currentTime}`);
});

/**
 * Takes the viewer "a" out of its page and puts it in again, `ROUNDS` times: it comes back where it was, and nothing that it held stays.
 * `mostOfGpu`: how much the browser's process for the GPU may grow from the tenth round on.
 */
async function goesAndComes(page, folder, mostOfGpu = 1.05) {
  await hears(page, "a", "load");
  await page.evaluate(() => (globalThis.viewer = document.getElementById("a")).setAttribute("camera", "70 12"));
  const { link } = await seen(page, "a");
  let first, tenth;
  for (let round = 1; round <= ROUNDS; round += 1) {
    await page.evaluate(() => viewer.remove());
    await settled(page);
    assert.equal(await page.evaluate(() => viewer.shadowRoot.querySelectorAll("canvas").length), 0);
    await page.evaluate(() => document.body.append(viewer));
    await hears(page, "a", "load", 1 + round);
    assert.equal((await seen(page, "a")).link, link);
    // What the test and the browser have noted is not the viewer's.
    await page.evaluate(() => {
      for (const type of Object.keys(details)) delete details[type];
      performance.clearResourceTimings();
    });
    if (round === 10) tenth = await held(page, folder);
    if (round === 3) first = await held(page, folder);
  }
  const last = await held(page, folder);
  for (const kind of COUNTED) assert.ok(last[kind] <= first[kind], `${kind}: ${JSON.stringify([first, last])}`);
  // Memory grows in steps until it has found its high-water mark; who did not leave would keep the bytes of a file a round.
  const grown = last.wasmMB - first.wasmMB;
  assert.ok(grown < (0.9 * (ROUNDS - 3) * statSync(SAMPLE).size) / 1e6, `${first.wasmMB} MB, then ${last.wasmMB}`);
  for (const kind of tenth ? ["wasmMB", "scriptMB", "gpuMB"] : []) {
    const most = kind === "gpuMB" ? mostOfGpu : 1.05;
    assert.ok(last[kind] <= most * tenth[kind], `${kind}: ${tenth[kind]}, then ${last[kind]}`);
  }
  return link;
}

test("a viewer that leaves the page gives all back, and comes again where it was; the last source wins", {
  ...pageOf(`<bindpose-viewer id="a" ${FIGURE} clip="Walk" current-time="0.5"></bindpose-viewer>`),
  draws: true,
}, async (page) => {
  const link = await goesAndComes(page, SMALL);
  // Another interface is another start with the same moment.
  await page.evaluate(() => (viewer.ui = "full"));
  await hears(page, "a", "load", ROUNDS + 2);
  assert.equal((await seen(page, "a")).link, link);
  await page.getByRole("button", { name: "Play" }).first().waitFor({ state: "attached" });
  await page.evaluate(() => (viewer.ui = "none"));
  await hears(page, "a", "load", ROUNDS + 3);
  assert.equal((await seen(page, "a")).link, link);
  await page.route("**/other.m3d", (route) => route.fulfill({ path: SAMPLE }));
  await page.evaluate(() => {
    viewer.src = "web/sample/figure.m3d";
    viewer.src = "web/nothing.m3d";
    viewer.src = "web/other.m3d";
  });
  await hears(page, "a", "load", ROUNDS + 4);
  const shown = () => page.evaluate(() => [viewer.error, viewer.state().model.name]);
  assert.deepEqual(await shown(), [null, "other.m3d"]);
  await page.evaluate(() => viewer.remove());
  await settled(page);
  await page.evaluate(() => {
    viewer.src = "web/sample/figure.m3d";
    document.body.append(viewer);
  });
  await hears(page, "a", "load", ROUNDS + 5);
  assert.deepEqual(await shown(), [null, "figure.m3d"], "also where it was set out of the page");
});

if (ROUNDS > 6) {
  test("with the page's interface too, a viewer that leaves the page gives all back", {
    ...pageOf(`<bindpose-viewer id="a" ${FIGURE} clip="Walk" current-time="0.5" ui="full"></bindpose-viewer>`),
    draws: true,
    // By software Chromium's process grows by a third of a megabyte a round until its own high-water mark, near the 200th, and stays there.
  }, (page) => goesAndComes(page, FOLDER, 1.1));
}

/** How many frames a viewer has drawn. */
const drawn = (page, id) => page.evaluate((id) => document.getElementById(id).state().framesRendered, id);

/** Whether a viewer draws nothing in twelve frames of its page. */
async function isStill(page, id) {
  const before = await drawn(page, id);
  for (let round = 0; round < 6; round += 1) await settled(page);
  return before === (await drawn(page, id));
}

/** Waits until a viewer draws no more. */
async function comesToRest(page, id) {
  for (const deadline = Date.now() + 30_000; !(await isStill(page, id)); ) assert.ok(Date.now() < deadline, `${id} draws on`);
}

const boxes = pageOf(`<style>body { margin: 0 }</style><div style="display: flex; width: 640px"><bindpose-viewer id="flex" ${FIGURE} style="flex: 1; min-width: 0" autoplay loop></bindpose-viewer><p style="width: 200px">Beside</p></div>
    <details id="more"><summary>More</summary><bindpose-viewer id="folded" ${FIGURE} loading="lazy" poster="web/icon.svg"></bindpose-viewer></details>
    <p style="height: 2000px">Far</p><bindpose-viewer id="far" src="web/far.m3d" loading="lazy"></bindpose-viewer>
    <p style="height: 4000px">Farther</p><bindpose-viewer id="farther" src="web/far.m3d" loading="lazy"></bindpose-viewer>`);
test("in a flex box, in what is folded away, hidden and shown, a viewer has its size and draws only in sight", {
  draws: true,
  ...boxes,
  motion: true,
  prepare: async (page) => {
    await page.route("**/far.m3d", (route) => route.fulfill({ path: SAMPLE }));
    await boxes.prepare(page);
  },
}, async (page) => {
  await hears(page, "flex", "load");
  const size = (id) => page.evaluate((id) => [document.getElementById(id).offsetWidth, document.getElementById(id).shadowRoot.querySelector("canvas")?.width ?? 0], id);
  const [width, pixels] = await size("flex");
  assert.equal(width, 440);
  assert.ok(Math.abs(pixels - width * (await page.evaluate(() => devicePixelRatio))) <= 1, `${pixels} pixels for ${width}`);
  await page.evaluate(() => document.querySelector("div").style.setProperty("width", "400px"));
  await page.waitForFunction(() => document.getElementById("flex").shadowRoot.querySelector("canvas").width < 120);
  // Neither what is folded nor what is far was loaded.
  assert.deepEqual(await page.evaluate(() => heard.filter(([id]) => id !== "flex")), []);
  const fetched = () => page.evaluate(() => {
    const all = performance.getEntriesByType("resource");
    return all.filter(({ name }) => name.endsWith("far.m3d")).length;
  });
  assert.equal(await fetched(), 0);
  await page.evaluate(() => (document.getElementById("more").open = true));
  await hears(page, "folded", "load");
  assert.deepEqual(await size("folded"), [640, 640 * (await page.evaluate(() => devicePixelRatio))]);
  await keep(page, "element-layout");
  assert.equal(await isStill(page, "flex"), false);
  await page.evaluate(() => (document.getElementById("flex").hidden = true));
  await comesToRest(page, "flex");
  assert.equal((await seen(page, "flex")).paused, false, "it goes on when it is seen again");
  await page.evaluate(() => (document.getElementById("flex").hidden = false));
  await page.waitForFunction((before) => document.getElementById("flex").state().framesRendered > before, await drawn(page, "flex"));
  await page.evaluate(() => document.getElementById("far").scrollIntoView());
  await hears(page, "far", "load");
  assert.equal(await fetched(), 1);
  // The one that plays is scrolled away now.
  await comesToRest(page, "flex");
  assert.equal((await seen(page, "flex")).paused, false);
  await page.evaluate(() => (document.getElementById("farther").loading = "auto"));
  await hears(page, "farther", "load");
});

for (const ui of ["none", "full"]) {
  test(`a page scrolls under a finger, and turns the view once it was touched, where its interface is ${ui}`, {
    phone: true,
    ...pageOf(`<meta name="viewport" content="width=device-width"><bindpose-viewer id="a" ${FIGURE} ui="${ui}" style="width: 360px; height: 480px"></bindpose-viewer><p style="height: 3000px">More</p>`),
  }, async (page) => {
    await hears(page, "a", "load");
    await page.waitForFunction(() => document.getElementById("a").state().framesRendered > 0, null, { polling: 50 });
    await settled(page);
    const devtools = await page.context().newCDPSession(page);
    const swipe = async () => {
      const touch = (type, y) => devtools.send("Input.dispatchTouchEvent", { type, touchPoints: y === null ? [] : [{ x: 180, y }] });
      await touch("touchStart", 260);
      for (let y = 250; y >= 110; y -= 20) {
        await touch("touchMove", y);
        await settled(page);
      }
      await touch("touchEnd", null);
      await settled(page);
      return page.evaluate(() => [scrollY, document.getElementById("a").state().camera.pitchRadians]);
    };
    const pitch = await page.evaluate(() => document.getElementById("a").state().camera.pitchRadians);
    const [scrolled, still] = await swipe();
    assert.ok(scrolled > 60, `${scrolled}`);
    assert.equal(still, pitch);
    await page.evaluate(() => scrollTo(0, 0));
    await page.touchscreen.tap(180, 200);
    await page.waitForFunction(() => document.getElementById("a").shadowRoot.activeElement?.localName === "canvas");
    const [there, turned] = await swipe();
    assert.equal(there, 0);
    assert.notEqual(turned, pitch);
  });
}

const full = pageOf(`<input id="field" aria-label="Search"><bindpose-viewer id="a" ${FIGURE} ui="full"></bindpose-viewer>
  <p id="low">More</p>`, {
  first: '<link rel="stylesheet" href="/notes.css">',
  sheet: "body { margin: 0 } bindpose-viewer { width: 960px; height: 560px } #low { height: 2000px }",
  policy: STRICT,
});
test("with the page's interface too, a viewer leaves the page its focus, its wheel and its stores", {
  ...full,
  firstVisit: true,
  prepare: async (page) => {
    // What pages of this site have kept before.
    await page.addInitScript(() => localStorage.clear());
    await full.prepare(page);
  },
}, async (page) => {
  await page.evaluate(() => {
    globalThis.viewer = document.getElementById("a");
    const field = document.getElementById("field");
    field.focus();
    field.addEventListener("blur", () => (globalThis.lost = true));
  });
  const focused = () => page.evaluate(() => [document.activeElement.id, viewer.shadowRoot.activeElement?.localName]);
  const camera = () => page.evaluate(() => JSON.stringify(viewer.state().camera));
  const scrolls = async (to) => {
    await page.mouse.move(480, 300);
    await page.mouse.wheel(0, to - (await page.evaluate(() => scrollY)));
    await page.waitForFunction((to) => scrollY === to, to, { polling: 50 });
  };
  await hears(page, "a", "load");
  assert.deepEqual([...(await focused()), await page.evaluate(() => globalThis.lost)], ["field", undefined, undefined]);
  await page.waitForFunction(() => viewer.state().framesRendered > 0, null, { polling: 50 });
  await settled(page);
  const before = await camera();
  await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.equal((await seen(page, "a")).currentTime, 0, "nor a key of the page's field");
  await scrolls(60);
  assert.equal(await camera(), before);
  // Where nothing has the focus, nothing gets it.
  await page.evaluate(() => {
    document.getElementById("field").blur();
    viewer.remove();
  });
  await settled(page);
  await page.evaluate(() => document.getElementById("low").before(viewer));
  await hears(page, "a", "load", 2);
  assert.deepEqual(await focused(), ["", undefined]);
  await scrolls(0);
  assert.equal(await camera(), before);
  await page.mouse.click(...GROUND);
  await page.mouse.wheel(0, -240);
  await page.waitForFunction((before) => JSON.stringify(viewer.state().camera) !== before, before, { polling: 50 });
  assert.equal(await page.evaluate(() => scrollY), 0, "until somebody turns to it");

  // A name is the viewer's own.
  await click(page, "page-1");
  await still(page, "bone-1");
  await page.mouse.dblclick(...(await place(page, "bone-1")));
  await page.waitForFunction(() => viewer.shadowRoot.activeElement?.localName === "input", null, { polling: 50 });
  await page.keyboard.type("Hips", { delay: 30 });
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => viewer.state().skeleton.names[1] === "Hips", null, { polling: 50 });

  // Clips that came to the model come back with it.
  const strolls = readFileSync(SAMPLE, "utf8").replace("AnimationClip Walk", "AnimationClip Stroll");
  const clips = page.locator("#a input[type=file]").nth(1);
  await clips.setInputFiles({ name: "stroll.m3d", mimeType: "text/plain", buffer: Buffer.from(strolls) });
  await page.waitForFunction(() => viewer.clips.includes("Stroll"), null, { polling: 50 });
  await page.evaluate(() => viewer.remove());
  await settled(page);
  await page.evaluate(() => document.getElementById("low").before(viewer));
  await hears(page, "a", "load", 3);
  assert.ok(await page.evaluate(() => viewer.clips.includes("Stroll")));

  // It draws in sight only.
  await page.evaluate(() => viewer.play());
  const goesOn = (from) =>
    page.waitForFunction((from) => viewer.state().framesRendered > from + 1, from, { polling: 50 });
  await goesOn(await drawn(page, "a"));
  await page.evaluate(() => scrollTo(0, 1500));
  await comesToRest(page, "a");
  assert.equal((await seen(page, "a")).paused, false);
  await page.evaluate(() => scrollTo(0, 0));
  await goesOn(await drawn(page, "a"));
  await page.evaluate(() => (viewer.ui = "none"));
  await hears(page, "a", "load", 4);
  assert.ok(await page.evaluate(() => viewer.clips.includes("Stroll")), "in the small program too");
  assert.deepEqual(await page.evaluate(() => violations), [], "the policy of the README is enough for it");
  const kept = await page.evaluate(() => [localStorage, sessionStorage].map((store) => Object.entries(store)));
  assert.deepEqual(kept, [[], []], "neither the name nor anything else");
});

test("a panic in one viewer is told by all, in what the page has for it", {
  expectErrors: true,
  ...pageOf(`<bindpose-viewer id="a" ${FIGURE}><p slot="error" id="mine">It stopped.</p></bindpose-viewer><bindpose-viewer id="b" ${FIGURE}></bindpose-viewer>`),
}, async (page) => {
  await hears(page, "a", "load");
  await hears(page, "b", "load");
  await page.evaluate(() => reportError(Object.assign(new Error("index out of bounds"), { name: "Panic" })));
  for (const id of ["a", "b"]) await hears(page, id, "error");
  assert.ok(await page.isVisible("#mine"));
  const told = (id) => page.evaluate((id) => [document.getElementById(id).error.message, document.getElementById(id).state().error.code, document.getElementById(id).shadowRoot.querySelectorAll("canvas").length], id);
  for (const id of ["a", "b"]) assert.deepEqual(await told(id), ["index out of bounds", "viewer-stopped", 0]);
  const card = page.locator("#b").getByRole("alert");
  assert.ok(await card.isVisible());
  assert.match(await card.textContent(), /index out of bounds/);
});

/** A program of the page's own: its function `trap` does. */
const TRAP = [
  0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 7, 8, 1, 4, 116, 114, 97, 112, 0, 0, 10, 5, 1, 3, 0, 0, 11,
];

const other = pageOf(`<bindpose-viewer id="a" ${FIGURE}></bindpose-viewer>`);
test("another program's end is none of a viewer's, and its own is", {
  ...other,
  expectErrors: true,
  prepare: async (page) => {
    await withViewer(`
      start(...values) {
        globalThis.newest = this;
        return super.start(...values);
      }`)(page);
    await page.addInitScript(() => {
      const errors = [];
      Object.assign(globalThis, { errors, onerror: (words) => void errors.push(words) });
      // How many listen for errors of the page.
      const listening = (globalThis.listening = new Set());
      const { addEventListener, removeEventListener } = globalThis;
      globalThis.addEventListener = (type, listener, ...rest) => {
        if (type === "error") listening.add(listener);
        addEventListener.call(globalThis, type, listener, ...rest);
      };
      globalThis.removeEventListener = (type, listener, ...rest) => {
        if (type === "error") listening.delete(listener);
        removeEventListener.call(globalThis, type, listener, ...rest);
      };
    });
    await other.prepare(page);
  },
}, async (page) => {
  await hears(page, "a", "load");
  const told = () => page.evaluate(() => [listening.size, document.getElementById("a").error?.message ?? null]);
  // What is thrown in a task of its own is an error of the page.
  await page.evaluate((bytes) => new Promise((done) => {
    const { trap } = new WebAssembly.Instance(new WebAssembly.Module(Uint8Array.from(bytes))).exports;
    setTimeout(trap);
    setTimeout(done);
  }), TRAP);
  assert.match(await page.evaluate(() => errors.join()), /RuntimeError: unreachable/);
  assert.deepEqual(await told(), [1, null]);
  await page.evaluate(() => {
    globalThis.viewer = document.getElementById("a");
    viewer.remove();
  });
  await settled(page);
  assert.deepEqual(await page.evaluate(() => listening.size), 0, "nobody listens where no viewer is");
  await page.evaluate(() => document.body.append(viewer));
  await hears(page, "a", "load", 2);
  // Our program traps: it is asked about a viewer where it has no memory.
  await page.evaluate(() => void setTimeout(() => {
    newest.__wbg_ptr = 0xf0000000;
    viewer.state();
  }));
  await hears(page, "a", "error");
  assert.deepEqual(await told(), [0, "memory access out of bounds"]);
});
