// A viewer for programs, as `globalThis.bindpose` is one. It is there before its viewer is: what is asked of it waits.

import { onlyJoins } from "./files.js";
import { recordOf } from "./sources.js";

/** The message of what was thrown, which need not be an `Error`. */
export function wordsOf(error) {
  return error?.message ?? String(error);
}

/** What `state()` says before there is a viewer to ask. */
const EMPTY = { backend: null, model: null, models: [], opening: null, timings: {}, clip: null, timeSecs: 0, playing: false, undo: null, redo: null, framesRendered: 0, notices: [], book: null, link: "", error: null };

/** A failure of the viewer itself, in the shape that `state().error` has for a file. */
const stopped = ({ message }) => ({ severity: "error", code: "viewer-stopped", message, expected: null, found: null, line: null, column: null, subject: null, count: 1, places: [], file: null });

/** Commands that are handed on to the viewer as they are; nothing is returned while there is none. */
const COMMANDS = [
  "seek", "play", "pause", "selectClip", "stepFrames", "nextKey", "previousKey", "seekStart", "seekEnd",
  "setRangeStart", "setRangeEnd", "clearRange", "setSpeed", "setLoop", "setWrap", "setPass", "setRenderScale", "setQuality", "setCrowd",
  "undo", "redo", "openModel", "closeModel", "boneToRoot",
];

/**
 * Makes the object that programs see, whose states say `linkText(state)` as their link (without it the viewer's own, which names no model), and what only the
 * page may do: `give(files, how)` for what a person opens, `attach(viewer)` when it runs, or another in its place, for which what is asked waits from `hold()` on,
 * `fail(error)` when it never will again, `emit(type, detail)`. After a failure the viewer is not called: `state().error` says why, promises are rejected.
 */
export function createApi(linkText = ({ link }) => link) {
  let viewer = null;
  let failure = null;
  let used = false;
  let resolve, reject;
  let opening = Promise.resolve(); // The last opening that others wait for.
  let current = new AbortController(); // Of the openings that no newer one has replaced.
  const pending = new Set(); // Rejects open promises when the viewer stops: it would never settle them.
  const bindpose = new EventTarget();
  const ready = new Promise((...settle) => ([resolve, reject] = settle));
  const emit = (type, detail) => bindpose.dispatchEvent(new CustomEvent(type, { detail }));
  // A failure that nobody waits for must not be reported as an unhandled rejection.
  ready.catch(() => {});
  let [held, isHeld, release] = [ready, false, resolve]; // Until there is a viewer, or another takes its place.
  /** The viewer once there is one: it may be another later. */
  const present = () => held.then(() => viewer);

  /** What a promise gives, or the viewer's failure, if that comes first. */
  const unlessStopped = (work) =>
    new Promise((done, fail) => {
      if (failure) return fail(failure);
      pending.add(fail);
      work.then(done, fail).finally(() => pending.delete(fail));
    });

  /** The bytes of a picture that the viewer draws, as a `Blob`. */
  const png = async (how, options) => {
    const running = await unlessStopped(present());
    return new Blob([await unlessStopped(running[how](options))], { type: "image/png" });
  };

  /**
   * Opens files, or adds their clips. What can bring a model replaces every opening before it that has not ended: those reject with an
   * `AbortError`. Clips and pictures wait for what was asked before them. `then(before, after)` hears of the states around it.
   */
  const give = (files, how, then = () => {}) => {
    // A FileList empties itself when its input is used again, so it is copied before anything waits.
    const copied = Array.from(files);
    if (how !== "addClips" && !onlyJoins(copied)) {
      current.abort(new DOMException("another opening came after this one", "AbortError"));
      current = new AbortController();
      opening = Promise.resolve();
    }
    const { signal } = current;
    const opened = opening.then(async () => {
      const records = copied.map(recordOf);
      const running = await unlessStopped(present());
      signal.throwIfAborted();
      const before = running.state();
      const after = await running[how](records);
      then(before, after);
      return after;
    });
    opening = opened.catch(() => {});
    const replaced = new Promise((_, fail) => signal.addEventListener("abort", () => fail(signal.reason)));
    const first = Promise.race([opened, replaced]);
    first.catch(() => {}); // Nobody hears of it once the viewer has stopped.
    return unlessStopped(first);
  };

  /** The same for programs. */
  const asked = (how) => (files) => {
    used = true;
    return give(files, how);
  };

  for (const name of COMMANDS) {
    bindpose[name] = (...values) => {
      if (viewer && !isHeld) return viewer[name](...values);
      if (!failure) present().then((running) => running?.[name](...values), () => {});
    };
  }

  Object.assign(bindpose, {
    ready,
    state() {
      const state = viewer?.state();
      return state ? { ...state, link: linkText(state) } : { ...EMPTY, error: failure && stopped(failure) };
    },

    /** Opens `File`s or `{name, bytes}` records, in place of what is being opened. Resolves with the state after it. */
    open: asked("open"),

    /** The same after what was asked before, but the clips of models with the same bones join those of the open one. */
    addClips: asked("addClips"),

    /** A picture of the current view: a PNG `Blob`, as large as the canvas unless told otherwise. */
    snapshot: (options = {}) => png("snapshot", options),

    /** Many pictures on one, through the clip or around the model, likewise. */
    contactSheet: (options = {}) => png("contactSheet", options),

    /** The model as a file of another format: `{name, bytes, changes, losses}`. */
    export: async (options = {}) => unlessStopped((await unlessStopped(present())).exportModel(options)),
  });

  return {
    bindpose,
    /** Whether a program asked to open anything. */
    wasUsed: () => used,
    give,
    attach(running) {
      if (failure) return;
      viewer = running;
      isHeld = false;
      release(running);
    },
    hold() {
      isHeld = true;
      held = new Promise((done) => (release = done));
    },
    /** The first failure stays: what follows are its echoes. */
    fail(error) {
      if (failure) return;
      failure = error;
      viewer = null;
      reject(error);
      for (const rejectPending of pending) rejectPending(error);
      emit("error", stopped(error));
    },
    hasFailed: () => failure !== null,
    emit,
  };
}
