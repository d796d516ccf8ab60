// A viewer from when its element comes into a page until it leaves it: its program, its canvas, its files.

import { createApi } from "../api.js";
import { handOver, hasOpened } from "../handing_over.js";
import { mirrorOf } from "../mirror.js";
import { servePanels } from "./panels.js";
import { compile, fetchProgram, nameFor } from "../program.js";
import { keepDrawn } from "../restart.js";
import { fetchFrom, joined, recordOf } from "../sources.js";

/** Programs that are here or on their way, by name: the viewers of a page share them. */
const programs = new Map();

/** A compiled program. `progress(part)` hears how much of it has arrived, where that is known. */
function programOf(name, progress) {
  if (!programs.has(name)) {
    const heard = new Set();
    const tell = (arrived, total) => total > 0 && heard.forEach((hear) => hear(arrived / total));
    const loading = fetchProgram(name).then((program) => compile(program, tell));
    loading.catch(() => programs.delete(name)); // The next viewer tries again.
    programs.set(name, { loading, heard });
  }
  const { loading, heard } = programs.get(name);
  heard.add(progress);
  return loading.finally(() => heard.delete(progress));
}

/** Viewers that live; a panic ends them all, since they share a memory. */
const living = new Set();
const endAll = (error) => living.forEach((life) => life.fail(error));
const hearError = ({ error }) => {
  if (error?.name === "Panic") return endAll(error);
  if (!(error instanceof WebAssembly.RuntimeError)) return;
  // The page may have programs of its own: one of ours that has trapped answers no more.
  try {
    for (const { viewer } of living) viewer?.state();
  } catch {
    endAll(error);
  }
};

/** The fields of a link, in order. */
export const fieldsOf = (text) => new Map(text.split("&").filter(Boolean).map((field) => [field.split("=")[0], field.slice(field.indexOf("=") + 1)]));
export const textOf = (fields) => [...fields].map(([name, value]) => `${name}=${value}`).join("&");

/**
 * A viewer from when its element came into a page until it leaves it: `host` is the element, `view` what its canvas lies in, `kept` what an earlier life was
 * ended with. `teller` has what the element does for it: `event(type)`, `progress(part)`, `load()`, `error(error)`, `camera(state)`, `nameCanvas()`,
 * `update()` of what shows how it plays, `moment()`, the link to what its attributes ask for, and `theme()`.
 */
export class Life {
  constructor(host, teller, view, kept) {
    Object.assign(this, { host, teller, view, kept, api: createApi(), viewer: null, over: false, mirror: null, isShown: false, wasGiven: false });
    /** With the page's interface, which brings its own window; else the viewer is told of its size and of events. */
    this.isFull = host.ui === "full";
    this.fetching = new AbortController();
    this.listening = new AbortController();
    living.add(this);
    addEventListener("error", hearError);
  }

  /** Starts the viewer and shows what is to be shown. */
  async run() {
    try {
      const { backend } = this.host;
      await keepDrawn(this.nameOf(await nameFor(backend)), backend, this);
      if (!this.over && !this.wasGiven) await this.show();
    } catch (error) {
      this.fail(error);
    }
  }

  /** The name of the program for this interface. */
  nameOf(program) {
    if (this.isFull) return program;
    return program === "full" ? "smallFull" : "smallWebgpu";
  }

  full() {
    return this.nameOf("full");
  }

  /** Makes a viewer of a program on a canvas of its own. */
  async make(name) {
    const { module } = await programOf(name, (part) => this.teller.progress(part / 2));
    const isFull = name === this.full();
    if (this.over) throw new Error("the element left its page");
    this.viewer = new module.Viewer({ ui: "full", theme: this.teller.theme() }, (type, detail) => this.hear(type, detail));
    const canvas = document.createElement("canvas");
    const box = this.isFull ? document.createElement("div") : this.view;
    this.view.replaceChildren(...(this.isFull ? [box] : []));
    box.append(canvas);
    this.panels = this.isFull ? servePanels(box, this.forPanels()) : {};
    this.teller.nameCanvas();
    if (!this.isFull) this.attend();
    return { viewer: this.viewer, canvas, isFull };
  }

