// Listens to a viewer and draws how high a bone is over the time of the clip.

const [viewer, bone, height, canvas] = ["viewer", "bone", "height", "curve"].map((id) => document.getElementById(id));
const context = canvas.getContext("2d");
let points = []; // [seconds, height].

/** Height is y or z, as the file has it: 13 and 14 of the matrix, after x. */
const heightNow = () => viewer.boneToRoot(Number(bone.value))?.[viewer.state().model.upAxis === "z" ? 14 : 13];

const begin = () => (points = []);

function note() {
  const now = heightNow();
  if (now === undefined) return;
  height.textContent = `${now.toFixed(3)} at ${viewer.currentTime.toFixed(2)} s`;
  // The clip has begun again.
  if (points.length && viewer.currentTime < points.at(-1)[0]) begin();
  points.push([viewer.currentTime, now]);
  draw();
}

function draw() {
  const heights = points.map(([, height]) => height);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.strokeStyle = getComputedStyle(canvas).color;
  context.lineWidth = 2;
  context.beginPath();
  for (const [secs, height] of points) {
    const x = ((secs - viewer.startTime) / viewer.duration) * canvas.width;
    const y = 8 + (1 - (height - low) / (high - low || 1)) * (canvas.height - 16);
    context.lineTo(x, y);
  }
  context.stroke();
}

viewer.addEventListener("load", () => {
  bone.max = viewer.state().model.counts.bones - 1;
  begin();
  note();
});
viewer.addEventListener("timeupdate", note);
bone.addEventListener("input", () => {
  viewer.setAttribute("bone", bone.value);
  begin();
  note();
});
