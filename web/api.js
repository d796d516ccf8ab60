// `globalThis.bindpose`: the page for programs. It is there from the start; what is asked of it waits for the viewer.

/** What `state()` says before there is a viewer to ask. */
const EMPTY = { backend: null, model: null, clip: null, timeSecs: 0, playing: false, framesRendered: 0, notices: [], error: null };

/** A failure of the viewer itself, in the shape that `state().error` has for a file. */
const stopped = ({ message }) => ({ severity: "error", code: "viewer-stopped", message, expected: null, found: null, line: null, column: null, file: null });

/**
 * Makes the object that programs see, and beside it what only the page may do with it:
 * `give(files, how)` for what a person opens, `attach(viewer)` when the viewer runs, `fail(error)` when it never will again, `emit(type, detail)` for its events.
 *
 * Once it has failed, the viewer is not called again: `state().error` says why, promises are rejected, and commands do nothing.
 */
export function createApi() {
  let viewer = null;
  let failure = null;
  let used = false;
  let resolve, reject;
  let opening = Promise.resolve();
  const pending = new Set(); // What rejects the promises that were given out: a viewer that stopped settles none of them.
  const bindpose = new EventTarget();
  const ready = new Promise((...settle) => ([resolve, reject] = settle));
  const emit = (type, detail) => bindpose.dispatchEvent(new CustomEvent(type, { detail }));
  // Whoever waits for it hears of a failure; nobody has to wait.
  ready.catch(() => {});

  /** What a promise gives, or the viewer's failure, if that comes first. */
  const unlessStopped = (work) =>
    new Promise((done, fail) => {
      if (failure) return fail(failure);
      pending.add(fail);
      work.then(done, fail).finally(() => pending.delete(fail));
    });

  /** Opens files, or adds their clips, one call after the other. `then(before, after)` hears of the states around it. */
  const give = (files, how, then = () => {}) => {
    // A FileList empties itself when its input is used again, so it is copied before anything waits.
    const given = Array.from(files);
    const opened = opening.then(async () => {
      const records = await Promise.all(given.map(read));
      const running = await unlessStopped(ready);
      const before = running.state();
      const after = running[how](records);
      then(before, after);
      return after;
    });
    opening = opened.catch(() => {});
    return unlessStopped(opened);
  };

  /** The same for programs. */
  const asked = (how) => (files) => {
    used = true;
    return give(files, how);
  };

  /** Now, or as soon as the viewer runs. */
  const command = (name) => (...values) => {
    if (viewer) viewer[name](...values);
    else if (!failure) ready.then(() => viewer?.[name](...values), () => {});
  };

  Object.assign(bindpose, {
    ready,
    state: () => viewer?.state() ?? { ...EMPTY, error: failure && stopped(failure) },
    seek: command("seek"),
    play: command("play"),
    pause: command("pause"),
    selectClip: command("selectClip"),
    stepFrames: command("stepFrames"),
    nextKey: command("nextKey"),
    previousKey: command("previousKey"),
    seekStart: command("seekStart"),
    seekEnd: command("seekEnd"),
    setRangeStart: command("setRangeStart"),
    setRangeEnd: command("setRangeEnd"),
    clearRange: command("clearRange"),
    setSpeed: command("setSpeed"),
    setLoop: command("setLoop"),
    setWrap: command("setWrap"),
    setPass: command("setPass"),
    setRenderScale: command("setRenderScale"),

    /** Opens `File`s or `{name, bytes}` records, one call after the other. Resolves with the state after it. */
    open: asked("open"),

    /** The same, but the clips of models with the same bones join those of the open one. */
    addClips: asked("addClips"),

    /** A picture of the current view: a PNG `Blob`, as large as the canvas unless told otherwise. */
    async snapshot(options = {}) {
      const running = await unlessStopped(ready);
      const { width, height } = document.querySelector("#view canvas");
      const png = await unlessStopped(running.snapshot({ width, height, transparent: false, ...options }));
      return new Blob([png], { type: "image/png" });
    },
  });

  return {
    bindpose,
    /** Whether a program asked to open anything. */
    wasUsed: () => used,
    give,
    attach(running) {
      if (failure) return;
      viewer = running;
      resolve(running);
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

/** Whether it is a `Blob` or a `File`, be it of another window. */
const isBlob = (item) => typeof item?.arrayBuffer === "function";

/** Bytes with their relative path, from a `File`, a `{name, file}` of drop.js or a `{name, bytes}`. */
async function read(item) {
  const name = item?.webkitRelativePath || item?.name;
  if (typeof name !== "string") throw new TypeError("a file to open is a File or {name, bytes}");
  // A `File` may have a method called `bytes`.
  const bytes = isBlob(item) ? item : item.bytes ?? item.file;
  if (ArrayBuffer.isView(bytes)) return { name, bytes: new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength) };
  if (bytes instanceof ArrayBuffer) return { name, bytes: new Uint8Array(bytes) };
  if (!isBlob(bytes)) throw new TypeError(`${name} needs its bytes as Uint8Array, ArrayBuffer or Blob`);
  try {
    return { name, bytes: new Uint8Array(await bytes.arrayBuffer()) };
  } catch (error) {
    throw new Error(`${name} could not be read: ${error.message}`, { cause: error });
  }
}