  keep(keeper) {
    this.keeper = keeper;
  }

  isOver() {
    return this.over;
  }

  onStart() {
    this.view.classList.add("drawn");
    this.teller.nameCanvas();
  }

  onEnd(error) {
    this.fail(error);
  }

  /** What the panels ask for. */
  forPanels() {
    const refused = (error) => this.over || error.name === "AbortError" || this.teller.error(error);
    const give = (files, addsClips) => (addsClips ? this.addClips(files) : this.openGiven(files, null));
    return {
      receive: (files, addsClips) => void give(Array.from(files), addsClips).catch(refused),
      refuse: (words) => this.teller.error(new Error(words)),
      again: () => void this.show(),
      openModel: () => this.viewer.state().model?.name ?? "",
      // A page of others has no links to what is seen in it.
      copy: async () => {
        const made = document.createElement("bindpose-viewer");
        made.setAttribute("src", this.host.src);
        made.setAttribute("link", this.viewer.link(0).text);
        await navigator.clipboard.writeText(made.outerHTML).then(() => this.viewer.tell("Copied as an element"), (error) => this.teller.error(error));
      },
    };
  }

  hold() {
    this.api.hold();
  }

  attach(viewer) {
    this.api.attach(viewer);
  }

  /** Brings what is open into another viewer. */
  async bring(from, to) {
    if (this.isFull) return handOver(from, to);
    await hasOpened(from);
    if (!this.files) return;
    const moment = this.moment(from);
    await to.open(this.files);
    if (this.clips.length) await to.addClips(this.clips);
    to.followLink(moment);
  }

  onBrought(error) {
    if (error) this.teller.error(error);
  }

  /** Tells the viewer of what a window would. A canvas may be replaced by a fresh one; what it lies in stays. */
  attend() {
    const canvas = () => this.view.querySelector("canvas");
    const resize = () => {
      const [width, height] = [this.view.clientWidth, this.view.clientHeight].map((side) => Math.max(Math.round(side * devicePixelRatio), 1));
      const { width: before, height: below } = canvas();
      if (width === before && height === below) return;
      // Until it starts, the viewer takes the canvas as it is.
      Object.assign(canvas(), { width, height });
      this.viewer.resize(width, height);
    };
    this.sizes?.disconnect();
    this.sizes = new ResizeObserver(resize);
    this.sizes.observe(this.view);
    resize();
    this.listening.abort(); // Of a program that gave way to another.
    const { signal } = (this.listening = new AbortController());
    const take = (event) => this.viewer.handle(event) && event.preventDefault();
    for (const type of ["pointerdown", "pointermove", "pointerup", "pointercancel", "click", "wheel", "keydown"]) this.view.addEventListener(type, take, { signal, passive: false });
    this.view.addEventListener("contextmenu", (event) => event.preventDefault(), { signal });
  }

  /** Opens what was open before, or what the element names, and shows the moment that it names. A later call gives an earlier one up. */
  async show() {
    this.fetching.abort();
    const { signal } = (this.fetching = new AbortController());
    try {
      const fresh = async () => ({ files: await this.fetch(signal), clips: [], moment: this.teller.moment() });
      const { files, clips, moment } = this.kept ?? (await fresh());
      if (signal.aborted || !files.length) return;
      await this.open(files, moment, clips);
      this.kept = null;
    } catch (error) {
      if (!signal.aborted && error.name !== "AbortError") this.teller.error(error);
    }
  }

  async fetch(signal) {
    const addresses = (this.host.getAttribute("src") ?? "").split(/\s+/).filter(Boolean);
    let [wanted, arrived] = [0, 0];
    return fetchFrom(addresses.map((address) => new URL(address, document.baseURI).href), {
      signal,
      began: (_, bytes) => (wanted += bytes),
      got: (bytes) => {
        arrived += bytes;
        if (wanted) this.teller.progress(0.5 + Math.min(arrived / wanted, 1) / 2);
      },
    });
  }

