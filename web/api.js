// `globalThis.bindpose`: the page for programs. It is there from the start; what is asked of it waits for the viewer.

/** What `state()` says before there is a viewer to ask. */
const EMPTY = { backend: null, model: null, clip: null, timeSecs: 0, playing: false, framesRendered: 0, notices: [], error: null };

/**
 * Makes the object that programs see, and beside it what only the page may do with it:
 * `give(files, how)` for what a person opens, `attach(viewer)` when the viewer runs, `fail(error)` when it never will again, `emit(type, detail)` for its events.
 */
export function createApi() {
  let viewer = null;
  let used = false;
  let resolve, reject;
  let opening = Promise.resolve();
  const bindpose = new EventTarget();
  const ready = new Promise((...settle) => ([resolve, reject] = settle));
  // Whoever waits for it hears of a failure; nobody has to wait.
  ready.catch(() => {});

  /** Opens files, or adds their clips, one call after the other. `then(before, after)` hears of the states around it. */
  const give = (files, how, then = () => {}) => {
    // A FileList empties itself when its input is used again, so it is copied before anything waits.
    const given = Array.from(files);
    const opened = opening.then(async () => {
      const records = await Promise.all(given.map(read));
      const running = await ready;
      const before = running.state();
      const after = running[how](records);
      then(before, after);
      return after;
    });
    opening = opened.catch(() => {});
    return opened;
  };

  /** The same for programs. */
  const asked = (how) => (files) => {
    used = true;
    return give(files, how);
  };

  /** Now, or as soon as the viewer runs. */
  const command = (name) => (...values) => {
    if (viewer) viewer[name](...values);
    else ready.then((running) => running[name](...values), () => {});
  };

  Object.assign(bindpose, {
    ready,
    state: () => viewer?.state() ?? { ...EMPTY },
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
      const canvas = document.querySelector("#view canvas");
      const size = { width: canvas.width, height: canvas.height, transparent: false };
      const png = await (await ready).snapshot({ ...size, ...options });
      return new Blob([png], { type: "image/png" });
    },
  });

  return {
    bindpose,
    /** Whether a program asked to open anything. */
    wasUsed: () => used,
    give,
    attach(running) {
      viewer = running;
      resolve(running);
    },
    fail(error) {
      viewer = null;
      reject(error);
    },
    emit: (type, detail) => bindpose.dispatchEvent(new CustomEvent(type, { detail })),
  };
}

/** Bytes with their relative path, from a `File`, a `{name, file}` of drop.js or a `{name, bytes}`. */
async function read(item) {
  if (item.bytes) return { name: item.name, bytes: item.bytes };
  const file = item.file ?? item;
  const name = item.file ? item.name : file.webkitRelativePath || file.name;
  try {
    return { name, bytes: new Uint8Array(await file.arrayBuffer()) };
  } catch (error) {
    throw new Error(`${name} could not be read: ${error.message}`, { cause: error });
  }
}
