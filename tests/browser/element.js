// <bindpose-viewer> on other people's pages: what it takes and tells, and that it is a guest there.

import assert from "node:assert/strict";
import { BACKEND, FOLDER, SAMPLE, keep, settled, test } from "./harness.js";
import { held } from "./held.js";
import { coloursOnScreen } from "./picture.js";

const FIGURE = 'src="web/sample/figure.m3d web/sample/figure_diff.png web/sample/figure_norm.png"';

/** Where the program without the interface is. */
const SMALL = FOLDER.replace("pkg/", "pkg/element/");

/** A page with this body. Events of its viewers are in `heard`, as `[id, type]`. */
const pageOf = (body, { first = "", policy = "", sheet = "" } = {}) => ({
  query: "notes.html",
  bare: true,
  prepare: async (page) => {
    const html = `<!doctype html><title>Notes</title>${policy && `<meta http-equiv="Content-Security-Policy" content="${policy}">`}${first}
      <script type="module" src="/web/element/bindpose-viewer.js"></script>${body.replaceAll("<bindpose-viewer", `<bindpose-viewer backend="${BACKEND}"`)}`;
    await page.route("**/notes.html", (route) => route.fulfill({ contentType: "text/html", body: html }));
    await page.route("**/notes.css", (route) => route.fulfill({ contentType: "text/css", body: sheet }));
    await page.addInitScript(() => {
      globalThis.heard = [];
      for (const type of ["load", "progress", "error", "play", "pause", "timeupdate", "camera-change"]) document.addEventListener(type, ({ target }) => target.id && heard.push([target.id, type]), true);
    });
  },
});

/** Waits until a viewer has told of this as often. */
const hears = (page, id, type, times = 1) =>
  page.waitForFunction(([id, type, times]) => heard.filter(([by, what]) => by === id && what === type).length >= times, [id, type, times], { polling: 50 });

/** What a viewer says of itself. */
const seen = (page, id) =>
  page.evaluate((id) => {
    const viewer = document.getElementById(id);
    const { clip, clips, currentTime, duration, paused, playbackRate } = viewer;
    const { look, skeleton, camera, backend, link } = viewer.state();
    return { clip, clips: clips.length, currentTime, duration, paused, playbackRate, light: look?.light, bone: skeleton?.selected, bones: skeleton?.bonesVisible, yaw: camera?.yawRadians, backend, link };
  }, id);

test("viewers of a page of notes show what their attributes say, and the page's styles stay outside", {
  draws: true,
  ...pageOf(`<h1>Notes</h1><bindpose-viewer id="a" ${FIGURE} clip="Walk" current-time="0.5" speed="0.5" loop alt="A step"></bindpose-viewer>
    <table><tr><td><bindpose-viewer id="b" ${FIGURE} ui="none" camera="right" light="book" skeleton bone="9" loading="lazy" style="width: 240px; height: 200px"></bindpose-viewer></td></tr></table>
    <bindpose-viewer id="c" src="web/nothing.m3d" style="height: 120px"></bindpose-viewer>`, {
    first: '<link rel="stylesheet" href="/notes.css">',
    sheet: "* { all: revert; color: red !important } body { margin: 8px }",
    policy: "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self' blob:; img-src 'self' blob:",
  }),
  expectErrors: true,
}, async (page) => {
  await hears(page, "a", "load");
  const a = await seen(page, "a");
  assert.deepEqual([a.clip, a.clips, a.currentTime, a.paused, a.playbackRate, a.backend], ["Walk", 4, 0.5, true, 0.5, BACKEND]);
  assert.ok(Math.abs(a.duration - 32 / 30) < 1e-3, `${a.duration}`);
  await hears(page, "c", "error");
  assert.match(await page.evaluate(() => document.getElementById("c").error.message), /has no \/web\/nothing\.m3d/);
  await page.locator("#b").scrollIntoViewIfNeeded();
  await hears(page, "b", "load");
  const b = await seen(page, "b");
  assert.deepEqual([b.light, b.bone, b.bones, b.clip], ["book", 9, true, "Take1"]);
  assert.ok(Math.abs(b.yaw - Math.PI / 2) < 1e-5, `${b.yaw}`);
  // One program and one download for all.
  assert.equal(await page.evaluate(() => performance.getEntriesByType("resource").filter(({ name }) => name.endsWith(".wasm")).length), 1);
  assert.ok((await coloursOnScreen(page)) > 200);
  await keep(page, "element");
  const styles = await page.evaluate(() => {
    const inside = document.getElementById("a").shadowRoot.querySelector("select");
    return [getComputedStyle(inside).color, getComputedStyle(document.querySelector("h1")).color, document.body.style.length, document.getElementById("a").offsetWidth, document.getElementById("a").offsetHeight];
  });
  assert.deepEqual(styles.slice(0, 3), ["rgb(231, 234, 240)", "rgb(255, 0, 0)", 0]);
  assert.ok(styles[3] > 600 && styles[4] > 400, `${styles}: its size is its own where the page takes back all`);
  assert.ok((await page.evaluate(async () => (await document.getElementById("a").snapshot({ width: 64, height: 48 })).size)) > 500);
  // Attributes that change, one at a time: the rest stays.
  await page.evaluate(() => {
    const viewer = document.getElementById("a");
    viewer.setAttribute("light", "book");
    viewer.setAttribute("bone", "5");
  });
  const changed = await seen(page, "a");
  assert.deepEqual([changed.light, changed.bone, changed.clip, changed.currentTime], ["book", 5, "Walk", 0.5]);
  await page.evaluate(() => document.getElementById("a").removeAttribute("bone"));
  assert.equal((await seen(page, "a")).bone, null);
});

