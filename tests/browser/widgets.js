// Where things are on the page. Its controls are asked by their stable names; what is only drawn has its place here, as points of a window
// of 960 × 600 with the sample open.

import { settled } from "./harness.js";

/** A control of a page of Playwright, where the viewer has drawn it: left, top, width and height. */
export async function bounds(page, control) {
  const element = page.locator(`[data-control="${control}"]`).first();
  await element.waitFor({ state: "attached" });
  return element.boundingBox();
}

/** The middle of a control, or as far from its left as `fraction` says. */
export async function place(page, control, fraction = 0.5) {
  const { x, y, width, height } = await bounds(page, control);
  return [x + fraction * width, y + height / 2];
}

/** Waits until a list has glided to its place: until a control stays where it is. */
export async function still(page, control) {
  for (let before; ; ) {
    for (let frames = 0; frames < 6; frames += 2) await settled(page);
    const now = JSON.stringify(await bounds(page, control));
    if (now === before) return;
    before = now;
  }
}

/** Clicks a control with the mouse. */
export async function click(page, control) {
  await page.mouse.click(...(await place(page, control)));
}

/** From the ends of the bar with the keys to its first and its last frame. */
const BAR_MARGIN = 12;

/** Where the bar with the keys has its first and its last frame: `{first, last, y}`. */
export function timeBar({ x, y, width, height }) {
  return { first: x + BAR_MARGIN, last: x + width - BAR_MARGIN, y: y + height / 2 };
}

/** The part of the page where the inspector is, as large as it is for a subset with maps. */
export const INSPECTOR = { x: 662, y: 62, width: 284, height: 386 };

/** The figure's chest, on its first frame: a part of its shell. */
export const CHEST = [505, 212];
/** Ground beside the figure that no panel covers. */
export const GROUND = [600, 510];

/** Bones of the figure on its first frame, by their numbers in the file: points on them beside other bones. */
export const BONES = { 19: [508, 318], 24: [444, 208], 4: [490, 195] };
