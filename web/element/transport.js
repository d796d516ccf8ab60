// Play, time, clip, speed and full screen as plain elements, for viewers on other people's pages.

const SPEEDS = [0.1, 0.25, 0.5, 1, 2];

/** Paths in a square of 16. */
const ICONS = {
  play: "M4 2.5v11l9-5.5z",
  pause: "M4 2.5h3v11H4zM9 2.5h3v11H9z",
  full: "M2 6V2h4v1.6H3.6V6zM10 2h4v4h-1.6V3.6H10zM3.6 10v2.4H6V14H2v-4zM12.4 10H14v4h-4v-1.6h2.4z",
};

function icon(name) {
  const [svg, path] = ["svg", "path"].map((tag) => document.createElementNS("http://www.w3.org/2000/svg", tag));
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("aria-hidden", "true");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  return svg;
}

function element(tag, part, label, rest = {}) {
  const made = Object.assign(document.createElement(tag), rest);
  made.part = part;
  made.setAttribute("aria-label", label);
  return made;
}

const words = (secs) => `${secs.toFixed(2)} s`;

/**
 * The transport of `player`, which has the names of a media element (`play()`, `pause()`, `paused`, `currentTime`, `duration`, `playbackRate`), `clip` and
 * `clips`. Gives its element and `update()`, for when any of these may be another.
 */
export function transportOf(player) {
  const bar = element("div", "transport", "Timeline");
  bar.setAttribute("role", "group");
  const play = element("button", "play-button", "Play", { type: "button" });
  const clips = element("select", "clips", "Clip");
  const time = element("input", "time", "Time", { type: "range", min: 0, step: "any" });
  const told = document.createElement("output");
  told.part = "time-text";
  const speed = element("select", "speed", "Speed");
  speed.append(...SPEEDS.map((factor) => new Option(`${factor}×`, factor)));
  const full = element("button", "full-screen-button", "Full screen", { type: "button" });
  full.append(icon("full"));
  full.hidden = !document.fullscreenEnabled;
  bar.append(play, clips, time, told, speed, full);

  play.addEventListener("click", () => (player.paused ? player.play() : player.pause()));
  clips.addEventListener("change", () => (player.clip = clips.value));
  time.addEventListener("input", () => (player.currentTime = player.startTime + Number(time.value)));
  speed.addEventListener("change", () => (player.playbackRate = Number(speed.value)));
  full.addEventListener("click", () => void (document.fullscreenElement ? document.exitFullscreen() : player.requestFullscreen()));

  let shown = { paused: null, names: null };
  const update = () => {
    const { paused, duration, currentTime, startTime, playbackRate, clip } = player;
    const names = player.clips;
    for (const control of [play, time, speed]) control.disabled = !names.length;
    if (paused !== shown.paused) {
      play.replaceChildren(icon(paused ? "play" : "pause"));
      play.setAttribute("aria-label", paused ? "Play" : "Pause");
    }
    if (names.join("\n") !== shown.names) {
      clips.replaceChildren(...names.map((name) => new Option(name)));
      clips.hidden = names.length < 2;
    }
    shown = { paused, names: names.join("\n") };
    clips.value = clip ?? "";
    time.max = duration || 1;
    time.value = currentTime - startTime;
    time.setAttribute("aria-valuetext", `${words(currentTime - startTime)} of ${words(duration || 0)}`);
    told.textContent = words(currentTime - startTime);
    if (!SPEEDS.includes(playbackRate) && ![...speed.options].some(({ value }) => Number(value) === playbackRate)) speed.append(new Option(`${Number(playbackRate.toFixed(2))}×`, playbackRate));
    speed.value = playbackRate;
  };
  return { bar, update };
}
