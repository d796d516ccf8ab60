// Starts the viewer: fetches the wasm with its progress shown, starts it on the canvas, gives it what was dropped
// meanwhile, and starts it again when the GPU went away.

import { createApi } from "./api.js";
import { takeChoices, takeDrops } from "./drop.js";
import {
  clearNotice, showDownloadFailure, showGpuFailure, showGpuLoss, showNotice, showOldBrowser, showPanic, wordsOf,
} from "./fault.js";
import { freshly, rememberGiven } from "./given.js";
import { saveFile } from "./save.js";
import { runsProgram } from "./support.js";
import { letTabLeave, mirrorTransport, nameTextInput } from "./transport.js";

/** A GPU that goes away more often than this within the time below does not come back for good. */
const MAX_RESTARTS = 3;
const RESTARTS_FORGOTTEN_MS = 60_000;

/** The sample: the model, then its maps. Addresses may carry a hash, names never do. */
const SAMPLE = {
  "figure.m3d": "sample/figure.m3d",
  "suit_diff.png": "sample/suit_diff.png",
  "suit_norm.png": "sample/suit_norm.png",
  "trim_diff.png": "sample/trim_diff.png",
  "trim_norm.png": "sample/trim_norm.png",
  "rubber_diff.png": "sample/rubber_diff.png",
  "rubber_norm.png": "sample/rubber_norm.png",
  "visor_diff.png": "sample/visor_diff.png",
  "visor_norm.png": "sample/visor_norm.png",
};

const element = (id) => document.getElementById(id);
const view = element("view");
/** What the address asks for, before the `#` or after it. */
const options = new URLSearchParams(`${location.search.slice(1)}&${location.hash.slice(1)}`);
const { bindpose, wasUsed, give, attach, fail, hasFailed, emit } = createApi();
globalThis.bindpose = bindpose;

let viewer = null; // The wasm module's exports.
let gpu = null; // {backend, adapter} of the last start that worked.
let openName = ""; // Of the model that is open: what is dragged over the page asks for it many times a second.
let starts = 0; // Losses are told apart by the start that they belong to.
let restarts = [];
let restarting = false;
let lostMeanwhile = null; // Why the GPU went away again while a restart was under way.

/** Begins anew, as a visit of the page does, but without loading the program. Resolves with the state after it. */
bindpose.reset = async () => {
  clearNotice();
  given.forget();
  // What could not be fetched is told there; then nothing is open.
  const files = (await fetchOpening()) ?? [];
  await give(files, "startOver");
  bindpose.setRenderScale(addressedScale());
  return bindpose.state();
};

const refuse = (words) => showNotice("Some files could not be read", words);
const given = rememberGiven();
let received = false; // Whether a person gave anything, be it sound or not.
const receive = async (files, addsClips = false) => {
  clearNotice();
  received = true;
  if (!gpu) element("progress-words").textContent = `${files[0].name} opens as soon as the viewer is here`;
  await hand(files, addsClips);
};
/** Hands files of the person to the viewer, and remembers what became of them. */
const hand = async (files, addsClips) => {
  try {
    // Without a model to join, a file of clips is opened.
    await give(files, addsClips ? "addClips" : "open", (before, { error }) => given.add(files, addsClips && Boolean(before.model), !error));
  } catch (error) {
    refuse(wordsOf(error));
  }
};
const pick = takeChoices({ receive, refuse });
takeDrops({ receive, refuse, openModel: () => openName });
const refreshTransport = mirrorTransport(bindpose);
letTabLeave(view, () => !hasFailed() && Boolean(viewer?.escapeShuts()));
element("open-files").addEventListener("click", () => pick("files"));
element("open-folder").addEventListener("click", () => pick("folder"));
element("notice-close").addEventListener("click", clearNotice);

boot();

async function boot() {
  if (!runsProgram()) {
    fail(new Error("WebAssembly with SIMD is missing"));
    showOldBrowser();
    return;
  }
  const opensAtOnce = fetchOpening();
  try {
    viewer = await load();
  } catch (error) {
    fail(error);
    showDownloadFailure(error);
    return;
  }
  addEventListener("error", ({ error }) => error instanceof WebAssembly.RuntimeError && onPanic(wordsOf(error)));
  addEventListener("unhandledrejection", ({ reason }) => reason instanceof WebAssembly.RuntimeError && onPanic(wordsOf(reason)));
  // Also by a restart, when the GPU goes away during the first start.
  bindpose.ready.then(async () => {
    element("shell").classList.add("leaving");
    setTimeout(() => (element("shell").hidden = true), 200);
    const files = await opensAtOnce;
    if (files && !wasUsed() && !received) await give(files, "open").catch((error) => refuse(wordsOf(error)));
    refreshTransport();
  }, () => {});
  await start(wantedBackend()).catch((error) => {
    fail(error);
    showGpuFailure(error, wantedBackend());
  });
}

/** Fetches and compiles the program while it arrives. */
async function load() {
  const link = element("wasm");
  const [module, response] = await Promise.all([import("../pkg/bindpose.js"), fetch(link.href)]);
  if (!response.ok) throw new Error(`The server answered ${response.status} for ${link.href}`);
  const total = Number(link.dataset.bytes);
  let arrived = 0;
  const counted = response.body.pipeThrough(
    new TransformStream({
      transform(chunk, controller) {
        arrived += chunk.byteLength;
        showProgress(arrived, total);
        controller.enqueue(chunk);
      },
    }),
  );
  const headers = { "Content-Type": "application/wasm" };
  await module.default({ module_or_path: new Response(counted, { headers }) });
  return module;
}