test("a page scrolls over a viewer until somebody turns to it; its controls are plain ones", pageOf(`<bindpose-viewer id="a" ${FIGURE} loop></bindpose-viewer><p style="height: 2000px">More</p>`), async (page) => {
  await hears(page, "a", "load");
  const [x, y] = [320, 200];
  const camera = async () => JSON.stringify(await page.evaluate(() => document.getElementById("a").state().camera));
  // It is framed in the first frame.
  await page.waitForFunction(() => document.getElementById("a").state().framesRendered > 2);
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

test("a viewer that leaves the page gives all back, and comes again where it was; the last source wins", {
  ...pageOf(`<bindpose-viewer id="a" ${FIGURE} clip="Walk" current-time="0.5"></bindpose-viewer>`),
  draws: true,
}, async (page) => {
  await hears(page, "a", "load");
  await page.evaluate(() => (globalThis.viewer = document.getElementById("a")).setAttribute("camera", "70 12"));
  const { link } = await seen(page, "a");
  let first;
  for (let round = 1; round <= 6; round += 1) {
    await page.evaluate(() => viewer.remove());
    await settled(page);
    assert.equal(await page.evaluate(() => viewer.shadowRoot.querySelectorAll("canvas").length), 0);
    await page.evaluate(() => document.body.append(viewer));
    await hears(page, "a", "load", 1 + round);
    assert.equal((await seen(page, "a")).link, link);
    if (round === 3) first = await held(page, SMALL);
  }
  const last = await held(page, SMALL);
  for (const kind of ["HTMLCanvasElement", "HTMLInputElement", "GPUDevice"]) assert.ok(last[kind] <= first[kind], `${kind}: ${JSON.stringify([first, last])}`);
  assert.ok(last.wasmMB <= 1.05 * first.wasmMB, `${first.wasmMB} MB, then ${last.wasmMB}`);
  // Another interface is another start with the same moment.
  await page.evaluate(() => (viewer.ui = "full"));
  await hears(page, "a", "load", 8);
  assert.equal((await seen(page, "a")).link, link);
  await page.getByRole("button", { name: "Play" }).first().waitFor({ state: "attached" });
  await page.evaluate(() => (viewer.ui = "none"));
  await hears(page, "a", "load", 9);
  await page.route("**/other.m3d", (route) => route.fulfill({ path: SAMPLE }));
  await page.evaluate(() => {
    viewer.src = "web/sample/figure.m3d";
    viewer.src = "web/nothing.m3d";
    viewer.src = "web/other.m3d";
  });
  await hears(page, "a", "load", 10);
  assert.deepEqual(await page.evaluate(() => [viewer.error, viewer.state().model.name]), [null, "other.m3d"]);
});
