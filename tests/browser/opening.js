// Files from the person: dropped for real, chosen in a dialog, good ones and bad ones.

import assert from "node:assert/strict";
import { mkdtempSync, mkdirSync, copyFileSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import {
  FIXTURES, LARGE, SAMPLE, SHARED, call, drop, dropAndWait, filesIn, keep, settled, state, test, unless, until,
} from "./harness.js";
import { assertDrawn, difference, picture } from "./picture.js";
import { GROUND, click } from "./widgets.js";

/** A copy of the sample under another name, in a folder of its own. */
export function copyOfSample(...parts) {
  const folder = mkdtempSync(join(tmpdir(), "bindpose-"));
  const path = join(folder, ...parts);
  mkdirSync(join(path, ".."), { recursive: true });
  copyFileSync(SAMPLE, path);
  return { folder, path };
}

test("a dropped file opens, and the page says before release what it will do", {}, async (page) => {
  const { path } = copyOfSample("hero.m3d");
  const look = async () => {
    assert.match(await page.innerText("#drop-overlay"), /^Drop to open\s+1 item · figure\.m3d stays until it is read · Shift adds its clips$/);
    await keep(page, "drop-overlay");
  };
  const { outcome, model, error } = await dropAndWait(page, [path], { look });
  assert.equal(outcome, "load");
  assert.equal(model.name, "hero.m3d");
  assert.equal(error, null);
  assert.equal(await page.isHidden("#drop-overlay"), true);
});

/** From now on the names of the files whose bytes the page asks for stand in `reads` there. */
async function watchReads(page) {
  await page.evaluate(() => {
    globalThis.reads = [];
    File.prototype.slice = function (from, ...rest) {
      if (from === 0) globalThis.reads.push(this.name);
      globalThis.ends = { ...globalThis.ends, [this.name]: rest[0] };
      return Blob.prototype.slice.call(this, from, ...rest);
    };
  });
}

test("a static model of the books opens, and goes out as it came; a text that is none is told", { draws: true }, async (page) => {
  const { folder, path } = copyOfSample("box.txt");
  const corners = [...Array(8).keys()].map((n) => [n & 1, (n >> 1) & 1, n >> 2].map((side) => 2 * side - 1));
  const rows = corners.map((at) => `\t${at.join(" ")} ${at.map((side) => (side * Math.sqrt(1 / 3)).toFixed(6)).join(" ")}`);
  const faces = ["0 2 1", "1 2 3", "4 5 6", "5 7 6", "0 1 4", "1 5 4", "2 6 3", "3 6 7", "0 4 2", "2 4 6", "1 3 5", "3 7 5"];
  const text = `VertexCount: 8\r\nTriangleCount: 12\r\nVertexList (pos, normal)\r\n{\r\n${rows.join("\r\n")}\r\n}\r\nTriangleList\r\n{\r\n\t${faces.join("\r\n\t")}\r\n}\r\n`;
  writeFileSync(path, text);
  const { outcome, model, notices, book } = await dropAndWait(page, [path]);
  assert.equal(outcome, "load");
  assert.deepEqual([model.dialect, model.counts.triangles, model.counts.bones, book.d3d12, book.converted.fits], ["txt", 12, 0, null, true]);
  assert.deepEqual(notices.filter(({ severity }) => severity !== "note"), []);
  assertDrawn(await picture(page));
  await keep(page, "text-model");
  const { name, bytes, losses } = await page.evaluate(() => bindpose.export({ format: "txt" }).then(({ name, bytes, losses }) => ({ name, losses, bytes: new TextDecoder().decode(bytes) })));
  assert.deepEqual([name, losses], ["box.txt", []]);
  const numbers = (text) => text.match(/-?[\d.]+/g).map(Number);
  numbers(bytes).forEach((number, index) => assert.ok(Math.abs(number - numbers(text)[index]) < 1e-5, `number ${index}`));
  const letter = join(folder, "letter.txt");
  writeFileSync(letter, "Dear reader,\n");
  const told = await dropAndWait(page, [letter]);
  assert.deepEqual([told.outcome, told.error.code], ["error", "not-m3d"]);
  assert.equal((await state(page)).model.name, "box.txt", "what was on screen stays");
});

test("a dropped folder opens with the paths in it", { own: true }, async (page) => {
  const { folder } = copyOfSample("pack", "models", "deep", "hero.m3d");
  writeFileSync(join(folder, "pack", "readme.md"), "not for the viewer");
  writeFileSync(join(folder, "pack", "letter.txt"), `Dear reader,\n${" ".repeat(5 << 20)}`);
  writeFileSync(join(folder, "pack", "point.txt"), "VertexCount: 1\nTriangleCount: 0\nVertexList (pos, normal)\n{\n0 0 0 0 1 0\n}\nTriangleList\n{\n}\n");
  await watchReads(page);
  const { outcome, model, models } = await dropAndWait(page, [join(folder, "pack")]);
  assert.equal(outcome, "load");
  assert.equal(model.path, "pack/models/deep/hero.m3d");
  assert.deepEqual([...models].sort(), ["figure.m3d", "pack/models/deep/hero.m3d", "pack/point.txt"]);
  const [reads, ends] = await page.evaluate(() => [globalThis.reads, globalThis.ends]);
  assert.deepEqual([...new Set(reads)].sort(), ["hero.m3d", "letter.txt", "point.txt"], "and only what may be of use");
  assert.equal(ends["letter.txt"], 64 << 10, "of notes the beginning alone");
});

test("a folder of more entries than one call gives is read to its end", { own: true }, async (page) => {
  const { folder } = copyOfSample("pack", "zz.m3d");
  const pictures = Array.from({ length: 250 }, (_, index) => `picture${index}.png`);
  for (const name of pictures) writeFileSync(join(folder, "pack", name), "none");
  await watchReads(page);
  const { outcome, model } = await dropAndWait(page, [join(folder, "pack")]);
  assert.equal(outcome, "load");
  assert.equal(model.path, "pack/zz.m3d");
  const reads = await page.evaluate(() => globalThis.reads);
  assert.deepEqual(reads.sort(), [...pictures, "zz.m3d"].sort());
});

test("of several models in one drop the largest opens", {}, async (page) => {
  const { folder, path } = copyOfSample("small.m3d");
  const large = join(folder, "large.m3d");
  writeFileSync(large, `${readFileSync(path, "utf8")}\n\n\n\n`);
  const { outcome, model } = await dropAndWait(page, [path, large]);
  assert.equal(outcome, "load");
  assert.equal(model.name, "large.m3d");
});

test("a drop before the viewer is there waits for it", {
  bare: true,
  prepare: (page) =>
    page.route("**/*_bg.wasm", async (route) => {
      await page.waitForFunction(() => globalThis.letWasmThrough);
      await route.continue();
    }),
}, async (page) => {
  const { path } = copyOfSample("early.m3d");
  await page.waitForFunction(() => globalThis.bindpose);
  await drop(page, [path]);
  await page.waitForFunction(() => /early\.m3d opens/.test(document.getElementById("progress-words").textContent));
  await keep(page, "shell-waiting");
  await page.evaluate(() => (globalThis.letWasmThrough = true));
  await until(page, ({ model }) => model !== null);
  assert.equal((await state(page)).model.name, "early.m3d", "not the sample");
});

test("the Open dialog gives its files", {}, async (page) => {
  const { path } = copyOfSample("chosen.m3d");
  await page.setInputFiles("#files", path);
  await until(page, ({ model }) => model?.name === "chosen.m3d");
});

test("a drop with Shift adds the clips of a model, and so does the dialog for clips", {}, async (page) => {
  const { path } = copyOfSample("more.m3d");
  const before = await state(page);
  const count = before.model.clips.length;
  const look = async () => {
    const words = await page.innerText("#drop-overlay");
    assert.match(words, /^Drop to add clips\s+1 item · its clips join those of figure\.m3d$/);
  };
  await drop(page, [path], { look, shift: true });
  const joined = await until(page, ({ model }) => model.clips.length > count);
  assert.equal(joined.model.name, "figure.m3d", "the model stays");
  assert.equal(joined.model.clips.length, 2 * count);
  await page.setInputFiles("#clips", path);
  const again = await until(page, ({ notices }) => notices.some(({ code }) => code === "clips-replaced"));
  assert.equal(again.model.clips.length, 2 * count, "the same file takes the places of its clips");
  assert.equal(again.error, null);
});

test("the same file again keeps the clip and the time", {}, async (page) => {
  const { path } = copyOfSample("again.m3d");
  const { model } = await dropAndWait(page, [path]);
  await call(page, "pause");
  await call(page, "selectClip", model.clips[1].name);
  await call(page, "seek", 0.3);
  await settled(page);
  const before = await picture(page);
  await dropAndWait(page, [path]);
  await settled(page);
  const after = await state(page);
  assert.equal(after.clip, model.clips[1].name);
  assert.ok(Math.abs(after.timeSecs - 0.3) < 1e-4, `${after.timeSecs}`);
  assert.ok(difference(before, await picture(page)) < 0.001);
});

test("R reads the files again as they are on disk now", {}, async (page) => {
  const { path } = copyOfSample("changing.m3d");
  const rewrite = (from, to) => writeFileSync(path, readFileSync(path, "latin1").replace(from, to), "latin1");
  await dropAndWait(page, [path]);
  await page.mouse.click(...GROUND);
  await settled(page);
  rewrite("AnimationClip Take1", "AnimationClip Stroll");
  await page.keyboard.press("r");
  await until(page, ({ model }) => model.clips[0].name === "Stroll");

  rewrite("#Bones 39", "#Bones many");
  await page.keyboard.press("r");
  const broken = await until(page, ({ error }) => error !== null);
  assert.match(JSON.stringify(broken.error), /changing\.m3d/);
  assert.equal(broken.model.clips[0].name, "Stroll", "the model that was open stays");

  rewrite("#Bones many", "#Bones 39");
  rewrite("AnimationClip Stroll", "AnimationClip March");
  await page.keyboard.press("r");
  const mended = await until(page, ({ model }) => model.clips[0].name === "March");
  assert.equal(mended.error, null);
});

test("R reads the sample again, and with a model the maps and clips that joined it later", {}, async (page) => {
  const loads = () => page.evaluate(() => globalThis.loads);
  await page.evaluate(() => {
    globalThis.loads = 0;
    bindpose.addEventListener("load", () => (loads += 1));
  });
  await page.mouse.click(...GROUND);
  await settled(page);
  await page.keyboard.press("r");
  await page.waitForFunction(() => loads === 1);
  assert.equal((await state(page)).model.name, "figure.m3d");

  const { folder, path } = copyOfSample("hero.m3d");
  writeFileSync(path, readFileSync(path, "latin1").replace(/^DiffuseMap:.*$/m, "DiffuseMap: late.png"), "latin1");
  const [clips, map] = [join(folder, "more.m3d"), join(folder, "late.png")];
  copyFileSync(SAMPLE, clips);
  copyFileSync(join(SAMPLE, "../figure_diff.png"), map);
  await dropAndWait(page, [path]);
  await drop(page, [map]);
  await until(page, ({ textures }) => !textures.missing.includes("late.png"));
  const own = (await state(page)).model.clips.length;
  await drop(page, [clips], { shift: true });
  const { model } = await until(page, ({ model }) => model.clips.length > own);
  const before = await loads();
  writeFileSync(clips, readFileSync(clips, "latin1").replace("AnimationClip Take1", "AnimationClip Stroll"), "latin1");
  await page.keyboard.press("r");
  const again = await until(page, ({ model }) => model.clips.some(({ name }) => name === "Stroll"));
  assert.equal(await loads(), before + 1, "the model was read too");
  assert.deepEqual([again.model.name, again.model.clips.length, again.error], ["hero.m3d", model.clips.length, null]);
  assert.ok(!again.textures.missing.includes("late.png"), "the map is there");
});

test("R tries again what was refused while its error is shown, and what is open when it is not", {}, async (page) => {
  const { folder, path } = copyOfSample("open.m3d");
  const rewrite = (file, from, to) => writeFileSync(file, readFileSync(file, "latin1").replace(from, to), "latin1");
  const press = async (key) => {
    await page.mouse.click(...GROUND);
    await settled(page);
    await page.keyboard.press(key);
  };
  await dropAndWait(page, [path]);
  const other = join(folder, "other.m3d");
  copyFileSync(SAMPLE, other);
  rewrite(other, "#Bones 39", "#Bones many");
  assert.equal((await dropAndWait(page, [other])).outcome, "error");
  // Its error sent away, what is open is what R is about.
  await press("Escape");
  await until(page, ({ error }) => error === null);
  rewrite(path, "AnimationClip Take1", "AnimationClip Stroll");
  await press("r");
  assert.equal((await until(page, ({ model }) => model.clips[0].name === "Stroll")).model.name, "open.m3d");
  // Clips that were refused are not asked for again.
  const less = join(folder, "less.m3d");
  copyFileSync(join(FIXTURES, "good/d3d12_skinned.m3d"), less);
  await drop(page, [less], { shift: true });
  await until(page, ({ error }) => error !== null);
  await press("Escape");
  await until(page, ({ error }) => error === null);
  rewrite(path, "AnimationClip Stroll", "AnimationClip March");
  await press("r");
  assert.equal((await until(page, ({ model }) => model.clips[0].name === "March")).error, null);
  // Mended on disk, what was refused opens.
  assert.equal((await dropAndWait(page, [other])).outcome, "error");
  rewrite(other, "#Bones many", "#Bones 39");
  await page.keyboard.press("r");
  assert.equal((await until(page, ({ model }) => model.name === "other.m3d")).error, null);
});

test("R opens again the model of a folder that was chosen", {}, async (page) => {
  const { folder, path } = copyOfSample("pack", "small.m3d");
  writeFileSync(join(folder, "pack", "large.m3d"), `${readFileSync(path, "utf8")}\n\n\n\n`);
  await dropAndWait(page, [join(folder, "pack")]);
  assert.equal((await state(page)).model.name, "large.m3d");
  await settled(page);
  await click(page, "models");
  await page.locator("[data-control=model-2]").waitFor({ state: "attached" });
  await settled(page);
  await click(page, "model-2");
  await until(page, ({ model }) => model.name === "small.m3d");
  writeFileSync(path, readFileSync(path, "latin1").replace("AnimationClip Take1", "AnimationClip Stroll"), "latin1");
  await page.mouse.click(...GROUND);
  await settled(page);
  await page.keyboard.press("r");
  assert.equal((await until(page, ({ model }) => model.clips[0].name === "Stroll")).model.name, "small.m3d");
});

test("R tells of a file from the dialog that has changed since", { expectErrors: true }, async (page) => {
  const { path } = copyOfSample("chosen.m3d");
  await page.setInputFiles("#files", path);
  await until(page, ({ model }) => model?.name === "chosen.m3d");
  writeFileSync(path, readFileSync(path, "latin1").replace("AnimationClip Take1", "AnimationClip Stroll or so"), "latin1");
  await page.mouse.click(...GROUND);
  await settled(page);
  await page.keyboard.press("r");
  await page.waitForSelector("#notice:not([hidden])");
  assert.match(await page.innerText("#notice"), /has to be chosen again/);
  assert.equal((await state(page)).model.clips[0].name, "Take1", "the model that was open stays");
});

test("maps are found beside the model and join it later, and are drawn", { draws: true }, async (page) => {
  const { folder, path } = copyOfSample("mapped.m3d");
  const plain = readFileSync(path, "utf8").replace(/^(DiffuseMap|NormalMap):.*$/gm, "$1: None");
  const named = plain.replace(/^DiffuseMap:.*$/m, "DiffuseMap: C:\\art\\Coat.dds");
  writeFileSync(path, named);
  const png = join(folder, "coat.png");
  await call(page, "pause");
  const bytes = await page.evaluate(async () => {
    const blob = await bindpose.snapshot({ width: 64, height: 64 });
    return [...new Uint8Array(await blob.arrayBuffer())];
  });
  writeFileSync(png, Buffer.from(bytes));

  await dropAndWait(page, [path]);
  await call(page, "pause");
  await call(page, "seek", 0.25);
  await settled(page);
  assert.deepEqual((await state(page)).textures, { named: 1, missing: ["C:\\art\\Coat.dds"], unreadable: [] });
  const without = await picture(page);
  await drop(page, [png]);
  await until(page, ({ textures }) => textures.missing.length === 0);
  await settled(page);
  const later = await picture(page);
  assert.ok(difference(without, later) > 0.02, "the map is drawn");
  assert.equal((await state(page)).error, null);
  await keep(page, "mapped");

  await dropAndWait(page, [SAMPLE]);
  await dropAndWait(page, [path, png]);
  await call(page, "pause");
  await call(page, "seek", 0.25);
  await settled(page);
  assert.ok(difference(later, await picture(page)) < 0.001, "at once is the same picture as later");
});

// The one that begins as glTF is no .m3d, but it opens.
const bad = [...filesIn(`${FIXTURES}bad/`, ".m3d"), ...filesIn(`${SHARED}reject/`, "d")].filter((path) => basename(path) !== "gltf.m3d");

test("a file that cannot be read shows its error and keeps the model", { viewport: LARGE }, async (page) => {
  assert.ok(bad.length > 0, "there are bad files to try");
  await call(page, "pause");
  await call(page, "seek", 0.25);
  await settled(page);
  const before = await picture(page);
  for (const path of bad) {
    const { outcome, model, error } = await dropAndWait(page, [path]);
    const name = basename(path);
    assert.equal(outcome, "error", name);
    assert.equal(model.name, "figure.m3d", name);
    assert.match(error.code, /^[a-z0-9-]+$/, name);
    assert.ok(error.message.length > 10, name);
    assert.ok(error.line == null || (error.line >= 1 && error.column >= 1), `${name}: ${JSON.stringify(error)}`);
  }
  await settled(page);
  await keep(page, "error-dark");
  await page.emulateMedia({ colorScheme: "light" });
  await settled(page);
  await keep(page, "error-light");
  await page.emulateMedia({ colorScheme: "dark" });
  await settled(page);
  assert.ok(difference(before, await picture(page)) < 0.001, "the old model stays as it was");
  const { outcome, error } = await dropAndWait(page, [SAMPLE]);
  assert.equal(outcome, "load");
  assert.equal(error, null, "the next load clears the error");
});

test("a drop with nothing useful in it is said so", {}, async (page) => {
  const folder = mkdtempSync(join(tmpdir(), "bindpose-"));
  mkdirSync(join(folder, "empty"));
  await drop(page, [join(folder, "empty")]);
  await page.waitForSelector("#notice:not([hidden])");
  assert.match(await page.textContent("#notice-words"), /no model/);
  await keep(page, "notice");
  await page.click("#notice-close");
  assert.equal(await page.isHidden("#notice"), true);
  assert.equal((await state(page)).model.name, "figure.m3d");
});

for (const model of ["d3d12/soldier", "d3d11/base", "d3d11/tree", "d3d11/rock", "d3d11/stairs", "imm/column"]) {
  const path = `${SHARED}models/${model}.m3d`;
  test(`the real file ${model} opens and is drawn`, { skip: unless(path), viewport: LARGE }, async (page) => {
    const { outcome, model: opened } = await dropAndWait(page, [path]);
    assert.equal(outcome, "load");
    assert.equal(opened.name, basename(path));
    assertDrawn(await picture(page));
    await call(page, "pause");
    await settled(page);
    await keep(page, `real-${basename(path, ".m3d")}`);
  });
}

test("programs open files and bytes in every form, also where a file has a method called bytes", {
  // As Firefox and Safari have it.
  prepare: (page) =>
    page.addInitScript(() => {
      Blob.prototype.bytes = async function () {
        return new Uint8Array(await this.arrayBuffer());
      };
    }),
}, async (page) => {
  const outcomes = await page.evaluate(async () => {
    const bytes = new Uint8Array(await (await fetch("web/sample/figure.m3d")).arrayBuffer());
    const padded = new Uint8Array(bytes.length + 2);
    padded.set(bytes, 1);
    const given = {
      File: new File([bytes], "file.m3d"),
      Uint8Array: { name: "view.m3d", bytes },
      part: { name: "part.m3d", bytes: padded.subarray(1, bytes.length + 1) },
      ArrayBuffer: { name: "buffer.m3d", bytes: bytes.buffer },
      Blob: { name: "blob.m3d", bytes: new Blob([bytes]) },
      words: { name: "words.m3d", bytes: "m3d" },
      nothing: { name: "nothing.m3d" },
      nameless: new Blob([bytes]),
    };
    const outcomes = {};
    for (const [form, file] of Object.entries(given)) {
      outcomes[form] = await bindpose.open([file]).then(({ model, error }) => error?.message ?? model.name, ({ message }) => message);
    }
    return outcomes;
  });
  assert.deepEqual(outcomes, {
    File: "file.m3d",
    Uint8Array: "view.m3d",
    part: "part.m3d",
    ArrayBuffer: "buffer.m3d",
    Blob: "blob.m3d",
    words: "words.m3d needs its bytes as Uint8Array, ArrayBuffer or Blob",
    nothing: "nothing.m3d needs its bytes as Uint8Array, ArrayBuffer or Blob",
    nameless: "a file to open is a File or {name, bytes}",
  });
});

test("what cannot be read or is too much is told in words, and a file of another kind is not read to its end", {}, async (page) => {
  const told = await page.evaluate(async () => {
    const pieces = [];
    const blob = (size, slice) => ({ size, slice, arrayBuffer: () => Promise.reject(new Error("not all at once")) });
    const open = (name, bytes) => bindpose.open([{ name, bytes }]).then(({ error }) => error?.message, ({ message }) => message);
    const film = new Blob([new Uint8Array([0x1a, 0x45, 0xdf, 0xa3, 0]), new Uint8Array(20 << 20).fill(7)]);
    const watched = blob(film.size, (from, until) => {
      pieces.push(until - from);
      return film.slice(from, until);
    });
    return {
      gone: await open("gone.m3d", blob(9, () => blob(9))),
      opening: bindpose.state().opening,
      much: await open("much.m3d", blob(600 << 20)),
      film: await open("film.m3d", watched),
      pieces,
    };
  });
  assert.equal(told.gone, "gone.m3d could not be read: not all at once");
  assert.equal(told.opening, null, "nothing is being opened any more");
  assert.equal(told.much, "These files have 600 MiB together; up to 512 MiB can be opened at once.");
  assert.match(told.film, /binary/);
  assert.deepEqual(told.pieces, [64 << 10]);
});