function showProgress(arrived, total) {
  const part = total ? Math.min(arrived / total, 1) : 0;
  element("bar").setAttribute("aria-valuenow", Math.round(part * 100));
  element("bar-fill").style.transform = `scaleX(${part})`;
  if (!wasUsed() && !received) {
    const megabytes = (bytes) => (bytes / 1e6).toFixed(1);
    const words = part < 1 ? `Loading the viewer · ${megabytes(arrived)} of ${megabytes(total)} MB` : "Starting";
    element("progress-words").textContent = words;
  }
}

/** How fine the address asks the view to be drawn. */
function addressedScale() {
  return Number(options.get("scale") ?? 1);
}

function wantedBackend() {
  const named = options.get("backend");
  return ["webgpu", "webgl2"].includes(named) ? named : "auto";
}

/** Starts on the canvas of the page, which must never have been drawn on. What becomes of a start after which another one came is of no account. */
async function start(backend) {
  const canvas = element("canvas");
  const mine = ++starts;
  canvas.addEventListener("webglcontextlost", () => restart("the WebGL context was lost", mine), { once: true });
  try {
    const started = await viewer.start(canvas, { backend, renderScale: addressedScale() }, onEvent);
    if (mine !== starts) return;
    gpu = started;
  } catch (error) {
    if (mine !== starts) return;
    throw error;
  }
  nameTextInput(view);
  view.classList.add("drawn");
  attach(viewer);
}

/** The GPU went away: what is open lives on in the module, so a new canvas and a new start bring all of it back. */
async function restart(reason, of = starts) {
  if (of !== starts || hasFailed()) return;
  if (restarting) {
    lostMeanwhile = reason;
    return;
  }
  restarting = true;
  try {
    for (;;) {
      const now = performance.now();
      restarts = restarts.filter((at) => now - at < RESTARTS_FORGOTTEN_MS);
      if (restarts.length === MAX_RESTARTS) throw new Error(`The GPU went away ${MAX_RESTARTS} times: ${reason}`);
      restarts.push(now);
      viewer.stop();
      lostMeanwhile = null;
      // A canvas remembers the kind of its first context for ever.
      const old = element("canvas");
      const fresh = old.cloneNode(false);
      fresh.removeAttribute("style");
      const hadFocus = view.contains(document.activeElement);
      old.replaceWith(fresh);
      try {
        // The last try takes the plainer way, unless the address asks for one.
        const plainer = restarts.length === MAX_RESTARTS && wantedBackend() === "auto";
        await start(plainer ? "webgl2" : wantedBackend());
        if (hadFocus) fresh.focus();
        if (!lostMeanwhile) return;
        reason = lostMeanwhile;
      } catch (error) {
        reason = wordsOf(error);
        await new Promise((done) => setTimeout(done, 250 * restarts.length));
      }
    }
  } catch (error) {
    fail(error);
    showGpuLoss(error, gpu);
  } finally {
    restarting = false;
  }
}

function onEvent(type, detail) {
  if (type === "devicelost") return void restart(detail?.reason ?? "the device was lost");
  if (type === "panic") return onPanic(detail?.message ?? "");
  if (type === "pickfiles") return pick("files");
  if (type === "pickclips") return pick("clips");
  if (type === "readagain") return void readAgain();
  if (type === "picture") return saveFile(detail.name, detail.bytes, "image/png");
  if (type === "picturefailed") return showNotice("The picture could not be saved", detail.message);
  if (type === "load") {
    clearNotice();
    const name = (openName = detail?.name ?? "");
    document.title = name ? `${name} · Bindpose` : "Bindpose";
    element("spoken").textContent = name ? `${name} is open` : "";
  }
  if (type === "error") element("spoken").textContent = detail?.message ?? "";
  emit(type, detail);
}

/** Opens what is open once more, as it is on disk or on the server now; while an error is shown, what it is about. */
async function readAgain() {
  const refused = bindpose.state().error && given.refused();
  // What a script opened is the script's to open again.
  if (!refused && !given.hasModel() && wasUsed()) return;
  try {
    if (refused) return await hand(await freshly(refused.files), refused.addsClips);
    const { files, clips } = await given.readAgain(fetchOpening);
    if (files.length) await give(files, "open");
    if (clips.length) await give(clips, "addClips");
  } catch (error) {
    refuse(`${wordsOf(error)}\nA file that was changed after it was chosen in a dialog has to be chosen again.`);
  }
}

function onPanic(message) {
  fail(new Error(message));
  showPanic(message);
}

/** What the page opens by itself: the files that the address names, else the sample. */
async function fetchOpening() {
  const named = ["src", "tex"].flatMap((key) => options.getAll(key));
  try {
    if (named.length) return await Promise.all(named.map((address) => fetchFile(address, lastPart(address))));
    const [model, ...maps] = Object.entries(SAMPLE).map(([name, at]) => fetchFile(new URL(at, import.meta.url), name));
    // A figure without one of its maps is still a figure.
    const opened = await Promise.all([model, ...maps.map((map) => map.catch(() => null))]);
    return opened.filter(Boolean);
  } catch (error) {
    refuse(wordsOf(error));
    return null;
  }
}

async function fetchFile(address, name) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`The server answered ${response.status} for ${address}`);
  return { name, bytes: new Uint8Array(await response.arrayBuffer()) };
}

function lastPart(address) {
  return decodeURIComponent(new URL(address, location.href).pathname.split("/").pop());
}
