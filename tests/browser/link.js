// Links: the address says what is seen, and brings it back.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { BACKEND, PAGE, SAMPLE, atRest, call, click, keep, listen, running, settled, state, test, until } from "./harness.js";
import { coloursOnScreen } from "./picture.js";

const QUERY = `?backend=${BACKEND}&scale=0.2`;
const OWN = { own: true, query: QUERY, passes: true };

/** As people would write them, in the order in which the page writes. */
const LINKS = [
  "t=0.5&play=0",
  "clip=Walk&play=0",
  "clip=Run&t=0.25&play=0&back=1",
  "clip=Wave&t=0.75&play=0&speed=0.25",
  "t=1&play=0&loop=once",
  "t=1.5&play=0&loop=pingpong",
  "t=2&play=0&wrap=book-demo",
  "t=0.5&play=0&range=0.25,1.5",
  "clip=Walk&t=0.1&play=0&blend=Run,0.25",
  "t=0.5&play=0&fade=0.5",
  "t=0.5&play=0&bind=1",
  "t=0.5&play=0&bone=5",
  "t=0.5&play=0&bone=9&skin=weight",
  "t=0.5&play=0&vertex=100",
  "t=0.5&play=0&subset=0&panel=skeleton",
  "t=0.5&play=0&skin=stretch&bones=1",
  "t=0.5&play=0&bones=1&bonestyle=axes",
  "t=0.5&play=0&trails=5,9&ghosts=2,1,3",
  "t=0.5&play=0&bindghost=1",
  "t=0.5&play=0&light=book&lamps=45&cam=20,10",
  "t=0.5&play=0&split=0.5",
  "t=0.5&play=0&view=normal&panel=keys",
  "t=0.5&play=0&bg=20262e&overlay=grid,wireframe",
  "t=0.5&play=0&bg=sky&exposure=0.5&env=90",
  "t=0.5&play=0&overlay=normals&lines=0.1&panel=findings,curves",
  "t=0.5&play=0&ground=0.05&green=1",
  "t=0.5&play=0&hand=right&cam=-160,12,6,0,1,0",
  "t=0.5&play=0&up=z&cam=30,5,7,0,1,0.5",
  "t=0.5&play=0&crowd=3&seed=7&instance=2&cam=0,20,12,0,1,0",
  "t=0.5&play=0&ortho=1&quality=low&cam=70,12",
];

/** What a state says of a view, without what counts starts and frames. */
const seen = ({ timings, cost, framesRendered, undo, redo, model, opening, look, ...rest }) => ({
  ...rest,
  model: { ...model, opening: null },
  look: { ...look, samples: null, lowered: null },
});

/** The colours of a small picture. */
const picture = (page) => page.evaluate(async () => {
  const shown = await createImageBitmap(await bindpose.snapshot({ width: 96, height: 72, samples: 1 }));
  const copy = new OffscreenCanvas(shown.width, shown.height).getContext("2d");
  copy.drawImage(shown, 0, 0);
  return [...copy.getImageData(0, 0, shown.width, shown.height).data];
});

const apart = (one, other) => one.map((byte, index) => Math.abs(byte - other[index]));
const most = (numbers) => Math.max(...numbers);

const hash = (page) => page.evaluate(() => location.hash.slice(1));
const notice = (page) => page.textContent("#notice");

/** Waits until a screen reader is given this. */
const hears = (page, words) =>
  page.waitForFunction((words) => globalThis.heard.some((heard) => heard?.includes(words)), words, { polling: 30, timeout: 20_000 });

/** Waits until the address says this. */
const says = (page, text) => page.waitForFunction((text) => location.hash.slice(1) === text, text, { polling: 50, timeout: 20_000 });

/** Goes to a link in the page as it is. */
async function follow(page, text) {
  await page.evaluate((text) => (location.hash = text), text);
  await page.waitForFunction((text) => bindpose.state().link === text, text, { polling: 50, timeout: 20_000 }).catch(async (error) => {
    throw new Error(`${text}: ${(await state(page)).link}`, { cause: error });
  });
}

