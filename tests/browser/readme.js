// The README's pictures: the page as it stands, with its own sample. `cargo xtask pictures` runs this and writes assets/page/.

import { mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { atRest, call, settled, state, test, until } from "./harness.js";
import { click } from "./widgets.js";

const FOLDER = fileURLToPath(new URL("../../assets/page/", import.meta.url));
mkdirSync(FOLDER, { recursive: true });

/** The window of all of them. */
const WINDOW = { width: 1280, height: 800 };
const WHOLE = { viewport: WINDOW, fine: true, passes: true, own: true };
/** Places in that window: ground beside the figure, and the bellows of its waist, which follow two bones and lie beside their lines. */
const GROUND = [820, 640];
const WAIST = [644, 332];

/** In the middle of a step. */
async function inStep(page) {
  await call(page, "pause");
  await call(page, "selectClip", "Walk");
  await call(page, "seek", 0.4);
  await atRest(page);
}

async function keep(page, name) {
  await page.mouse.move(...GROUND);
  await atRest(page);
  await page.screenshot({ path: `${FOLDER}${name}.jpg`, type: "jpeg", quality: 88 });
}

test("light", { ...WHOLE, colorScheme: "light" }, async (page) => {
  await inStep(page);
  await keep(page, "light");
});

test("dark, with the timeline open", WHOLE, async (page) => {
  await inStep(page);
  await click(page, "dope-sheet");
  await keep(page, "dark-timeline");
});

test("one vertex explained", WHOLE, async (page) => {
  await inStep(page);
  await click(page, "page-1");
  await settled(page);
  await page.mouse.click(...GROUND);
  await page.keyboard.press("w");
  await until(page, ({ skeleton }) => skeleton.skinView !== null);
  await page.mouse.click(...WAIST);
  await until(page, ({ skeleton }) => skeleton.vertex !== null);
  // A press on a panel that was not drawn yet would go to what is behind it.
  await atRest(page);
  const { x, y, width, height } = await page.getByRole("button", { name: "Explain this vertex" }).boundingBox();
  await page.mouse.click(x + width / 2, y + height / 2);
  await atRest(page);
  await page.keyboard.press("w");
  await until(page, ({ skeleton }) => skeleton.bonesVisible && skeleton.vertex !== null);
  await keep(page, "vertex");
});

test("both lights side by side", WHOLE, async (page) => {
  await inStep(page);
  await click(page, "light");
  await settled(page);
  await click(page, "split");
  await until(page, ({ look }) => look.split !== null);
  await page.keyboard.press("Escape");
  await keep(page, "both-lights");
});
