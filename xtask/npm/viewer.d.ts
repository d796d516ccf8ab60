// Types of the class `Viewer`, which the element is made over: who has a canvas of their own starts one on it. `null` is
// what is not there.

import type { NamedBytes, SnapshotOptions, State } from "./bindpose-viewer.js";

/** Compiles the program, whose file is `bindpose-viewer/viewer.wasm`. No `Viewer` can be made before it has resolved. */
export default function init(options: {
  module_or_path: RequestInfo | URL | Response | BufferSource | WebAssembly.Module;
}): Promise<unknown>;

export interface ViewerOptions {
  renderScale?: number;
  quality?: "auto" | "full" | "low";
  samples?: number;
  displaySecs?: number;
  theme?: "light" | "dark";
  light?: "studio" | "book";
  split?: number;
  ui?: "none" | "transport" | "full";
}

/** What draws, and on what. */
export interface Started {
  backend: "webgpu" | "webgl2";
  adapter: string;
}

/** What a viewer tells, with its detail; beside these what only the page around can do (`pickfiles`, `save`, `announce` …). */
export interface ViewerEventMap {
  load: { name: string | null };
  error: State["error"];
  play: { timeSecs: number };
  pause: { timeSecs: number };
  timeupdate: { timeSecs: number };
  playbackchange: Pick<State, "clip" | "rangeSecs" | "speed" | "loop" | "wrap">;
}

/** All that another viewer needs to go on with what is open. */
export interface HandedOver {
  openings: NamedBytes[][];
  model: string | null;
  clips: NamedBytes[][];
  sky: NamedBytes[];
  rest: string;
}

export interface ExportOptions {
  format?: "glb" | "d3d12" | "d3d11" | "txt";
  clips?: string[];
  inPlace?: boolean;
  range?: [number, number];
  closeLoop?: number;
  reduce?: number;
  forBook?: boolean;
}

/** What an export changes. */
export interface Change {
  code: string;
  message: string;
}

/** What the other format has no place for. */
export interface Loss extends Change {
  count: number;
}

export interface Exported {
  name: string;
  bytes: Uint8Array;
  changes: Change[];
  losses: Loss[];
}

export interface ContactSheetOptions extends SnapshotOptions {
  columns?: number;
  rows?: number;
  turntable?: boolean;
  signal?: AbortSignal;
}

/** What is open and how it is viewed, and the canvas that it is drawn on. */
export class Viewer {
  /** `onEvent` hears of `ViewerEventMap`, and of what only the page around can do. It may call any method but `free`. */
  constructor(options: ViewerOptions, onEvent: (type: string, detail: unknown) => void);
  /** Gives the canvas back and forgets what is open. */
  free(): void;
  /** Starts on a canvas that was never drawn on. Resolves when the first frame was drawn. */
  start(canvas: HTMLCanvasElement, options: { backend?: "auto" | "webgpu" | "webgl2" }): Promise<Started>;
  /** Gives the canvas back. What is open stays. */
  stop(): void;
  /** Learns whether anybody can see the canvas. Nothing is drawn while nobody can. */
  setVisible(visible: boolean): void;
  state(): State;

  /** Resolves with the state, which has a failure in its `error`. */
  open(files: NamedBytes[]): Promise<State>;
  /** The clips of models with the same bones join those of the open one. */
  addClips(files: NamedBytes[]): Promise<State>;
  /** One of the state's `models` again, by its path. Returns whether it is listed, as `closeModel` does. */
  openModel(path: string): boolean;
  closeModel(path: string): boolean;
  /** Forgets every choice, as a new viewer, once these files are ready. */
  startOver(files: NamedBytes[]): Promise<State>;
  /** Files are fetched that will be opened: gives the number by which `noteFetched` and `endFetching` go. */
  beginFetching(name: string): number;
  /** Returns whether they are still waited for. */
  noteFetched(fetching: number, bytes: number, promised: number): boolean;
  endFetching(fetching: number): void;
  modelOnScreen(): { path: string; opening: number | null } | null;
  modelBytes(): Uint8Array | undefined;
  handOver(): HandedOver;
  goOnFrom(rest: string): void;

  seek(secs: number): void;
  play(): void;
  pause(): void;
  /** Returns whether there is a clip of this name. */
  selectClip(name: string): boolean;
  stepFrames(frames: number): void;
  nextKey(): void;
  previousKey(): void;
  seekStart(): void;
  seekEnd(): void;
  setRangeStart(secs?: number): void;
  setRangeEnd(secs?: number): void;
  clearRange(): void;
  setSpeed(factor: number): void;
  setLoop(name: State["loop"]): boolean;
  setWrap(name: "wrap" | "book-demo"): boolean;
  boneToRoot(bone: number): Float32Array | undefined;

  setPass(name: "shadow" | "reflections" | "contact" | "ao", drawn: boolean): boolean;
  setQuality(name: "auto" | "full" | "low", options?: { samples?: number }): boolean;
  setSparing(sparing: boolean): void;
  setRenderScale(fraction: number): void;
  setCrowd(crowd: { count?: number; seed?: number; selected?: number }): void;

  /** What stands behind `#` in a link to what is seen; so many bytes of the address are `taken`. */
  link(taken: number): { text: string; leftOut: string[] };
  /** Shows what a link says. Returns the fields that are damaged, unknown or not of this model, cut short. */
  followLink(text: string, isChange?: boolean): string[];

  /** The bytes of a PNG. */
  snapshot(options: SnapshotOptions): Promise<Uint8Array>;
  contactSheet(options: ContactSheetOptions): Promise<Uint8Array>;
  exportModel(options: ExportOptions): Promise<Exported>;
  /** Return whether there was something to take back, or to do again. */
  undo(): boolean;
  redo(): boolean;

  /** A sentence above the timeline, with a button to open files; without words takes it away. */
  greet(words?: string): void;
  /** A sentence over the view for a while. */
  tell(words: string): void;
  /** Reads the names that are kept for the open model once more. */
  readNames(): void;
  /** What a person did with an element of the mirror, as `web/mirror.js` tells it. */
  act(asked: { node?: string; action: string; value?: unknown }): void;
  /** Returns whether the viewer uses the key. */
  press(event: KeyboardEvent): boolean;
  setMirrorFocused(focused: boolean): void;
}
