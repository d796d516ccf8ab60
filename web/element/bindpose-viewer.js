// <bindpose-viewer>: a viewer as an element of any page. It is a guest there: it changes nothing outside itself, and lets the page scroll over it
// until somebody turns to it.

import { createApi, wordsOf } from "../api.js";
import { SHEET } from "./sheet.js";
import { letScroll } from "../guest.js";
import { Life, fieldsOf, textOf } from "./life.js";
import { transportOf } from "./transport.js";

/** Attributes that stand in links: their fields there. */
const FIELDS = {
  clip: "clip", "current-time": "t", speed: "speed", loop: "loop", camera: "cam", light: "light", background: "bg", "view-mode": "view",
  bone: "bone", skeleton: "bones",
};
/** What an attribute that is taken away leaves, where that is something. */
const FIRST = { bone: "", bones: 0, light: "studio", bg: "backdrop", view: "lit", speed: 1 };
const OTHERS = ["src", "link", "ui", "alt", "poster", "interaction", "loading"];
/** Attributes with few values: the first is what it is without one of them. */
const VALUES = {
  ui: ["transport", "none", "full"], backend: ["auto", "webgpu", "webgl2"], loading: ["auto", "lazy"], interaction: ["orbit", "none"],
};

/** What shows is in sight when it is this near to the window. */
const NEAR = "200px";

const box = (className) => Object.assign(document.createElement("div"), { className });

const inNoPage = () => new DOMException("the viewer is not in a page", "InvalidStateError");

/** A colour of CSS as links have it; what is no colour as it is. */
function hexOf(colour) {
  if (!CSS.supports("color", colour)) return colour;
  const pen = new OffscreenCanvas(1, 1).getContext("2d");
  pen.fillStyle = colour;
  return pen.fillStyle;
}

const prefersStill = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

export class BindposeViewerElement extends (globalThis.HTMLElement ?? class {}) {
  static observedAttributes = [...Object.keys(FIELDS), ...OTHERS];

