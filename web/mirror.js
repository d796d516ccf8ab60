// The viewer's controls as elements of the page, for screen readers and for Tab: a canvas has only pixels.
// They lie where the controls are drawn, unseen and out of the pointer's way; the viewer draws the focus ring.

/** What says by which attribute that it is on; others say it by `aria-selected`. */
const ON = {
  button: "aria-pressed", checkbox: "aria-checked", switch: "aria-checked", radio: "aria-checked",
  menuitemcheckbox: "aria-checked", menuitemradio: "aria-checked",
};
/** Roles that are pressed, and are a `<button>` here. */
const PRESSED = new Set([...Object.keys(ON), "tab", "option", "link", "menuitem"]);
/** What else is on is chosen, where ARIA knows such a state. */
const CHOSEN = new Set(["option", "tab", "treeitem", "row", "gridcell", "columnheader", "rowheader"]);
/** Roles that may be folded. */
const FOLDED = new Set(["button", "link", "row", "tab", "treeitem", "gridcell", "rowheader", "checkbox", "switch", "menuitem", "menuitemcheckbox", "menuitemradio"]);
/** Roles that have a place among their like. */
const PLACED = new Set(["treeitem", "option", "listitem", "radio", "tab", "menuitem", "menuitemradio"]);
/** Roles that `aria-label` does not name; they are named by their text. */
const UNNAMED = new Set(["text", "heading", "listitem", "gridcell", "columnheader", "rowheader", "status", "alert"]);
/** Controls that open a dialog of the browser: what is picked there. */
const PICKED = { "open-files": "files", "add-clips": "clips" };
/** What opens over the rest, and takes the focus with it. */
const OVERLAYS = new Set(["dialog", "alertdialog", "menu"]);
/** Keys of a slider that the browser turns into a value. */
const SLIDER_KEYS = new Set(["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"]);
/** Keys of a field that are the viewer's: they end the typing, or walk through what was found. */
const KEYS_OUT_OF_FIELD = new Set(["Enter", "Escape", "ArrowUp", "ArrowDown"]);

/** The canvas is not called otherwise more often than this. */
const LABEL_EVERY_MS = 1000;
/** So long the viewer may take to say where the focus is when its element is gone. */
const HEIR_AFTER_MS = 400;
/** A focused slider's value is read out when it has stood still for so long. */
const RESTS_MS = 600;
/** What the viewer tells this long after the person moved a slider is what came of it. */
const ANSWERS_MS = 1000;
/** So often the viewer may tell of something else before it moves the focus as asked. */
const MOST_ANSWERS = 4;

/** Ids of elements hold for the whole page. */
let mirrors = 0;

