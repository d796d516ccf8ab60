// Pages to copy: that of the README, and those of examples/.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { BACKEND, FIXTURES, keep, test } from "./harness.js";
import { FIGURE } from "./notes.js";

/** The page of a README, with the sample in place of its model. */
function copied(readme) {
  const [, page] = /```html\n(<!doctype html>[^`]*)```/.exec(readFileSync(new URL(`../../${readme}`, import.meta.url), "utf8"));
  const here = page.replace("bindpose/web/", "web/").replace('import "bindpose-viewer";', 'import "/web/element/bindpose-viewer.js";');
  return here.replace(/src="soldier\.m3d[^"]*"/, `backend="${BACKEND}" ${FIGURE}`);
}

for (const [words, readme] of [["README", "README.md"], ["package's README", "xtask/npm/README.md"]]) {
  test(`the page of the ${words}: it plays, and a sentence leads to a moment`, {
    query: "notes.html",
    bare: true,
    motion: true,
    prepare: async (page) => {
      await page.route("**/notes.html", (route) => route.fulfill({ contentType: "text/html", body: copied(readme) }));
      await page.route("**/soldier.jpg", (route) => route.fulfill({ contentType: "image/svg+xml", body: '<svg xmlns="http://www.w3.org/2000/svg"/>' }));
    },
  }, async (page) => {
    await page.waitForFunction(() => document.getElementById("step").paused === false, null, { polling: 50 });
    await page.getByRole("button", { name: "left foot" }).click();
    await page.waitForFunction(() => document.getElementById("step").paused, null, { polling: 50 });
    const { clip, currentTime, camera } = await page.evaluate(() => {
      const { clip, currentTime } = document.getElementById("step");
      return { clip, currentTime, camera: document.getElementById("step").state().camera };
    });
    assert.deepEqual([clip, currentTime], ["Walk", 0.5]);
    assert.ok(Math.abs(camera.yawRadians - Math.PI / 2) < 1e-5, `${camera.yawRadians}: from the right`);
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
  await page.locator("input[data-for=right]").setInputFiles(`${FIXTURES}good/d3d12_skinned.m3d`);
  await page.waitForFunction(() => document.getElementById("right").state().model.name === "d3d12_skinned.m3d", null, { polling: 50 });
  await page.getByRole("slider", { name: "Time" }).fill("0.25");
  assert.deepEqual(await at(), [25, 25], "two files, each at its own clip's time");
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction(() => document.getElementById("left").currentTime > 0.7, null, { polling: 50 });
  await keep(page, "example-compare");
});
