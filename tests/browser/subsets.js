// Parts of the model and their materials, by mouse; and pictures that are saved as files.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { atRest, drag, keep, settled, test } from "./harness.js";
import { decoded, difference, picture } from "./picture.js";
import { CHEST, GROUND, INSPECTOR, click, place, still } from "./widgets.js";

/** The subset of the sample that is orange. */
const TRIM = 1;


/** The part of the page where the inspector is when something is selected. */
async function inspectorArea(page) {
  await atRest(page);
  return decoded(page, await page.screenshot({ clip: INSPECTOR }));
}

test("a click in the view selects what is there, and the inspector comes and goes with it", {}, async (page) => {
  const nothing = await inspectorArea(page);
  const before = await picture(page);
  await page.mouse.click(...CHEST);
  const selected = await inspectorArea(page);
  assert.ok(difference(nothing, selected) > 0.5, "the inspector is there");
  await keep(page, "subset-selected");
  assert.equal((await picture(page)).digest, before.digest, "what is selected keeps its colours");
  await page.mouse.click(...GROUND);
  assert.equal(difference(nothing, await inspectorArea(page)), 0, "the ground selects nothing");
  await page.mouse.click(...CHEST);
  await settled(page);
  await page.keyboard.press("Escape");
  assert.equal(difference(nothing, await inspectorArea(page)), 0, "and Esc lets go");
});

test("the eye of a subset hides it and shows it again", { draws: true }, async (page) => {
  await atRest(page);
  const all = await picture(page);
  const clickEye = async () => {
    await page.mouse.move(...(await place(page, "model")));
    await page.mouse.wheel(0, 1000);
    await still(page, `hide-subset-${TRIM}`);
    await click(page, `hide-subset-${TRIM}`);
    await settled(page);
    await page.mouse.move(...GROUND);
    await atRest(page);
  };
  await clickEye();
  const without = await picture(page);
  assert.ok(difference(all, without) > 0.005, `${difference(all, without)} of the pixels`);
  const orange = ({ pixels }) => {
    let count = 0;
    for (let at = 0; at < pixels.length; at += 4) {
      // The visor is gold: greener.
      count += pixels[at] > 150 && pixels[at + 1] < 0.6 * pixels[at] && pixels[at + 2] < 0.5 * pixels[at];
    }
    return count;
  };
  assert.ok(orange(all) > 100, `${orange(all)} pixels are orange`);
  assert.equal(orange(without), 0);
  await keep(page, "subset-hidden");
  await clickEye();
  assert.equal((await picture(page)).digest, all.digest);
});

test("roughness is edited in the inspector, and Reset brings the very same picture back", { draws: true, passes: true }, async (page) => {
  await atRest(page);
  const before = await picture(page);
  await page.mouse.click(...CHEST);
  await atRest(page);
  await drag(page, await place(page, "roughness"), await place(page, "roughness", 0));
  await page.mouse.move(...GROUND);
  await atRest(page);
  const smooth = await picture(page);
  // Four parts of a hundred are reflected, so what becomes sharper in them is faint.
  assert.ok(difference(before, smooth, { tolerance: 0 }) > 0.01, `${difference(before, smooth, { tolerance: 0 })}`);
  await keep(page, "subset-smooth");
  await click(page, "reset-material");
  await page.mouse.move(...GROUND);
  await atRest(page);
  assert.equal((await picture(page)).digest, before.digest);
});

test("Shift+P saves the picture without what is behind the model", { draws: true, fine: true }, async (page) => {
  await page.mouse.click(...GROUND);
  await atRest(page);
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Shift+P")]);
  assert.equal(download.suggestedFilename(), "figure-Take1-0.png");
  const saved = await decoded(page, readFileSync(await download.path()));
  assert.deepEqual([saved.width, saved.height], [960, 600]);
  assert.ok(saved.clear > 0.3 && saved.clear < 0.99, `${saved.clear} of the pixels are clear`);
  const asked = await picture(page, { width: 960, height: 600, transparent: true });
  assert.equal(difference(saved, asked, { tolerance: 0 }), 0, "what a script's picture shows");
  await atRest(page);
});
