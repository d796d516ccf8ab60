// The transport as DOM controls, for screen readers and for keyboards: the viewer's own are pixels on a canvas.
// Seen only while one of them has the focus.

const element = (id) => document.getElementById(id);

/** Follows and steers `bindpose`. */
export function mirrorTransport(bindpose) {
  const section = element("transport");
  const play = element("transport-play");
  const clip = element("transport-clip");
  const time = element("transport-time");

  const refresh = () => {
    const state = bindpose.state();
    const clips = state.model?.clips ?? [];
    section.hidden = !state.model;
    play.textContent = state.playing ? "Pause" : "Play";
    play.disabled = time.disabled = clips.length === 0;
    const names = clips.map(({ name }) => name);
    if (names.join("\n") !== Array.from(clip.options, ({ value }) => value).join("\n")) {
      clip.replaceChildren(...names.map((name) => new Option(name, name)));
    }
    const current = clips.find(({ name }) => name === state.clip);
    if (!current) return;
    clip.value = current.name;
    time.min = current.startSecs;
    time.max = current.endSecs;
    time.value = state.timeSecs;
    time.setAttribute("aria-valuetext", `${state.timeSecs.toFixed(2)} of ${current.endSecs.toFixed(2)} seconds`);
  };

  play.addEventListener("click", () => (bindpose.state().playing ? bindpose.pause() : bindpose.play()));
  clip.addEventListener("change", () => bindpose.selectClip(clip.value));
  time.addEventListener("input", () => bindpose.seek(time.valueAsNumber));
  element("transport-view").addEventListener("click", () => focusable()?.focus());
  section.addEventListener("focusin", refresh);
  for (const type of ["load", "play", "pause"]) bindpose.addEventListener(type, refresh);
  // Many a second while it plays: only when somebody looks.
  bindpose.addEventListener("timeupdate", () => section.matches(":focus-within") && refresh());
  return refresh;
}

/** Where keys go to the viewer: its hidden text input, or the canvas. */
function focusable() {
  return document.querySelector("#view input") ?? document.querySelector("#view canvas");
}

/** Lets Tab leave the viewer once Escape was pressed: until then it moves between the viewer's own widgets. */
export function letTabLeave(view) {
  let leaving = false;
  addEventListener("keydown", (event) => {
    if (!view.contains(document.activeElement)) {
      leaving = false;
    } else if (event.key === "Tab" && leaving) {
      // The browser moves the focus; the viewer must not hear of it and hold on.
      event.stopImmediatePropagation();
    } else if (event.key !== "Shift") {
      leaving = event.key === "Escape";
    }
  }, true);
  addEventListener("pointerdown", () => (leaving = false), true);
}
