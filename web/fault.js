// Pages and cards for what the viewer itself cannot say, because it does not run or never saw the file.

import { wordsOf } from "./api.js";

/** The ways to draw, by their names in the address. */
const BACKENDS = { webgl2: "WebGL2", webgpu: "WebGPU" };

const element = (id) => document.getElementById(id);

/** A card over the view that stays until it is dismissed. */
export function showNotice(title, words, isError = true) {
  element("notice").classList.toggle("plain", !isError);
  element("notice-title").textContent = title;
  element("notice-words").textContent = words;
  element("notice").hidden = false;
}

/** Takes the card away. */
export function clearNotice() {
  element("notice").hidden = true;
}

/** Replaces the page by what happened. The first fault stays: what follows are its echoes. */
function showFault(title, words, details, links = backendLinks()) {
  if (!element("fault").hidden) return;
  element("shell").hidden = true;
  element("view").inert = true;
  element("fault-title").textContent = title;
  element("fault-words").textContent = words;
  element("fault-details").textContent = details;
  const again = document.createElement("button");
  again.type = "button";
  again.className = "primary";
  again.textContent = "Reload";
  again.addEventListener("click", () => location.reload());
  element("fault-actions").replaceChildren(again, ...links);
  element("fault").hidden = false;
  again.focus();
}

/** The program ended in a way it did not expect. */
export function showPanic(message) {
  showFault(
    "Bindpose stopped",
    "It came upon something that it did not expect. That is a mistake in the program, not in your file. Reload the page to go on.",
    message,
  );
}

/** The graphics could not be started. `backend` is the one that was asked for by name, if any. */
export function showGpuFailure(error, backend) {
  showFault(
    "The graphics could not be started",
    backend in BACKENDS
      ? `${BACKENDS[backend]} was asked for and did not work. The other way to draw may.`
      : "Neither WebGPU nor WebGL2 worked. A newer browser or graphics driver, or hardware acceleration turned on in the browser's settings, helps most often.",
    wordsOf(error),
  );
}

/** The GPU went away and did not come back. `gpu` is what it was, or null when no start had come to its end. */
export function showGpuLoss(error, gpu) {
  const lost = gpu ? `${BACKENDS[gpu.backend]} on ${gpu.adapter} was lost` : "The GPU was lost while it started";
  showFault(
    "The graphics went away",
    `${lost} and could not be started again. The other way to draw may last.`,
    wordsOf(error),
  );
}

/** The model was closed, since the GPU went away each time that it was shown. */
export function showPutAside(name) {
  showNotice(
    `${name} was put aside`,
    "The graphics went away three times in a row before they had drawn a few pictures of it. It may be too much for this GPU or its driver. Drop it again to try once more.",
  );
}

/** The browser lacks what the program is built for. */
export function showOldBrowser() {
  showFault(
    "This browser is too old",
    "Bindpose needs WebAssembly with SIMD: Chrome or Edge 91, Firefox 89, Safari 16.4, or a newer one.",
    navigator.userAgent,
    [],
  );
}

/** The program could not be fetched or compiled. */
export function showDownloadFailure(error) {
  showFault(
    "The viewer could not be loaded",
    "A part of this page did not arrive, or this browser cannot run it. Bindpose needs WebAssembly.",
    wordsOf(error),
    [],
  );
}

function backendLinks() {
  return Object.entries(BACKENDS).map(([backend, name]) => {
    const address = new URL(location.href);
    address.searchParams.set("backend", backend);
    address.hash = ""; // It may name the other one.
    const link = document.createElement("a");
    link.href = address.href;
    link.textContent = `Use ${name}`;
    return link;
  });
}
