// Types of the element and of what it tells. `null` is what is not there.

/** Yaw, pitch and distance of the camera about what it looks at. */
export interface CameraState {
  target: [number, number, number];
  distance: number;
  yawRadians: number;
  pitchRadians: number;
  orthographic: boolean;
}

/** A clip; times in seconds of its own clock. */
export interface Clip {
  name: string;
  startSecs: number;
  endSecs: number;
  /** The unit of a frame. */
  keysPerSec: number;
  keys: number;
}

export interface Model {
  name: string;
  path: string;
  opening: number | null;
  dialect: "d3d11" | "d3d12" | "imm" | "txt" | "glb" | "gltf" | "fbx" | "fbx-text";
  handedness: "left" | "right";
  upAxis: "y" | "z";
  counts: { materials: number; vertices: number; triangles: number; bones: number; clips: number };
  bones: { name: string | null; parent: number | null }[];
  materials: string[];
  clips: Clip[];
  bindBounds: { min: [number, number, number]; max: [number, number, number] } | null;
}

/** What is wrong with a file, or worth knowing of it. Lines and columns count from 1, columns in bytes. */
export interface Finding {
  severity: "note" | "warning" | "error";
  code: string;
  message: string;
  expected: string | null;
  found: string | null;
  line: number | null;
  column: number | null;
  jsonPointer: string | null;
  byteOffset: number | null;
  subject: { kind: "material" | "subset" | "vertex" | "triangle" | "bone" | "clip"; index: number } | null;
  timeSecs: number | null;
  bone: number | null;
  count: number;
  places: { line: number; column: number }[];
}

/** What a book's program makes of the file. */
export interface Verdict {
  reads: boolean;
  line: number | null;
  column: number | null;
  why: string | null;
  shows: string;
  ends: boolean;
  limits: { code: string; message: string }[];
}

export interface Look {
  light: "studio" | "book";
  split: number | null;
  viewMode: string;
  background: string;
  overlays: string[];
  /** Stops. */
  exposure: number;
  passes: Record<string, "drawn" | "off" | "too slow">;
  renderScale: number;
  quality: "auto" | "full" | "low";
  samples: number;
  refined: boolean;
  lowered: { scale: number; occlusion: string; shadow: string; frameMillis: number } | null;
}

/** What a viewer shows and how. */
export interface State {
  backend: "webgpu" | "webgl2" | null;
  adapter: string | null;
  model: Model | null;
  /** Paths of all models that are open. */
  models: string[];
  opening: { name: string; stage: string; percent: number } | null;
  /** Milliseconds of each stage of the last opening. */
  timings: Record<string, number>;
  textures: { named: number; missing: string[]; unreadable: string[] };
  blend: { clip: string | null; share: number } | null;
  timeSecs: number;
  playing: boolean;
  backward: boolean;
  clip: string | null;
  rangeSecs: [number, number] | null;
  speed: number;
  loop: "once" | "loop" | "pingpong";
  wrap: string;
  camera: CameraState;
  gridVisible: boolean;
  look: Look;
  skeleton: {
    selected: number | null;
    vertex: number | null;
    bonesVisible: boolean;
    boneStyle: string;
    labelsVisible: boolean;
    skinView: string | null;
    bindShare: number;
    /** Names that a person gave, by the bone's number. */
    names: Record<string, string>;
  };
  crowd: { count: number; seed: number; selected: number };
  cost: { cpuMs: number | null; gpuMs: Record<string, number> | null; vertices: number; uploadedBytes: number };
  undo: string | null;
  redo: string | null;
  framesRendered: number;
  theme: string | null;
  /** What stands behind `#` in a link to what is seen. */
  link: string;
  notices: Finding[];
  /** Of the program with the interface. */
  book: { d3d11: Verdict | null; d3d12: Verdict | null; converted: { fits: boolean; limits: { code: string; message: string }[] } | null } | null;
  error: (Finding & { file: string | null }) | null;
}

/** Before a viewer runs, its state says no more than this. */
export type EarlyState = Partial<State> & Pick<State, "backend" | "model" | "error">;

/** A file to open; a path with folders as its name. */
export type NamedBytes = { name: string; bytes: Uint8Array | ArrayBuffer | Blob };

export interface SnapshotOptions {
  width?: number;
  height?: number;
  transparent?: boolean;
  light?: string;
  viewMode?: string;
  background?: string;
  split?: number;
  overlays?: string[];
  samples?: number;
  aperture?: number;
}

export interface BindposeViewerEventMap extends HTMLElementEventMap {
  load: CustomEvent<null>;
  /** 0…1. */
  progress: CustomEvent<{ totalProgress: number }> & ProgressEvent<EventTarget>;
  error: CustomEvent<{ message: string }> & ErrorEvent;
  play: CustomEvent<null>;
  pause: CustomEvent<null>;
  /** After `pause`, where the clip ends. */
  ended: CustomEvent<null> & Event;
  timeupdate: CustomEvent<null>;
  "camera-change": CustomEvent<CameraState>;
}

/**
 * `<bindpose-viewer>`: its attributes, each a property too, are those of the README. What is asked before the model is there (`currentTime = 0.5`, `play()`) is
 * done then.
 */
export class BindposeViewerElement extends HTMLElement {
  /** Addresses of the model and its pictures, with spaces between. */
  src: string;
  ui: "transport" | "none" | "full";
  loading: "auto" | "lazy";
  alt: string;
  poster: string;
  interaction: "orbit" | "none";
  link: string;
  camera: string;
  light: string;
  background: string;
  viewMode: string;
  bone: string;
  speed: string;
  get skeleton(): string;
  set skeleton(shown: string | boolean);
  get loop(): boolean;
  /** `pingpong` goes back and forth. */
  set loop(how: boolean | "loop" | "pingpong");
  autoplay: boolean;
  /** How it draws. Read when it starts. */
  backend: "auto" | "webgpu" | "webgl2";
  play(): void;
  pause(): void;
  readonly paused: boolean;
  readonly ended: boolean;
  /** Seconds on the clip's own clock, which begins at `startTime`. */
  currentTime: number;
  readonly startTime: number;
  readonly duration: number;
  playbackRate: number;
  /** The name of the clip on show. */
  get clip(): string | null;
  set clip(name: string);
  readonly clips: string[];
  readonly error: Error | null;
  state(): State | EarlyState;
  /**
   * The books' toRoot of a bone in the pose on show: 16 numbers, row by row for row vectors, in the file's space and units; the translation is at 12 to 14, its
   * height at 13 where `state().model.upAxis` is `y`, else at 14.
   */
  boneToRoot(bone: number): Float32Array | undefined;
  open(files: Iterable<File | NamedBytes>): Promise<State>;
  snapshot(options?: SnapshotOptions): Promise<Blob>;
  addEventListener<K extends keyof BindposeViewerEventMap>(
    type: K,
    listener: (this: BindposeViewerElement, event: BindposeViewerEventMap[K]) => unknown,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
}

declare global {
  interface HTMLElementTagNameMap {
    "bindpose-viewer": BindposeViewerElement;
  }
}
