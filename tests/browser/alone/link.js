// When the address is written and which model it names, with stand-ins for the viewer, the address and the clock.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { mock, test } from "node:test";
import { keepLink } from "../../../web/link.js";

const BYTES = new TextEncoder().encode("a model");
const SHA = createHash("sha256").update(BYTES).digest("hex").slice(0, 12);

const soon = () => new Promise((done) => setImmediate(done));

/** A page that opened `own.m3d` by itself, with `other.m3d` in the same list; its address ends in `page.hash`. */
async function pageOf() {
  const address = "https://host/";
  let now = 0;
  const page = { hash: "", view: "", taken: 0, writes: [], told: [], asked: [] };
  page.shown = { path: "own.m3d", opening: 1 };
  page.viewer = {
    link(taken) {
      page.taken = taken;
      return { text: page.view, leftOut: [] };
    },
    modelOnScreen: () => page.shown,
    modelBytes: () => BYTES,
    openModel(path) {
      if (!["own.m3d", "other.m3d"].includes(path)) return false;
      page.loading = soon().then(() => page.opens({ path, opening: 1 }));
      return true;
    },
  };
  globalThis.location = {
    get href() {
      return address + this.hash;
    },
    get hash() {
      return page.hash && `#${page.hash}`;
    },
  };
  globalThis.history = {
    state: null,
    replaceState(state, title, written) {
      page.hash = new URL(written).hash.slice(1); // Browsers write some characters in codes.
      page.writes.push([now, page.hash]);
    },
  };
  page.link = keepLink({
    viewer: () => page.viewer,
    changed: (text) => page.told.push(text),
    follow(view) {
      page.view = view;
      return page.leavesOut ?? [];
    },
    ask: (words) => page.asked.push(words),
    tell() {},
    refuse: (...told) => (page.refused = told),
  });
  mock.method(performance, "now", () => now);
  mock.timers.enable({ apis: ["setTimeout"] });
  page.opens = (shown) => {
    page.shown = shown;
    return page.link.loaded();
  };
  /** Time goes on, and then a frame is drawn, of this view. */
  page.after = (ms, view = page.view) => {
    for (let step = 0; step < ms; step += 1) {
      now += 1;
      mock.timers.tick(1);
    }
    page.view = view;
    page.link.settling();
  };
  page.click = async (hash) => {
    page.hash = hash;
    page.link.hashChanged();
    await page.loading;
  };
  await page.link.opens(soon().then(() => page.opens(page.shown)));
  page.after(1000);
  page.told.length = 0;
  return page;
}

/** A test of such a page; the clock and the address are as before after it. */
const testOf = (name, body) =>
  test(name, async () => {
    try {
      await body();
    } finally {
      mock.timers.reset();
      mock.restoreAll();
      delete globalThis.location;
      delete globalThis.history;
    }
  });

testOf("a link is written a quarter of a second after the last change", async () => {
  const page = await pageOf();
  page.after(0, "t=1");
  for (const secs of [2, 3, 4]) page.after(200, `t=${secs}`);
  // Frames that change nothing, as when the mouse moves, put nothing off.
  for (let frame = 0; frame < 24; frame += 1) page.after(10);
  assert.deepEqual(page.writes, []);
  page.after(10);
  assert.deepEqual(page.writes, [[1000 + 600 + 250, "t=4"]]);
  assert.deepEqual(page.told, ["t=4"]);
  page.after(0, "t=5");
  page.after(100, "t=4");
  page.after(1000);
  assert.equal(page.writes.length, 1, "what went and came back is no change");
});

testOf("it is written twice a second at most", async () => {
  const page = await pageOf();
  for (let step = 0; step < 20; step += 1) page.after(260, `t=${step}`);
  page.after(1000);
  const times = page.writes.map(([time]) => time);
  assert.ok(times.length > 5, String(times));
  times.slice(1).forEach((time, index) => assert.ok(time - times[index] >= 500, String(times)));
  assert.equal(page.hash, "t=19");
});

testOf("nothing is written while it moves, and what was changed then is afterwards", async () => {
  const page = await pageOf();
  page.after(0, "t=1");
  page.after(100);
  page.link.moving();
  page.view = "t=2";
  page.after(0);
  page.link.moving();
  for (let ms = 0; ms < 1000; ms += 100) mock.timers.tick(100);
  assert.deepEqual(page.writes, []);
  page.after(250, "t=2");
  page.after(250);
  assert.equal(page.hash, "t=2");
});

testOf("a link that was clicked is not written over before the page hears of it", async () => {
  const page = await pageOf();
  page.after(0, "t=1");
  page.hash = "t=9";
  page.after(300);
  assert.deepEqual([page.writes, page.hash], [[], "t=9"]);
  await page.click("t=9");
  assert.equal(page.view, "t=9");
});

testOf("a link without a model is about the page's own, one with a model of its list about that", async () => {
  const page = await pageOf();
  await page.click("model=other.m3d&t=1");
  assert.deepEqual([page.shown.path, page.view], ["other.m3d", "t=1"]);
  assert.equal(page.link.whole().asksFor, null, "who opens the link has it in the list too");
  assert.equal(page.link.text(), `model=other.m3d&sha=${SHA}&t=1`);
  await page.click("t=2");
  assert.deepEqual([page.shown.path, page.view, page.link.text()], ["own.m3d", "t=2", "t=2"]);
  await page.click("model=other.m3d&t=3");
  await page.click("");
  assert.deepEqual([page.shown.path, page.view, page.link.text()], ["own.m3d", "", ""]);
  assert.deepEqual(page.asked.filter(Boolean), []);
  // A file of one's own, and a link back to what the page opens by itself.
  await page.opens({ path: "theirs.m3d", opening: 2 });
  assert.equal(page.link.whole().asksFor, "theirs.m3d");
  await page.click("t=4");
  assert.deepEqual([page.shown.path, page.view], ["own.m3d", "t=4"]);
});

testOf("what is left out and which file is shown are told together", async () => {
  const page = await pageOf();
  await page.opens({ path: "hero.m3d", opening: 2 });
  page.leavesOut = ["bone"];
  await page.click("model=hero.m3d&sha=0123456789ab&bone=99");
  assert.deepEqual(page.refused, [["bone"], "hero.m3d has other bytes than the file that the link was made of"]);
});

for (const [characters, isNamed] of [[2_000, true], [2_001, false]]) {
  const outcome = isNamed ? "named" : "left out, and that is told";
  testOf(`a model with which the address would have ${characters} characters is ${outcome}`, async () => {
    const page = await pageOf();
    await page.opens({ path: "a".repeat(characters - "https://host/#model=&sha=".length - SHA.length), opening: 2 });
    const { address, leftOut, asksFor } = page.link.whole();
    assert.equal(asksFor === null, !isNamed, "who opens a link without its name is not asked for it");
    assert.equal(address.length, isNamed ? characters : "https://host/".length);
    assert.deepEqual(leftOut, isNamed ? [] : ["model"]);
    const taken = isNamed ? characters + 1 : "https://host/".length + 2;
    assert.equal(page.taken, taken, "the rest of the room is the viewer's");
  });
}
