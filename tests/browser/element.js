// <bindpose-viewer> on other people's pages: what it takes and tells, and that it is a guest there.

import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { assertSound } from "./axe.js";
import { BACKEND, FOLDER, SAMPLE, keep, settled, test } from "./harness.js";
import { held } from "./held.js";
import { coloursOnScreen } from "./picture.js";
import { pretendGpu } from "./programs.js";

/** So often a viewer leaves its page and comes back; the longer checks do it fifty times. */
const ROUNDS = process.env.BINDPOSE_CASES > 1 ? 50 : 6;

const FIGURE = 'src="web/sample/figure.m3d web/sample/figure_diff.png web/sample/figure_norm.png"';

/** Where the program without the interface is. */
const SMALL = FOLDER.replace("pkg/", "pkg/element/");

/** A page with this body. Events of its viewers are in `heard`, as `[id, type]`. */
const pageOf = (body, { first = "", policy = "", sheet = "", backend = BACKEND } = {}) => ({
  query: "notes.html",
  bare: true,
  prepare: async (page) => {
    const html = `<!doctype html><title>Notes</title>${policy && `<meta http-equiv="Content-Security-Policy" content="${policy}">`}${first}
      <script type="module" src="/web/element/bindpose-viewer.js"></script>${body.replaceAll("<bindpose-viewer", `<bindpose-viewer backend="${backend}"`)}`;
    await page.route("**/notes.html", (route) => route.fulfill({ contentType: "text/html", body: html }));
    await page.route("**/notes.css", (route) => route.fulfill({ contentType: "text/css", body: sheet }));
    await page.addInitScript(() => {
      globalThis.heard = [];
      for (const type of ["load", "progress", "error", "play", "pause", "timeupdate", "camera-change"]) document.addEventListener(type, ({ target }) => target.id && heard.push([target.id, type]), true);
    });
  },
});

/** For `prepare`: the file at this address comes once `letThrough` is set in the page. */
const holding = (address) => (page) =>
  page.route(`**/${address}`, async (route) => {
    await page.waitForFunction(() => globalThis.letThrough).catch(() => {});
    await route.fulfill({ path: SAMPLE }).catch(() => {});
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
  assert.deepEqual(styles.slice(0, 3), ["rgb(27, 32, 41)", "rgb(255, 0, 0)", 0]);
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
  let first, half;
  for (let round = 1; round <= ROUNDS; round += 1) {
    await page.evaluate(() => viewer.remove());
    await settled(page);
    assert.equal(await page.evaluate(() => viewer.shadowRoot.querySelectorAll("canvas").length), 0);
    await page.evaluate(() => document.body.append(viewer));
    await hears(page, "a", "load", 1 + round);
    assert.equal((await seen(page, "a")).link, link);
    if (round === ROUNDS / 2 + 15) half = await held(page, SMALL);
    if (round === 3) first = await held(page, SMALL);
  }
  const last = await held(page, SMALL);
  for (const kind of ["HTMLCanvasElement", "HTMLInputElement", "GPUDevice"]) assert.ok(last[kind] <= first[kind], `${kind}: ${JSON.stringify([first, last])}`);
  // Memory grows in steps until it has found its high-water mark; who did not leave would keep the bytes of a file a round.
  const grown = last.wasmMB - first.wasmMB;
  assert.ok(grown < (0.9 * (ROUNDS - 3) * statSync(SAMPLE).size) / 1e6, `${first.wasmMB} MB, then ${last.wasmMB}`);
  if (ROUNDS > 10) assert.ok(last.wasmMB <= 1.05 * half.wasmMB, `${half.wasmMB} MB, then ${last.wasmMB}`);
  // Another interface is another start with the same moment.
  await page.evaluate(() => (viewer.ui = "full"));
  await hears(page, "a", "load", ROUNDS + 2);
  assert.equal((await seen(page, "a")).link, link);
  await page.getByRole("button", { name: "Play" }).first().waitFor({ state: "attached" });
  await page.evaluate(() => (viewer.ui = "none"));
  await hears(page, "a", "load", ROUNDS + 3);
  await page.route("**/other.m3d", (route) => route.fulfill({ path: SAMPLE }));
  await page.evaluate(() => {
    viewer.src = "web/sample/figure.m3d";
    viewer.src = "web/nothing.m3d";
    viewer.src = "web/other.m3d";
  });
  await hears(page, "a", "load", ROUNDS + 4);
  assert.deepEqual(await page.evaluate(() => [viewer.error, viewer.state().model.name]), [null, "other.m3d"]);
});

