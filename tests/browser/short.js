// A short walk through the page in the browsers that the other tests are not run in. One page serves all of it, in order.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { launch } from "./other_browsers.js";
import { CHEST, GROUND, timeBar } from "./widgets.js";

/** Given by `cargo xtask test`: where the page is, the browser's name and its program. */
const { PAGE, BROWSER, PROGRAM } = process.env;
const path = (relative) => fileURLToPath(new URL(relative, import.meta.url));
const FIXTURES = path("../fixtures/");
const OUT = path("out/");
const PATIENCE_MS = 120_000;

let page;
before(start, { timeout: PATIENCE_MS });
async function start() {
  mkdirSync(OUT, { recursive: true });
  page = await launch(BROWSER, PROGRAM);
  // Nothing moves but what a test moves, and WebGL2 is what these browsers draw with here.
  await page.open(`${PAGE}?backend=webgl2&scale=0.2`);
}
// Firefox was seen not to end.
after(() => page?.close(), { timeout: PATIENCE_MS });

const state = () => page.evaluate(() => JSON.parse(JSON.stringify(globalThis.bindpose?.state() ?? null)));
const call = (name, ...values) => page.evaluate((name, ...values) => void globalThis.bindpose[name](...values), name, ...values);

/** Waits until `holds(state)`; gives that state. */
async function until(holds) {
  const deadline = Date.now() + PATIENCE_MS;
  for (;;) {
    const now = await state();
    if (now && holds(now)) return now;
    if (Date.now() > deadline) throw new Error(`waited in vain for ${holds}: ${JSON.stringify(now)}`);
    await new Promise((done) => setTimeout(done, 50));
  }
}

/** A picture of the view: its size and how many colours it has. */
const snapshot = (options) =>
  page.evaluate(async (options) => {
    const bitmap = await createImageBitmap(await globalThis.bindpose.snapshot(options));
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [bitmap.width, bitmap.height];
    const context = canvas.getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    return { width: bitmap.width, height: bitmap.height, colours: new Set(new Uint32Array(data.buffer)).size };
  }, options);

/** Opens the files of a dialog or of a script, and waits for what comes of them. */
async function outcomeOf(open) {
  await page.evaluate(() => {
    globalThis.outcome = new Promise((done) => {
      for (const type of ["load", "error"]) globalThis.bindpose.addEventListener(type, () => done(type), { once: true });
    });
  });
  await open();
  return page.evaluate(() => globalThis.outcome);
}

let failed = null;
const check = (name, body) =>
  test(`${BROWSER}: ${name}`, { timeout: 2 * PATIENCE_MS }, async () => {
    // On a page that is lost each would wait as long as it may.
    assert.equal(failed, null, "this one came to nothing, and the rest is not tried");
    try {
      await body();
    } catch (error) {
      failed = name;
      await page?.screenshot(`${OUT}${BROWSER}-FAILED-${name.replace(/\W+/g, "-")}.png`).catch(() => {});
      throw error;
    }
  });

check("the page starts, opens the sample and plays it", async () => {
  const { backend, model, textures } = await until(({ model }) => model !== null);
  assert.equal(backend, "webgl2");
  const fetched = await page.evaluate(() => performance.getEntriesByType("resource").map(({ name }) => new URL(name).pathname).filter((path) => path.endsWith(".wasm")));
  assert.deepEqual(fetched, ["/pkg/bindpose_bg.wasm"], "the program that has WebGL2");
  assert.equal(model.name, "figure.m3d");
  assert.deepEqual(textures, { named: 2, missing: [], unreadable: [] });
  const { timeSecs } = await until(({ playing }) => playing);
  await until((now) => now.timeSecs !== timeSecs);
  await call("pause");
  // The first visit is greeted. A button of the page's mirror takes that away, so that the next clicks reach the view.
  await page.evaluate(() => document.querySelector('[aria-label="Close the welcome"]').click());
  await call("seek", 0.25);
  assert.equal((await state()).playing, false);
});

check("a snapshot is a picture of the model in the size that was asked for", async () => {
  const { width, height, colours } = await snapshot({ width: 160, height: 120 });
  assert.deepEqual([width, height], [160, 120]);
  assert.ok(colours > 200, `${colours} colours`);
  await page.screenshot(`${OUT}${BROWSER}-sample.png`);
});

check("keys go to the viewer once the view was clicked", async () => {
  await page.click(GROUND);
  await page.press("Space");
  await until(({ playing }) => playing);
  await page.press("Space");
  await until(({ playing }) => !playing);
  await page.press("Home");
  await until(({ timeSecs }) => timeSecs === 0);
  await page.press("b");
  await until(({ skeleton }) => skeleton.bonesVisible);
  await page.press("b");
  await until(({ skeleton }) => !skeleton.bonesVisible);
});

