// Pictures of the view: drawn by the page, decoded by it, compared with each other and with those that are committed.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { BACKEND, OUT } from "./harness.js";

/** What both backends must come to. */
const GOLDEN = fileURLToPath(new URL("golden/", import.meta.url));

/** What a call of `bindpose` gives that resolves with a PNG: its bytes. */
async function png(page, call, options) {
  const { type, base64 } = await page.evaluate(async ([call, options]) => {
    const png = await globalThis.bindpose[call](options);
    const reader = new FileReader();
    const address = await new Promise((done) => {
      reader.onload = () => done(reader.result);
      reader.readAsDataURL(png);
    });
    return { type: png.type, base64: address.split(",")[1] };
  }, [call, options]);
  assert.equal(type, "image/png");
  return Buffer.from(base64, "base64");
}

/** The pixels of a PNG, and what can be said of them. */
export async function decoded(page, png) {
  const { pixels, ...rest } = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    const colours = new Set();
    let [clear, letters] = [0, ""];
    for (let at = 0; at < data.length; at += 4) {
      colours.add((data[at] << 16) | (data[at + 1] << 8) | data[at + 2]);
      clear += data[at + 3] === 0;
      letters += String.fromCharCode(data[at], data[at + 1], data[at + 2], data[at + 3]);
    }
    return {
      width: bitmap.width,
      height: bitmap.height,
      colours: colours.size,
      clear: clear / (data.length / 4),
      pixels: btoa(letters),
    };
  }, png.toString("base64"));
  return { ...rest, pixels: Buffer.from(pixels, "base64") };
}

/** A picture of the view without the interface, with the options of `bindpose.snapshot`: its PNG and the hash of that, and its pixels. */
export async function picture(page, options = {}, call = "snapshot") {
  const bytes = await png(page, call, { width: 320, height: 200, ...options });
  const digest = createHash("sha256").update(bytes).digest("hex");
  return { png: bytes, digest, ...(await decoded(page, bytes)) };
}

/** The same of a contact sheet. */
export const contactSheet = (page, options) => picture(page, options, "contactSheet");

/**
 * The part of the pixels, from 0 to 1, that differ by more than `tolerance` of 255 in any channel. Of the columns between
 * two shares of the width only, when they are given.
 */
export function difference(one, other, { tolerance = 8, columns = [0, 1] } = {}) {
  assert.deepEqual([one.width, one.height], [other.width, other.height]);
  const [from, to] = columns.map((fraction) => Math.round(fraction * one.width));
  let differing = 0;
  for (let y = 0; y < one.height; y += 1) {
    for (let x = from; x < to; x += 1) {
      const at = 4 * (y * one.width + x);
      const far = (channel) => Math.abs(one.pixels[at + channel] - other.pixels[at + channel]) > tolerance;
      differing += far(0) || far(1) || far(2) || far(3);
    }
  }
  return differing / ((to - from) * one.height);
}

/**
 * The part of the pixels, from 0 to 1, that no pixel near them in the other picture explains: a channel is more than `tolerance` of 255 less than
 * the least, or more than the greatest, of the nine pixels around that place.
 */
function outside(one, other, tolerance) {
  const { width, height } = one;
  assert.deepEqual([width, height], [other.width, other.height]);
  const around = (at, end) => [at - 1, at, at + 1].filter((near) => near >= 0 && near < end);
  let differing = 0;
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1) {
      const near = around(y, height).flatMap((row) => around(x, width).map((column) => 4 * (row * width + column)));
      differing += [0, 1, 2].some((channel) => {
        const seen = one.pixels[4 * (y * width + x) + channel];
        const known = near.map((at) => other.pixels[at + channel]);
        return seen < Math.min(...known) - tolerance || seen > Math.max(...known) + tolerance;
      });
    }
  }
  return differing / (width * height);
}

/**
 * Compares with the committed picture of this name. With `BLESS=1` in the environment that picture is written first, on WebGPU: look
 * at it before it is committed.
 *
 * The committed pictures are drawn on WebGPU, by SwiftShader. There a channel may be 4 of 255 off anywhere, and more than that in one pixel of
 * 500. WebGL2 is drawn by Mesa, which takes its samples at other places in a pixel, so edges differ: a channel may lie 4 of 255 outside the range
 * of the pixel and the eight around it in the committed picture, and further than that in one pixel of 100. Seen was one of 200.
 */
export async function assertGolden(page, name, drawn) {
  const file = `${GOLDEN}${name}.png`;
  if (process.env.BLESS && BACKEND === "webgpu") {
    mkdirSync(GOLDEN, { recursive: true });
    writeFileSync(file, drawn.png);
  }
  assert.ok(existsSync(file), `${file} is not there; BLESS=1 cargo xtask test --browser webgpu writes it`);
  const committed = await decoded(page, readFileSync(file));
  const [differing, most] = BACKEND === "webgpu" ? [difference(drawn, committed, { tolerance: 4 }), 0.002] : [outside(drawn, committed, 4), 0.01];
  if (differing <= most) return;
  const seen = `${OUT}${BACKEND}-DIFFERS-${name}.png`;
  writeFileSync(seen, drawn.png);
  assert.fail(`${(100 * differing).toFixed(1)} % of the pixels of ${seen} differ from ${file}`);
}

/** A model in front of a backdrop has hundreds of colours; a blank picture has one. */
export function assertDrawn(drawn) {
  assert.ok(drawn.colours > 200, `the picture has ${drawn.colours} colours`);
}

/** The number of distinct colours in a screenshot of the page, for what `picture` cannot see: the canvas itself. */
export async function coloursOnScreen(page) {
  return (await decoded(page, await page.screenshot())).colours;
}