const slow = pageOf('<bindpose-viewer id="a" src="web/slow.m3d"></bindpose-viewer>');
test("what a script opens takes the place of the source, and a source that comes late the place of nothing", {
  ...slow,
  prepare: async (page) => {
    await holding("slow.m3d")(page);
    await page.route("**/other.m3d", (route) => route.fulfill({ path: SAMPLE }));
    await slow.prepare(page);
  },
}, async (page) => {
  // The program is on its way.
  const given = await page.evaluate(async () => {
    globalThis.viewer = document.getElementById("a");
    const bytes = new Uint8Array(await (await fetch("web/sample/figure.m3d")).arrayBuffer());
    return (await viewer.open([{ name: "given.m3d", bytes }])).model.name;
  });
  assert.equal(given, "given.m3d");
  const late = async () => {
    await page.evaluate(() => (globalThis.letThrough = true));
    for (let round = 0; round < 10; round += 1) await settled(page);
    return page.evaluate(() => {
      globalThis.letThrough = false;
      return viewer.state().model.name;
    });
  };
  assert.equal(await late(), "given.m3d");
  await page.evaluate(() => {
    viewer.src = "web/slow.m3d?again";
    viewer.src = "web/slow.m3d";
  });
  await settled(page);
  await page.evaluate(() => (viewer.src = "web/other.m3d"));
  await page.waitForFunction(() => viewer.state().model.name === "other.m3d");
  assert.equal(await late(), "other.m3d");
  const refused = await page.evaluate(() => {
    const loose = document.createElement("bindpose-viewer");
    return Promise.all(["open", "snapshot"].map((name) => loose[name]([]).then(() => "done", (error) => error.name)));
  });
  assert.deepEqual(refused, ["InvalidStateError", "InvalidStateError"]);
  // One bone's matrix, for who draws beside it.
  const [root, none, matrix] = await page.evaluate(() => [viewer.boneToRoot(0), viewer.boneToRoot(9999), Array.from(viewer.boneToRoot(9))]);
  assert.equal(root.length ?? Object.keys(root).length, 16);
  assert.equal(none, undefined);
  assert.ok(matrix[13] > 0.5 && matrix[15] === 1, `${matrix}: above the ground`);
});

const waits = pageOf(`<bindpose-viewer id="a" ui="none" poster="web/icon.svg" src="web/slow.m3d"></bindpose-viewer>
  <bindpose-viewer id="b" src="web/slow.m3d"><b slot="poster">A step</b><i slot="progress">Wait</i></bindpose-viewer>`);
test("a poster and progress are seen until the model is, also those of the page; full screen is the element's", {
  draws: true,
  ...waits,
  prepare: async (page) => {
    await holding("slow.m3d")(page);
    await waits.prepare(page);
  },
}, async (page) => {
  await page.waitForFunction(() => ["a", "b"].every((id) => document.getElementById(id).state?.().backend));
  const over = (id) =>
    page.evaluate((id) => {
      const viewer = document.getElementById(id);
      const root = viewer.shadowRoot;
      return {
        poster: root.querySelector(".poster img").checkVisibility() && root.querySelector(".poster img").naturalWidth > 0,
        progress: root.querySelector("progress").checkVisibility(),
        own: Array.from(viewer.children, (child) => child.checkVisibility() && child.getBoundingClientRect().width > 0),
      };
    }, id);
  assert.deepEqual(await over("a"), { poster: true, progress: true, own: [] });
  assert.deepEqual(await over("b"), { poster: false, progress: false, own: [true, true] });
  await keep(page, "element-waits");
  await page.evaluate(() => (globalThis.letThrough = true));
  await hears(page, "a", "load");
  await hears(page, "b", "load");
  assert.deepEqual(await over("a"), { poster: false, progress: false, own: [] });
  assert.deepEqual(await over("b"), { poster: false, progress: false, own: [false, false] });
  const full = page.getByRole("button", { name: "Full screen" });
  await full.click();
  await page.waitForFunction(() => document.fullscreenElement?.id === "b", null, { polling: 50 });
  await page.waitForFunction(() => document.getElementById("b").shadowRoot.querySelector("canvas").clientWidth > innerWidth * 0.9, null, { polling: 50 });
  await full.click();
  await page.waitForFunction(() => !document.fullscreenElement, null, { polling: 50 });
});