  /** Opens what a person or a script gave, in place of what the element names. */
  openGiven(files, moment) {
    this.fetching.abort();
    this.wasGiven = true;
    this.kept = null;
    return this.open(files, moment);
  }

  /** Opens files and goes to a moment in them, if one is named. Resolves with the state, which has an `error` where they could not be opened. */
  async open(files, moment, clips = []) {
    this.isShown = false;
    const state = await this.give(files, "open");
    if (state.error) {
      this.teller.error(new Error(state.error.message));
      return state;
    }
    const { error } = clips.length ? await this.addClips(clips) : state;
    if (error) this.teller.error(new Error(error.message));
    if (moment !== null) this.follow(moment);
    this.isShown = true;
    this.teller.load();
    return this.api.bindpose.state();
  }

  /** Adds the clips of files to those of the model. */
  addClips(files) {
    return this.give(files, "addClips");
  }

  /** Gives files to the viewer. Pictures and clips that join a model are kept beside it, for when the element comes back. */
  async give(files, how) {
    let joins;
    const state = await this.api.give(files, how, (before, { model }) => (joins = before.model && before.model.opening === model?.opening));
    if (state.error) return state;
    const [list, records] = [how === "open" ? "files" : "clips", files.map(recordOf)];
    Object.assign(this, this.files && joins ? { [list]: joined(this[list], records) } : { files: records, clips: [] });
    return state;
  }

  /** Shows the moment of a link, or a change of what is seen, as far as the model and the viewer know it. */
  follow(moment, isChange = false) {
    const leftOut = this.viewer.followLink(moment, isChange);
    if (leftOut.length) this.warnOf(leftOut);
  }

  warnOf(fields) {
    console.warn(`<bindpose-viewer>: not understood, or not in ${this.api.bindpose.state().model?.name}: ${fields.join(", ")}`, this.host);
  }

  /** What the viewer tells. */
  hear(type, detail) {
    if (this.over) return;
    if (type === "devicelost") return void this.keeper.restart(detail.reason);
    if (type === "mirror") {
      if (detail.changes.fresh) {
        this.mirror?.remove();
        this.mirror = mirrorOf(this.viewer, this.view.querySelector("canvas"), this.panels.pick);
      }
      return this.mirror?.take(detail);
    }
    if (this.panels[type]) return void this.panels[type](detail);
    if (!this.isShown) return;
    if (["play", "pause", "timeupdate"].includes(type)) this.teller.event(type);
    if (type === "playbackchange") this.teller.update();
    if (type === "settling") this.teller.camera(this.viewer.state().camera);
  }

  /** Nothing is drawn while nobody sees it. */
  setInSight(isInSight) {
    if (!this.over) this.viewer?.setVisible(isInSight);
  }

  fail(error) {
    if (this.over) return;
    this.api.fail(error);
    this.finish(false);
    this.teller.error(error);
  }

  /** Gives the GPU and the program's objects back. Returns what is open and seen, or what was still to be, for another life. */
  finish(isSound = true) {
    if (this.over) return null;
    const moment = isSound && this.files ? this.moment() : null;
    this.over = true;
    this.fetching.abort();
    this.listening.abort();
    this.sizes?.disconnect();
    living.delete(this);
    if (!living.size) removeEventListener("error", hearError);
    this.mirror?.remove();
    if (isSound) this.viewer?.free();
    this.view.replaceChildren();
    this.view.classList.remove("drawn");
    return this.kept ?? (moment === null ? null : { files: this.files, clips: this.clips, moment });
  }

  /** The link to what is seen, with whether it plays. */
  moment(viewer = this.viewer) {
    const fields = fieldsOf(viewer.link(0).text);
    return textOf(fields.set("play", Number(viewer.state().playing)));
  }
}
