// The page: its elements, and the one viewer on it. Starts the viewer on the canvas, hands it what the person opens, and shows what it cannot
// say itself.

import { createApi, wordsOf } from "./api.js";
import { watchBattery, watchDisplay } from "./device.js";
import { takeChoices, takeDrops } from "./drop.js";
import {
  clearNotice, showDownloadFailure, showGpuFailure, showGpuLoss, showNotice, showOldBrowser, showPanic, showPutAside,
} from "./fault.js";
import { greeting, keep, kept } from "./kept.js";
import { letScroll } from "./guest.js";
import { handOver } from "./handing_over.js";
import { embedding, keepLink } from "./link.js";
import { mirrorOf } from "./mirror.js";
import { keepPage, takeLaunches } from "./offline.js";
import { printView } from "./printing.js";
import { backend, compile, fetchProgram, first, options } from "./program.js";
import { keepDrawn } from "./restart.js";
import { saveFile, savePicture } from "./saving.js";
import { decoded, fetchFrom, fetchOwn, readAgain, rememberSources } from "./sources.js";

/** The sample: the model, then its maps. Addresses may carry a hash, names never do. */
const SAMPLE = {
  "figure.m3d": "sample/figure.m3d",
  "figure_diff.png": "sample/figure_diff.png",
  "figure_norm.png": "sample/figure_norm.png",
};

/** "\0asm", version 1, and the type of a function that gives a vector of 128 bits: the least that needs SIMD. */
const SIMD_PROGRAM = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123];

/** A region that speaks is empty for so long before other words come. */
const SPOKEN_AFTER_MS = 60;

const element = (id) => document.getElementById(id);
const view = element("view");
const { bindpose, wasUsed, give, hold, attach, fail, hasFailed, emit } = createApi(() => link.text());
globalThis.bindpose = bindpose;

/** Whether the page lies in another one, as "Copy embed" has it: the viewer has no panels there, and says nothing itself. */
const isFramed = ["transport", "none"].includes(options.get("ui"));
if (isFramed && parent !== window) {
  letScroll(view);
  [document.documentElement, document.body].forEach(({ classList }) => classList.add("framed"));
  const whole = element("whole");
  whole.hidden = options.get("ui") === "none";
  whole.onfocus = whole.onclick = whole.onpointerdown = () => {
    const address = new URL(bindpose.link());
    address.searchParams.delete("ui");
    whole.href = address.href;
  };
}

let viewer = null;
let onCanvas = null; // Starts and restarts the viewer on the page's canvas.
let openName = ""; // Of the open model: a drag reads it many times a second.
let mirror = null; // The viewer's controls as elements, of its present canvas.
let gpuWasLost = false;
let handed = 0; // How often the person gave something.
let handing = 0; // How much of it is being opened.
let replaced = []; // Names of what was dropped before something else, and gave way to it.
let received = false; // Whether the person opened anything, readable or not.
const sources = rememberSources();
const programs = []; // The names of those that this visit took.
let choices = null; // Of the person, as they were when the visit began.

const link = keepLink({
  viewer: () => (hasFailed() ? null : viewer),
  changed: (text) => emit("linkchange", { link: text }),
  // A link's values are not the person's choices.
  follow(view) {
    clearNotice(); // It may be about the link before.
    keepVisit();
    const leftOut = viewer.followLink(view);
    choices = choicesNow();
    return leftOut;
  },
  ask(words) {
    if (isFramed) return words ? tellOf(words) : clearNotice();
    viewer.greet(words ?? undefined);
    if (words) say(words);
  },
  tell: (words) => tellOf(words),
  refuse: (names, words) => showNotice("The link is not shown in full", `${words ? `${words}. ` : ""}Left out, since they are damaged, newer than this page or not of this model: ${names.map((name) => name || "a field without a name").join(", ")}`),
});

/** A link to what is seen: the whole address. */
bindpose.link = () => link.whole().address;