check("a drag on the bar scrubs, and one in the view turns the camera", async () => {
  const { model, camera } = await state();
  const { first, last, y } = timeBar(await page.evaluate(() => document.querySelector("[data-control=time]").getBoundingClientRect().toJSON()));
  const onBar = (fraction) => [first + fraction * (last - first), y];
  await page.drag(onBar(0.2), onBar(0.5));
  const half = model.clips[0].endSecs / 2;
  const { camera: still } = await until(({ timeSecs }) => Math.abs(timeSecs - half) < 0.04 * half);
  assert.equal(still.yawRadians, camera.yawRadians);
  await page.drag(CHEST, [CHEST[0] + 80, CHEST[1]]);
  await until((now) => Math.abs(now.camera.yawRadians - camera.yawRadians) > 0.1);
});

check("a script opens a File and bytes with a name", async () => {
  const opened = await page.evaluate(async () => {
    const bytes = new Uint8Array(await (await fetch("web/sample/figure.m3d")).arrayBuffer());
    const names = [];
    for (const given of [new File([bytes], "from-file.m3d"), { name: "from-bytes.m3d", bytes }]) {
      names.push((await globalThis.bindpose.open([given])).model.name);
    }
    return names;
  });
  assert.deepEqual(opened, ["from-file.m3d", "from-bytes.m3d"]);
});

check("the dialog's files open, and one that cannot be read says why and leaves the model", async () => {
  const good = `${FIXTURES}good/d3d12_skinned.m3d`;
  assert.equal(await outcomeOf(() => page.choose("#files", good)), "load");
  assert.equal((await state()).model.name, "d3d12_skinned.m3d");
  const bad = `${FIXTURES}bad/parent_not_a_number.m3d`;
  assert.equal(await outcomeOf(() => page.choose("#files", bad)), "error");
  const { model, error } = await state();
  assert.equal(model.name, "d3d12_skinned.m3d");
  assert.match(error.message, /parent index/);
  await page.screenshot(`${OUT}${BROWSER}-error.png`);
});

check("a file that is dropped opens", async () => {
  const outcome = await page.evaluate(async () => {
    const bytes = await (await fetch("web/sample/figure.m3d")).arrayBuffer();
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([bytes], "dropped.m3d"));
    const opened = new Promise((done) => {
      for (const type of ["load", "error"]) globalThis.bindpose.addEventListener(type, () => done(type), { once: true });
    });
    const canvas = document.querySelector("#view canvas");
    for (const type of ["dragenter", "dragover", "drop"]) canvas.dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }));
    return opened;
  });
  assert.equal(outcome, "load");
  assert.equal((await state()).model.name, "dropped.m3d");
});

check("Tab goes from the view into the controls, and their elements do what the viewer's do", async () => {
  await page.click(GROUND);
  await page.press("Tab");
  const focused = () => page.evaluate(() => [document.activeElement.closest("[data-mirror]") !== null, document.activeElement.ariaLabel ?? document.activeElement.textContent]);
  const names = new Set();
  for (let stop = 0; stop < 3; stop += 1) {
    const [isControl, name] = await focused();
    assert.ok(isControl, `stop ${stop} is ${name}`);
    names.add(name);
    await page.press("Tab");
  }
  assert.equal(names.size, 3, [...names].join(", "));
  await call("pause");
  await until(({ playing }) => !playing);
  // The mirror follows the window some times a second.
  await new Promise((done) => setTimeout(done, 500));
  const clickPlay = () => page.evaluate(() => {
    const buttons = Array.from(document.querySelectorAll("button[data-mirror]"));
    buttons.find((button) => /^(Play|Pause)/.test(button.ariaLabel ?? button.textContent)).click();
  });
  await clickPlay();
  await until(({ playing }) => playing);
  await clickPlay();
  await until(({ playing }) => !playing);
});

check("glTF opens, and what is exported of it opens again", async () => {
  assert.equal(await outcomeOf(() => page.choose("#files", `${FIXTURES}gltf/banner.glb`)), "load");
  const { model } = await state();
  assert.equal(model.name, "banner.glb");
  const again = await page.evaluate(async () => {
    const opened = [];
    for (const options of [{ format: "glb" }, { format: "d3d12" }]) {
      const { name, bytes } = await globalThis.bindpose.export(options);
      const { model, error } = await globalThis.bindpose.open([{ name, bytes }]);
      opened.push([name.split(".").pop(), error, model.counts.triangles, model.clips.length]);
    }
    return opened;
  });
  const { triangles } = model.counts;
  assert.deepEqual(again, [["glb", null, triangles, model.clips.length], ["zip", null, triangles, model.clips.length]]);
});

check("a lost context comes back with the model", async () => {
  const opened = await state();
  await page.evaluate(() => {
    globalThis.lostCanvas = document.querySelector("#view canvas");
    globalThis.lostCanvas.getContext("webgl2").getExtension("WEBGL_lose_context").loseContext();
  });
  const fresh = () => page.evaluate(() => document.querySelector("#view canvas") !== globalThis.lostCanvas);
  for (const deadline = Date.now() + PATIENCE_MS; !(await fresh()); ) {
    assert.ok(Date.now() < deadline, "no new canvas came");
    await new Promise((done) => setTimeout(done, 50));
  }
  const { model } = await until(({ backend }) => backend === "webgl2");
  assert.equal(model.name, opened.model.name);
  const { colours } = await snapshot({ width: 160, height: 120 });
  assert.ok(colours > 50, `${colours} colours`);
});