/** Opens the page anew. */
async function visit(page, text) {
  await page.goto("about:blank");
  await page.goto(`${PAGE}${QUERY}#${text}`);
  await running(page);
}

test("links bring back what they say, in this page and in a new one", { ...OWN, draws: true }, async (page) => {
  await until(page, (now) => now.model);
  const shown = [];
  // The suite of WebGPU takes the longest: it looks at a third of them.
  const links = LINKS.filter((_, index) => BACKEND === "webgl2" || index % 3 === 0);
  for (const text of links) {
    await follow(page, text);
    await atRest(page); // The model is framed in what panels leave.
    shown.push([seen(await state(page)), await picture(page)]);
    assert.equal((await state(page)).undo, null, `${text} is no step`);
  }
  const of = (text) => shown[links.indexOf(text)][0];
  const [paused] = shown;
  assert.deepEqual([of("t=0.5&play=0").timeSecs, of("clip=Wave&t=0.75&play=0&speed=0.25").clip], [0.5, "Wave"]);
  const { skeleton } = of("t=0.5&play=0&bone=9&skin=weight");
  assert.deepEqual([skeleton.selected, skeleton.skinView], [9, "weight"]);
  assert.equal(of("t=0.5&play=0&view=normal&panel=keys").look.viewMode, "normal");
  assert.ok(shown.filter(([, picture]) => most(apart(picture, paused[1])) > 20).length > 0.6 * shown.length, "most of them are seen");
  await follow(page, "");
  const fresh = (index) => index % 5 === 0;
  for (const [index, text] of links.entries()) {
    if (fresh(index)) await visit(page, text);
    else await follow(page, "").then(() => follow(page, text));
    await until(page, (now) => now.link === text);
    await atRest(page);
    assert.deepEqual(seen(await state(page)), shown[index][0], text);
    assert.equal(most(apart(await picture(page), shown[index][1])), 0, text);
  }
});

test("the address follows what is seen once that rests", OWN, async (page) => {
  await until(page, (now) => now.model);
  await page.evaluate(() => {
    globalThis.links = [];
    bindpose.addEventListener("linkchange", ({ detail }) => globalThis.links.push(detail.link));
  });
  await call(page, "pause");
  await call(page, "seek", 0.5);
  await says(page, "t=0.5&play=0");
  assert.equal(await page.evaluate(() => bindpose.link()), await page.evaluate(() => location.href));
  await call(page, "play");
  await page.waitForTimeout(700);
  assert.equal(await hash(page), "t=0.5&play=0", "the last rest");
  await call(page, "pause");
  await call(page, "seek", 1);
  await says(page, "t=1&play=0");
  assert.deepEqual([await page.evaluate(() => globalThis.links.at(-1)), (await state(page)).link], ["t=1&play=0", "t=1&play=0"]);
  // While the model is dragged round nothing is written.
  await page.mouse.move(480, 250);
  await page.mouse.down();
  await page.mouse.move(560, 260, { steps: 4 });
  await page.waitForTimeout(700);
  assert.equal(await hash(page), "t=1&play=0");
  await page.mouse.up();
  await page.waitForFunction(() => /&cam=-?[\d.]+,-?[\d.]+$/.test(location.hash), null, { polling: 50 });
  assert.equal(await page.evaluate(() => history.length), 2, "no step of the history");
  const moment = await hash(page);
  await page.reload();
  await running(page);
  await until(page, (now) => now.link === moment);
});

