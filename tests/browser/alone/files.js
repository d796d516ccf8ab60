// What comes in, without a browser: api.js, drop.js, sources.js and files.js against small stand-ins.

import assert from "node:assert/strict";
import { test } from "node:test";

import { createApi } from "../../../web/api.js";
import { takeChoices, takeDrops } from "../../../web/drop.js";
import { isUseful, onlyJoins, withoutNotes } from "../../../web/files.js";
import { rememberSources } from "../../../web/sources.js";

/** A file whose bytes are there when `come()` is called, or at once. */
function file(name, waits = false) {
  let come = () => {};
  const there = waits ? new Promise((done) => (come = done)) : Promise.resolve();
  return { name, come, arrayBuffer: () => there.then(() => new ArrayBuffer(1)) };
}

/** A viewer that reads and opens what it is given, unless something else was given meanwhile; the last part of `opened` is on screen. */
function viewerOf(opened = []) {
  let given = 0;
  const state = () => ({ model: opened.length ? { name: opened.at(-1), opening: opened.length } : null, error: null });
  const open = async (records) => {
    const mine = ++given;
    await Promise.all(records.map(({ bytes }) => bytes.arrayBuffer()));
    if (mine !== given) throw new DOMException("overtaken", "AbortError");
    opened.push(records[0].name);
    return state();
  };
  return { opened, state, open, addClips: open, undo: () => true, selectClip: (name) => name === "Walk" };
}

const outcome = (promise) => promise.then(() => "opened", ({ name, message }) => `${name}: ${message}`);
const REPLACED = "AbortError: another opening came after this one";
const soon = () => new Promise((done) => setTimeout(done, 5));

test("a later open overtakes one that is still read, which ends at once", async () => {
  const { bindpose, attach } = createApi();
  const viewer = viewerOf();
  attach(viewer);
  const big = file("big.m3d", true);
  const first = outcome(bindpose.open([big]));
  const clips = outcome(bindpose.addClips([file("walk.m3d")]));
  const last = outcome(bindpose.open([file("small.m3d")]));
  assert.deepEqual(await Promise.all([first, clips, last]), [REPLACED, REPLACED, "opened"]);
  big.come();
  await soon();
  assert.deepEqual(viewer.opened, ["small.m3d"], "what was overtaken never opens");
});

test("clips and pictures wait for the model that was asked for before them", async () => {
  const { bindpose, attach } = createApi();
  const viewer = viewerOf();
  attach(viewer);
  const big = file("big.m3d", true);
  const all = [bindpose.open([big]), bindpose.addClips([file("walk.m3d")]), bindpose.open([file("skin.PNG"), file("sky.dds")])];
  await soon();
  assert.deepEqual(viewer.opened, []);
  big.come();
  assert.deepEqual(await Promise.all(all.map(outcome)), ["opened", "opened", "opened"]);
  assert.deepEqual(viewer.opened, ["big.m3d", "walk.m3d", "skin.PNG"]);
});

test("an opening that failed holds up nothing, and the first of two before the viewer is there gives way", async () => {
  const { bindpose, attach } = createApi();
  const early = outcome(bindpose.open([file("early.m3d")]));
  const late = outcome(bindpose.open([file("late.m3d")]));
  const viewer = viewerOf();
  attach(viewer);
  assert.deepEqual(await Promise.all([early, late]), [REPLACED, "opened"]);
  const broken = { name: "gone.m3d", arrayBuffer: () => Promise.reject(new Error("it was moved")) };
  assert.equal(await outcome(bindpose.open([broken])), "Error: it was moved");
  assert.equal(await outcome(bindpose.addClips([file("walk.m3d")])), "opened");
  assert.deepEqual(viewer.opened, ["late.m3d", "walk.m3d"]);
});

test("commands return what the viewer returns", () => {
  const { bindpose, attach } = createApi();
  assert.equal(bindpose.undo(), undefined, "there is no viewer yet");
  attach(viewerOf());
  assert.deepEqual([bindpose.undo(), bindpose.selectClip("Walk"), bindpose.selectClip("Run")], [true, true, false]);
});

/** An entry of a drop: a file, or a folder of entries that can be listed once `come()` was called. */
const fileEntry = (path) => ({ name: path.split("/").pop(), fullPath: `/${path}`, isDirectory: false, file: (done) => done(file(path)) });
function folderEntry(path, entries) {
  let come;
  const there = new Promise((done) => (come = done));
  const batches = [entries, []];
  const createReader = () => ({ readEntries: (done) => there.then(() => done(batches.shift())) });
  return { name: path, fullPath: `/${path}`, isDirectory: true, createReader, come };
}

/** Drops entries on an area and gives what it told. */
function dropArea() {
  const listeners = {};
  const told = [];
  takeDrops({ addEventListener: (type, listener) => (listeners[type] = listener) }, {
    receive: (files, addsClips) => told.push([files.map(({ name }) => name).join(), addsClips]),
    refuse: (words) => told.push(["refused", words]),
    gaveWay: (name) => told.push(["gave way", name]),
    openModel: () => "",
    show: () => {},
  });
  const drop = (entries, shiftKey = false) =>
    listeners.drop({
      dataTransfer: { types: ["Files"], items: entries.map((entry) => ({ kind: "file", webkitGetAsEntry: () => entry })), files: [] },
      shiftKey,
      preventDefault() {},
      stopImmediatePropagation() {},
    });
  return { drop, told };
}

