// Opening in slices: what the page does beside it, what it tells of it, and what must not end it.

import assert from "node:assert/strict";
import { copyFileSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { hide, loseGpu, watchGpu } from "./away.js";
import { BACKEND, CENTRE, SAMPLE, call, dropAndWait, keep, settled, state, test, until } from "./harness.js";
import { coloursOnScreen } from "./picture.js";

const TIMES = 90;

/** The sample with so many times its vertices, as a file: it takes a while to read, and shows the same. */
function large() {
  const [, head, vertices, rest] = /^([^]*\*+Vertices\*+\s+)([^]*?)(\s+\*+Triangles[^]*)$/.exec(readFileSync(SAMPLE, "utf8"));
  const counted = head.replace(/(#Vertices )(\d+)/, (_, label, count) => label + TIMES * count);
  const path = join(mkdtempSync(join(tmpdir(), "bindpose-")), "large.m3d");
  writeFileSync(path, counted + Array(TIMES).fill(vertices).join("\n") + rest);
  return path;
}

/** Gives the page the large file. What it returns begins to open it; the outcome will stand in `outcome` there: a model's name, or an error's. */
async function withLarge(page) {
  await call(page, "pause");
  await page.evaluate(() => {
    const input = document.createElement("input");
    input.type = "file";
    input.id = "large";
    document.body.append(input);
  });
  await page.setInputFiles("#large", large());
  return () => page.evaluate(() => {
    globalThis.outcome = null;
    bindpose.open(document.getElementById("large").files).then((state) => (globalThis.outcome = state.model.name), ({ name }) => (globalThis.outcome = name));
  });
}

/** Waits for the outcome, by a timer: a hidden page has no frames. */
async function outcome(page) {
  await page.waitForFunction(() => globalThis.outcome !== null, null, { polling: 100 });
  return page.evaluate(() => globalThis.outcome);
}

const isOpening = (page) => page.evaluate(() => globalThis.outcome === null && bindpose.state().opening?.name === "large.m3d");

test("while a large file opens the page goes on, tells how far it is, and Esc gives it up", { own: true }, async (page) => {
  const begin = await withLarge(page);
  await begin();
  const chip = page.getByRole("button", { name: "Cancel opening large.m3d" });
  await chip.waitFor({ state: "attached" });
  await keep(page, "opening");
  assert.equal((await state(page)).model.name, "figure.m3d", "what was open stays");
  await page.evaluate(() => bindpose.seek(0.5));
  await until(page, (now) => now.timeSecs === 0.5);
  assert.ok(await isOpening(page), "and the page takes commands");
  await page.mouse.click(...CENTRE);
  await page.keyboard.press("Escape");
  assert.equal(await outcome(page), "AbortError");
  assert.equal((await state(page)).model.name, "figure.m3d");
  await chip.waitFor({ state: "detached" });

  // What the person gave the page and gave up again was not replaced by anything, and the page does not say so.
  await page.setInputFiles("#files", large());
  await chip.waitFor({ state: "attached" });
  await page.keyboard.press("Escape");
  await until(page, ({ opening }) => !opening);
  await chip.waitFor({ state: "detached" });
  assert.equal(await page.isHidden("#notice"), true);

  await begin();
  assert.equal(await outcome(page), "large.m3d");
});

test("a GPU that goes away while a file opens takes nothing of it along", { draws: true, prepare: watchGpu, expectErrors: true }, async (page) => {
  const { model } = await state(page);
  const begin = await withLarge(page);
  await begin();
  await until(page, ({ opening }) => opening?.stage === "reading");
  await loseGpu(page);
  assert.ok(await isOpening(page), "it went away in the middle");
  await page.waitForFunction(() => document.querySelector("#view canvas") !== globalThis.lostCanvas);
  assert.equal(await outcome(page), "large.m3d");
  const { error, model: opened } = await until(page, ({ backend, opening, framesRendered }) => backend === BACKEND && !opening && framesRendered > 0);
  await settled(page);
  assert.equal(error, null);
  assert.equal(opened.counts.vertices, TIMES * model.counts.vertices);
  assert.equal(await page.isHidden("#fault"), true);
  assert.ok((await coloursOnScreen(page)) > 200, "it is drawn on the new canvas");
});

test("a file opens to its end in a tab that is hidden meanwhile", { own: true, draws: true }, async (page) => {
  const { model } = await state(page);
  const begin = await withLarge(page);
  await begin();
  await until(page, ({ opening }) => opening?.stage === "reading");
  await page.evaluate(hide);
  assert.ok(await isOpening(page), "it was hidden in the middle");
  assert.equal(await outcome(page), "large.m3d");
  const { error, model: opened, opening } = await state(page);
  assert.deepEqual([error, opening], [null, null]);
  assert.equal(opened.counts.vertices, TIMES * model.counts.vertices);
});

test("scripts and the browser's timeline see how long each stage of an opening took", { own: true, draws: true }, async (page) => {
  // The same bytes once more would not be read again.
  const path = join(mkdtempSync(join(tmpdir(), "bindpose-")), "timed.m3d");
  copyFileSync(SAMPLE, path);
  const began = await page.evaluate(() => {
    performance.clearMarks();
    return performance.now();
  });
  assert.equal((await dropAndWait(page, [path])).outcome, "load");
  await page.waitForFunction(() => performance.getEntriesByName("bindpose:drawn").length === 1);
  const { timings } = await state(page);
  const { marks, now } = await page.evaluate(() => ({
    marks: performance.getEntriesByType("mark").map(({ name, startTime }) => [name, startTime]),
    now: performance.now(),
  }));
  const stages = ["fetching", "reading", "building", "compiling", "checking", "measuring", "decoding", "judging", "drawing"];
  const expected = stages.filter((stage) => stage !== "decoding" || stage in timings);
  assert.deepEqual(marks.map(([name]) => name), [...expected, "drawn"].map((stage) => `bindpose:${stage}`));
  assert.deepEqual(Object.keys(timings).sort(), expected.toSorted());
  const times = [began, ...marks.map(([, time]) => time), now];
  assert.ok(times.every((time, index) => index === 0 || time >= times[index - 1]), `in their order: ${times}`);
  for (const [index, stage] of expected.entries()) {
    const between = marks[index + 1][1] - marks[index][1];
    assert.ok(Math.abs(timings[stage] - between) < 5, `${stage}: ${timings[stage]} ms, and ${between} ms between the marks`);
  }
  assert.ok(timings.reading > 0 && timings.building > 0 && timings.drawing > 0, JSON.stringify(timings));
});
