// Names that a person gives to bones: typed in the tree, kept by the browser, there again with the next visit.

import assert from "node:assert/strict";
import { atRest, keep, running, settled, test, until, visitAgain } from "./harness.js";
import { decoded, difference } from "./picture.js";
import { GROUND, bounds, place, click } from "./widgets.js";


/** What the browser keeps for this page. */
function kept(page) {
  return page.evaluate(() => Object.entries(localStorage).filter(([key]) => key.startsWith("bindpose.names.")));
}

/** Opens the tree. A click before the page has come to rest would find nothing there yet. */
async function openTree(page) {
  await atRest(page);
  await click(page, "page-1");
}

/** The rows of the tree, with nothing under the pointer. */
async function tree(page) {
  await page.mouse.move(...GROUND);
  await settled(page);
  return decoded(page, await page.screenshot({ clip: await bounds(page, "model") }));
}

async function nameSecondBone(page, name) {
  await page.mouse.dblclick(...(await place(page, "bone-1")));
  await atRest(page);
  await page.keyboard.type(name, { delay: 30 });
  await page.keyboard.press("Enter");
  await settled(page);
  // Esc lets go of the bone, which the clicks have selected.
  await page.keyboard.press("Escape");
}

test("names of bones are kept and are there after a reload", {}, async (page) => {
  await openTree(page);
  const unnamed = await tree(page);
  assert.deepEqual(await kept(page), []);
  await nameSecondBone(page, "Hips");
  const named = await tree(page);
  await keep(page, "names");
  assert.ok(difference(unnamed, named) > 0, "the name is in the tree");
  const [[key, text], ...others] = await kept(page);
  assert.match(key, /^bindpose\.names\.[0-9a-f]{16}$/);
  assert.equal(text, "1 Hips\n");
  assert.deepEqual(others, []);

  await visitAgain(page);
  // The names follow with the first pass of the window.
  const { skeleton } = await until(page, ({ skeleton }) => skeleton.names[1]);
  assert.deepEqual(skeleton.names, { 1: "Hips" });
  await openTree(page);
  assert.equal(difference(named, await tree(page)), 0, "the same names");
  assert.deepEqual(await kept(page), [[key, text]]);
});

test("names that are given in another tab are those of this one, and more than there is room for are not kept", { own: true }, async (page) => {
  await openTree(page);
  await nameSecondBone(page, "Hips");
  const [[key]] = await kept(page);
  const other = await page.context().newPage();
  try {
    await other.goto(page.url());
    await running(other);
    await until(other, ({ skeleton }) => skeleton.names[1] === "Hips");
    // A page hears of it from its own frames on: this one draws none while the other is in front of it.
    await other.evaluate((key) => localStorage.setItem(key, "1 Pelvis\n"), key);
  } finally {
    await other.close();
  }
  await page.bringToFront();
  await until(page, ({ skeleton }) => skeleton.names[1] === "Pelvis");
  await page.evaluate(() => {
    for (let place = 0; place < 80; place += 1) localStorage.setItem(`bindpose.names.${place.toString(16).padStart(16, "0")}`, "1 Old\n");
  });
  await nameSecondBone(page, "Waist");
  const all = await kept(page);
  assert.equal(all.length, 64, "those of other hierarchies give way");
  assert.deepEqual(all.find(([of]) => of === key), [key, "1 Waist\n"]);
});

test("a browser that keeps nothing does not stand in the way", {
  prepare: (page) => page.addInitScript(() => {
    const refuse = () => { throw new DOMException("full", "QuotaExceededError"); };
    Object.assign(Storage.prototype, { getItem: refuse, setItem: refuse, removeItem: refuse });
  }),
}, async (page) => {
  await openTree(page);
  const unnamed = await tree(page);
  await nameSecondBone(page, "Hips");
  assert.ok(difference(unnamed, await tree(page)) > 0, "the name is in the tree all the same");
});

test("a name that is typed in one slow frame is kept, and none of its letters is a shortcut", { own: true, motion: true }, async (page) => {
  // The model plays meanwhile, and the page draws once in a second.
  await page.evaluate(() => {
    const soon = requestAnimationFrame.bind(globalThis);
    globalThis.requestAnimationFrame = (draw) => setTimeout(() => soon(draw), 1000);
  });
  const before = await until(page, ({ playing }) => playing);
  await click(page, "page-1");
  await page.waitForTimeout(2500);
  await page.mouse.dblclick(...(await place(page, "bone-1")));
  await page.keyboard.type("Spin A");
  await page.keyboard.press("Enter");
  const { skeleton, look, playing, rangeSecs } = await until(page, ({ skeleton }) => skeleton.names[1]);
  assert.equal(skeleton.names[1], "Spin A");
  assert.deepEqual([look, playing, rangeSecs], [before.look, true, null]);
  const [[, text]] = await kept(page);
  assert.equal(text, "1 Spin A\n");
});
