// The address of the page and what is seen: written, copied, followed from elsewhere, framed.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { LARGE, PAGE, SAMPLE, atRest, call, keep, listen, running, state, test, until } from "./harness.js";
import { OWN, QUERY, follow, hash, notice, says, speaks, visit } from "./link.js";
import { coloursOnScreen } from "./picture.js";
import { click, still } from "./widgets.js";

/** The digits by which a link knows a file. */
const digestOf = (bytes) => createHash("sha256").update(bytes).digest("hex").slice(0, 12);

/** A page of other people's: `{address, stop()}` of one with what `body()` gives. */
async function serve(body) {
  const page = () => `<!doctype html><title>Notes</title>${body()}<p style="height: 2000px">More</p>`;
  const server = createServer((_, answer) => answer.setHeader("content-type", "text/html").end(page()));
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return { address: `http://127.0.0.1:${server.address().port}/`, stop: () => server.close() };
}

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
  assert.equal(await page.evaluate(() => globalThis.links.at(-1)), "t=1&play=0");
  assert.equal((await state(page)).link, "t=1&play=0");
  // While the model is dragged round nothing is written.
  await page.mouse.move(480, 250);
  await page.mouse.down();
  await page.mouse.move(560, 260, { steps: 4 });
  await page.waitForTimeout(700);
  assert.equal(await hash(page), "t=1&play=0");
  await page.mouse.up();
  await page.waitForFunction(() => /&cam=(-?[\d.]+,){6}[\d.]+$/.test(location.hash), null, { polling: 50 });
  assert.equal(await page.evaluate(() => history.length), 2, "no step of the history");
  const { camera, link } = await state(page);
  await page.reload();
  await running(page);
  const apart = (one, other) => Math.hypot(one.distance - other.distance, ...one.target.map((at, axis) => at - other.target[axis]));
  await until(page, ({ timeSecs, playing, camera: now }) => timeSecs === 1 && !playing && now.yawRadians === camera.yawRadians && apart(now, camera) < 1e-4 * camera.distance);
  // Whoever follows it has the same link, and in a window of another shape the model is framed.
  await atRest(page);
  assert.equal((await state(page)).link, link);
  await page.setViewportSize({ width: 480, height: 600 });
  await until(page, ({ camera: now, link }) => /&cam=[^,]+,[^,]+$/.test(link) && now.yawRadians === camera.yawRadians);
});

test("back and forward go from link to link, also to the models that were open", OWN, async (page) => {
  await until(page, (now) => now.model);
  await follow(page, "t=0.5&play=0");
  await page.setInputFiles("#files", { name: "hero.m3d", mimeType: "text/plain", buffer: await readFile(SAMPLE) });
  await until(page, (now) => now.model?.name === "hero.m3d");
  await call(page, "pause");
  await page.waitForFunction(() => location.hash.startsWith("#model=hero.m3d"), null, { polling: 50 });
  const ofHero = await hash(page);
  const is = (name, secs) =>
    until(page, ({ model, timeSecs, playing }) => model?.name === name && timeSecs === secs && !playing);
  await page.evaluate(() => (location.hash = "t=1&play=0"));
  await is("figure.m3d", 1);
  await page.goBack();
  await page.waitForFunction((text) => location.hash.slice(1) === text, ofHero, { polling: 50 });
  await until(page, ({ model }) => model?.name === "hero.m3d");
  await page.goForward();
  await is("figure.m3d", 1);
});

const FINE = { ...OWN, query: `${QUERY}&samples=4` };

test("what changes beside a picture at rest is in the address", FINE, async (page) => {
  await call(page, "pause");
  await call(page, "seek", 0.5);
  await until(page, ({ look }) => look.samples === 4);
  await says(page, "t=0.5&play=0");
  await call(page, "setLoop", "once");
  await says(page, "t=0.5&play=0&loop=once");
});

test("a link in a page of notes shows its moment in the page that another one opened", OWN, async (page) => {
  const moments = ["t=0.5&play=0", "clip=Walk&t=0.25&play=0"];
  const links = moments.map((link) => `${PAGE}${QUERY}#${link}`.replaceAll("&", "&amp;"));
  const notes = await serve(() => links.map((link) => `<a target="viewer" href="${link}">A moment</a>`).join(" "));
  await page.goto(notes.address);
  const [viewer] = await Promise.all([page.waitForEvent("popup"), page.locator("a").first().click()]);
  await until(viewer, ({ timeSecs, playing }) => timeSecs === 0.5 && !playing);
  await viewer.evaluate(() => (globalThis.stays = true));
  await page.locator("a").last().click();
  await until(viewer, ({ clip, timeSecs, playing }) => clip === "Walk" && timeSecs === 0.25 && !playing);
  assert.equal(await viewer.evaluate(() => globalThis.stays), true, "it is not loaded anew");
  await viewer.close();
  notes.stop();
});

