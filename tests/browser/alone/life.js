// Scripts of the page alone, with stand-ins for the viewer and the browser: no GPU.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

/** The page's scripts are modules without a package that says so. */
const script = (name) => import(`data:text/javascript,${encodeURIComponent(readFileSync(new URL(`../../../web/${name}`, import.meta.url), "utf8"))}`);
const { keepOnCanvas } = await script("restart.js");
const { greeting, keep, kept } = await script("kept.js");

/**
 * A page whose GPU goes away `framesUntilLoss(start)` frames after the start of this number, `null` for one that lasts. A start begins to draw
 * once it has resolved, as on the page.
 */
function page(framesUntilLoss, { hidden = false, model = "heavy.m3d" } = {}) {
  const canvas = { parentElement: { contains: () => false }, cloneNode: () => canvas, removeAttribute() {}, replaceWith() {}, focus() {}, getRootNode: () => document };
  globalThis.document = { hidden, body: {}, activeElement: null };
  document.activeElement = document.body;
  const log = [];
  let onCanvas, frameCallbacks = [];
  globalThis.requestAnimationFrame = (callback) => frameCallbacks.push(callback);
  const frame = () => {
    const due = frameCallbacks;
    frameCallbacks = [];
    due.forEach((callback) => callback());
  };
  let starts = 0;
  const viewer = {
    stop() {},
    state: () => ({ framesRendered: 1, model }),
    async start() {
      starts += 1;
      log.push(model ? "with" : "without");
      return { backend: "webgl2", adapter: "stand-in" };
    },
  };
  const ended = new Promise((done) => {
    const next = async () => {
      const frames = framesUntilLoss(starts, model);
      if (frames === null) return done("lasts");
      // The start resolves before its frames come.
      await new Promise((then) => setImmediate(then));
      if (!hidden) for (let count = 0; count < frames; count += 1) frame();
      onCanvas.restart("the driver hung");
    };
    onCanvas = keepOnCanvas(viewer, {
      canvas,
      backend: "auto",
      isOver: () => false,
      onStart: () => void next(),
      onEnd: (error) => done(error.message),
      putAside() {
        const had = model !== null;
        log.push("put aside");
        model = null;
        return had;
      },
    });
    onCanvas.start();
  });
  return { log, ended };
}

test("a model with which no start lasts three frames is put aside, and the page goes on without it", async () => {
  const { log, ended } = page((_start, model) => (model ? 2 : null));
  assert.equal(await ended, "lasts");
  assert.deepEqual(log, ["with", "with", "with", "put aside", "without"]);
});

test("a GPU that does not last without a model either ends in words", async () => {
  const { log, ended } = page(() => 0);
  assert.match(await ended, /^The GPU went away 3 times in a row, as soon as something was drawn: the driver hung$/);
  assert.deepEqual(log, ["with", "with", "with", "put aside", "without", "without", "without", "put aside"]);
});

test("a GPU that goes away later comes back with the model, however often", async () => {
  const { log, ended } = page((start) => (start === 12 ? null : 3));
  assert.equal(await ended, "lasts");
  assert.deepEqual(log, new Array(12).fill("with"));
});

test("losses that are not in a row do not add up", async () => {
  const { log, ended } = page((start) => (start === 10 ? null : start % 3 === 0 ? 5 : 1));
  assert.equal(await ended, "lasts");
  assert.deepEqual(log, new Array(10).fill("with"));
});

test("the last try to get a lost GPU back takes another way to draw, where the program has one", async () => {
  const later = globalThis.setTimeout;
  globalThis.setTimeout = (work) => setImmediate(work);
  const asked = async (lastBackend) => {
    const canvas = { parentElement: { contains: () => false }, cloneNode: () => canvas, removeAttribute() {}, replaceWith() {}, getRootNode: () => document };
    globalThis.document = { activeElement: null };
    globalThis.requestAnimationFrame = () => {};
    const tried = [];
    const viewer = {
      stop() {},
      async start(_canvas, { backend }) {
        tried.push(backend);
        if (tried.length > 1) throw new Error("no device any more");
        return { backend: "webgpu", adapter: "stand-in" };
      },
    };
    const words = await new Promise((done) => {
      const onCanvas = keepOnCanvas(viewer, {
        canvas, backend: "auto", lastBackend, isOver: () => false, putAside: () => true,
        onStart: () => setImmediate(() => onCanvas.restart("the driver hung")),
        onEnd: ({ message }) => done(message),
      });
      onCanvas.start();
    });
    assert.equal(words, "The GPU did not come back in 6 starts: no device any more");
    return tried;
  };
  try {
    assert.deepEqual(await asked("webgl2"), [...new Array(6).fill("auto"), "webgl2"]);
    assert.deepEqual(await asked(undefined), new Array(7).fill("auto"));
  } finally {
    globalThis.setTimeout = later;
  }
});

test("in a hidden tab, where nothing is drawn, nothing is put aside", async () => {
  const { log, ended } = page((start) => (start === 6 ? null : 0), { hidden: true });
  assert.equal(await ended, "lasts");
  assert.deepEqual(log, new Array(6).fill("with"));
});

test("what is kept is there at the next visit, beside what another tab keeps", () => {
  const store = new Map();
  globalThis.localStorage = { getItem: (key) => store.get(key) ?? null, setItem: (key, text) => void store.set(key, text) };
  assert.deepEqual(kept(), {});
  keep({ theme: "light" });
  keep({ light: "book" });
  assert.deepEqual(kept(), { theme: "light", light: "book" });
  for (const text of ["", "nonsense", "null", "3", "[]"]) {
    store.set("bindpose.kept", text);
    assert.equal(kept().theme, undefined, text);
  }
  globalThis.localStorage = { getItem: () => { throw new Error("private"); }, setItem: () => { throw new Error("full"); } };
  keep({ theme: "light" });
  assert.deepEqual(kept(), {});
});

test("a visit begins with what was open, else once with what the page is for", () => {
  for (const [before, words] of [
    [{ open: "soldier.m3d", names: 3, greeted: true }, "soldier.m3d was open: drop it again; your 3 names are kept."],
    [{ open: "soldier.m3d", names: 1, greeted: true }, "soldier.m3d was open: drop it again; your 1 name is kept."],
    [{ open: "soldier.m3d", names: 0 }, "soldier.m3d was open: drop it again."],
    [{ open: null, greeted: true }, null],
  ]) {
    assert.equal(greeting(before), words);
  }
  assert.match(greeting({}), /drop a \.m3d, \.glb, \.fbx or a folder\. Files stay on this machine\.$/);
});
