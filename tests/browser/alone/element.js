// The element's scripts where there is no page: a server that renders pages imports them too, and what is open is kept with stand-ins for viewers.

import assert from "node:assert/strict";
import { test } from "node:test";

test("the element's module can be imported where there are no elements", async () => {
  const { BindposeViewerElement } = await import("../../../web/element/bindpose-viewer.js");
  assert.equal(typeof BindposeViewerElement, "function");
  assert.equal(globalThis.customElements, undefined);
});

/** A file whose only byte says which it is of those of its name. */
const file = (name, byte = 1) => ({ name, bytes: Uint8Array.of(byte) });
const told = (files) => files.map(({ name, bytes }) => `${name} ${bytes[0]}`).join();

/** A viewer that keeps what it is asked for in `asked`: pictures join its model, other files bring one. */
function viewerOf() {
  const asked = [];
  let opening = 0;
  const state = () => ({ model: opening ? { opening } : null, opening: null, playing: false, error: null });
  return {
    asked,
    state,
    async open(files) {
      asked.push(`open ${told(files)}`);
      if (files.some(({ name }) => !name.endsWith(".png"))) opening += 1;
      return state();
    },
    async addClips(files) {
      asked.push(`add ${told(files)}`);
      opening ||= 1;
      return state();
    },
    link: () => ({ text: "clip=Stroll&t=1" }),
    followLink(moment) {
      asked.push(moment);
      return [];
    },
    free() {},
  };
}

/** The life of a viewer, which is there already, in an element without the page's interface. */
async function lifeOf(viewer, kept = null) {
  globalThis.addEventListener = globalThis.removeEventListener = () => {};
  const { Life } = await import("../../../web/element/life.js");
  const view = { replaceChildren() {}, classList: { remove() {} } };
  const life = Object.assign(new Life({ ui: "none" }, { load() {}, error: assert.ifError }, view, kept), { viewer });
  if (viewer) life.attach(viewer);
  return life;
}

/** What all that is open is asked for with. */
const ALL = ["open a.m3d 1,skin.png 1", "add walk.m3d 2,stroll.m3d 1", "clip=Stroll&t=1&play=0"];

test("clips that joined come with the model into another program and another life, the last of each file", async () => {
  const first = await lifeOf(viewerOf());
  await first.openGiven([file("a.m3d")], null);
  await first.addClips([file("walk.m3d")]);
  await first.addClips([file("walk.m3d", 2), file("stroll.m3d")]);
  await first.open([file("skin.png")], null);
  const other = viewerOf();
  await first.bring(first.viewer, other);
  assert.deepEqual(other.asked, ALL);
  const second = await lifeOf(viewerOf(), first.finish());
  await second.show();
  assert.deepEqual(second.viewer.asked, ALL);
  // They are of that model alone.
  await second.openGiven([file("b.m3d")], null);
  const third = viewerOf();
  await second.bring(second.viewer, third);
  assert.deepEqual(third.asked, ["open b.m3d 1", ALL[2]]);
  second.finish();
});

test("clips that come where nothing is open are the model that an element is brought back with", async () => {
  const life = await lifeOf(viewerOf());
  await life.addClips([file("walk.m3d")]);
  const { files, clips } = life.finish();
  assert.deepEqual([told(files), clips], ["walk.m3d 1", []]);
});

test("what a life was to bring back goes to the next one, if it ends before", async () => {
  const kept = { files: [file("a.m3d")], clips: [file("walk.m3d")], moment: "t=1" };
  assert.equal((await lifeOf(null, kept)).finish(), kept, "before its viewer is there");
  const life = await lifeOf(viewerOf(), kept);
  life.show();
  assert.equal(life.finish(), kept, "before its files are open");
});

test("clips that no longer fit are told, and the model is shown without them", async () => {
  const viewer = viewerOf();
  viewer.addClips = async () => ({ ...viewer.state(), error: { message: "walk.m3d has no clips to add." } });
  const kept = { files: [file("a.m3d")], clips: [file("walk.m3d")], moment: "t=1" };
  const life = await lifeOf(viewer, kept);
  const heard = [];
  Object.assign(life.teller, { error: ({ message }) => heard.push(message), load: () => heard.push("load") });
  await life.show();
  assert.deepEqual(heard, ["walk.m3d has no clips to add.", "load"]);
  assert.deepEqual(viewer.asked, ["open a.m3d 1", "t=1"]);
  life.finish();
});
