// The address as a link to what is seen: written when that rests, followed when the page opens and when another link is clicked. Behind `#`
// stands what the viewer says of itself, and before that which model it is about, where the page does not open that one by itself.

/** The most characters of an address, as the viewer has it for what it writes. */
const MOST_CHARACTERS = 2_000;

/** A link is written so long after the last change. */
const RESTS_AFTER_MS = 250;

/** And no more often than this. */
const EVERY_MS = 500;

/** A file is known by so many digits of its SHA-256. */
const DIGITS = 12;

const baseName = (path) => path.split("/").pop();

/** `{model, sha, view}` of a text behind `#`: the model's name and digest where it says one, and the rest, which the viewer reads. */
function parsed(text) {
  const found = { view: [] };
  for (const field of text.split("&")) {
    const [name, ...value] = field.split("=");
    if (name !== "model" && name !== "sha") {
      found.view.push(field);
      continue;
    }
    try {
      found[name] = decodeURIComponent(value.join("="));
    } catch {
      found.view.push(field); // The viewer names it as unknown.
    }
  }
  return { ...found, view: found.view.join("&") };
}

const asking = (name) => `This link is about ${baseName(name)}: open or drop it to see the same moment.`;

/** The first digits of the SHA-256 of bytes; nothing where the page may not know it: it came without `https:`. */
async function digestOf(bytes) {
  const digest = new Uint8Array((await globalThis.crypto?.subtle?.digest("SHA-256", bytes)) ?? []);
  return [...digest].map((byte) => byte.toString(16).padStart(2, "0")).join("").slice(0, DIGITS);
}

/**
 * Keeps the address and what is seen together. The page gives what it does otherwise: `viewer()`, or null while there is none; `changed(link)`
 * hears of another link, `follow(view)` shows one and names what is left out, `ask(words)` asks for a file, `tell(words)` says what was opened in its place and `refuse(names, words)` what was left out too.
 */
