// Files and folders from the person: dropped on a viewer, or chosen in a dialog.

import { CLIP_FILES, isUseful, onlyJoins, withoutNotes } from "./files.js";

/** A folder with more than this in it was not meant for a viewer. */
const MAX_ENTRIES = 20_000;

/**
 * Takes every drop on `area`: an element of one viewer among several, or `window`. `receive(files, addsClips)` gets `{name, file}` records, name being
 * the path inside what was dropped, and whether Shift asks for their clips only; `refuse(words)` hears what could not be read; `openModel()` names the model
 * that a drop would replace; `show({title, what})` says while files are over the area what a drop would do, then `show(null)`. A folder that is listed
 * after a newer drop was received is not; `gaveWay(name)` hears of it.
 */
export function takeDrops(area, { receive, refuse, openModel, show, gaveWay = () => {} }) {
  let drops = 0;
  let received = 0; // Number of the newest drop that could bring a model.
  const onDrag = (event) => {
    if (!carriesFiles(event)) return;
    claim(event);
    event.dataTransfer.dropEffect = "copy";
    const addsClips = event.shiftKey && Boolean(openModel());
    show({ title: addsClips ? "Drop to add clips" : "Drop to open", what: describe(event, openModel(), addsClips) });
  };
  // The element that the pointer enters; null outside the window.
  const leaves = ({ relatedTarget }) => !relatedTarget || area.contains?.(relatedTarget) === false;
  // In the capture phase, so that nothing below sees the drop and takes half of it.
  area.addEventListener("dragenter", onDrag, true);
  area.addEventListener("dragover", onDrag, true);
  area.addEventListener("dragleave", (event) => leaves(event) && show(null), true);
  area.addEventListener("dragend", () => show(null), true);
  area.addEventListener("drop", async (event) => {
    if (!carriesFiles(event)) return;
    claim(event);
    show(null);
    // The list is emptied when this listener returns, so the entries are taken now.
    const roots = entriesOf(event.dataTransfer);
    const addsClips = event.shiftKey;
    const mine = ++drops;
    const { files, problems } = await collect(roots);
    if (mine < received) return gaveWay(roots[0].entry.name);
    if (files.length && !addsClips && !onlyJoins(files)) received = mine;
    if (problems.length) refuse(problems.join("\n"));
    if (files.length) receive(files, addsClips);
    else if (!problems.length) refuse("There is no model and no picture in what was dropped.");
  }, true);
}

/**
 * Makes file inputs hand their files to `receive`: `inputs` has one for "files", a "folder" and "clips". Gives `pick(what)`, which opens its
 * dialog.
 */
export function takeChoices(inputs, { receive, refuse }) {
  inputs.clips.accept = CLIP_FILES;
  for (const [what, input] of Object.entries(inputs)) {
    input.addEventListener("change", () => {
      const chosen = Array.from(input.files, (file) => ({ name: file.webkitRelativePath || file.name, file }));
      input.value = ""; // So that choosing the same file again is a change.
      const files = what === "folder" ? withoutNotes(chosen.filter(({ name }) => isUseful(name))) : chosen;
      if (files.length) receive(files, what === "clips");
      else if (chosen.length) refuse("There is no model and no picture in this folder.");
    });
  }
  return (what) => inputs[what].click();
}

function carriesFiles(event) {
  return event.dataTransfer?.types.includes("Files") ?? false;
}

function claim(event) {
  event.preventDefault();
  event.stopImmediatePropagation();
}

/** What would be opened and what it replaces. Before the drop a page learns how many items there are, not their names. */
function describe(event, openModel, addsClips) {
  const count = Array.from(event.dataTransfer.items).filter((item) => item.kind === "file").length;
  const what = count ? [count === 1 ? "1 item" : `${count} items`] : [];
  const then = addsClips ? [`its clips join those of ${openModel}`] : [`${openModel} stays until it is read`, "Shift adds its clips"];
  return [...what, ...(openModel ? then : [])].join(" · ");
}

function entriesOf(transfer) {
  const items = Array.from(transfer.items).filter((item) => item.kind === "file");
  const roots = items.map((item) => {
    const file = item.getAsFile?.();
    return { entry: item.webkitGetAsEntry?.() ?? file, file };
  }).filter(({ entry }) => entry);
  return roots.length ? roots : Array.from(transfer.files, (file) => ({ entry: file, file }));
}

/** Every useful file below the roots, with its path. What was dropped by itself is always taken. */
async function collect(roots) {
  const files = [];
  const problems = [];
  let seen = 0;

  const visit = async ({ entry, file }, isRoot) => {
    const path = (entry.fullPath ?? entry.name).replace(/^\/+/, "");
    if (++seen > MAX_ENTRIES) return;
    try {
      if (entry instanceof File) {
        files.push({ name: path, file: entry });
      } else if (entry.isDirectory) {
        const reader = entry.createReader();
        // A call gives some hundred entries at most; an empty answer is the end.
        for (let batch = await next(reader); batch.length && seen <= MAX_ENTRIES; batch = await next(reader)) {
          for (const child of batch) await visit({ entry: child }, false);
        }
      } else if (isRoot || isUseful(path)) {
        // A file that was changed since cannot be read through its old `File`, so another can be asked for.
        const again = () => new Promise((done, fail) => entry.file(done, fail));
        // WebKit's entry of a file that a script made never answers.
        files.push({ name: path, file: file ?? (await again()), again });
      }
    } catch (error) {
      problems.push(`${path} could not be read: ${error.message}`);
    }
  };

  for (const root of roots) await visit(root, true);
  if (seen > MAX_ENTRIES) problems.push(`Only the first ${MAX_ENTRIES} entries of the folder were looked at.`);
  return { files: withoutNotes(files), problems };
}

function next(reader) {
  return new Promise((done, fail) => reader.readEntries(done, fail));
}
