// What the page's interface asks of the page that it is on, in an element with `ui="full"`: files to open and to save, words to speak.

import { takeChoices, takeDrops } from "../drop.js";
import { saveFile, savePicture } from "../saving.js";

/**
 * Makes what the interface needs in `box`, which lies about its canvas: inputs for files, and a region that speaks. Drops on it open too. `life` has `receive(files, addsClips)`,
 * `refuse(words)`, `again()`, `openModel()` and `copy()`. Gives what is done for each event of a viewer, by its type.
 */
export function servePanels(box, life) {
  const { refuse } = life;
  const input = () => Object.assign(document.createElement("input"), { type: "file", multiple: true, hidden: true });
  const inputs = { files: input(), clips: input() };
  const spoken = Object.assign(document.createElement("p"), { className: "spoken" });
  spoken.setAttribute("role", "status");
  box.append(...Object.values(inputs), spoken);
  const pick = takeChoices(inputs, life);
  takeDrops(box, { ...life, show: (words) => box.classList.toggle("dropped", Boolean(words)) });
  return {
    pick,
    pickfiles: () => pick("files"),
    pickclips: () => pick("clips"),
    readagain: life.again,
    picture: (detail) => void savePicture(detail, refuse),
    picturefailed: ({ message }) => refuse(message),
    save: ({ name, contents, type }) => saveFile(name, contents, type),
    explain: ({ code }) => void open(`${new URL("../codes.html", import.meta.url)}#${code}`, "_blank", "noopener"),
    copylink: () => void life.copy(),
    announce: ({ text }) => (spoken.textContent = text),
  };
}