/** Resets the page to how a visit begins, without loading the program again. Resolves with the new state. */
bindpose.reset = async () => {
  clearNotice();
  sources.forget();
  // fetchOpening() reports what it could not fetch. Then nothing is opened.
  const files = (await fetchOpening()) ?? [];
  await link.opens(give(files, "startOver"));
  bindpose.setRenderScale(addressedScale());
  bindpose.setQuality(addressedQuality(), { samples: addressedSamples() });
  bindpose.setCrowd(addressedCrowd());
  return bindpose.state();
};

const tellOf = (words) => showNotice("About this link", words, false);
const refuse = (words) => showNotice("Some files could not be read", words);
const refusePicture = (words) => showNotice("The picture could not be saved", words);
/** Tells of a failed opening, but not of one that gave way to another. */
const refuseError = (error) => error.name === "AbortError" || refuse(wordsOf(error));

/** Has a screen reader speak. Words are put in anew, since the same ones are not spoken again; what comes close together is spoken together. */
const say = (words, region = "spoken") => {
  const { textContent: spoken, dataset } = element(region);
  if (dataset.next === undefined) {
    if (spoken) element(region).textContent = "";
    setTimeout(() => {
      element(region).textContent = dataset.next;
      delete dataset.next;
    }, SPOKEN_AFTER_MS);
  }
  dataset.next = [dataset.next, words].filter(Boolean).join(" ");
};
const focusView = () => view.querySelector("canvas").focus();

const receive = async (files, addsClips = false) => {
  clearNotice();
  received = true;
  if (viewer && !hasFailed()) viewer.greet();
  keep({ greeted: true });
  if (!bindpose.state().backend) {
    const words = `${files[0].name} opens as soon as the viewer is here`;
    element("progress-words").textContent = words;
    say(`${words}.`);
  }
  await hand(files, addsClips);
};

/** Opens the person's files in the viewer, and remembers them for R. */
const hand = async (files, addsClips) => {
  const { name } = files[0];
  const mine = ++handed;
  handing += 1;
  try {
    await give(files, addsClips ? "addClips" : "open", (before, after) => sources.add(files, addsClips, before, after));
    replaced = replaced.filter((other) => other !== name);
  } catch (error) {
    // What the person gave up needs no words.
    if (error.name === "AbortError") mine !== handed && replaced.push(name);
    else refuse(wordsOf(error));
  }
  handing -= 1;
  tellReplaced();
};

/** Names what was dropped and never opened, once all that came after it is. */
const tellReplaced = () => {
  if (handing || !replaced.length) return;
  showNotice(`Not opened: ${replaced.join(", ")}`, "Something else was dropped after it, and opens in its place.");
  replaced = [];
};

/** Hears of a dropped folder that came too late. */
const gaveWay = (name) => {
  replaced.push(name);
  tellReplaced();
};

const pick = takeChoices({ files: element("files"), folder: element("folder"), clips: element("clips") }, { receive, refuse });
// The page has one viewer, so all of it is the viewer's.
takeDrops(globalThis, { receive, refuse, gaveWay, openModel: () => openName, show: showDrop });
takeLaunches(receive, refuse);
takeUnclaimedKeys();
printView(bindpose, () => view.querySelector("canvas"));
element("open-files").addEventListener("click", () => pick("files"));
element("open-folder").addEventListener("click", () => pick("folder"));
element("notice-close").addEventListener("click", clearNotice);

boot();