test("back and forward go from link to link, also to the models that were open", { ...OWN, firstVisit: true, prepare: listen }, async (page) => {
  await until(page, (now) => now.model);
  await follow(page, "t=0.5&play=0");
  await page.setInputFiles("#files", { name: "hero.m3d", mimeType: "text/plain", buffer: await readFile(SAMPLE) });
  await until(page, (now) => now.model?.name === "hero.m3d");
  await call(page, "pause");
  await page.waitForFunction(() => location.hash.startsWith("#model=hero.m3d"), null, { polling: 50 });
  const ofHero = await hash(page);
  const is = (name, secs) => until(page, ({ model, timeSecs, playing }) => model?.name === name && timeSecs === secs && !playing);
  await page.evaluate(() => (location.hash = "t=1&play=0"));
  await is("figure.m3d", 1);
  await page.goBack();
  await page.waitForFunction((text) => location.hash.slice(1) === text, ofHero, { polling: 50 });
  await until(page, ({ model }) => model?.name === "hero.m3d");
  await page.goForward();
  await is("figure.m3d", 1);
});

test("a link wins over what the address asks for and over what is kept, and is not kept", { ...OWN, query: `${QUERY}&crowd=2` }, async (page) => {
  await until(page, (now) => now.model);
  const before = await page.evaluate(() => localStorage.getItem("bindpose.kept"));
  await page.goto("about:blank");
  await page.goto(`${PAGE}${QUERY}&crowd=2#t=0.5&play=0&light=book&crowd=3`);
  await running(page);
  const now = await until(page, ({ timeSecs, look }) => timeSecs === 0.5 && look.light === "book");
  assert.equal(now.crowd?.count ?? now.instances?.count ?? now.crowd, 3);
  await page.goto("about:blank");
  await page.goto(`${PAGE}${QUERY}`);
  await running(page);
  assert.notEqual((await until(page, ({ model }) => model)).look.light, "book");
  assert.equal(await page.evaluate(() => localStorage.getItem("bindpose.kept")), before);
});

test("the buttons copy what the page says of itself, and the address is written twice a second at most", OWN, async (page) => {
  await until(page, (now) => now.model);
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await follow(page, "t=0.5&play=0");
  const copied = () => page.evaluate(() => navigator.clipboard.readText());
  for (const [control, wanted] of [
    ["copy-link", () => page.evaluate(() => bindpose.link())],
    ["copy-embed", () => page.evaluate(async () => (await import("/web/link.js")).embedding(location.href, document.title))],
  ]) {
    await page.evaluate(() => navigator.clipboard.writeText(""));
    await click(page, "picture");
    await click(page, control);
    await page.waitForFunction(async () => (await navigator.clipboard.readText()) !== "", null, { polling: 50 });
    assert.equal(await copied(), await wanted());
  }
  const written = await page.evaluate(async () => {
    const times = [];
    const write = history.replaceState.bind(history);
    history.replaceState = (...given) => (times.push(performance.now()), write(...given));
    for (let step = 0; step < 40; step += 1) {
      bindpose.seek(0.5 + (step >> 3) / 10);
      await new Promise((done) => setTimeout(done, 60));
    }
    return times;
  });
  assert.ok(written.slice(1).every((time, index) => time - written[index] > 490), String(written));
});

test("what a link does not know or the model does not have is named, and the rest is shown", OWN, async (page) => {
  await until(page, (now) => now.model);
  await page.evaluate(() => (location.hash = "clip=Fly&t=0.5&play=0&speed=fast&%zz&future=1&view=uv&bone=4000000000"));
  await until(page, (now) => now.look.viewMode === "uv");
  assert.match(await notice(page), /The link is not shown in full.*bone, clip, future, speed, zz/s);
  assert.equal((await state(page)).error, null);
  await follow(page, "t=0.5&play=0");
  const rubbish = [..."=&%#,.-:1aé🦴 \u0000", "http://127.0.0.1:9/", "src"];
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  await page.evaluate((rubbish) => {
    let seed = 1;
    const next = (below) => (seed = (seed * 48_271) % 2_147_483_647) % below;
    const names = ["clip", "t", "cam", "bone", "model", "sha", "range", "ghosts", "bg", "crowd", "panel", "x"];
    for (let round = 0; round < 1000; round += 1) {
      const fields = Array.from({ length: next(5) }, () => `${names[next(names.length)]}=${Array.from({ length: next(9) }, () => rubbish[next(rubbish.length)]).join("")}`);
      location.hash = fields.join("&");
      dispatchEvent(new HashChangeEvent("hashchange"));
    }
  }, rubbish);
  await follow(page, "t=0.25&play=0");
  assert.deepEqual([await page.isHidden("#fault"), (await state(page)).error], [true, null]);
  assert.deepEqual(asked.filter((address) => !address.startsWith(PAGE)), [], "no other server is asked");
});