test("what is asked early is done when the model is there; what is asked again is shown again; a wrong name is a warning", {
  draws: true,
  ...pageOf(`<meta name="color-scheme" content="dark"><bindpose-viewer id="a" src="web/sample/figure.m3d web/nothing.png"></bindpose-viewer>
    <script>
      // Before the module is there.
      const early = document.getElementById("a");
      early.clip = "Run";
      early.bone = "5";
    </script>
    <script type="module">
      const viewer = document.getElementById("a");
      viewer.currentTime = 0.25;
      viewer.loop = true;
    </script>`),
  expectErrors: true,
}, async (page) => {
  const warned = [];
  page.on("console", (message) => message.type() === "warning" && message.text().includes("bindpose-viewer") && warned.push(message.text()));
  await hears(page, "a", "load");
  const { clip, currentTime, yaw, bone } = await seen(page, "a");
  assert.deepEqual([clip, currentTime, bone], ["Run", 0.25, 5], "and the picture that is not there leaves the model");
  const set = (name, value) => page.evaluate(([name, value]) => void (document.getElementById("a")[name] = value), [name, value]);
  const camera = () => page.evaluate(() => document.getElementById("a").state().camera);
  await set("camera", "right");
  const right = await camera();
  assert.notEqual(right.yawRadians, yaw);
  // A drag, and the same side again.
  await page.mouse.click(100, 100);
  await page.mouse.move(100, 100);
  await page.mouse.down();
  await page.mouse.move(160, 120, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  const dragged = await camera();
  assert.notEqual(dragged.yawRadians, right.yawRadians);
  await set("bone", "999");
  await set("clip", "Nonsense");
  assert.deepEqual(await camera(), dragged, "a bone and a clip that are not there change nothing");
  assert.equal((await seen(page, "a")).clip, "Run");
  await page.waitForTimeout(50);
  assert.match(warned.join(), /not understood, or not in figure\.m3d: bone .*: clip/);
  await set("bone", null);
  await set("skeleton", true);
  await set("skeleton", false);
  assert.deepEqual([await camera(), (await seen(page, "a")).bones], [dragged, false], "nor do those that are taken away");
  await set("camera", "right");
  assert.deepEqual(await camera(), right);
  await set("link", "clip=Walk&t=0.5&bones=1");
  await set("clip", "Wave");
  await set("link", "clip=Walk&t=0.5&bones=1");
  const again = await seen(page, "a");
  assert.deepEqual([again.clip, again.currentTime, again.bones], ["Walk", 0.5, true]);
  await set("skeleton", false);
  assert.equal((await seen(page, "a")).bones, false, "bones of a link, too");

  // The theme is the page's, where the element is; a colour of a style is behind the model.
  const corner = () =>
    page.evaluate(async () => {
      const bitmap = await createImageBitmap(await document.getElementById("a").snapshot({ width: 64, height: 64 }));
      const pen = new OffscreenCanvas(64, 64).getContext("2d");
      pen.drawImage(bitmap, 0, 0);
      return Array.from(pen.getImageData(1, 1, 1, 1).data.subarray(0, 3));
    });
  const dark = await corner();
  assert.ok(Math.max(...dark) < 100, `dark: ${dark}`);
  await page.evaluate(() => document.getElementById("a").style.setProperty("color-scheme", "light"));
  await page.waitForFunction(() => getComputedStyle(document.getElementById("a").shadowRoot.querySelector(".view")).color === "rgb(0, 0, 0)", null, { polling: 50 });
  await page.waitForTimeout(100);
  const light = await corner();
  assert.ok(Math.min(...light) > 150, `light: ${light}`);
  await set("background", "rebeccapurple");
  assert.deepEqual(await corner(), [102, 51, 153]);
  await page.evaluate(() => {
    const viewer = document.getElementById("a");
    viewer.removeAttribute("background");
    viewer.style.setProperty("--bindpose-background", "rgb(10 90 20)");
    viewer.remove();
    viewer.removeAttribute("link");
    document.body.append(viewer);
    viewer.src = "web/sample/figure.m3d";
  });
  await hears(page, "a", "load", 2);
  assert.deepEqual(await corner(), [10, 90, 20]);
  await page.evaluate(() => document.getElementById("a").style.setProperty("--bindpose-background", "rgb(90 20 10)"));
  await page.waitForTimeout(200);
  assert.deepEqual(await corner(), [90, 20, 10], "a style that changes");
});

test("in a flex box, in what is folded away, hidden and shown, a viewer has its size and draws only in sight", {
  draws: true,
  ...pageOf(`<style>body { margin: 0 }</style><div style="display: flex; width: 640px"><bindpose-viewer id="flex" ${FIGURE} style="flex: 1; min-width: 0" autoplay loop></bindpose-viewer><p style="width: 200px">Beside</p></div>
    <details id="more"><summary>More</summary><bindpose-viewer id="folded" ${FIGURE} loading="lazy" poster="web/icon.svg"></bindpose-viewer></details>
    <p style="height: 2000px">Far</p><bindpose-viewer id="far" ${FIGURE} loading="lazy"></bindpose-viewer>`),
  motion: true,
}, async (page) => {
  await hears(page, "flex", "load");
  const size = (id) => page.evaluate((id) => [document.getElementById(id).offsetWidth, document.getElementById(id).shadowRoot.querySelector("canvas")?.width ?? 0], id);
  const drawn = (id) => page.evaluate((id) => document.getElementById(id).state().framesRendered, id);
  const [width, pixels] = await size("flex");
  assert.equal(width, 440);
  assert.ok(Math.abs(pixels - width * (await page.evaluate(() => devicePixelRatio))) <= 1, `${pixels} pixels for ${width}`);
  await page.evaluate(() => document.querySelector("div").style.setProperty("width", "400px"));
  await page.waitForFunction(() => document.getElementById("flex").shadowRoot.querySelector("canvas").width < 120);
  // Neither what is folded nor what is far was loaded.
  assert.deepEqual(await page.evaluate(() => heard.filter(([id]) => id !== "flex")), []);
  await page.evaluate(() => (document.getElementById("more").open = true));
  await hears(page, "folded", "load");
  assert.ok((await size("folded"))[1] > 0);
  await keep(page, "element-layout");
  const isStill = async (id) => {
    const before = await drawn(id);
    for (let round = 0; round < 6; round += 1) await settled(page);
    return before === (await drawn(id));
  };
  assert.equal(await isStill("flex"), false);
  await page.evaluate(() => (document.getElementById("flex").hidden = true));
  await page.waitForFunction(async () => {
    const frames = () => document.getElementById("flex").state().framesRendered;
    const before = frames();
    await new Promise((done) => setTimeout(done, 300));
    return before === frames();
  });
  assert.equal((await seen(page, "flex")).paused, false, "it goes on when it is seen again");
  await page.evaluate(() => (document.getElementById("flex").hidden = false));
  await page.waitForFunction((before) => document.getElementById("flex").state().framesRendered > before, await drawn("flex"));
  await page.evaluate(() => scrollTo(0, 4000));
  await hears(page, "far", "load");
});

for (const ui of ["transport", "none", "full"]) {
  test(`axe finds nothing on a page with a viewer whose interface is ${ui}`, { expectErrors: true, ...pageOf(`<html lang="en"><main><h1>Notes</h1><bindpose-viewer id="a" ${FIGURE} ui="${ui}" alt="A figure"></bindpose-viewer></main>`) }, async (page) => {
    await hears(page, "a", "load");
    await assertSound(page, ui);
    await page.evaluate(() => reportError(Object.assign(new Error("index out of bounds"), { name: "Panic" })));
    await hears(page, "a", "error");
    await assertSound(page, `${ui}, after a panic`);
  });
}

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
  assert.match(await page.locator("#b").evaluate((viewer) => viewer.shadowRoot.querySelector("[role=alert]").textContent), /index out of bounds/);
});