async function boot() {
  if (!(typeof WebAssembly === "object" && WebAssembly.validate(new Uint8Array(SIMD_PROGRAM)))) {
    fail(new Error("WebAssembly with SIMD is missing"));
    showOldBrowser();
    return;
  }
  const program = load(first);
  // Pictures of the sample wait until the program is here: on a slow line they would take its place.
  const opensAtOnce = fetchOpening(program.catch(() => {}));
  const displaySecs = watchDisplay();
  addEventListener("error", ({ error }) => onPanic(error));
  addEventListener("unhandledrejection", ({ reason }) => onPanic(reason));
  addEventListener("hashchange", () => link.hashChanged());
  addEventListener("storage", ({ key }) => key?.startsWith("bindpose.names.") && !hasFailed() && viewer?.readNames());
  addEventListener("pagehide", keepVisit);
  addEventListener("visibilitychange", keepVisit);
  // A restart comes here too, when the GPU goes away during the first start.
  bindpose.ready.then(async () => {
    greet();
    link.follow();
    hideShell();
    const files = await opensAtOnce;
    if (!files || wasUsed() || received) return;
    // A crowd is of what is open.
    const opened = link.opens(give(files, "open"));
    await opened.then(() => {
      bindpose.setCrowd(addressedCrowd());
      link.follow();
    }, refuseError);
  }, () => {});
  await start(program, displaySecs);
}

/** Starts a viewer of a program on the page's canvas, and has another go on where its GPU is lost for good. What is asked of it meanwhile waits. */
async function start(program, displaySecs) {
  let before; // What was open in the viewer that gave way.
  try {
    await keepDrawn(program, backend, {
      async make(program) {
        const { name, module } = await program;
        viewer = new module.Viewer({ ...kept(), renderScale: addressedScale(), quality: addressedQuality(), samples: addressedSamples(), ui: options.get("ui") ?? undefined, displaySecs: displaySecs() }, onEvent);
        programs.push(name);
        watchBattery(viewer);
        choices = choicesNow();
        return { viewer, canvas: element("canvas"), isFull: name === "full" };
      },
      full() {
        keepVisit();
        return load(fetchProgram("full"));
      },
      keep: (keeper) => (onCanvas = keeper),
      onStart() {
        if (gpuWasLost) say("The graphics are back.");
        gpuWasLost = false;
        view.classList.add("drawn");
      },
      onEnd(error, gpu) {
        keepVisit();
        fail(error);
        showGpuLoss(error, gpu);
      },
      hold,
      attach,
      bring(from, to) {
        before = from.state();
        return handOver(from, to);
      },
      onBrought(error) {
        sources.move(before, viewer.state());
        keepPage(programs, say);
        viewer.tell(`WebGPU went away: drawn with WebGL2 from here on${error ? ", without a part of what was open" : ""}`);
      },
      putAside,
      isOver: hasFailed,
    });
    keepPage(programs, say);
  } catch (error) {
    fail(error);
    if (error.isOfDownload) showDownloadFailure(error);
    else showGpuFailure(error, backend);
  }
}

/** Tells somebody who has opened nothing yet what the page is for, or what was open at the last visit. */
function greet() {
  const words = received || wasUsed() ? null : greeting();
  if (!words) return;
  viewer.greet(words);
  say(words);
}

/** Closes the model with which the GPU went away again and again. Returns whether there was one. */
function putAside() {
  const { model } = viewer.state();
  if (!model) return false;
  viewer.startOver([]);
  sources.forget();
  showPutAside(model.name);
  return true;
}

/** Keys go to the viewer while nothing has the focus; it gets the focus by the first that it acts on. */
function takeUnclaimedKeys() {
  addEventListener("keydown", (event) => {
    if (event.target !== document.body || event.key === "Tab" || !onCanvas || hasFailed()) return;
    const canvas = view.querySelector("canvas");
    canvas.focus({ preventScroll: true });
    const { key, code, location, repeat, ctrlKey, shiftKey, altKey, metaKey } = event;
    const again = new KeyboardEvent("keydown", { key, code, location, repeat, ctrlKey, shiftKey, altKey, metaKey, cancelable: true });
    if (canvas.dispatchEvent(again)) canvas.blur();
    else event.preventDefault();
  });
}