test("a link is about a model of those that the address names, without one about the first", OWN, async (page) => {
  const sample = await readFile(SAMPLE, "utf8");
  // The larger one opens.
  const texts = { "small.m3d": sample, "large.m3d": `${sample}\n\n` };
  await page.route(/\/(small|large)\.m3d$/, (route) =>
    route.fulfill({ body: texts[route.request().url().split("/").pop()] }),
  );
  const open = async (link) => {
    await page.goto("about:blank");
    await page.goto(`${PAGE}${QUERY}&src=small.m3d&src=large.m3d#${link}`);
    await running(page);
  };
  const is = (name, secs) => until(page, ({ model, timeSecs }) => model?.name === name && timeSecs === secs);
  await open("model=small.m3d&t=0.5&play=0");
  await is("small.m3d", 0.5);
  await says(page, `model=small.m3d&sha=${digestOf(sample)}&t=0.5&play=0`);
  await page.evaluate(() => (location.hash = "t=1&play=0"));
  await is("large.m3d", 1);
  await says(page, "t=1&play=0");
  await page.goBack();
  await is("small.m3d", 0.5);
  await page.evaluate(() => (location.hash = ""));
  await until(page, ({ model, link }) => model?.name === "large.m3d" && link === "");
});

test("a link wins over what else the address says and over what is kept, and is not kept", OWN, async (page) => {
  const kept = () => page.evaluate(() => JSON.parse(localStorage.getItem("bindpose.kept")));
  const open = async (rest) => {
    await page.goto("about:blank");
    await page.goto(PAGE + QUERY + rest);
    await running(page);
    return until(page, ({ link }) => link === (rest.split("#")[1] ?? link));
  };
  const chosen = { greeted: true, light: "book" };
  await page.evaluate((chosen) => localStorage.setItem("bindpose.kept", JSON.stringify(chosen)), chosen);
  const { crowd, look } = await open("&crowd=2&quality=full#t=0.5&play=0&crowd=3&quality=low");
  assert.deepEqual([crowd.count, look.quality, look.light], [3, "low", "studio"]);
  const { look: { light }, link } = await open("");
  assert.deepEqual([light, link.split("&").includes("light=book")], ["book", true], "elsewhere it is not kept");
  assert.deepEqual(await kept(), chosen);
  await page.evaluate(() => localStorage.setItem("bindpose.kept", JSON.stringify({ greeted: true })));
  assert.equal((await open("#t=0.5&play=0&light=book")).look.light, "book");
  assert.equal((await open("")).look.light, "studio");
  assert.deepEqual(await kept(), { greeted: true });
});

/** A window in which all of the panel with the buttons is seen. */
const HIGH = { ...OWN, viewport: LARGE, prepare: listen };

test("the buttons copy a link and a frame, and tell what has no room", HIGH, async (page) => {
  await until(page, (now) => now.model);
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  const moment = "t=0.5&play=0";
  await follow(page, moment);
  const press = async (control) => {
    await page.evaluate(() => navigator.clipboard.writeText(""));
    await click(page, "picture");
    await still(page, control);
    await click(page, control);
    for (const deadline = Date.now() + 20_000; ; await page.waitForTimeout(50)) {
      const text = await page.evaluate(() => navigator.clipboard.readText());
      if (text) return text;
      assert.ok(Date.now() < deadline, `${control} copies nothing: ${await notice(page)}`);
    }
  };
  assert.equal(await press("copy-link"), `${PAGE}${QUERY}#${moment}`);
  await speaks(page, "Link copied");
  const frame = await press("copy-embed");
  await speaks(page, "Embed copied");
  const [, source] = /^<iframe src="([^"]*)"[^<>]*><\/iframe>$/.exec(frame);
  assert.equal(source.replaceAll("&amp;", "&"), `${PAGE}${QUERY}&ui=transport#${moment}`);
  // An address that leaves little room.
  await follow(page, `${moment}&trails=${[...Array(39).keys()]}`);
  await page.evaluate(() => {
    const longer = `${location.search}&note=${"x".repeat(1850)}`;
    history.replaceState(null, "", longer + location.hash);
  });
  const short = await press("copy-link");
  assert.ok(short.length < 2000 && short.endsWith(`#${moment}`), short);
  await speaks(page, "Link copied; too long for trails");
  await page.context().clearPermissions();
});

