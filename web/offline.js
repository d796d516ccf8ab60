// The page as a program of the system: it opens without a network, takes files that the system opens with it or other programs share with it, and hears
// of a newer build. Of this only a build for a host has the worker: the page names the build there.

import { wordsOf } from "./api.js";

/** How often a page that stays open asks for a newer build. */
const ASKS_EVERY_MS = 3_600_000;

const element = (id) => document.getElementById(id);
const site = new URL("../", import.meta.url).href;
const build = document.querySelector("meta[name=build]")?.content;
const worker = build && navigator.serviceWorker;
const address = location.href;

// As long as the page lives, the worker keeps the files of its build.
if (worker) navigator.locks?.request(`bindpose-${build}`, { mode: "shared" }, () => new Promise(() => {}));

/** Keeps the page for visits without a network, with the programs that it took; `say(words)` has a newer build spoken of, which the page shows. */
export async function keepPage(programs, say) {
  if (!worker) return;
  element("newer-take").addEventListener("click", () => location.reload());
  element("newer-close").addEventListener("click", () => (element("newer").hidden = true));
  const tell = () => worker.controller?.postMessage({ programs });
  worker.addEventListener("message", ({ data }) => data.build === build || showNewer(say));
  worker.addEventListener("controllerchange", tell);
  tell();
  try {
    const registration = await worker.register(new URL("../sw.js", import.meta.url));
    let asked = performance.now();
    document.addEventListener("visibilitychange", () => {
      if (document.hidden || performance.now() - asked < ASKS_EVERY_MS) return;
      asked = performance.now();
      registration.update().catch(() => {}); // Without a network there is nothing to hear.
    });
  } catch {
    // The browser keeps nothing: each visit needs the network.
  }
}

/** A newer build is there. What is open would have to be opened again after a reload, so the person says when. */
function showNewer(say) {
  element("newer").hidden = false;
  say("A newer Bindpose is here: reload the page to have it now.");
}

/** Hands on what the system opens with the page, and what was shared with it, as a drop; `refuse(words)` hears of what could not be read. */
export function takeLaunches(receive, refuse) {
  const open = async (listing) => {
    try {
      const files = await listing;
      if (files.length) receive(files);
    } catch (error) {
      refuse(wordsOf(error));
    }
  };
  if (new URL(address).searchParams.has("shared")) open(takeShared());
  globalThis.launchQueue?.setConsumer(({ files, targetURL }) => {
    if (files?.length) return open(Promise.all(Array.from(files, readHandle)));
    // A shortcut, while the page was open already.
    if (targetURL && targetURL !== address && new URL(targetURL).search) location.assign(targetURL);
  });
}

async function readHandle(handle) {
  const again = () => handle.getFile();
  return { name: handle.name, file: await again(), again };
}

/** What the worker has put aside for this page. */
async function takeShared() {
  history.replaceState(null, "", site);
  const stash = await caches.open(`shared ${site}`);
  const form = await (await stash.match(address))?.formData();
  await stash.delete(address);
  if (!form) throw new Error("What was shared with Bindpose did not arrive: there may be no room for it.");
  return form.getAll("files").map((file) => ({ name: file.name, file }));
}
