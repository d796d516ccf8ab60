// A viewer's life on its canvas: it starts there, and again on a fresh canvas when the GPU went away.

/** After so many starts in a row that failed, the GPU does not come back. */
const MOST_FAILURES = 6;
/** The pause after the first of them; each later one is twice as long. */
const FIRST_PAUSE_MS = 250;
/** A GPU that goes away sooner than this after a start gets a pause too, so that the page does not flicker. */
const SOON_MS = 500;

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/**
 * Keeps `viewer` on a canvas that was never drawn on. `backend` is "webgpu", "webgl2" or "auto". `onStart({backend, adapter})` hears of
 * every start that worked; `onEnd(error, gpu)` that the GPU did not come back, and what the last start that worked gave. `isOver()` says that the
 * viewer is not to be called any more.
 */
export function keepOnCanvas(viewer, { canvas, backend, onStart, onEnd, isOver }) {
  let gpu = null; // {backend, adapter} of the last start that worked.
  let starts = 0;
  let startedAt = -Infinity; // By `performance.now()`.
  let restarting = false;
  let lostMeanwhile = null; // The reason, when the GPU went away again during a restart.

  /** Starts on the present canvas. The outcome of a start is ignored once a later one has begun. */
  const start = async (wanted) => {
    const mine = ++starts;
    let started;
    try {
      started = await viewer.start(canvas, { backend: wanted });
    } catch (error) {
      if (mine === starts) throw error;
    }
    if (mine !== starts) return;
    gpu = started;
    startedAt = performance.now();
    onStart(gpu);
  };

  /** A canvas remembers the kind of its first context for ever. */
  const replaceCanvas = () => {
    const fresh = canvas.cloneNode(false);
    fresh.removeAttribute("style");
    canvas.replaceWith(fresh);
    canvas = fresh;
  };

  /** The GPU went away: what is open lives on in the viewer, so a fresh canvas and a new start bring all of it back, however often. */
  const restart = async (reason) => {
    if (isOver()) return;
    if (restarting) {
      lostMeanwhile = reason;
      return;
    }
    restarting = true;
    let hadFocus = false;
    try {
      for (let failures = 0; !isOver(); ) {
        // The viewer's hidden input and its mirror stand behind its canvas.
        if (performance.now() - startedAt < SOON_MS) await pause(FIRST_PAUSE_MS);
        hadFocus ||= canvas.parentElement.contains(canvas.getRootNode().activeElement);
        viewer.stop();
        lostMeanwhile = null;
        replaceCanvas();
        try {
          // The last try takes the plainer way, unless one was asked for.
          await start(failures === MOST_FAILURES - 1 && backend === "auto" ? "webgl2" : backend);
          if (hadFocus) canvas.focus();
          if (!lostMeanwhile) return;
          reason = lostMeanwhile;
          // A GPU that went away again after it had drawn was there.
          if (viewer.state().framesRendered > 0) {
            failures = 0;
            continue;
          }
        } catch (error) {
          reason = error?.message ?? String(error);
        }
        failures += 1;
        if (failures === MOST_FAILURES) throw new Error(`The GPU did not come back in ${failures} starts: ${reason}`);
        await pause(FIRST_PAUSE_MS * 2 ** (failures - 1));
      }
    } catch (error) {
      onEnd(error, gpu);
    } finally {
      restarting = false;
    }
  };

  return { start: () => start(backend), restart };
}