test("a phone opens the link of a desk", { ...OWN, phone: true }, async (page) => {
  const link = "clip=Walk&t=0.5&play=0&bone=9&skin=weight&light=book&cam=70,12,4.2,0,1,0";
  await visit(page, link);
  const { clip, timeSecs, playing, skeleton, look, camera } = await until(page, (now) => now.link === link);
  assert.deepEqual([clip, timeSecs, playing], ["Walk", 0.5, false]);
  assert.deepEqual([skeleton.selected, skeleton.skinView, look.light], [9, "weight", "book"]);
  assert.deepEqual([Math.fround(camera.distance), camera.target], [Math.fround(4.2), [0, 1, 0]]);
  await atRest(page);
  assert.ok((await coloursOnScreen(page)) > 200);
  await keep(page, "link-on-phone");
  assert.equal(await hash(page), link);
});

const GREETED = { ...OWN, firstVisit: true, prepare: listen };

test("a link to a dropped file waits for it, by its name and by its bytes", { ...GREETED, draws: true }, async (page) => {
  const bytes = await readFile(SAMPLE);
  const file = (name, bytes) => ({ name, mimeType: "text/plain", buffer: bytes });
  const choose = (name, bytes) => page.setInputFiles("#files", file(name, bytes));
  await until(page, (now) => now.model);
  await choose("hero.m3d", bytes);
  await until(page, (now) => now.model?.name === "hero.m3d");
  await call(page, "pause");
  await call(page, "seek", 0.75);
  const link = `model=hero.m3d&sha=${digestOf(bytes)}&t=0.75&play=0`;
  await says(page, link);
  for (const [name, changed, told] of [
    ["hero.m3d", false, null],
    ["other.m3d", false, "other.m3d is hero.m3d of the link, under another name"],
    ["hero.m3d", true, "hero.m3d has other bytes than the file that the link was made of"],
  ]) {
    await visit(page, link);
    await speaks(page, "This link is about hero.m3d: open or drop it to see the same moment.");
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
  const { address, stop } = await serve(() => notes);
  const waits = { polling: 50 };
  const isShown = () => globalThis.bindpose?.state().timeSecs === 0.5 && document.getElementById("shell").hidden;
  const transport = ["timeline", "play", "time", "range-in", "range-out", "clips", "speed", "next-loop-mode"];
  const framed = [["transport", copied, transport], ["none", copied.replace("ui=transport", "ui=none"), []]];
  for (const [ui, html, wanted] of framed) {
    notes = html;
    await page.goto(address);
    const frame = page.frames()[1];
    await frame.waitForFunction(isShown, null, waits);
    const controls = () => Array.from(document.querySelectorAll("[data-control]"), ({ dataset }) => dataset.control);
    await frame.waitForFunction(
      (count) => document.querySelectorAll("[data-control]").length === count,
      wanted.length,
      waits,
    );
    assert.deepEqual(await frame.evaluate(controls), wanted);
    const whole = frame.getByRole("link", { name: "Open in Bindpose" });
    assert.equal(await whole.count(), wanted.length ? 1 : 0);
    if (wanted.length) {
      await whole.dispatchEvent("pointerdown");
      assert.equal((await whole.getAttribute("href")).replace("&#", "#"), `${PAGE}${QUERY}#clip=Walk&t=0.5&play=0`);
    }
    assert.ok((await coloursOnScreen(page)) > 200, ui);
    await keep(page, `framed-${ui}`);
    // The page scrolls over it.
    await page.mouse.move(200, 200);
    await page.mouse.wheel(0, 40);
    await page.waitForFunction(() => scrollY === 40);
  }
  notes = copied.replace("ui=transport", "ui=full");
  await page.goto(address);
  const whole = page.frames()[1];
  await whole.waitForFunction(isShown, null, waits);
  await whole.locator("[data-control=more]").waitFor({ state: "attached" });
  // Of a file of one's own the frame says that it is missing.
  notes = copied.replace("#clip", "#model=hero.m3d&amp;clip");
  await page.goto(address);
  const asks = () => document.getElementById("notice-words")?.textContent.includes("This link is about hero.m3d");
  await page.frames()[1].waitForFunction(asks, null, waits);
  stop();
});
