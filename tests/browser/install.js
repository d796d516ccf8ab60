// What a system shows of the page where it is installed: icons and screenshots. `cargo xtask pictures` runs this and writes web/install/.

import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { atRest, call, test } from "./harness.js";

const FOLDER = fileURLToPath(new URL("../../web/install/", import.meta.url));
const ICON = readFileSync(new URL("../../web/icon.svg", import.meta.url), "base64");
mkdirSync(FOLDER, { recursive: true });

/** The icon's own ground, and how much of a maskable icon no system cuts away. */
const GROUND = "#181b21";
const SAFE = 0.8;

test("icons", { bare: true, query: "web/icon.svg", expectErrors: true }, async (page) => {
  for (const [name, side, share] of [["icon-192", 192, 1], ["icon-512", 512, 1], ["maskable-512", 512, SAFE]]) {
    const png = await page.evaluate(async ([icon, side, share, ground]) => {
      const image = Object.assign(new Image(), { src: `data:image/svg+xml;base64,${icon}` });
      await image.decode();
      const canvas = Object.assign(document.createElementNS("http://www.w3.org/1999/xhtml", "canvas"), { width: side, height: side });
      const context = canvas.getContext("2d");
      context.fillStyle = ground;
      if (share < 1) context.fillRect(0, 0, side, side);
      const margin = ((1 - share) * side) / 2;
      context.drawImage(image, margin, margin, share * side, share * side);
      return canvas.toDataURL("image/png").split(",")[1];
    }, [ICON, side, share, GROUND]);
    writeFileSync(`${FOLDER}${name}.png`, Buffer.from(png, "base64"));
  }
});

async function keep(page, name) {
  await call(page, "pause");
  await call(page, "selectClip", "Walk");
  await call(page, "seek", 0.4);
  await page.mouse.move(0, 0);
  await atRest(page);
  await page.screenshot({ path: `${FOLDER}${name}.jpg`, type: "jpeg", quality: 80 });
}

test("a wide window", { viewport: { width: 1280, height: 800 }, fine: true, passes: true, own: true }, (page) => keep(page, "wide"));

test("a narrow one", { sharp: true, fine: true, passes: true, own: true }, (page) => keep(page, "narrow"));
