// Two viewers with one transport: the time is a part of each one's own clip.

const [left, right, play, time, told] = ["left", "right", "play", "time", "told"].map((id) => document.getElementById(id));
const both = [left, right];
let playing = false;
let before; // When the last frame was, milliseconds.

function seek(part) {
  time.value = part;
  for (const viewer of both) if (viewer.duration) viewer.currentTime = viewer.startTime + part * viewer.duration;
  told.textContent = `${Math.round(100 * part)} %`;
}

/** Time goes by as the left clip's does. */
function step(now) {
  if (!playing) return;
  const secs = (now - (before ?? now)) / 1000;
  before = now;
  seek((Number(time.value) + secs / (left.duration || 1)) % 1);
  requestAnimationFrame(step);
}

play.addEventListener("click", () => {
  playing = !playing;
  before = undefined;
  play.textContent = playing ? "Pause" : "Play";
  if (playing) requestAnimationFrame(step);
});
time.addEventListener("input", () => seek(Number(time.value)));

for (const [viewer, other] of [[left, right], [right, left]]) {
  viewer.addEventListener("load", () => {
    viewer.pause();
    seek(Number(time.value));
  });
  viewer.addEventListener("camera-change", ({ detail: { yawRadians, pitchRadians, distance } }) => {
    // What this one is told by the other, it tells no more.
    if (!viewer.matches(":focus, :hover")) return;
    const degrees = [yawRadians, pitchRadians].map((angle) => (angle * 180) / Math.PI);
    other.setAttribute("camera", [...degrees, distance].join(" "));
  });
}
for (const input of document.querySelectorAll("input[data-for]")) {
  input.addEventListener("change", () => document.getElementById(input.dataset.for).open(input.files));
}