test("a folder that is listed after a newer drop was received gives way", async () => {
  const { drop, told } = dropArea();
  const folder = folderEntry("big", [fileEntry("big/old.m3d")]);
  const slow = drop([folder]);
  await drop([fileEntry("new.m3d")]);
  folder.come();
  await slow;
  assert.deepEqual(told, [["new.m3d", false], ["gave way", "big"]]);
});

test("pictures, clips and nothing that are dropped meanwhile replace no folder", async () => {
  const { drop, told } = dropArea();
  const folder = folderEntry("big", [fileEntry("big/old.m3d")]);
  const slow = drop([folder]);
  await drop([fileEntry("skin.png")]);
  await drop([fileEntry("walk.glb")], true);
  const empty = folderEntry("empty", []);
  empty.come();
  await drop([empty]);
  folder.come();
  await slow;
  const nothing = ["refused", "There is no model and no picture in what was dropped."];
  assert.deepEqual(told, [["skin.png", false], ["walk.glb", true], nothing, ["big/old.m3d", false]]);
});

test("of a folder archives, what cannot be read yet and texts that may be models arrive too, and nothing else", async () => {
  const { drop, told } = dropArea();
  const names = ["pack.zip", "notes.txt", "studio.HDR", "a.gltf", "a.bin", "skin.jpeg", "sky.exr", "scene.blend"];
  const folder = folderEntry("big", names.map((name) => fileEntry(`big/${name}`)));
  folder.come();
  await drop([folder]);
  assert.deepEqual(told, [["big/pack.zip,big/notes.txt,big/studio.HDR,big/a.gltf,big/a.bin,big/skin.jpeg,big/sky.exr", false]]);
  assert.deepEqual(["m3d", "a.m3d.txt", ".zip", "x/y.zip"].map(isUseful), [false, true, true, true]);
  const left = (...names) => withoutNotes(names.map((name) => ({ name }))).map(({ name }) => name).join();
  assert.deepEqual([left("a/b.txt", "a/c.png"), left("b.txt", "a/c.png"), left("a/b.txt"), left("a/b.txt", "a/c.png", "a/d.m3d")], ["a/c.png", "b.txt,a/c.png", "a/b.txt", "a/b.txt,a/c.png,a/d.m3d"]);
  assert.deepEqual([[], [file("a.png")], [file("a.png"), file("b.zip")]].map(onlyJoins), [false, true, false]);
});

test("the dialog for clips offers models, archives and buffers, and the one for any file offers all", () => {
  const inputs = Object.fromEntries(["files", "folder", "clips"].map((name) => [name, { addEventListener() {} }]));
  takeChoices(inputs, { receive() {}, refuse() {} });
  assert.deepEqual([inputs.files.accept, inputs.clips.accept], [undefined, ".m3d,.glb,.gltf,.fbx,.zip,.bin"]);
});

/** States around an opening: the number of the opening that brought the model, or null, and an error. */
const at = (opening, error = null) => ({ model: opening === null ? null : { opening }, error });
const record = (name) => ({ name, file: name });
const names = (files) => files.map(({ name }) => name).join();
const again = async (sources, opening) => {
  const { files, clips } = await sources.again(at(opening), async () => [record("figure.m3d")]);
  return [names(files), names(clips)];
};

test("R reads what the viewer took for a model, whatever its name, and pictures in an archive stay beside it", async () => {
  const sources = rememberSources();
  sources.add([record("soldier.txt")], false, at(1), at(2));
  sources.add([record("maps.zip")], false, at(2), at(2));
  sources.add([record("walk.gltf"), record("walk.bin")], true, at(2), at(2));
  assert.deepEqual(await again(sources, 2), ["soldier.txt,maps.zip", "walk.gltf,walk.bin"]);
  sources.add([record("maps.zip")], false, at(2), at(2));
  assert.deepEqual(await again(sources, 2), ["soldier.txt,maps.zip", "walk.gltf,walk.bin"], "once each");
  sources.move(at(2), at(3));
  assert.deepEqual(await again(sources, 3), ["soldier.txt,maps.zip", "walk.gltf,walk.bin"], "read again, it is another opening");
});

test("R reads what belongs to the model on screen, also one of the list", async () => {
  const sources = rememberSources();
  sources.add([record("skin.png")], false, at(1), at(1));
  assert.deepEqual([await again(sources, 1), sources.hasModel(at(1))], [["figure.m3d,skin.png", ""], false]);
  sources.add([record("a.m3d")], false, at(1), at(2));
  sources.add([record("b.zip")], true, at(null), at(3));
  assert.deepEqual([await again(sources, 2), await again(sources, 3)], [["a.m3d", ""], ["b.zip", ""]]);
  assert.deepEqual([sources.hasModel(at(2)), sources.hasModel(at(9))], [true, false]);
});

test("what was refused is read again by itself, and forgotten with the next that opens", () => {
  const sources = rememberSources();
  sources.add([record("bad.m3d")], false, at(1), at(1, {}));
  assert.deepEqual(sources.refused(), { files: [record("bad.m3d")], addsClips: false });
  sources.add([record("good.m3d")], false, at(1), at(2));
  assert.equal(sources.refused(), null);
  assert.deepEqual(sources.hasModel(at(1)), false);
});
