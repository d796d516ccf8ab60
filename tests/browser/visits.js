// A visit: what the page says at the first one, what is kept for the next, and what goes on while nobody looks.

import assert from "node:assert/strict";
import { hide } from "./away.js";
import { BACKEND, SAMPLE, call, dropAndWait, listen, settled, state, test, until, visitAgain, withViewer } from "./harness.js";

/** A button by the start of its name. */
const control = (page, start) => page.getByRole("button", { name: new RegExp(`^${start}`) }).first();

async function press(page, start) {
  await control(page, start).focus();
  await page.keyboard.press("Enter");
  await settled(page);
}

const greeting = (page) => control(page, "Close the welcome").count();
const kept = (page) => page.evaluate(() => JSON.parse(localStorage.getItem("bindpose.kept")));

test("a page in a hidden tab comes to its start and opens the model", { bare: true, prepare: (page) => page.addInitScript(hide) }, async (page) => {
  await page.waitForFunction(() => globalThis.bindpose?.state().model, null, { polling: 200, timeout: 60_000 });
  assert.equal((await state(page)).backend, BACKEND);
});

test("an export that was begun goes on in a hidden tab", { own: true }, async (page) => {
  await call(page, "pause");
  await page.keyboard.press("e");
  await control(page, "Save figure").waitFor({ state: "attached" });
  const saved = page.waitForEvent("download", { timeout: 60_000 });
  await press(page, "Save figure");
  await page.evaluate(hide);
  assert.match((await saved).suggestedFilename(), /^figure\.glb$/);
});

/** Waits until there are so many greetings: the mirror of the controls follows the window some times a second. */
async function greeted(page, count) {
  for (const deadline = Date.now() + 20_000; (await greeting(page)) !== count; await page.waitForTimeout(50)) {
    assert.ok(Date.now() < deadline, `${await greeting(page)} greetings, not ${count}`);
  }
}

test("the first visit says what the page is for, until something is dropped", { own: true, firstVisit: true, prepare: listen }, async (page) => {
  await greeted(page, 1);
  await page.waitForFunction(() => globalThis.heard.some((words) => /Files stay on this machine\./.test(words)));
  await dropAndWait(page, [SAMPLE]);
  await settled(page);
  await greeted(page, 0);
  await visitAgain(page);
  await settled(page);
  await control(page, "Choose files to open").waitFor({ state: "attached" }); // Now it tells what was open.
  await page.waitForFunction(() => globalThis.heard.some((words) => /figure\.m3d was open: drop it again\./.test(words)));
  await press(page, "Close the welcome");
  await visitAgain(page);
  await settled(page);
  await control(page, "Help").waitFor({ state: "attached" }); // What is on the window is told as a whole.
  assert.equal(await greeting(page), 0);
});

test("what a person has chosen is there at the next visit", { own: true, query: `?backend=${BACKEND}&scale=0.2` }, async (page) => {
  assert.equal((await state(page)).look.light, "studio");
  await press(page, "Light theme");
  await page.keyboard.press("v");
  await call(page, "setQuality", "low");
  await until(page, ({ look, theme }) => look.light === "book" && theme === "light");
  await visitAgain(page);
  const { theme, light, quality, split } = await kept(page);
  assert.deepEqual({ theme, light, quality, split }, { theme: "light", light: "book", quality: "low", split: undefined });
  await settled(page);
  assert.equal((await state(page)).look.light, "book");
  assert.equal(await control(page, "Dark theme").count(), 1, "the theme is light");
});

test("a model with which no start lasts is put aside in words", {
  expectErrors: true,
  prepare: withViewer(`
    async start(...values) {
      const gpu = await super.start(...values);
      globalThis.loseGpu = () => this.onEvent("devicelost", { reason: "the driver hung" });
      if (globalThis.hangs && this.state().model) setTimeout(globalThis.loseGpu);
      return gpu;
    }`),
}, async (page) => {
  await page.evaluate(() => {
    globalThis.hangs = true;
    globalThis.loseGpu();
  });
  await page.waitForSelector("#notice:not([hidden])");
  assert.equal(await page.textContent("#notice-title"), "figure.m3d was put aside");
  await until(page, ({ backend, model }) => backend === BACKEND && !model);
  assert.equal(await page.isHidden("#fault"), true);
  await page.evaluate(() => (globalThis.hangs = false));
  const { outcome, model } = await dropAndWait(page, [SAMPLE]);
  assert.equal(outcome, "load");
  assert.equal(model.name, "figure.m3d");
});
