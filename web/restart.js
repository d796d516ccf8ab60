// A viewer's life on its canvas: it starts there, again on a fresh canvas when the GPU went away, and by another program where it stays away.

/** After so many starts in a row that failed, the GPU does not come back. */
const MOST_FAILURES = 6;
/** The pause after the first of them; each later one is twice as long. */
const FIRST_PAUSE_MS = 250;
/** A GPU that goes away sooner than this after a start gets a pause too, so that the page does not flicker. */
const SOON_MS = 500;
/** A start that loses the GPU before this many frames may have lost it by what it draws. */
const FIRST_FRAMES = 3;
/** After so many of these in a row what is open is put aside. */
const MOST_EARLY_LOSSES = 3;

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/**
 * Keeps `viewer` on a canvas that was never drawn on; `lastBackend` is for the last try to get a lost GPU back. `onStart(gpu)` hears of each start that
 * worked, `onEnd(error, gpu)` that the GPU did not come back, and which it was. `putAside()` closes what is open, with which the GPU did not last, and says
 * whether there was something. `isOver()` says that the viewer is not to be called any more.
 */
export function keepOnCanvas(viewer, { canvas, backend, lastBackend = backend, onStart, onEnd, putAside = () => false, isOver }) {
  let gpu = null; // {backend, adapter} of the last start that worked.
  let starts = 0;
  let startedAt = -Infinity; // By `performance.now()`.
  let restarting = false;
  let lostMeanwhile = null; // The reason, when the GPU went away again during a restart.
  let frames = 0; // Since the last start that worked.
  let earlyLosses = 0; // In a row.

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
    frames = 0;
    requestAnimationFrame(function count() {
      if (mine === starts && ++frames < FIRST_FRAMES) requestAnimationFrame(count);
    });
    onStart(gpu);
  };

  /** A start that worked has lost the GPU. In a hidden tab nothing is drawn. */
  const noteLoss = () => (earlyLosses = frames < FIRST_FRAMES && !document.hidden ? earlyLosses + 1 : 0);

  /** Goes on without what is open, once that seems to be why the GPU goes away. */
  const endEarlyLosses = (reason) => {
    if (earlyLosses < MOST_EARLY_LOSSES) return;
    earlyLosses = 0;
    if (!putAside()) throw new Error(`The GPU went away ${MOST_EARLY_LOSSES} times in a row, as soon as something was drawn: ${reason}`);
  };

  /** A canvas remembers the kind of its first context for ever. */
  const replaceCanvas = () => {
    const fresh = canvas.cloneNode(false);
    fresh.removeAttribute("style");
    canvas.replaceWith(fresh);
    canvas = fresh;
  };

  /** What is open lives on in the viewer, so a fresh canvas and a new start bring it back, however often, unless no start lasts with it. */
  const restart = async (reason) => {
    if (isOver()) return;
    if (restarting) {
      lostMeanwhile = reason;
      return;
    }
    restarting = true;
    let hadFocus = false;
    if (gpu) noteLoss();
    try {
      for (let failures = 0; !isOver(); ) {
        // The viewer's hidden input and its mirror stand behind its canvas.
        if (performance.now() - startedAt < SOON_MS) await pause(FIRST_PAUSE_MS);
        hadFocus ||= canvas.parentElement.contains(canvas.getRootNode().activeElement);
        viewer.stop();
        lostMeanwhile = null;
        endEarlyLosses(reason);
        replaceCanvas();
        try {
          await start(failures === MOST_FAILURES - 1 ? lastBackend : backend);
          if (hadFocus) canvas.focus();
          if (!lostMeanwhile) return;
          reason = lostMeanwhile;
          noteLoss();
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

/**
 * Has `program` draw on `backend`, and the full one where it cannot: at once where there is no WebGPU, or once WebGPU is lost for good, with all that is open.
 * Resolves when it draws. `rim` has, beside `isOver` and, where it wants, `putAside` as above:
 * - `make(program)` promises `{viewer, canvas, isFull}`, its canvas never drawn on; `full()` promises the full program;
 * - `keep(keeper)` takes what restarts the viewer, by `keeper.restart(reason)`;
 * - `onStart()` hears of each start that worked, `onEnd(error, gpu)` that nothing will draw any more, and on what it drew last;
 * - `hold()` lets all that is asked of the viewer wait for the next `attach(viewer)`;
 * - `bring(from, to)` brings what is open from viewer to viewer, and `onBrought(error)` hears that it ended, and what stood in the way of a part.
 */
export async function keepDrawn(program, backend, rim, before = null) {
  const { viewer, canvas, isFull } = await rim.make(program);
  let isFirst = true;
  const goOn = async () => {
    const error = await rim.bring(before, viewer).then(() => null, (error) => error);
    if (rim.isOver()) return;
    rim.attach(viewer);
    before.free();
    rim.onBrought(error);
  };
  const keeper = keepOnCanvas(viewer, {
    canvas,
    backend,
    // The plainer backend, unless one was asked for.
    lastBackend: backend === "auto" && isFull ? "webgl2" : backend,
    isOver: () => rim.isOver(),
    putAside: () => rim.putAside?.() ?? false,
    onStart() {
      rim.onStart();
      if (isFirst && before) void goOn();
      else if (isFirst) rim.attach(viewer);
      isFirst = false;
    },
    onEnd(error, gpu) {
      const end = () => rim.onEnd(error, gpu);
      if (isFull || backend !== "auto") return end();
      rim.hold();
      keepDrawn(rim.full(), "webgl2", rim, viewer).catch(end);
    },
  });
  rim.keep(keeper);
  try {
    await keeper.start();
  } catch (error) {
    if (rim.isOver() || error.name !== "WebGl2Missing") throw error;
    console.info(error.message);
    const full = rim.full();
    viewer.free(); // Nothing is open yet, nor drawn.
    await keepDrawn(full, "webgl2", rim);
  }
}
