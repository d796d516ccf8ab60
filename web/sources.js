// Where files come from, and how the page gets their bytes: from the person, from a program, from the server.

/** Whether it is a `Blob` or a `File`, also one of another window. */
const isBlob = (item) => typeof item?.arrayBuffer === "function";

/** `{name, bytes}` with a relative path from a `File`, a `{name, file}` of drop.js or a `{name, bytes}`; a `Blob` is read piece by piece. */
export function recordOf(item) {
  const name = item?.webkitRelativePath || item?.name;
  if (typeof name !== "string") throw new TypeError("a file to open is a File or {name, bytes}");
  // A `File` may have a method called `bytes`.
  const bytes = isBlob(item) ? item : item.bytes ?? item.file;
  if (ArrayBuffer.isView(bytes)) return { name, bytes: new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength) };
  if (bytes instanceof ArrayBuffer) return { name, bytes: new Uint8Array(bytes) };
  if (!isBlob(bytes)) throw new TypeError(`${name} needs its bytes as Uint8Array, ArrayBuffer or Blob`);
  return { name, bytes };
}

/** The file at an address. */
export async function fetchFile(address, name = decodeURIComponent(new URL(address, location.href).pathname.split("/").pop())) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`The server answered ${response.status} for ${address}`);
  return { name, bytes: await response.blob() };
}

/** `before` without the files whose names come again in `files`, and then those. */
const joined = (before, files) => {
  const names = new Set(files.map(({ name }) => name));
  return [...before.filter(({ name }) => !names.has(name)), ...files];
};

/** `{name, file}` records with the files as they are on disk, where the page may ask for them again. */
export const readAgain = (files) =>
  Promise.all(files.map(async (item) => ({ ...item, file: item.again ? await item.again() : item.file })));

/** Remembers the files that the person opened, for another reading. `state.model.opening` is the number of the opening that brought the model on screen. */
export function rememberSources() {
  let all = new Map(); // By that number: `files` that brought the model, `beside` maps and skies that came later, `clips` that were added.
  let refused = null; // What came last, if it could not be opened: it may be mended on disk.
  const of = ({ model }) => all.get(model?.opening);
  return {
    add(files, addsClips, before, after) {
      refused = after.error ? { files, addsClips } : null;
      if (refused) return;
      const number = after.model?.opening;
      const opened = number !== before.model?.opening;
      const known = (!opened && of(after)) || { files: opened ? files : null, beside: [], clips: [] };
      if (!opened) {
        const list = addsClips ? "clips" : "beside";
        known[list] = joined(known[list], files);
      }
      all.set(number, known);
    },
    /** What was remembered of the model on screen before, is now of the one on screen after. */
    move(before, after) {
      const known = of(before);
      all.delete(before.model?.opening);
      if (known) all.set(after.model?.opening, known);
    },
    forget: () => ([all, refused] = [new Map(), null]),
    refused: () => refused,
    hasModel: (state) => Boolean(of(state)?.files),
    /** All that belongs to the model on screen, read again. Without a file of the person's `own()` gives the page's. */
    async again(state, own) {
      const { files, beside, clips } = of(state) ?? { files: null, beside: [], clips: [] };
      const opened = files ? await readAgain(files) : await own();
      const rest = await Promise.all([beside, clips].map(readAgain));
      return { files: [...(opened ?? []), ...rest[0]], clips: rest[1] };
    },
  };
}
