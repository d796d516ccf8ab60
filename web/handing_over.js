// What is open goes from a viewer of one program to one of another.

/** What is being opened is waited for, but not for a server that answers nothing. */
const PATIENCE_MS = 10_000;

const nextTask = () => new Promise((done) => setTimeout(done, 20));

/** Waits until a viewer has opened what it was opening. */
export async function hasOpened(viewer) {
  for (const until = performance.now() + PATIENCE_MS; viewer.state().opening && performance.now() < until; ) await nextTask();
}

/** Shows in the viewer `to` all that is open in `from`, as it is seen there. What `from` is opening comes along, if that ends soon. */
export async function handOver(from, to) {
  await hasOpened(from);
  const { openings, model, clips, sky, rest } = from.handOver();
  for (const files of openings) await to.open(files);
  if (to.modelOnScreen()?.path !== model && to.openModel(model ?? "")) {
    await hasOpened(to);
  }
  for (const files of clips) await to.addClips(files);
  if (sky.length) await to.open(sky);
  to.goOnFrom(rest);
}
