// What is open goes from a viewer of one program to one of another.

/** What is being opened is waited for, but not for a server that answers nothing. */
const PATIENCE_MS = 10_000;

const nextTask = () => new Promise((done) => setTimeout(done, 20));

/** Shows in the viewer `to` all that is open in `from`, as it is seen there. What `from` is opening comes along, if that ends soon. */
export async function handOver(from, to) {
  const until = performance.now() + PATIENCE_MS;
  while (from.state().opening && performance.now() < until) await nextTask();
  const { openings, model, clips, sky, rest } = from.handOver();
  for (const files of openings) await to.open(files);
  if (to.modelOnScreen()?.path !== model && to.openModel(model ?? "")) {
    while (to.state().opening) await nextTask();
  }
  for (const files of clips) await to.addClips(files);
  if (sky.length) await to.open(sky);
  to.goOnFrom(rest);
}
