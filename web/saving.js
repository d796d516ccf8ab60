// What a person saves: pictures, reports and models, as files.

import { wordsOf } from "./api.js";

/** The browser may take this long to begin a download. */
const DOWNLOAD_KEPT_MS = 60_000;

/** Saves a picture where the person chooses, or as a download. `refuse(words)` hears why it could not be. */
export async function savePicture({ name, bytes, choosesPlace }, refuse) {
  if (!choosesPlace || !globalThis.showSaveFilePicker) return saveFile(name, bytes, "image/png");
  try {
    const types = [{ description: "PNG picture", accept: { "image/png": [".png"] } }];
    const file = await (await showSaveFilePicker({ suggestedName: name, types })).createWritable();
    await file.write(bytes);
    await file.close();
  } catch (error) {
    if (error.name !== "AbortError") refuse(wordsOf(error));
  }
}

/** Saves bytes or text as a file of this name, as a download. */
export function saveFile(name, contents, type) {
  const address = URL.createObjectURL(new Blob([contents], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), DOWNLOAD_KEPT_MS);
}
