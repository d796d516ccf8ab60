// <bindpose-viewer> on other people's pages: what it takes, tells and shows.

import assert from "node:assert/strict";
import { assertSound } from "./axe.js";
import { BACKEND, FOLDER, SAMPLE, keep, programs, settled, test, withViewer } from "./harness.js";
import { SCENE, TRIANGLE } from "./elsewhere.js";
import { LINKS } from "./link.js";
import { FIGURE, SMALL, STRICT, hears, holding, pageOf, seen } from "./notes.js";
import { coloursOnScreen } from "./picture.js";
import { pretendGpu } from "./programs.js";

test("viewers of a page of notes show what their attributes say, and the page's styles stay outside", {
  draws: true,
  ...pageOf(`<h1>Notes</h1><bindpose-viewer id="a" ${FIGURE} clip="Walk" current-time="0.5" speed="0.5" loop alt="A step"></bindpose-viewer>
    <table><tr><td><bindpose-viewer id="b" ${FIGURE} ui="none" camera="right" light="book" skeleton bone="9" loading="lazy"></bindpose-viewer></td></tr></table>
    <bindpose-viewer id="c" src="web/nothing.m3d"></bindpose-viewer>`, {
    first: '<link rel="stylesheet" href="/notes.css">',
    sheet: "* { all: revert; color: red !important } body { margin: 8px } #b { width: 240px; height: 200px } #c { height: 120px; position: sticky }",
    policy: STRICT,
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
  const cell = await page.locator("#b").evaluate((viewer) => {
    const canvas = viewer.shadowRoot.querySelector("canvas");
    return [viewer.offsetWidth, viewer.offsetHeight, canvas.clientWidth, canvas.clientHeight, viewer.parentElement.offsetHeight];
  });
  assert.deepEqual(cell.slice(0, 4), [240, 200, 240, 200], "in a cell of a table");
  assert.ok(cell[4] < 230, `${cell[4]}: the cell is not higher than what is in it`);
  assert.deepEqual(await page.evaluate(() => violations), [], "the page's policy is enough");
  assert.equal(await page.evaluate(() => getComputedStyle(document.getElementById("c")).position), "sticky", "it stands as the page says");
  const global = await page.evaluate(() => [Object.getOwnPropertyNames(globalThis).filter((name) => !namesBefore.has(name)), document.title, location.href]);
  assert.deepEqual(global, [[], "Notes", page.url()], "it leaves no name behind");
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
  await page.evaluate(() => {
    globalThis.before = document.getElementById("a").shadowRoot.querySelector(".poster img").src;
    document.getElementById("a").poster = "web/sample/figure_diff.png";
  });
  await page.waitForFunction(() => {
    const { src, complete } = document.getElementById("a").shadowRoot.querySelector(".poster img");
    return src !== before && complete;
  }, null, { polling: 50 });
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
  assert.match(warned.join(), /not understood, or not in figure\.m3d: bone=999 .*: clip/);
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

/** Every attribute that says how a model is seen, with a value that is not the first. */
const ATTRIBUTES = {
  clip: "Walk", "current-time": "0.5", speed: "0.5", loop: "pingpong", camera: "70 12 4.2", light: "book", background: "rebeccapurple",
  "view-mode": "normal", bone: "5", skeleton: "", alt: "A step", interaction: "none", link: "model=soldier.m3d&sha=0123456789ab&skin=weight",
};
const written = Object.entries(ATTRIBUTES).map(([name, value]) => `${name}="${value}"`).join(" ");

test("each attribute means the same before the element is defined and after it has loaded", {
  ...pageOf(`<bindpose-viewer id="a" ${FIGURE} ${written}></bindpose-viewer><bindpose-viewer id="b" ${FIGURE}></bindpose-viewer>`),
  viewport: { width: 960, height: 1000 },
}, async (page) => {
  const warned = [];
  page.on("console", (message) => message.text().includes("<bindpose-viewer>") && warned.push(message.text()));
  for (const id of ["a", "b"]) await hears(page, id, "load");
  const told = (id) =>
    page.evaluate((id) => {
      const viewer = document.getElementById(id);
      const { clip, timeSecs, speed, loop, camera, look, skeleton } = viewer.state();
      const canvas = viewer.shadowRoot.querySelector("canvas");
      const takesPointers = getComputedStyle(canvas).pointerEvents;
      return {
        clip, timeSecs, speed, loop, yaw: camera.yawRadians, pitch: camera.pitchRadians, distance: camera.distance, light: look.light, background: look.background,
        viewMode: look.viewMode, bone: skeleton.selected, bones: skeleton.bonesVisible, skin: skeleton.skinView, takesPointers,
        alt: canvas.getAttribute("aria-label"), tabIndex: canvas.tabIndex,
      };
    }, id);
  for (const [name, value] of Object.entries(ATTRIBUTES)) {
    const before = await told("b");
    await page.evaluate(([name, value]) => document.getElementById("b").setAttribute(name, value), [name, value]);
    assert.notDeepEqual(await told("b"), before, name);
  }
  const { yaw, pitch, distance, ...rest } = await told("a");
  assert.deepEqual(rest, {
    clip: "Walk", timeSecs: 0.5, speed: 0.5, loop: "pingpong", light: "book", background: "#663399", viewMode: "normal", bone: 5, bones: true,
    skin: "weight", takesPointers: "none", alt: "A step", tabIndex: -1,
  });
  assert.deepEqual([yaw, pitch].map((angle) => Math.round((angle * 180) / Math.PI)), [70, 12]);
  assert.ok(Math.abs(distance - 4.2) < 1e-5, `${distance}`);
  assert.deepEqual(await told("b"), { yaw, pitch, distance, ...rest });
  assert.deepEqual(warned, [], "which model a link is about says its page");
  // As properties: what has few values has one of them, what needs none is there or not.
  const properties = () =>
    page.evaluate(() => {
      const { autoplay, loop, loading, interaction, ui, viewMode, alt } = document.getElementById("b");
      return { autoplay, loop, loading, interaction, ui, viewMode, alt };
    });
  const rests = { loading: "auto", ui: "transport", viewMode: "normal", alt: "A step" };
  assert.deepEqual(await properties(), { autoplay: false, loop: true, interaction: "none", ...rests });
  await page.evaluate(() => Object.assign(document.getElementById("b"), { autoplay: true, loop: false, interaction: "orbit" }));
  assert.deepEqual(await properties(), { autoplay: true, loop: false, interaction: "orbit", ...rests });
  const { loop, takesPointers, tabIndex } = await told("b");
  assert.deepEqual([loop, takesPointers, tabIndex], ["once", "auto", 0]);
});

/** For `prepare`: this file comes in four pieces, and its length is told, as servers do that do not compress. */
const inPieces = (address) => async (page) => {
  await page.route(`**/${address}`, (route) => route.fulfill({ path: SAMPLE }));
  await page.addInitScript((address) => {
    const { fetch } = globalThis;
    globalThis.fetch = async (wanted, ...rest) => {
      const response = await fetch(wanted, ...rest);
      if (!String(wanted).endsWith(address)) return response;
      const bytes = new Uint8Array(await response.arrayBuffer());
      const quarter = Math.ceil(bytes.length / 4);
      const start = (stream) => {
        for (let at = 0; at < bytes.length; at += quarter) stream.enqueue(bytes.slice(at, at + quarter));
        stream.close();
      };
      return new Response(new ReadableStream({ start }), { headers: { "Content-Length": bytes.length } });
    };
  }, address);
};

const plays = pageOf('<bindpose-viewer id="a" src="web/whole.m3d" clip="Walk"></bindpose-viewer>', {
  first: `<style>bindpose-viewer { --bindpose-accent: rgb(1 2 3); --bindpose-radius: 12px }
    bindpose-viewer::part(transport) { background: rgb(4 5 6) }</style>`,
});
test("a viewer plays as media elements do: it tells of what arrives and of the end, at each speed", {
  ...plays,
  prepare: async (page) => {
    await inPieces("whole.m3d")(page);
    await plays.prepare(page);
  },
}, async (page) => {
  await hears(page, "a", "load");
  const parts = await page.evaluate(() => details.progress.map(({ totalProgress }) => totalProgress));
  // The program came before, without a length.
  assert.deepEqual(parts.map((part) => Math.round(8 * part)), [5, 6, 7, 8, 8]);
  await page.evaluate(() => (document.getElementById("a").playbackRate = 2));
  assert.equal((await seen(page, "a")).playbackRate, 2);
  const speed = page.getByRole("combobox", { name: "Speed" });
  await page.waitForFunction(() => document.getElementById("a").shadowRoot.querySelector("[part=speed]").value === "2", null, { polling: 50 });
  await speed.selectOption("0.5×");
  assert.equal((await seen(page, "a")).playbackRate, 0.5);
  // To the end, which is told after the pause.
  await page.evaluate(() => {
    const viewer = document.getElementById("a");
    viewer.currentTime = viewer.startTime + viewer.duration - 0.05;
    viewer.play();
  });
  await hears(page, "a", "ended");
  const told = await page.evaluate(() => heard.map(([, type]) => type));
  assert.deepEqual(told.filter((type) => ["play", "pause", "ended"].includes(type)), ["play", "pause", "ended"]);
  const { ended, paused } = await page.evaluate(() => {
    const { ended, paused } = document.getElementById("a");
    return { ended, paused };
  });
  assert.deepEqual([ended, paused], [true, true]);
  const looks = await page.evaluate(() => {
    const root = document.getElementById("a").shadowRoot;
    const styleOf = (selector) => getComputedStyle(root.querySelector(selector));
    return [styleOf("[part=time]").accentColor, styleOf(".frame").borderRadius, styleOf("[part=transport]").backgroundColor];
  });
  assert.deepEqual(looks, ["rgb(1, 2, 3)", "12px", "rgb(4, 5, 6)"]);
});

const beside = pageOf('<bindpose-viewer id="a" src="notes/scene.gltf"></bindpose-viewer>');
test("what a .gltf names beside itself comes with it", {
  ...beside,
  prepare: async (page) => {
    await page.route("**/notes/scene.gltf", (route) => route.fulfill({ body: SCENE }));
    await page.route("**/notes/data/a%20triangle.bin", (route) => route.fulfill({ body: TRIANGLE }));
    await beside.prepare(page);
  },
}, async (page) => {
  await hears(page, "a", "load");
  const { model, error } = await page.evaluate(() => document.getElementById("a").state());
  assert.deepEqual([error, model.name, model.counts.triangles], [null, "scene.gltf", 1]);
});

test("the small program takes keys and clicks, and has no edits, export or verdicts", pageOf(`<bindpose-viewer id="a" ${FIGURE} ui="none" skeleton></bindpose-viewer>`), async (page) => {
  await hears(page, "a", "load");
  const ask = () => page.evaluate(() => document.getElementById("a").state());
  const { x, y, width, height } = await page.locator("#a").boundingBox();
  await page.mouse.click(x + 10, y + 10);
  assert.equal((await ask()).skeleton.selected, null, "beside all bones");
  await page.keyboard.press("ArrowRight");
  const stepped = await ask();
  assert.ok(Math.abs(stepped.timeSecs - 1 / 30) < 1e-3, `${stepped.timeSecs}: one frame on`);
  await page.keyboard.press("Space");
  await page.waitForFunction(() => !document.getElementById("a").paused, null, { polling: 50 });
  await page.keyboard.press("Space");
  await page.waitForFunction(() => document.getElementById("a").paused, null, { polling: 50 });
  // Somewhere on the middle line of a figure that is framed there is a bone.
  for (let part = 0.3; part < 0.7 && (await ask()).skeleton.selected === null; part += 0.02) {
    await page.mouse.click(x + width / 2, y + part * height);
    await settled(page);
  }
  assert.notEqual((await ask()).skeleton.selected, null);
  await page.keyboard.press("Escape");
  assert.equal((await ask()).skeleton.selected, null);
  // Two clicks frame the model again.
  const far = () => page.evaluate(() => document.getElementById("a").state().camera.distance);
  const framed = await far();
  await page.mouse.wheel(0, 600);
  await page.waitForFunction((framed) => document.getElementById("a").state().camera.distance > 1.2 * framed, framed, { polling: 50 });
  await page.mouse.dblclick(x + 10, y + 10);
  await page.waitForFunction((framed) => Math.abs(document.getElementById("a").state().camera.distance / framed - 1) < 0.02, framed, { polling: 50 });
  const { book, timings } = await ask();
  assert.deepEqual([book, timings.judging], [null, undefined]);
  assert.ok(timings.reading > 0);
  const lacks = await page.evaluate(async (folders) => {
    const programs = await Promise.all(folders.map((folder) => import(`${folder}bindpose.js`)));
    const names = ["undo", "redo", "exportModel", "contactSheet", "handOver", "act", "readNames"];
    return programs.map(({ Viewer }) => names.filter((name) => !(name in Viewer.prototype)));
  }, [FOLDER, SMALL]);
  assert.deepEqual(lacks, [[], ["undo", "redo", "exportModel", "contactSheet", "handOver", "act", "readNames"]]);
});

const follows = pageOf(`<bindpose-viewer id="a" ${FIGURE} ui="none"></bindpose-viewer>`);
test("the small program brings back what every link says, but panels", {
  ...follows,
  prepare: async (page) => {
    await withViewer(`
      start(...values) {
        globalThis.newest = this;
        return super.start(...values);
      }`)(page);
    await follows.prepare(page);
  },
}, async (page) => {
  await hears(page, "a", "load");
  for (const link of LINKS) {
    const text = link.replace(/&panel=[^&]*/, "");
    assert.deepEqual(await page.evaluate((text) => newest.followLink(text, false), text), [], link);
    await page.waitForFunction((text) => newest.link().text === text, text, { polling: 50 }).catch(async (error) => {
      throw new Error(`${text}: ${await page.evaluate(() => newest.link().text)}`, { cause: error });
    });
  }
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

const loses = pageOf(`<bindpose-viewer id="a" ${FIGURE}></bindpose-viewer>`, { backend: "auto" });
for (const ui of ["transport", "full"]) {
  test(`a viewer that loses WebGPU for good goes on with WebGL2, where its interface is ${ui}`, {
    only: "webgpu",
    draws: true,
    ...loses,
    prepare: async (page) => {
      await pretendGpu()(page);
      // The checks have one small program at both addresses: here that of the one for WebGPU alone says what it would.
      await withViewer(`
        start(...values) {
          if (globalThis.adapters === "none" && import.meta.url.includes("/webgpu/")) throw Object.assign(new Error("no WebGL2"), { name: "WebGl2Missing" });
          return super.start(...values);
        }`)(page);
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
    const newest = async () => (await programs(page)).at(-1);
    const [first, then] = ui === "full" ? ["/pkg/webgpu/", "/pkg/"] : ["/pkg/element/webgpu/", "/pkg/element/"];
    assert.equal(await newest(), first, "the program for WebGPU alone");
    await page.evaluate(() => {
      globalThis.adapters = "none";
      globalThis.device.destroy();
    });
    await page.waitForFunction(() => viewer.state().backend === "webgl2" && viewer.clip === "Run" && viewer.currentTime === 0.25);
    assert.equal(await newest(), then);
    assert.equal((await seen(page, "a")).link, link);
    assert.ok((await coloursOnScreen(page)) > 200);
    assert.equal(await page.evaluate(() => viewer.shadowRoot.querySelectorAll("canvas").length), 1);
  });
}