/** Mirrors the controls of `viewer` behind its canvas. `pick(what)` opens a dialog within the click. `take()` is for the viewer's `mirror` events. */
export function mirrorOf(viewer, canvas, pick) {
  const prefix = `mirror${++mirrors}-`;
  const root = document.createElement("div");
  // By its style object, since a page may forbid styles in attributes.
  Object.assign(root.style, {
    position: "absolute", left: "0", top: "0", width: "100%", height: "100%", overflow: "hidden", opacity: "0",
    pointerEvents: "none", userSelect: "none",
  });
  canvas.parentElement.append(root);
  // What is typed into fields on the canvas goes through a hidden input, which has the focus only meanwhile.
  const input = canvas.nextElementSibling;
  input.tabIndex = -1;
  input.setAttribute("aria-label", "Text of the field in the 3D view");
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-roledescription", "3D view");

  /** By id: `{record, element}`. */
  const mirrored = new Map();
  /** What opens over the rest, with the element that had the focus before it. */
  const openers = new Map();
  let focus = null; // What has the focus in the viewer.
  let start = null; // What was clicked last on the canvas, while nothing has the focus.
  let follows = false; // The viewer's focus is being followed, and need not be told of it.
  let asked; // What the viewer was asked to focus, until it says so.
  let answers = 0;
  let lost = null; // The element with the focus is gone.
  let returning = 0; // After this timer the viewer is told where the focus is.
  let tabbing = false; // Tab went down, and moves the focus.
  let pressing = false; // A pointer went down on the canvas, and takes the focus.
  const held = new Set(); // Keys that the viewer was told of.
  const turned = new Set(); // Keys that the browser turns into clicks and values.
  let left = false; // The focus went from an element to something else.

  const idOf = (element) => element?.closest?.("[data-mirror]")?.dataset.mirror;
  const elementOf = (id) => mirrored.get(id)?.element;
  const active = () => root.getRootNode().activeElement;
  const hasFocus = () => root.contains(active());
  // In a shadow root it is null that has no focus.
  const nothingHasFocus = () => [null, root.ownerDocument.body].includes(active());
  const act = (element, action, value) => viewer.act({ node: idOf(element), action, value });
  const askFocus = (id) => {
    // What has it already does not answer.
    [asked, answers] = [id === focus ? undefined : id, 0];
    viewer.act(id === null ? { action: "blur" } : { node: id, action: "focus" });
  };

  /** Gives an element the focus that the viewer says it has. */
  const giveFocus = (element) => {
    follows = true;
    element.focus({ preventScroll: true });
    follows = false;
  };

  const create = (record) => {
    const element = document.createElement(tagOf(record));
    element.dataset.mirror = record.id;
    element.id = prefix + record.id;
    Object.assign(element.style, { position: "absolute", margin: "0", padding: "0", border: "0" });
    if (element.localName === "button") {
      element.type = "button";
      if (record.role !== "button") element.setAttribute("role", record.role);
    } else if (element.localName === "input") {
      element.type = record.role === "slider" ? "range" : "text";
      if (record.role === "spinbutton") element.inputMode = "decimal";
      element.autocomplete = "off";
    } else if (record.role !== "text") {
      element.setAttribute("role", record.role);
    }
    return element;
  };

  const update = (entry, record) => {
    const { element } = entry;
    const { role } = record;
    // A button has no value of its own.
    const name = PRESSED.has(role) && record.value ? `${record.name}: ${record.value}` : record.name;
    const set = (attribute, value) => {
      if (value === null || value === undefined || value === "") element.removeAttribute(attribute);
      else if (element.getAttribute(attribute) !== String(value)) element.setAttribute(attribute, value);
    };
    const [left, top, width, height] = record.bounds;
    Object.assign(element.style, { left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` });
    if (UNNAMED.has(role) && !record.children.length) {
      if (element.textContent !== name) element.textContent = name;
    } else {
      set("aria-label", name);
    }
    set("data-control", record.control);
    set("aria-description", record.description);
    set("aria-disabled", record.disabled || null);
    set("aria-invalid", record.invalid || null);
    const on = ON[role] ?? (CHOSEN.has(role) ? "aria-selected" : null);
    if (on) set(on, record.on);
    if (FOLDED.has(role)) set("aria-expanded", record.expanded);
    set("aria-haspopup", record.popup);
    set("aria-activedescendant", record.active && prefix + record.active);
    if (role === "grid") set("aria-rowcount", record.of);
    if (role === "row") set("aria-rowindex", record.place);
    set("aria-modal", record.modal || null);
    if (role === "treeitem" || role === "heading") set("aria-level", record.level ?? (role === "heading" ? 2 : null));
    if (PLACED.has(role)) {
      set("aria-posinset", record.place);
      set("aria-setsize", record.of);
    }
    if (element.localName === "input") updateInput(entry, record, set);
    else if (role === "slider" || role === "progressbar" || role === "spinbutton") {
      set("aria-valuenow", record.number ?? 0);
      set("aria-valuemin", record.min);
      set("aria-valuemax", record.max);
      set("aria-valuetext", record.value ?? (record.number === null ? name : null));
    }
    const reachable = record.focusable && !record.disabled;
    if (reachable || PRESSED.has(role) || element.localName === "input") element.tabIndex = reachable && record.stop ? 0 : -1;
    else element.removeAttribute("tabindex");
  };

  /** A value that the person has just given is not taken back by one that was on its way. */
  const updateInput = (entry, record, set) => {
    const { element } = entry;
    element.disabled = record.disabled;
    if (element.type === "range") {
      element.min = record.min ?? 0;
      element.max = record.max ?? 1;
      element.step = record.step ?? "any";
      entry.show = () => {
        entry.rests = clearTimeout(entry.rests);
        element.value = record.number ?? 0;
        set("aria-valuetext", record.value);
      };
      clearTimeout(entry.rests);
      // What changes by itself, as the time does while a clip plays, would be read out without an end.
      if (element !== active() || performance.now() - entry.movedAt < ANSWERS_MS) entry.show();
      else entry.rests = setTimeout(entry.show, RESTS_MS);
      return;
    }
    set("placeholder", record.placeholder);
    const value = record.role === "spinbutton" ? record.value ?? rounded(record.number) : record.value ?? "";
    if (entry.typed === value) entry.typed = undefined;
    if (entry.typed === undefined && element.value !== value) element.value = value;
  };

  /** Puts these children in order, and moves only those that stand elsewhere: what is moved loses the focus. */
  const arrange = (parent, ids) => {
    let next = null;
    for (const id of ids.toReversed()) {
      const element = elementOf(id);
      if (!element) continue;
      if (element.parentElement !== parent || element.nextElementSibling !== next) parent.insertBefore(element, next);
      next = element;
    }
  };

  /** The focus was on an element that is gone: unless the viewer soon says where it is, it goes to what is nearest. */
  const seekHeir = ({ left, top, width, height }) => {
    clearTimeout(lost?.timer);
    const timer = setTimeout(() => {
      lost = null;
      if (!nothingHasFocus()) return;
      const away = (element) => {
        const box = element.getBoundingClientRect();
        return Math.hypot(box.left + box.width / 2 - left - width / 2, box.top + box.height / 2 - top - height / 2);
      };
      const stops = Array.from(root.querySelectorAll("[tabindex='0']"));
      const [nearest] = stops.map((element) => [away(element), element]).sort(([a], [b]) => a - b);
      (nearest?.[1] ?? canvas).focus({ preventScroll: true });
    }, HEIR_AFTER_MS);
    lost = { timer };
  };

  /** Takes `{changes, view}` of the viewer's event. */
  const take = ({ changes, view }) => {
    describe(view);
    const had = active();
    const within = hasFocus() || (lost !== null && nothingHasFocus());
    const place = within && (had ?? canvas).getBoundingClientRect();
    const opened = [];
    for (const record of changes.changed) {
      const entry = mirrored.get(record.id);
      // A role is for life.
      const stays = entry && entry.record.role === record.role && tagOf(record) === entry.element.localName;
      const fresh = stays ? entry : { element: create(record) };
      if (entry && !stays) entry.element.remove();
      if (!entry && OVERLAYS.has(record.role)) opened.push(record.id);
      mirrored.set(record.id, Object.assign(fresh, { record }));
      update(fresh, record);
    }
    const shut = changes.removed.filter((id) => openers.has(id));
    const heir = shut.map((id) => openers.get(id)).find((id) => !changes.removed.includes(id));
    for (const id of changes.removed) {
      elementOf(id)?.remove();
      mirrored.delete(id);
      openers.delete(id);
    }
    for (const { id, children } of changes.changed) if (children.length) arrange(elementOf(id), children);
    arrange(root, changes.children);
    // What was moved to another place has lost it.
    if (within && root.contains(had) && !hasFocus()) giveFocus(had);
    for (const id of opened) openers.set(id, idOf(had));
    let moved = changes.focus !== focus;
    ({ focus, start } = changes);
    if (asked !== undefined) {
      // One that cannot have the focus never answers.
      if (focus === asked || ++answers === MOST_ANSWERS) asked = undefined;
      moved = false;
    }
    if (within || [canvas, input].includes(active())) followFocus({ had, within, opened, heir, moved, place });
  };

  /** The focus of the page goes where the viewer's is; where that is nowhere, the page's is kept. */
  const followFocus = ({ had, within, opened, heir, moved, place }) => {
    const wanted = elementOf(focus);
    if (within && opened.length && !opened.some((id) => elementOf(id).contains(wanted))) {
      // Opened by an element, so the keyboard goes into it.
      const [first] = opened.flatMap((id) => Array.from(elementOf(id).querySelectorAll("[tabindex='0']")));
      if (first) return void first.focus({ preventScroll: true });
    }
    if (wanted && moved) {
      // What is typed into a field on the canvas goes to the viewer's hidden input.
      if (!within && wanted.matches("input[type=text]")) return;
      if (wanted !== active()) giveFocus(wanted);
    } else if (within && !root.contains(had)) {
      // It is gone.
      const next = elementOf(heir) ?? wanted;
      if (next) next.focus({ preventScroll: true });
      else if (!lost) seekHeir(place);
    } else if (within && moved && focus === null) {
      // It may be on its way to what is not drawn yet.
      clearTimeout(returning);
      returning = setTimeout(() => focus === null && hasFocus() && askFocus(idOf(active())), HEIR_AFTER_MS);
    }
  };

  let label = "";
  let labelTimer = 0;
  /** Calls the canvas by what it shows, not too often. */
  const describe = (words) => {
    label = words;
    if (labelTimer) return;
    canvas.setAttribute("aria-label", label);
    labelTimer = setTimeout(() => {
      labelTimer = 0;
      if (canvas.getAttribute("aria-label") !== label) describe(label);
    }, LABEL_EVERY_MS);
  };

  /** The viewer makes one step to undo of what a key does until it is up. */
  const release = () => {
    if (turned.size) viewer.act({ action: "release" });
    turned.clear();
  };

  root.addEventListener("focusin", ({ target }) => {
    left = false;
    viewer.setMirrorFocused(true);
    if (!follows) {
      askFocus(idOf(target));
      act(target, "scrollIntoView");
    }
  });
  root.addEventListener("focusout", ({ target, relatedTarget }) => {
    const entry = mirrored.get(idOf(target));
    if (entry?.typed !== undefined) {
      entry.typed = undefined;
      update(entry, entry.record);
    }
    release();
    if (!root.contains(relatedTarget)) {
      left = relatedTarget !== input;
      viewer.setMirrorFocused(false);
      held.clear();
    }
  });
  root.addEventListener("click", ({ target }) => {
    const { record } = mirrored.get(idOf(target)) ?? {};
    if (!record?.clickable || record.disabled) return;
    if (pick && PICKED[record.control]) return pick(PICKED[record.control]);
    // From here on the viewer says where the focus is: what opens may take it.
    asked = undefined;
    act(target, "click");
  });
  root.addEventListener("input", ({ target }) => {
    const entry = mirrored.get(idOf(target));
    if (!entry) return;
    if (target.type === "range") {
      entry.movedAt = performance.now();
      return act(target, "setValue", target.valueAsNumber);
    }
    entry.typed = target.value;
    // A number is taken when it is complete.
    if (entry.record.role !== "spinbutton") act(target, "setValue", target.value);
  });
  root.addEventListener("change", ({ target }) => {
    const entry = mirrored.get(idOf(target));
    if (entry?.record.role !== "spinbutton") return;
    act(target, "setValue", target.value); // What is no number of its range is refused in words.
    entry.typed = undefined;
    update(entry, entry.record);
  });
  root.addEventListener("keydown", (event) => {
    const { key, code, target } = event;
    if (key === "Tab" || event.isComposing) return;
    const entry = mirrored.get(idOf(target));
    if (!entry) return;
    const { record, rests, show } = entry;
    if (isOwnKey(target, record, event)) {
      if (target.type === "text") return;
      // A step begins at the value of now.
      if (rests) show();
      if (!turned.size) viewer.act({ action: "hold" });
      turned.add(code);
      if (target.type !== "range" || (key !== "Home" && key !== "End")) return;
      // The element rounds to its steps: where it shows an end before the value is there, it would say nothing.
      event.preventDefault();
      target.value = key === "Home" ? record.min : record.max;
      entry.movedAt = performance.now();
      return act(target, "setValue", key === "Home" ? record.min : record.max);
    }
    if (target.localName === "input" && target.type === "text" && key === "Enter") target.dispatchEvent(new Event("change", { bubbles: true }));
    if ((key === "Enter" || key === " ") && record.clickable && target.localName === "div") {
      event.preventDefault();
      return void (event.repeat || target.click());
    }
    if (record.folds && !modified(event) && (key === "ArrowRight" || key === "ArrowLeft")) {
      const expands = key === "ArrowRight";
      if (record.expanded === !expands) {
        event.preventDefault();
        return act(target, expands ? "expand" : "collapse");
      }
    }
    held.add(code);
    asked = undefined;
    if (viewer.press(event)) event.preventDefault();
  });
  root.addEventListener("keyup", (event) => {
    if (held.delete(event.code)) viewer.press(event);
    if (turned.has(event.code)) release();
  });

  // Tab leaves the canvas from where the viewer's focus is, or what was clicked last.
  const onTab = (event) => {
    if (event.key !== "Tab") return;
    tabbing = true;
    setTimeout(() => (tabbing = false));
    if (![canvas, input].includes(active())) return;
    event.stopImmediatePropagation();
    const from = elementOf(asked === undefined ? focus : asked) ?? elementOf(start);
    if (from) giveFocus(from);
    else if (!event.shiftKey && active() !== canvas) canvas.focus({ preventScroll: true });
  };
  /** Who comes by Tab sees that the view has the focus; eframe takes the browser's own outline away. */
  const outline = (shown) => {
    canvas.style.outline = shown ? "2px solid var(--accent, Highlight)" : "none";
    canvas.style.outlineOffset = "-2px";
  };
  const onBlur = () => outline(false);
  const onPointer = () => {
    outline(false);
    pressing = true;
    setTimeout(() => (pressing = false));
  };
  const leavesForCanvas = () => {
    // The keyboard came here from a control, which the viewer still has in its focus.
    if (!pressing && left) askFocus(null);
    left = false;
    outline(tabbing);
  };
  globalThis.addEventListener("keydown", onTab, true);
  canvas.addEventListener("pointerdown", onPointer, true);
  canvas.addEventListener("focus", leavesForCanvas);
  canvas.addEventListener("blur", onBlur);

  return {
    take,
    remove() {
      clearTimeout(labelTimer);
      clearTimeout(lost?.timer);
      clearTimeout(returning);
      globalThis.removeEventListener("keydown", onTab, true);
      canvas.removeEventListener("pointerdown", onPointer, true);
      canvas.removeEventListener("focus", leavesForCanvas);
      canvas.removeEventListener("blur", onBlur);
      root.remove();
    },
  };
}

/** The element for a record. */
function tagOf({ role, settable, min, max, children }) {
  if (role === "textbox" || (role === "spinbutton" && settable)) return "input";
  if (role === "slider" && settable && min !== null && max !== null) return "input";
  // A button cannot have other controls in it.
  if (PRESSED.has(role) && !children.length) return "button";
  return role === "text" ? "span" : "div";
}

const modified = ({ ctrlKey, altKey, metaKey }) => ctrlKey || altKey || metaKey;

/** Whether the browser does with a key what the element is for. */
function isOwnKey(target, { role }, event) {
  const { key } = event;
  if (target.localName === "button") return !modified(event) && (key === "Enter" || key === " ");
  if (target.localName !== "input") return false;
  if (target.type === "range") return !modified(event) && SLIDER_KEYS.has(key);
  if (role === "spinbutton" && (key === "ArrowUp" || key === "ArrowDown")) return false;
  return !KEYS_OUT_OF_FIELD.has(key) && !/^F\d/.test(key);
}

const rounded = (number) => (number === null ? "" : String(Number(number.toFixed(4))));