async function load(fetching) {
  try {
    return await compile(await fetching, showProgress);
  } catch (error) {
    throw Object.assign(error, { isOfDownload: true });
  }
}

function showProgress(arrived, total) {
  const part = Math.min(arrived / total, 1);
  element("bar").setAttribute("aria-valuenow", Math.round(part * 100));
  element("bar-fill").style.transform = `scaleX(${part})`;
  if (!wasUsed() && !received) {
    const megabytes = (bytes) => (bytes / 1e6).toFixed(1);
    const words = part < 1 ? `Loading the viewer · ${megabytes(arrived)} of ${megabytes(total)} MB` : "Starting";
    element("progress-words").textContent = words;
  }
}

function hideShell() {
  const shell = element("shell");
  shell.classList.add("leaving");
  // The button that has the focus is about to be hidden.
  if (shell.contains(shell.getRootNode().activeElement)) focusView();
  setTimeout(() => (shell.hidden = true), 200);
}

/** Says what a drop would do; `null` when nothing is dragged over the page. */
function showDrop(words) {
  element("drop-overlay").hidden = !words;
  if (!words) return;
  element("drop-title").textContent = words.title;
  element("drop-what").textContent = words.what;
}

/** What the address asks for. */
function addressedScale() {
  const scale = Number(options.get("scale"));
  return scale > 0 && scale < Infinity ? scale : 1;
}

function addressedQuality() {
  return options.get("quality") ?? kept().quality ?? "auto";
}

function addressedSamples() {
  return Math.max(0, options.get("samples") | 0);
}

function addressedCrowd() {
  const whole = (text) => (/^\d{1,10}$/.test(text) && Number(text) < 2 ** 32 ? Number(text) : undefined);
  const [count, seed] = ["crowd", "seed"].map((key) => whole(options.get(key)));
  return { count, seed };
}

function onEvent(type, detail) {
  if (hasFailed()) return;
  if (type === "mirror") return showMirror(detail);
  if (type === "announce") return sayUnlessHeard(detail);
  if (type === "devicelost") {
    gpuWasLost = true;
    say("The graphics went away and are started again.", "alarm");
    return void onCanvas.restart(detail.reason);
  }
  if (type === "settling") return link.settling();
  if (type === "moving") return link.moving();
  if (type === "copylink") return void copyLink(detail.embed);
  if (type === "pickfiles") return pick("files");
  if (type === "pickclips") return pick("clips");
  if (type === "readagain") return void readSourcesAgain();
  if (type === "greetingclosed") return keep({ greeted: true, open: null });
  if (type === "picture") return void savePicture(detail, refusePicture);
  if (type === "save") return saveFile(detail.name, detail.contents, detail.type);
  if (type === "explain") return void open("web/codes.html#" + detail.code, "_blank", "noopener");
  if (type === "picturefailed") return refusePicture(detail.message);
  if (type === "load") {
    clearNotice();
    const name = (openName = detail?.name ?? "");
    document.title = name ? `${name} · Bindpose` : "Bindpose";
    void link.loaded();
  }
  emit(type, detail);
}

/** What the person may choose for this visit and the next. */
function choicesNow() {
  const { theme, look: { light, split, quality } } = viewer.state();
  return { theme, light, split, quality };
}

/** Keeps for the next visit what the person chose, and which model was theirs. */
function keepVisit() {
  if (!viewer || hasFailed()) return;
  const chosen = Object.entries(choicesNow()).filter(([name, value]) => value !== choices[name]);
  if (chosen.length) keep(Object.fromEntries(chosen));
  const state = viewer.state();
  if (sources.hasModel(state)) keep({ open: state.model.name, names: Object.keys(state.skeleton.names).length });
}

/** Shows what changed of the viewer's controls; those of another start stand behind another canvas. */
function showMirror(detail) {
  if (detail.changes.fresh) {
    mirror?.remove();
    mirror = mirrorOf(viewer, view.querySelector("canvas"), pick);
  }
  mirror?.take(detail);
}

