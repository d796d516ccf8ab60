// A viewer on other people's pages: the page scrolls over it by wheel and by finger until somebody has turned to it, and again once they turned away.

/** Lets the page scroll over `view`, in which a viewer's canvas lies; it has the class `turned` meanwhile. */
export function letScroll(view) {
  const hold = (event) => !view.classList.contains("turned") && event.stopPropagation();
  for (const type of ["wheel", "touchstart", "touchmove", "touchend", "touchcancel"]) view.addEventListener(type, hold, { capture: true, passive: true });
  for (const type of ["pointerdown", "pointermove", "pointerup", "pointercancel"]) view.addEventListener(type, (event) => event.pointerType === "touch" && hold(event), { capture: true });
  view.addEventListener("focusin", () => view.classList.add("turned"));
  view.addEventListener("focusout", () => view.classList.remove("turned"));
  view.addEventListener("click", () => view.querySelector("canvas")?.focus({ preventScroll: true }));
}
