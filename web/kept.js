// What the browser keeps of a visit for the next one: what the person prefers, whether the page was introduced, and which model was open.
// Where nothing may be kept nobody is told: the next visit begins as the first.

const KEY = "bindpose.kept";

/** What an earlier visit left, or another tab of this one. */
export function kept() {
  try {
    return Object(JSON.parse(localStorage.getItem(KEY)));
  } catch {
    return {};
  }
}

/** Keeps these values beside the others. */
export function keep(values) {
  try {
    localStorage.setItem(KEY, JSON.stringify({ ...kept(), ...values }));
  } catch {
    // The browser keeps nothing, or is full.
  }
}

/** The sentence that a visit begins with: what was open, else what the page is for; `null` when there is nothing to say. */
export function greeting({ open, names, greeted } = kept()) {
  if (typeof open === "string") {
    const theirs = names > 0 ? `; your ${names} ${names === 1 ? "name is" : "names are"} kept` : "";
    return `${open} was open: drop it again${theirs}.`;
  }
  return greeted ? null : "A viewer for models with bones: drop a .m3d, .glb, .fbx or a folder. Files stay on this machine.";
}
