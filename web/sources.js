// Where files come from, and how the page gets their bytes: from the person, from a program, from the server.

import { onlyJoins } from "./files.js";

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

/** A part of an address as people read it, or as it is where it cannot be read so. */
export function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** The file at an address of this site. */
export async function fetchOwn(address, name) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`The server answered ${response.status} for ${address}`);
  return { name, bytes: await response.blob() };
}

/** The viewer opens no more bytes at once; a server that sends more is asked no longer. */
const MOST_BYTES = 2 ** 29;

/** This computer, which may be asked without encryption. */
const LOCAL = ["localhost", "127.0.0.1"];

/** The address that a person wrote into the page's own; throws where the page asks nobody for it. */
function addressOf(text) {
  const url = URL.parse?.(text, location.href) ?? new URL(text, location.href);
  const isAsked = url.origin === location.origin || url.protocol === "https:" || (url.protocol === "http:" && LOCAL.includes(url.hostname));
  if (!isAsked) throw new Error(`${url.href} is not asked for: a file comes from this server, from an https: address or from this computer`);
  return url;
}

/** The server's answer. No server but this one learns who asks, nor from which page. */
async function answerOf(url, signal) {
  const how = { credentials: "same-origin", referrerPolicy: "no-referrer", signal };
  let response;
  try {
    response = await fetch(url, how);
  } catch (error) {
    if (signal.aborted) throw error;
    // Without a look at what it says it answers also where it lets no other page read.
    const isThere = url.origin !== location.origin && (await fetch(url, { ...how, mode: "no-cors" }).then(() => true, () => false));
    if (signal.aborted) throw error;
    throw new Error(isThere ? `${url.host} does not let other pages read ${url.pathname} (it sends no Access-Control-Allow-Origin)` : `${url.host} did not answer`);
  }
  if (response.status === 404) throw new Error(`${url.host} has no ${url.pathname}`);
  if (!response.ok) throw new Error(`${url.host} answered ${response.status} for ${url.pathname}`);
  return response;
}

/** What a `.gltf` names beside itself: addresses on its server, by the paths that it has for them. */
async function namedBy({ name, bytes }, url) {
  if (!/\.gltf$/i.test(name)) return [];
  try {
    const { buffers = [], images = [] } = JSON.parse(await bytes.text());
    const paths = new Set([...buffers, ...images].map(({ uri }) => uri).filter((uri) => typeof uri === "string" && !uri.startsWith("data:")));
    const named = [...paths].map((path) => [decoded(path), new URL(path, url)]);
    return named.filter(([, address]) => address.origin === url.origin);
  } catch {
    return []; // The viewer tells what is wrong with it.
  }
}

/**
 * The files at addresses, and what each `.gltf` among them names beside it. `began(name, bytes)` and `got(bytes)` hear how far it is, as far as servers tell; it
 * ends when `signal` does. Throws in words that say what happened: no answer, not allowed, not found, broken off.
 */
export async function fetchFrom(addresses, { began, got, signal }) {
  let room = MOST_BYTES;
  const fetchOne = async ([name, url]) => {
    const response = await answerOf(url, signal);
    const length = response.headers.has("Content-Encoding") ? 0 : Number(response.headers.get("Content-Length"));
    began(name, length);
    const pieces = [];
    let arrived = 0;
    try {
      for (const reader = response.body.getReader(); ; ) {
        const { done, value } = await reader.read();
        if (done) break;
        arrived += value.length;
        pieces.push(value);
        room -= value.length;
        if (room < 0) {
          void reader.cancel();
          break;
        }
        got(value.length);
      }
    } catch (error) {
      if (signal.aborted) throw error;
      throw new Error(`${url.host} broke off after ${arrived}${length ? ` of ${length}` : ""} bytes of ${url.pathname}`);
    }
    if (room < 0) throw new Error(`${url.host} sends more than ${MOST_BYTES >> 20} MiB, the most that can be opened at once`);
    return { name, bytes: new Blob(pieces) };
  };
  const asked = addresses.map(addressOf).map((url) => [decoded(url.pathname.split("/").pop()), url]);
  const orNone = (one) =>
    fetchOne(one).catch((error) => {
      if (signal.aborted) throw error;
      console.warn(error.message);
      return null;
    });
  // A model without one of its pictures is still a model; the viewer tells of those that it names.
  const [joins, models] = [true, false].map((joins) => asked.filter(([name]) => onlyJoins([{ name }]) === joins));
  const [opened, pictures] = await Promise.all([models.map(fetchOne), joins.map(models.length ? orNone : fetchOne)].map((all) => Promise.all(all)));
  const beside = await Promise.all(opened.map((file, index) => namedBy(file, models[index][1])));
  const found = await Promise.all(beside.flat().map(orNone));
  return [...opened, ...pictures, ...found].filter(Boolean);
}

/** `before` without the files whose names come again in `files`, and then those. */
export const joined = (before, files) => {
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
