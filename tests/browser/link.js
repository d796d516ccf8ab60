// Links bring back what they say, and nothing else.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { BACKEND, COARSE, PAGE, atRest, call, running, state, test, until } from "./harness.js";

export const QUERY = `?backend=${BACKEND}&scale=${COARSE}`;
export const OWN = { own: true, query: QUERY, passes: true };

/** As people would write them, in the order in which the page writes. Each field of a view at rest stands in one, but for clips in place. */
export const LINKS = [
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
  "t=0.5&play=0&bone=5&hide=0,2",
  "t=0.5&play=0&bone=9&skin=weight",
  "t=0.5&play=0&vertex=100",
  "t=0.5&play=0&subset=0&panel=skeleton",
  "t=0.5&play=0&skin=stretch&bones=1",
  "t=0.5&play=0&bones=1&bonestyle=axes&labels=1",
  "t=0.5&play=0&trails=5,9&ghosts=2,1,3",
  "t=0.5&play=0&bindghost=1",
  "t=0.5&play=0&light=book&lamps=45&cam=20,10",
  "t=0.5&play=0&solo=1&split=0.5",
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

/** Every name of a field: those of the README's table, and one that none has. */
const README = readFileSync(new URL("../../README.md", import.meta.url), "utf8");
const [TABLE] = README.split("| what | fields |")[1].split("\n\n");
const NAMES = [...TABLE.matchAll(/`([a-z]+)`/g)].map(([, name]) => name).concat("x");

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

export const hash = (page) => page.evaluate(() => location.hash.slice(1));
export const notice = (page) => page.textContent("#notice");

const PATIENCE = { polling: 50, timeout: 60_000 };

/** Waits until a screen reader is given this. */
export const speaks = (page, words) =>
  page.waitForFunction((words) => globalThis.heard.some((heard) => heard?.includes(words)), words, PATIENCE);

/** Waits until the address says this. */
export const says = (page, text) =>
  page.waitForFunction((text) => location.hash.slice(1) === text, text, PATIENCE).catch(async (error) => {
    throw new Error(`${text}: ${await hash(page)}`, { cause: error });
  });

/** Waits until what a link says is seen. */
const shows = (page, text) =>
  page.waitForFunction((text) => bindpose.state().link === text, text, PATIENCE).catch(async (error) => {
    throw new Error(`${text}: ${(await state(page)).link}`, { cause: error });
  });

/** Goes to a link in the page as it is. */
export async function follow(page, text) {
  await page.evaluate((text) => (location.hash = text), text);
  await shows(page, text);
}

/** Opens the page anew. */
export async function visit(page, text) {
  await page.goto("about:blank");
  await page.goto(`${PAGE}${QUERY}#${text}`);
  await running(page);
}

/** What a state has of some of them. */
const MEANT = {
  "t=0.5&play=0": ({ timeSecs, playing }) => [timeSecs, playing].join() === "0.5,false",
  "clip=Wave&t=0.75&play=0&speed=0.25": ({ clip, speed }) => [clip, speed].join() === "Wave,0.25",
  "t=0.5&play=0&bone=9&skin=weight": ({ skeleton }) => [skeleton.selected, skeleton.skinView].join() === "9,weight",
  "t=0.5&play=0&view=normal&panel=keys": ({ look }) => look.viewMode === "normal",
  "t=0.5&play=0&ortho=1&quality=low&cam=70,12": ({ look, camera }) => look.quality === "low" && camera.orthographic,
};

/** Waits until a link is shown, and gives what the page says of its view then, and a small picture. */
async function shown(page, text) {
  await shows(page, text);
  await atRest(page); // The model is framed in what panels leave.
  return [seen(await state(page)), await picture(page)];
}

/** Holds what a link brought back against what was seen before. */
function assertSame([{ camera: after, ...now }, again], [{ camera: before, ...rest }, picture], text) {
  assert.deepEqual(now, rest, text);
  // A camera that was turned after the model was framed differs in the last bits.
  const [wanted, found] = [before, after].map((camera) => Object.values(camera).flat().map(Number));
  const off = found.map((number, index) => Math.abs(number - wanted[index]) / (1 + Math.abs(number)));
  assert.ok(most(off) < 1e-5, `${text}: ${JSON.stringify([before, after])}`);
  const differing = apart(again, picture).filter((by) => by > 2);
  assert.ok(differing.length < 0.005 * 4 * 96 * 72, `${text}: ${differing.length} channels of its picture differ`);
}

/** All fields in few links: a new page is started for each, which takes time. */
const TOGETHER = [
  "clip=Run&t=0.25&play=0&back=1&speed=0.25&loop=pingpong&wrap=book-demo&fade=0.5&bone=5&hide=0,2&skin=weight&bones=1&bonestyle=axes&labels=1&panel=skeleton",
  "clip=Walk&t=0.1&play=0&loop=once&blend=Run,0.25&vertex=100&trails=5,9&ghosts=2,1,3&bindghost=1&light=book&lamps=45&cam=20,10",
  "t=0.5&play=0&range=0.25,1.5&bind=1&subset=0&solo=1&view=normal&panel=keys",
  "t=0.5&play=0&skin=stretch&split=0.5&bg=20262e&overlay=grid,wireframe,normals&lines=0.1&exposure=0.5&ground=0.05&green=1&hand=right&panel=findings,curves&cam=-160,12,6,0,1,0",
  "t=0.5&play=0&bg=sky&env=90&up=z&crowd=3&seed=7&instance=2&ortho=1&quality=low&cam=70,12",
];
const fieldsOf = (links) => new Set(links.flatMap((text) => text.split("&").map((field) => field.split("=")[0])));

test("links bring back in the page as it is what they say", { ...OWN, draws: true }, async (page) => {
  for (const text of LINKS) {
    await follow(page, text);
    const now = await state(page);
    assert.ok(MEANT[text]?.(now) ?? true, text);
    assert.equal(now.undo, null, `${text} is no step`);
  }
});

// In parts, so that none takes too long.
const IN_NEW_PAGES = process.env.BINDPOSE_CASES > 1 ? [TOGETHER, LINKS.slice(0, 10), LINKS.slice(10, 20), LINKS.slice(20)] : [TOGETHER];
IN_NEW_PAGES.forEach((links, part) => {
  test(`links bring back in a new page what they say: ${part + 1}`, { ...OWN, draws: true }, async (page) => {
    assert.deepEqual(fieldsOf(TOGETHER), fieldsOf(LINKS));
    const first = "t=0.5&play=0";
    await follow(page, first);
    const [, paused] = await shown(page, first);
    // In the page as it is each comes after another one, of which a new page knows nothing.
    const before = new Map();
    for (const text of links) {
      await follow(page, text);
      before.set(text, await shown(page, text));
    }
    const differ = links.filter((text) => most(apart(before.get(text)[1], paused)) > 20);
    assert.ok(differ.length >= 0.6 * links.length, "most of them are seen");
    for (const text of links) {
      await visit(page, text);
      assertSame(await shown(page, text), before.get(text), text);
    }
  });
});

test("a link to what moves moves again", OWN, async (page) => {
  await visit(page, "clip=Run&play=1&speed=0.5&turntable=1");
  const { clip, timeSecs, speed, camera } = await until(page, (now) => now.playing && now.timeSecs > 0);
  assert.deepEqual([clip, speed], ["Run", 0.5]);
  await until(page, (now) => now.timeSecs !== timeSecs && now.camera.yawRadians !== camera.yawRadians);
  const { link } = await state(page);
  const fields = ["clip=Run", "play=1", "speed=0.5", "turntable=1"];
  assert.deepEqual(fields.filter((field) => !link.split("&").includes(field)), [], link);
});

test("what a link does not know or the model does not have is named, and the rest is shown", { ...OWN, draws: true }, async (page) => {
  await until(page, (now) => now.model);
  await page.evaluate(() => (location.hash = "clip=Fly&t=0.5&play=0&speed=fast&%zz&future=1&view=uv&bone=4000000000"));
  await until(page, (now) => now.look.viewMode === "uv");
  assert.match(await notice(page), /The link is not shown in full.*: bone=4000000000, clip=Fly, future=1, speed=fast, zz/s);
  assert.equal((await state(page)).error, null);
  await follow(page, "t=0.5&play=0");
  assert.equal(await page.isHidden("#notice"), true, "it was about the link before");
  await page.evaluate(() => (location.hash = "t=99&play=0"));
  await page.waitForFunction(() => document.getElementById("notice-words").textContent.endsWith(": t=99"), null, PATIENCE);
  const { timeSecs } = await state(page);
  await call(page, "seek", 99);
  assert.deepEqual([(await state(page)).timeSecs, timeSecs > 0.5], [timeSecs, true], "the clip's end");
  assert.ok(NAMES.length > 45, String(NAMES));
  const rubbish = [..."=&%#,.-:1aé🦴 \u0000", "http://127.0.0.1:9/x.m3d", "src"];
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  await page.evaluate(([rubbish, names]) => {
    let seed = 1;
    const next = (below) => (seed = (seed * 48_271) % 2_147_483_647) % below;
    for (let round = 0; round < 1000; round += 1) {
      const some = (count, one) => Array.from({ length: next(count) }, one);
      const one = (of) => of[next(of.length)];
      location.hash = some(5, () => `${one(names)}=${some(9, () => one(rubbish)).join("")}`).join("&");
      dispatchEvent(new HashChangeEvent("hashchange"));
    }
  }, [rubbish, NAMES]);
  await follow(page, "t=0.25&play=0");
  assert.deepEqual([await page.isHidden("#fault"), (await state(page)).error], [true, null]);
  assert.deepEqual(asked.filter((address) => !address.startsWith(PAGE)), [], "no other server is asked");
});
