// A viewer's life on its canvas: it starts there, and again on a fresh canvas when the GPU went away.

/** A GPU that goes away more often than this within the time below does not come back for good. */
const MAX_RESTARTS = 3;
const RESTARTS_FORGOTTEN_MS = 60_000;

/**
 * Keeps `viewer` on a canvas that was never drawn on. `backend` is "webgpu", "webgl2" or "auto". `onStart({backend, adapter})` hears of
 * every start that worked; `onEnd(error, gpu)` that the GPU went away too often, and what the last start gave. `isOver()` says that the
 * viewer is not to be called any more.
 */
export function keepOnCanvas(viewer, { canvas, backend, onStart, onEnd, isOver }) {
  let gpu = null; // {backend, adapter} of the last start that worked.
  let starts = 0;
  let restarts = []; // Times of the latest restarts, in milliseconds.
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
    onStart(gpu);
  };

  /** A canvas remembers the kind of its first context for ever. */
  const replaceCanvas = () => {
    const fresh = canvas.cloneNode(false);
    fresh.removeAttribute("style");
    canvas.replaceWith(fresh);
    canvas = fresh;
  };

  /** The GPU went away: what is open lives on in the viewer, so a fresh canvas and a new start bring all of it back. */
  const restart = async (reason) => {
    if (isOver()) return;
    if (restarting) {
      lostMeanwhile = reason;
      return;
    }
    restarting = true;
    try {
      for (;;) {
        const now = performance.now();
        restarts = restarts.filter((at) => now - at < RESTARTS_FORGOTTEN_MS);
        if (restarts.length === MAX_RESTARTS) throw new Error(`The GPU went away ${MAX_RESTARTS} times: ${reason}`);
        restarts.push(now);
        // The viewer's hidden input and its mirror stand behind its canvas.
        const hadFocus = document.activeElement !== document.body && canvas.parentElement.contains(document.activeElement);
        viewer.stop();
        lostMeanwhile = null;
        replaceCanvas();
        try {
          // The last try takes the plainer way, unless one was asked for.
          await start(restarts.length === MAX_RESTARTS && backend === "auto" ? "webgl2" : backend);
          if (hadFocus) canvas.focus();
          if (!lostMeanwhile) return;
          reason = lostMeanwhile;
        } catch (error) {
          reason = error?.message ?? String(error);
          await new Promise((done) => setTimeout(done, 250 * restarts.length));
        }
      }
    } catch (error) {
      onEnd(error, gpu);
    } finally {
      restarting = false;
    }
  };

  return { start: () => start(backend), restart };
}