test("a link to a dropped file waits for it, by its name and by its bytes", { ...OWN, firstVisit: true, prepare: listen }, async (page) => {
  const bytes = await readFile(SAMPLE);
  const file = (name, bytes) => ({ name, mimeType: "text/plain", buffer: bytes });
  const choose = (name, bytes) => page.setInputFiles("#files", file(name, bytes));
  await until(page, (now) => now.model);
  await choose("hero.m3d", bytes);
  await until(page, (now) => now.model?.name === "hero.m3d");
  await call(page, "pause");
  await call(page, "seek", 0.75);
  await page.waitForFunction(() => /^#model=hero\.m3d&sha=[0-9a-f]{12}&t=0\.75&play=0$/.test(location.hash), null, { polling: 50 });
  const link = await hash(page);
  assert.equal(/sha=(\w+)/.exec(link)[1], createHash("sha256").update(bytes).digest("hex").slice(0, 12));
  for (const [name, changed, told] of [
    ["hero.m3d", false, null],
    ["other.m3d", false, "other.m3d is hero.m3d of the link, under another name"],
    ["hero.m3d", true, "hero.m3d has other bytes than the file that the link was made of"],
  ]) {
    await visit(page, link);
    await hears(page, "This link is about hero.m3d: open or drop it to see the same moment.");
    await page.getByRole("button", { name: /^Close the welcome/ }).waitFor({ state: "attached" });
    await page.waitForTimeout(600);
    assert.equal(await hash(page), link, "it stays until its model is here");
    await choose(name, changed ? Buffer.concat([bytes, Buffer.from("\n")]) : bytes);
    await until(page, (now) => now.model?.name === name && now.timeSecs === 0.75 && !now.playing);
    if (told) assert.ok((await notice(page)).includes(told), told);
  }
});

test("a page of notes frames a moment with its timeline, or the picture alone", OWN, async (page) => {
  await until(page, (now) => now.model);
  await follow(page, "clip=Walk&t=0.5&play=0");
  const copied = await page.evaluate(async () => (await import("/web/link.js")).embedding(location.href, "A step"));
  let notes;
  const server = createServer((_, answer) => answer.setHeader("content-type", "text/html").end(`<!doctype html><title>Notes</title>${notes}<p style="height: 2000px">More</p>`));
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const transport = ["timeline", "play", "time", "range-in", "range-out", "clips", "speed", "next-loop-mode"];
  for (const [ui, html, wanted] of [["transport", copied, transport], ["none", copied.replace("ui=transport", "ui=none"), []]]) {
    notes = html;
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    const frame = page.frames()[1];
    await frame.waitForFunction(() => globalThis.bindpose?.state().timeSecs === 0.5 && document.getElementById("shell").hidden, null, { polling: 50, timeout: 30_000 });
    await frame.waitForFunction((count) => document.querySelectorAll("[data-control]").length === count, wanted.length, { polling: 50 });
    const controls = await frame.evaluate(() => Array.from(document.querySelectorAll("[data-control]"), ({ dataset }) => dataset.control));
    assert.deepEqual(controls, wanted);
    assert.ok((await coloursOnScreen(page)) > 200, ui);
    await keep(page, `framed-${ui}`);
    // The page scrolls over it.
    await page.mouse.move(200, 200);
    await page.mouse.wheel(0, 40);
    await page.waitForFunction(() => scrollY === 40);
  }
  // Of a file of one's own the frame says that it is missing.
  notes = copied.replace("#clip", "#model=hero.m3d&amp;clip");
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.frames()[1].waitForFunction(() => document.getElementById("notice-words")?.textContent.includes("This link is about hero.m3d"), null, { polling: 50 });
  server.close();
});
