// What the page learns of the device before and beside the viewer.

/** Has a viewer spare the battery while the device runs on it. */
export function watchBattery(viewer) {
  navigator.getBattery?.().then((battery) => {
    const tell = () => viewer.setSparing(!battery.charging);
    battery.onchargingchange = tell;
    tell();
  }, () => {});
}

/** Watches the display while nothing is drawn. Returns a function that ends it and tells the seconds between two pictures, if it saw enough. */
export function watchDisplay() {
  const intervals = [];
  let last;
  let request = requestAnimationFrame(function note(now) {
    if (last !== undefined && intervals.length < 60) intervals.push(now - last);
    last = now;
    request = requestAnimationFrame(note);
  });
  return () => {
    cancelAnimationFrame(request);
    intervals.sort((a, b) => a - b);
    // While the program arrives, the page is busy now and then: the quick ones show what the display can do.
    return intervals.length >= 8 ? intervals[intervals.length >> 2] / 1000 : undefined;
  };
}