test("a page scrolls under a finger, and turns the view once it was touched", {
  phone: true,
  ...pageOf(`<meta name="viewport" content="width=device-width"><bindpose-viewer id="a" ${FIGURE} ui="none" style="width: 360px; height: 360px"></bindpose-viewer><p style="height: 3000px">More</p>`),
}, async (page) => {
  await hears(page, "a", "load");
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

const loses = pageOf(`<bindpose-viewer id="a" ${FIGURE}></bindpose-viewer>`, { backend: "auto" });
for (const ui of ["transport", "full"]) {
  test(`a viewer that loses WebGPU for good goes on with WebGL2, where its interface is ${ui}`, {
    only: "webgpu",
    draws: true,
    ...loses,
    prepare: async (page) => {
      await pretendGpu()(page);
      await loses.prepare(page);
    },
  }, async (page) => {
    await hears(page, "a", "load");
    await page.evaluate(async (ui) => {
      globalThis.viewer = document.getElementById("a");
      if (ui === "full") viewer.ui = ui;
    }, ui);
    await hears(page, "a", "load", ui === "full" ? 2 : 1);
    await page.evaluate(() => {
      viewer.setAttribute("clip", "Run");
      viewer.setAttribute("camera", "70 12");
      viewer.currentTime = 0.25;
    });
    const { link, backend } = await seen(page, "a");
    assert.equal(backend, "webgpu");
    await page.evaluate(() => {
      globalThis.adapters = "none";
      globalThis.device.destroy();
    });
    await page.waitForFunction(() => viewer.state().backend === "webgl2" && viewer.clip === "Run" && viewer.currentTime === 0.25);
    assert.equal((await seen(page, "a")).link, link);
    assert.ok((await coloursOnScreen(page)) > 200);
    assert.equal(await page.evaluate(() => viewer.shadowRoot.querySelectorAll("canvas").length), 1);
  });
}

/** A page of examples/. */
const example = (name) => ({ query: `examples/${name}.html`, bare: true, draws: true, only: "webgl2", viewport: { width: 700, height: 900 } });
const ready = (page, id) => page.waitForFunction((id) => document.getElementById(id).state?.().model, id, { polling: 50 });

test("the example with three viewers: a sentence leads to a moment", example("three"), async (page) => {
  await ready(page, "walk");
  await page.getByRole("link", { name: "the weight changes feet" }).click();
  await page.waitForFunction(() => document.getElementById("walk").currentTime === 0.5 && document.getElementById("walk").paused);
  for (const viewer of await page.locator("bindpose-viewer").all()) await viewer.scrollIntoViewIfNeeded();
  await page.waitForFunction(() => [...document.querySelectorAll("bindpose-viewer")].every((viewer) => viewer.state().model && viewer.shadowRoot.querySelector(".poster").hidden));
  assert.equal(await page.evaluate(() => document.querySelectorAll("bindpose-viewer")[2].state().skeleton.skinView), "weight");
  await keep(page, "example-three");
});

test("the example with a curve: a bone's height is drawn while the clip plays", { ...example("bone-height"), motion: true }, async (page) => {
  await ready(page, "viewer");
  const inked = () => page.evaluate(() => document.getElementById("curve").getContext("2d").getImageData(0, 0, 640, 160).data.filter((value, index) => index % 4 === 3 && value > 0).length);
  await page.waitForFunction(() => document.getElementById("viewer").currentTime > 0.3);
  assert.ok((await inked()) > 100);
  await keep(page, "example-bone-height");
  const told = await page.evaluate(() => Number.parseFloat(document.getElementById("height").textContent));
  const tall = await page.evaluate(() => document.getElementById("viewer").state().model.bindBounds.max[1]);
  assert.ok(told > 0.3 * tall && told < 0.7 * tall, `${told}: the hips of a figure of ${tall}`);
});

test("the example with two files: one transport moves both, and one camera the other", example("compare"), async (page) => {
  for (const id of ["left", "right"]) await ready(page, id);
  await page.getByRole("slider", { name: "Time" }).fill("0.5");
  const at = () => page.evaluate(() => ["left", "right"].map((id) => document.getElementById(id)).map(({ currentTime, duration }) => Math.round((100 * currentTime) / duration)));
  await page.waitForFunction(() => document.getElementById("right").currentTime > 0.3);
  assert.deepEqual(await at(), [50, 50]);
  const left = await page.locator("#left").boundingBox();
  await page.mouse.move(left.x + 100, left.y + 100);
  await page.mouse.down();
  await page.mouse.move(left.x + 160, left.y + 100, { steps: 5 });
  await page.mouse.up();
  await page.waitForFunction(() => {
    const [one, other] = ["left", "right"].map((id) => document.getElementById(id).state().camera.yawRadians);
    return Math.abs(one) > 0.1 && Math.abs(one - other) < 1e-4;
  });
  await page.locator("input[data-for=right]").setInputFiles(SAMPLE);
  await page.waitForFunction(() => document.getElementById("right").state().model.name === "figure.m3d" && document.getElementById("right").state().models.length === 1);
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction(() => document.getElementById("left").currentTime > 0.7);
  await keep(page, "example-compare");
});