export function keepLink({ viewer, changed, follow, ask, tell, refuse }) {
  let own = null; // What the page opened by itself: its opening and path.
  let opensOwn = false; // Whether it does so now.
  let model = { opening: null, path: null, sha: "" }; // On screen.
  let wanted = null; // A link that waits for its model.
  let seen = null; // The link when it was looked at last.
  let last = null; // The one that was told last.
  let heard = location.hash.slice(1); // What stands behind the `#`, as far as this page knows.
  let timer = 0;
  let writtenAt = -EVERY_MS;

  const isOwn = ({ opening, path }) => opening === own?.opening && path === own?.path;

  /** What is seen as a text behind `#`, the address before that, and the names of what has no room. */
  const read = () => {
    const { opening, path } = model;
    const named = path && !isOwn({ opening, path }) ? [`model=${encodeURIComponent(path)}`, model.sha && `sha=${model.sha}`] : [];
    const address = location.href.split("#")[0];
    const whole = named.filter(Boolean).join("&");
    const start = address.length + whole.length < MOST_CHARACTERS ? whole : "";
    const { text, leftOut } = viewer()?.link(address.length + start.length + 2) ?? { text: "", leftOut: [] };
    if (start !== whole) leftOut.unshift("model");
    return { address, text: [start, text].filter(Boolean).join("&"), leftOut };
  };

  /** Nothing is written until what is seen rests. */
  const holdOff = () => {
    clearTimeout(timer);
    seen = last;
  };

  /** What is seen now is written once it rests. */
  const look = () => {
    // The address stays that of the link until the model is here that it is about.
    if (!viewer() || model.path === null || (wanted && isOwn(model))) return;
    const { text } = read();
    if (text === seen) return;
    seen = text;
    clearTimeout(timer);
    if (text !== last) timer = setTimeout(write, Math.max(RESTS_AFTER_MS, writtenAt + EVERY_MS - performance.now()));
  };

  const write = () => {
    if (!viewer() || model.path === null || (wanted && isOwn(model))) return;
    // A link was clicked, and its event is to come.
    if (location.hash.slice(1) !== heard) return;
    const { address, text } = read();
    last = seen = text;
    writtenAt = performance.now();
    if (text !== heard) history.replaceState(history.state, "", text ? `${address}#${text}` : address);
    heard = location.hash.slice(1);
    changed(text);
  };

  const show = ({ view }, words) => {
    wanted = null;
    ask(null);
    const leftOut = follow(view);
    if (leftOut.length) refuse(leftOut, words);
    else if (words) tell(words);
  };

  /** Shows the moment of the link that waits, if it is about the model on screen. */
  const showWanted = () => {
    const { model: name, sha } = wanted;
    if (name === undefined) return void show(wanted);
    if (isOwn(model) && name !== model.path) return;
    const isNamed = baseName(name) === baseName(model.path);
    const isSame = sha && model.sha ? sha === model.sha : null;
    if (isNamed && isSame !== false) return void show(wanted);
    if (isNamed) show(wanted, `${baseName(name)} has other bytes than the file that the link was made of`);
    else if (isSame) show(wanted, `${baseName(model.path)} is ${baseName(name)} of the link, under another name`);
    else if (!isOwn(model)) ask(`${baseName(model.path)} is another file. ${asking(name)}`);
  };

  return {
    /** Behind the `#`. */
    text: () => read().text,
    /** The whole address, the names of what it has no room for, and the file that who opens it is asked for. */
    whole() {
      const { address, text, leftOut } = read();
      const asksFor = model.opening === own?.opening || leftOut.includes("model") ? null : model.path;
      return { address: text ? `${address}#${text}` : address, leftOut, asksFor };
    },
    /** What comes until `work` is settled, the page opens by itself. Returns that. */
    opens(work) {
      opensOwn = true;
      const end = () => (opensOwn = false);
      work.then(end, end);
      return work;
    },
    /** Follows the link in the address, an empty one only where it was clicked. Its model may not be here yet. */
    follow(isClicked = false) {
      heard = location.hash.slice(1);
      const link = parsed(heard);
      if (!isClicked && link.model === undefined && !link.view) return;
      wanted = link;
      const { model: name } = link;
      // Without a name it is about what the page opens by itself, which may be in the list.
      if (name === undefined && own && model.path !== null && !isOwn(model) && viewer().openModel(own.path)) return;
      if (model.path !== null && !opensOwn) showWanted();
      if (!wanted || name === undefined || viewer().openModel(name)) return;
      ask(asking(name));
    },
    /** Another model is on screen. */
    async loaded() {
      const now = viewer().modelOnScreen() ?? { opening: null, path: null };
      model = { ...now, sha: "" };
      if (opensOwn) own = now;
      const sha = isOwn(now) || now.path === null ? "" : await digestOf(viewer().modelBytes()).catch(() => "");
      if (model.opening !== now.opening || model.path !== now.path) return;
      model.sha = sha;
      // Of its own model the page has more to set first.
      if (wanted && !opensOwn && now.path !== null) showWanted();
      look();
    },
    /** What is seen may be another. */
    settling: look,
    /** It changes by itself, or something is held. */
    moving: holdOff,
    /** Follows a link that was clicked, or one of before. */
    hashChanged() {
      const text = (heard = location.hash.slice(1));
      if (!viewer() || text === last) return;
      last = text;
      if (text || model.path !== null) this.follow(true);
    },
  };
}

/** An element that shows an address on another page, without a script of its own. */
export function embedding(address, name) {
  const shown = new URL(address);
  shown.searchParams.set("ui", "transport");
  const frame = document.createElement("iframe");
  Object.assign(frame, { src: shown.href, title: name, width: 640, height: 480, loading: "lazy", allowFullscreen: true });
  frame.style.border = "0";
  return frame.outerHTML;
}