  /** What the element does for its life: life.js. */
  #teller = {
    event: (type) => this.#tell(type),
    progress: (part) => this.#tellProgress(part),
    load: () => this.#tellLoad(),
    error: (error) => this.#tellError(error),
    camera: (state) => this.#tellCamera(state),
    nameCanvas: () => this.#nameCanvas(),
    update: () => this.#transport.update(),
    moment: () => this.#moment(),
    theme: () => this.#theme,
  };
  #life = null;
  #wasBehind = null;
  #later = []; // What was asked of a model that is not there yet.
  #kept = null;
  #view;
  #transport;
  #over = {};
  #error = null;
  #camera = "";
  #sight;
  #isNear = false;
  #resolveReady;

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(SHEET);
    root.adoptedStyleSheets = [sheet];
    const [frame, stage] = ["frame", "stage"].map(box);
    this.#view = box("view");
    const over = (name, fallback) => {
      const slot = Object.assign(document.createElement("slot"), { name });
      slot.append(fallback);
      this.#over[name] = Object.assign(box(`over ${name}`), { hidden: true });
      this.#over[name].append(slot);
      return this.#over[name];
    };
    const [bar, words] = ["progress", "p"].map((tag) => document.createElement(tag));
    bar.setAttribute("aria-label", "Loading");
    words.setAttribute("role", "alert");
    this.#transport = transportOf(this);
    stage.append(this.#view, over("poster", new Image()), over("progress", bar), over("error", words));
    frame.append(stage, this.#transport.bar);
    root.append(frame);
    this.#transport.bar.hidden = this.ui !== "transport";
    this.#transport.update();
    letScroll(this.#view);
    // The styles of the page have changed.
    frame.addEventListener("transitionend", ({ target }) => {
      if (target === this.#view) this.#life?.viewer?.setTheme?.(this.#theme);
      if (target !== frame || !this.#life?.isShown || this.#behind === this.#wasBehind || this.hasAttribute("background")) return;
      this.#wasBehind = this.#behind;
      this.#life.follow(`bg=${this.#behind ?? FIRST.bg}`, true);
    });
    this.#sight = globalThis.IntersectionObserver && new IntersectionObserver((entries) => this.#see(entries.at(-1).isIntersecting), { rootMargin: NEAR });
  }

  connectedCallback() {
    // What scripts set before the module was there hides what the element has by these names.
    for (const name of Object.keys(this).filter((name) => name in BindposeViewerElement.prototype)) {
      const value = this[name];
      delete this[name];
      this[name] = value;
    }
    this.#showPoster(true);
    this.#sight?.observe(this);
    if (this.loading !== "lazy" || this.#isNear) this.#begin();
  }

  disconnectedCallback() {
    // Who is moved within the page is there again before this script ends.
    queueMicrotask(() => {
      if (this.isConnected) return;
      this.#sight?.disconnect();
      this.#isNear = false;
      this.#kept = this.#life?.finish() ?? this.#kept;
      this.#life = null;
    });
  }

  attributeChangedCallback(name, before, value) {
    // A moment that is asked for once more is shown once more.
    if (name in FIELDS || name === "link") return this.#follow(name);
    if (before === value) return;
    if (name === "poster") this.#showPoster(!this.#over.poster.hidden);
    if (["alt", "interaction"].includes(name)) this.#nameCanvas();
    if (name === "loading" && this.loading === "auto") this.#begin();
    if (name === "ui") this.#restart(before);
    if (name === "src") this.#kept = null;
    if (name === "src" && this.#life) {
      this.#later = [];
      this.#error = null;
      this.#over.error.hidden = true;
      Object.assign(this.#life, { wasGiven: false, kept: null });
      if (this.#life.viewer) void this.#life.show();
    }
  }

  /** Does something with a viewer that shows its model, at once or when it does. */
  #whenShown(work) {
    if (this.#life?.isShown) work(this.#life.api.bindpose);
    else this.#later.push(work);
  }

  // As media elements have them.

  play() {
    this.#whenShown((bindpose) => bindpose.play());
  }

  pause() {
    this.#whenShown((bindpose) => bindpose.pause());
  }

  get paused() {
    return !this.state().playing;
  }

  get ended() {
    return this.paused && this.duration > 0 && this.currentTime >= this.startTime + this.duration;
  }

  /** Seconds on the clip's own clock. */
  get currentTime() {
    return this.state().timeSecs;
  }

  set currentTime(secs) {
    this.#whenShown((bindpose) => bindpose.seek(secs));
  }

  /** Where the clip begins, seconds. */
  get startTime() {
    return this.#clip?.startSecs ?? 0;
  }

  /** Seconds; not a number while there is no clip. */
  get duration() {
    const clip = this.#clip;
    return clip ? clip.endSecs - clip.startSecs : NaN;
  }

  get playbackRate() {
    return this.state().speed ?? 1;
  }

  set playbackRate(factor) {
    this.#whenShown((bindpose) => bindpose.setSpeed(factor));
  }

  /** The name of the clip on show. */
  get clip() {
    return this.state().clip ?? null;
  }

  set clip(name) {
    this.#whenShown((bindpose) => (this.clips.includes(name) ? bindpose.selectClip(name) : this.#life.warnOf(["clip"])));
  }

  /** The names of all clips. */
  get clips() {
    return this.state().model?.clips.map(({ name }) => name) ?? [];
  }

  get error() {
    return this.#error;
  }

  /** As `bindpose.state()` of the page has it. */
  state() {
    return (this.#life?.api ?? NOTHING).bindpose.state();
  }

  /** The books' toRoot of a bone in the pose on show, 16 numbers with the translation at 12 to 14; `undefined` where there is no such bone. */
  boneToRoot(bone) {
    return this.#life?.api.bindpose.boneToRoot(bone);
  }

  /** Opens `File`s or `{name, bytes}` records in place of what `src` names. Resolves with the state after it. */
  async open(files) {
    if (!this.#life) this.#begin();
    if (!this.#life) throw inNoPage();
    return this.#life.openGiven(Array.from(files), this.#moment());
  }

  /** A PNG of what is seen, as a `Blob`; the page's `snapshot` has the options. */
  snapshot(options) {
    return this.#life ? this.#life.api.bindpose.snapshot(options) : Promise.reject(inNoPage());
  }

  /** What a link to what the attributes ask for has behind its `#`. */
  #moment() {
    const fields = new Map();
    for (const [attribute, field] of Object.entries(FIELDS)) {
      const value = this.#valueOf(attribute);
      if (value !== null) fields.set(field, value);
    }
    fields.set("play", Number(this.hasAttribute("autoplay") && !prefersStill()));
    for (const [field, value] of this.#linked) fields.set(field, value);
    this.#wasBehind = this.#behind;
    if (!fields.has("bg") && this.#behind) fields.set("bg", this.#behind);
    return textOf(fields);
  }

  /** The fields of the attribute `link`. */
  get #linked() {
    const fields = fieldsOf((this.getAttribute("link") ?? "").replace(/^.*#/, ""));
    for (const ofPage of ["model", "sha"]) fields.delete(ofPage); // Which file it is about says `src`.
    return fields;
  }

  /** The colour that the page's styles have behind the model, as links have it; `null` for none. */
  get #behind() {
    const { backgroundColor } = getComputedStyle(this.#view.closest(".frame"));
    const isNamed = getComputedStyle(this).getPropertyValue("--bindpose-background") !== "";
    return isNamed && backgroundColor.startsWith("rgb(") ? encodeURIComponent(hexOf(backgroundColor)) : null;
  }

  /** `light` or `dark`, as the page has it where the element is. */
  get #theme() {
    return getComputedStyle(this.#view).color === "rgb(0, 0, 0)" ? "light" : "dark";
  }

  #tell(type, detail) {
    this.#transport.update();
    this.dispatchEvent(new CustomEvent(type, { detail }));
    if (type === "pause" && this.ended) this.dispatchEvent(new CustomEvent("ended"));
  }

  #tellProgress(part) {
    const { progress } = this.#over;
    progress.hidden = this.#life?.files !== undefined || part >= 1;
    progress.querySelector("progress").value = part;
    this.dispatchEvent(new CustomEvent("progress", { detail: { totalProgress: part } }));
  }

  #tellLoad() {
    this.#error = null;
    this.#over.error.hidden = true;
    this.#showPoster(false);
    this.#tellProgress(1);
    this.#nameCanvas();
    for (const work of this.#later.splice(0)) work(this.#life.api.bindpose);
    this.#tell("load");
    if (!this.#isNear && this.#sight) this.#life.setInSight(false);
  }

  #tellError(error) {
    this.#error = error;
    const words = this.#over.error.querySelector("p");
    words.textContent = wordsOf(error);
    this.#over.error.hidden = false;
    this.#over.progress.hidden = true;
    this.dispatchEvent(new CustomEvent("error", { detail: { message: wordsOf(error) } }));
  }

  #tellCamera(camera) {
    const now = JSON.stringify(camera);
    if (now === this.#camera) return;
    const isFirst = !this.#camera;
    this.#camera = now;
    if (!isFirst) this.dispatchEvent(new CustomEvent("camera-change", { detail: camera }));
  }

  #nameCanvas() {
    const canvas = this.#view.querySelector("canvas");
    const name = this.state().model?.name;
    if (!canvas) return;
    canvas.tabIndex = this.interaction === "none" ? -1 : 0;
    canvas.setAttribute("role", this.ui === "full" ? "application" : "img");
    const words = this.getAttribute("alt") ?? (name ? `3D view of ${name}` : "3D view");
    canvas.setAttribute("aria-label", words);
    this.#transport.bar.setAttribute("aria-label", `Timeline: ${words}`);
  }

  get #clip() {
    const { model, clip } = this.state();
    return model?.clips.find(({ name }) => name === clip);
  }

  #valueOf(attribute) {
    const value = this.getAttribute(attribute);
    if (attribute === "loop") return value === null ? "once" : value || "loop";
    if (value === null) return null;
    if (attribute === "skeleton") return Number(!["0", "false"].includes(value));
    if (attribute === "camera") return value.trim().split(/[\s,]+/).join();
    return encodeURIComponent(attribute === "background" ? hexOf(value) : value);
  }

  #begin() {
    if (this.#life || !this.isConnected) return;
    this.#life = new Life(this, this.#teller, this.#view, this.#kept);
    this.#kept = null;
    this.#over.progress.hidden = !this.src;
    this.#over.progress.querySelector("progress").removeAttribute("value"); // Until something is known.
    void this.#life.run();
  }

  /** Another interface starts anew, with the same files and moment. */
  #restart(before) {
    const isFull = (name) => name === "full";
    this.#transport.bar.hidden = this.ui !== "transport";
    if (!this.#life || isFull(before) === isFull(this.ui)) return;
    this.#kept = this.#life.finish();
    this.#life = null;
    this.#begin();
  }

  /** One attribute has changed: the rest of what is seen stays. */
  #follow(name) {
    const life = this.#life;
    if (!life?.files || life.over) return;
    const value = this.#valueOf(name) ?? FIRST[FIELDS[name]];
    if (name === "link") life.follow(textOf(this.#linked), true);
    else if (value !== undefined) life.follow(textOf([[FIELDS[name], value]]), true);
    this.#transport.update();
  }

  #see(isNear) {
    this.#isNear = isNear;
    if (isNear) this.#begin();
    this.#life?.setInSight(isNear);
  }

  #showPoster(isShown) {
    const { poster } = this.#over;
    const address = this.getAttribute("poster");
    const image = poster.querySelector("img");
    image.hidden = !address;
    image.alt = "";
    if (address) image.src = address;
    poster.hidden = !isShown;
  }
}

// The other attributes are properties of their names; those that need no value are also set by `true` and `false`.
for (const attribute of [...BindposeViewerElement.observedAttributes, "autoplay", "backend"]) {
  const name = attribute.replace(/-(.)/g, (_, letter) => letter.toUpperCase());
  if (name in BindposeViewerElement.prototype) continue;
  Object.defineProperty(BindposeViewerElement.prototype, name, {
    get() {
      const value = this.getAttribute(attribute);
      if (["autoplay", "loop"].includes(name)) return value !== null;
      const values = VALUES[name];
      return values ? values.find((known) => known === value) ?? values[0] : value ?? "";
    },
    set(value) {
      // Bones that a link shows are hidden too.
      if (value === false && attribute === "skeleton") this.setAttribute(attribute, "false");
      else if (value === false || value === null) this.removeAttribute(attribute);
      else this.setAttribute(attribute, value === true ? "" : value);
    },
    enumerable: true,
    configurable: true,
  });
}

/** What a viewer says that is in no page. */
const NOTHING = globalThis.EventTarget && createApi();

if (globalThis.customElements && !customElements.get("bindpose-viewer")) customElements.define("bindpose-viewer", BindposeViewerElement);