/** A slider that has the focus speaks for itself. */
function sayUnlessHeard({ text, assertive }) {
  if (assertive) say(text, "alarm");
  else if (view.getRootNode().activeElement?.type !== "range") say(text);
}

/** A panic is reported with its words; the error that ends the program follows, alone in old browsers. */
function onPanic(error) {
  if (error?.name !== "Panic" && !(error instanceof WebAssembly.RuntimeError)) return;
  fail(new Error(wordsOf(error)));
  showPanic(wordsOf(error));
}

/** Opens what is open, or what could not be opened, once more, as it is now. */
async function readSourcesAgain() {
  const state = bindpose.state();
  const refused = state.error && sources.refused();
  // What a script opened, only the script can open again.
  if (!refused && !sources.hasModel(state) && wasUsed()) return;
  try {
    if (refused) return await hand(await readAgain(refused.files), refused.addsClips);
    const { files, clips } = await sources.again(state, fetchOpening);
    if (files.length) await give(files, "open", sources.move);
    if (clips.length) await give(clips, "addClips");
  } catch (error) {
    if (error.name === "AbortError") return;
    refuse(`${wordsOf(error)}\nA file that was changed after it was chosen in a dialog has to be chosen again.`);
  }
}

/** What the page opens by itself: what the address names, else the sample, with its maps once `program` has come. */
async function fetchOpening(program) {
  const named = ["src", "tex"].flatMap((key) => options.getAll(key));
  try {
    if (named.length) return await fetchNamed(named);
    const [first, ...rest] = Object.entries(SAMPLE);
    const fetchSample = ([name, at]) => fetchOwn(new URL(at, import.meta.url), name);
    const model = fetchSample(first);
    model.catch(() => {}); // It is reported below.
    await program;
    // A figure without one of its maps is still a figure.
    const opened = await Promise.all([model, ...rest.map((map) => fetchSample(map).catch(() => null))]);
    return opened.filter(Boolean);
  } catch (error) {
    refuseError(error);
    return null;
  }
}

/** The files at the addresses that the page's own names. The viewer shows how far it is, and Esc gives it up. */
async function fetchNamed(addresses) {
  const stop = new AbortController();
  let fetching; // The number by which the viewer knows it.
  const before = [0, 0]; // What came and what was promised before the viewer was there.
  const note = (bytes, promised) => {
    before[0] += bytes;
    before[1] += promised;
    if (fetching !== undefined && !viewer.noteFetched(fetching, bytes, promised)) stop.abort();
  };
  bindpose.ready.then(() => {
    if (stop.signal.aborted) return;
    fetching = viewer.beginFetching(decoded(addresses[0].split(/[?#]/)[0].split("/").pop()));
    viewer.noteFetched(fetching, ...before);
  }, () => {});
  // A server that answers nothing is given up too.
  const asking = setInterval(() => note(0, 0), 250);
  try {
    return await fetchFrom(addresses, { signal: stop.signal, began: (_, promised) => note(0, promised), got: (bytes) => note(bytes, 0) });
  } finally {
    clearInterval(asking);
    stop.abort();
    if (fetching !== undefined) viewer.endFetching(fetching);
  }
}

/** Copies a link to what is seen, or an element that shows it on another page, and says of what it cannot tell. */
async function copyLink(embed) {
  const { address, leftOut, asksFor } = link.whole();
  try {
    await navigator.clipboard.writeText(embed ? embedding(address, document.title) : address);
    const asked = asksFor ? [`who opens it is asked for ${asksFor.split("/").pop()}`] : [];
    const missing = leftOut.length ? [`too long for ${leftOut.join(", ")}`] : [];
    viewer.tell([`${embed ? "Embed" : "Link"} copied`, ...asked, ...missing].join("; "));
  } catch {
    showNotice("The link could not be copied", address);
  }
}
