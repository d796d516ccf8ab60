// The transport as DOM controls, for screen readers and for keyboards: the viewer's own are pixels on a canvas.
// Seen only while one of them has the focus.

/** What each button asks of the viewer. */
const BUTTONS = {
  first: (bindpose) => bindpose.seekStart(),
  "previous-key": (bindpose) => bindpose.previousKey(),
  back: (bindpose) => bindpose.stepFrames(-1),
  on: (bindpose) => bindpose.stepFrames(1),
  "next-key": (bindpose) => bindpose.nextKey(),
  last: (bindpose) => bindpose.seekEnd(),
  in: (bindpose) => bindpose.setRangeStart(),
  out: (bindpose) => bindpose.setRangeEnd(),
  all: (bindpose) => bindpose.clearRange(),
};

/**
 * Follows and steers `bindpose` with the controls in `section`, each found by its name; `say(words)` tells a screen reader where a button
 * led, and `focusView()` gives the viewer the keyboard. Returns what brings the controls up to date.
 */
export function mirrorTransport(bindpose, { section, control, say, focusView }) {
  const [play, clip, time, speed, loop, wrap, range, all] =
    ["play", "clip", "time", "speed", "loop", "wrap", "range", "all"].map(control);
  const buttons = Object.keys(BUTTONS).map(control);

  const refresh = () => {
    const state = bindpose.state();
    const clips = state.model?.clips ?? [];
    section.hidden = !state.model;
    play.textContent = state.playing ? "Pause" : "Play";
    for (const widget of [play, time, speed, loop, wrap, ...buttons]) widget.disabled = clips.length === 0;
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
    time.setAttribute("aria-valuetext", `${timeWords(state)} of ${current.endSecs.toFixed(2)} seconds`);
    // A number that is being typed is not taken from under the fingers.
    if (document.activeElement !== speed) speed.value = rounded(state.speed);
    loop.value = state.loop;
    wrap.value = state.wrap;
    wrap.disabled = state.loop !== "loop";
    all.disabled = !state.rangeSecs;
    range.textContent = rangeWords(state);
  };

  play.addEventListener("click", () => (bindpose.state().playing ? bindpose.pause() : bindpose.play()));
  clip.addEventListener("change", () => bindpose.selectClip(clip.value));
  time.addEventListener("input", () => bindpose.seek(time.valueAsNumber));
  speed.addEventListener("change", () => {
    // An empty field has no number.
    if (speed.valueAsNumber > 0) bindpose.setSpeed(speed.valueAsNumber);
    speed.value = rounded(bindpose.state().speed);
  });
  loop.addEventListener("change", () => bindpose.setLoop(loop.value));
  wrap.addEventListener("change", () => bindpose.setWrap(wrap.value));
  for (const [name, ask] of Object.entries(BUTTONS)) {
    const button = control(name);
    button.addEventListener("click", () => {
      ask(bindpose);
      const state = bindpose.state();
      // Where it came to is seen on the canvas alone.
      say(["in", "out", "all"].includes(name) ? rangeWords(state) : `${timeWords(state)} seconds`);
      // A button that has done its work must not take the focus with it.
      if (button.disabled) play.focus();
    });
  }
  control("view").addEventListener("click", focusView);
  section.addEventListener("focusin", refresh);
  for (const type of ["load", "play", "pause", "playbackchange"]) bindpose.addEventListener(type, refresh);
  // Many a second while it plays: only when somebody looks.
  bindpose.addEventListener("timeupdate", () => section.matches(":focus-within") && refresh());
  return refresh;
}

/** Thousandths, without what f32 adds to a number: 0.3 instead of 0.30000001192092896. */
const rounded = (number) => Number(number.toFixed(3));

const timeWords = ({ timeSecs }) => timeSecs.toFixed(2);

const rangeWords = ({ rangeSecs }) =>
  rangeSecs ? `From ${rangeSecs[0].toFixed(2)} to ${rangeSecs[1].toFixed(2)} seconds` : "The whole clip plays";

/**
 * Lets Tab leave the viewer once Escape was pressed and had nothing to shut there, as `escapeShuts()` says: until then Tab moves
 * between the viewer's own widgets.
 */
export function letTabLeave(view, escapeShuts) {
  let leaving = false;
  addEventListener("keydown", (event) => {
    if (!view.contains(document.activeElement)) {
      leaving = false;
    } else if (event.key === "Tab" && leaving) {
      // The browser moves the focus; the viewer must not hear of it and hold on.
      event.stopImmediatePropagation();
      leaving = false;
    } else if (event.key !== "Shift") {
      leaving = event.key === "Escape" && !escapeShuts();
    }
  }, true);
  addEventListener("pointerdown", () => (leaving = false), true);
}

/** The viewer's hidden input takes what is typed into the fields on the canvas. It has the focus only while one of them is typed into. */
export function nameTextInput(view) {
  for (const input of view.querySelectorAll("input")) {
    input.tabIndex = -1;
    input.setAttribute("aria-label", "Text of the field in the 3D view");
  }
}
