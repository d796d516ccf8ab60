// The view on paper, with a line of facts.

/** Pixels. */
const LONGEST_PRINTED_SIDE = 2400;

/** Prints the view with a line of facts: for Ctrl+P a picture made for paper, for the browser's menu, which cannot wait, a copy of `canvas()`. */
export function printView(bindpose, canvas) {
  const sheet = document.createElement("section");
  sheet.id = "print";
  const picture = new Image();
  const copy = document.createElement("canvas");
  const line = document.createElement("p");
  sheet.append(picture, copy, line);
  document.body.append(sheet);

  let drawing = false;
  addEventListener("keydown", (event) => {
    const { key, ctrlKey, metaKey, shiftKey, altKey } = event;
    if (key.toLowerCase() !== "p" || !(ctrlKey || metaKey) || shiftKey || altKey || !bindpose.state().model) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.repeat || drawing) return;
    drawing = true;
    drawPicture(bindpose, picture)
      // Without a picture the print gets a copy of the view.
      .catch(() => forget(picture))
      .finally(() => {
        drawing = false;
        print();
      });
  }, true);
  addEventListener("beforeprint", () => {
    const state = bindpose.state();
    line.textContent = facts(state);
    copy.hidden = Boolean(picture.src) || !state.model;
    if (!copy.hidden) copyView(canvas(), copy);
  });
  addEventListener("afterprint", () => {
    copy.width = 0; // Its pixels are freed.
    document.body.classList.remove("has-picture");
    forget(picture);
  });
}

async function drawPicture(bindpose, picture) {
  const scale = LONGEST_PRINTED_SIDE / Math.max(innerWidth, innerHeight);
  const [width, height] = [innerWidth, innerHeight].map((side) => Math.round(side * scale));
  picture.src = URL.createObjectURL(await bindpose.snapshot({ width, height }));
  await picture.decode();
  document.body.classList.add("has-picture");
}

function forget(picture) {
  URL.revokeObjectURL(picture.src);
  picture.removeAttribute("src");
}

/** The viewer draws without its panels when its canvas hears of a print; it can be copied until the script ends. */
function copyView(canvas, copy) {
  canvas.dispatchEvent(new Event("beforeprint"));
  [copy.width, copy.height] = [canvas.width, canvas.height];
  copy.getContext("2d").drawImage(canvas, 0, 0);
  document.body.classList.add("has-picture");
}

function facts({ model, clip, timeSecs }) {
  if (!model) return "";
  const { counts } = model;
  // As the panels group them.
  const count = (number, word) => `${String(number).replace(/\B(?=(\d{3})+$)/g, "\u2009")} ${word}`;
  const size = [count(counts.vertices, "vertices"), count(counts.triangles, "triangles"), count(counts.bones, "bones")];
  const time = clip ? [`${clip} at ${timeSecs.toFixed(3)} s`] : [];
  return [model.name, ...time, size.join(", ")].join(" · ");
}
