// Prints the view with a line of facts, and not the interface that is drawn over it. Ctrl+P draws a picture first; a print that the
// browser's menu begins cannot wait for one, so it prints the page as it is, above the same line.

/** The largest side of a printed picture, in pixels. */
const LONGEST_SIDE = 2400;

/** Takes Ctrl+P (or the Mac's Command P) on the page of this viewer. */
export function printView(bindpose) {
  const sheet = document.createElement("section");
  sheet.id = "print";
  const picture = new Image();
  const line = document.createElement("p");
  sheet.append(picture, line);
  document.body.append(sheet);

  addEventListener("keydown", (event) => {
    const { key, ctrlKey, metaKey, shiftKey, altKey } = event;
    if (key.toLowerCase() !== "p" || !(ctrlKey || metaKey) || shiftKey || altKey || !bindpose.state().model) return;
    event.preventDefault();
    event.stopPropagation();
    drawPicture(bindpose, picture).then(print, print);
  }, true);
  addEventListener("beforeprint", () => (line.textContent = facts(bindpose.state())));
  addEventListener("afterprint", () => {
    document.body.classList.remove("has-picture");
    URL.revokeObjectURL(picture.src);
    picture.removeAttribute("src");
  });
}

async function drawPicture(bindpose, picture) {
  const scale = LONGEST_SIDE / Math.max(innerWidth, innerHeight);
  const [width, height] = [innerWidth, innerHeight].map((side) => Math.round(side * scale));
  picture.src = URL.createObjectURL(await bindpose.snapshot({ width, height }));
  await picture.decode();
  document.body.classList.add("has-picture");
}

/** Name, clip and time, counts: `soldier.m3d · Take1 at 0.517 s · 13 748 triangles, 58 bones`. */
function facts({ model, clip, timeSecs }) {
  if (!model) return "";
  const { counts } = model;
  const count = (number, word) => `${number.toLocaleString()} ${word}`;
  const size = [count(counts.vertices, "vertices"), count(counts.triangles, "triangles"), count(counts.bones, "bones")];
  const time = clip ? [`${clip} at ${timeSecs.toFixed(3)} s`] : [];
  return [model.name, ...time, size.join(", ")].join(" · ");
}
