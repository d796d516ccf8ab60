// web/mirror.js without a browser and without a viewer: what it makes of records, and what it asks of the viewer.

import assert from "node:assert/strict";
import { test } from "node:test";
import { mirrorOf } from "../../../web/mirror.js";
import { pageOf } from "./dom.js";

const RECORD = {
  name: "", description: null, value: null, placeholder: null, number: null, min: null, max: null, step: null, on: null, expanded: null, popup: null,
  invalid: false, disabled: false, modal: false, focusable: true, stop: true, clickable: true, folds: false, settable: false, level: null, place: null,
  of: null, active: null, control: null, bounds: [0, 0, 10, 10], children: [],
};
const button = (id, more) => ({ ...RECORD, id, role: "button", name: id, ...more });
const slider = (number, more) => ({ ...RECORD, id: "time", role: "slider", name: "Time", number, min: 0, max: 10, step: 1, value: `${number} s`, settable: true, ...more });
const width = (number, more) => ({ ...RECORD, id: "width", role: "spinbutton", name: "Width", number, settable: true, ...more });

/** A mirror of these records. Gives its page, what the viewer was asked, `tell` of changed records and `at` for an element. */
function mirrorWith(records, options = {}) {
  const page = pageOf(options);
  const asked = [];
  const viewer = {
    act: (action) => void asked.push(action),
    press: (event) => (asked.push({ pressed: event.type, key: event.key, shift: event.shiftKey }), true),
    setMirrorFocused: (focused) => void asked.push({ focused }),
  };
  const mirror = mirrorOf(viewer, page.canvas, options.pick);
  let focus = null;
  const roots = records.map(({ id }) => id);
  const tell = (changed, more = {}) => {
    focus = more.focus === undefined ? focus : more.focus;
    mirror.take({ view: "a model", changes: { changed, removed: [], children: roots, focus, fresh: false, ...more } });
  };
  tell(records);
  const at = (id) => page.host.all().find(({ dataset }) => dataset.mirror === id);
  const actions = () => asked.splice(0).filter(({ action }) => action && action !== "scrollIntoView").map(({ action, value }) => (value === undefined ? action : `${action} ${value}`));
  return { ...page, asked, tell, at, actions };
}

test("a number that is being typed stays, whatever is told meanwhile, and is taken once it is complete", () => {
  const { at, tell, leave, actions } = mirrorWith([width(1920)]);
  const field = at("width");
  field.focus();
  actions();
  field.value = "12";
  field.dispatchEvent({ type: "input", bubbles: true });
  tell([width(1920, { bounds: [0, 50, 10, 10] })]);
  assert.equal(field.value, "12");
  field.value = "1280";
  field.dispatchEvent({ type: "input", bubbles: true });
  assert.deepEqual(actions(), []);
  field.dispatchEvent({ type: "change", bubbles: true });
  assert.deepEqual(actions(), ["setValue 1280"]);
  tell([width(1280)]);
  assert.equal(field.value, "1280");
  field.value = "7";
  field.dispatchEvent({ type: "input", bubbles: true });
  leave();
  assert.equal(field.value, "1280", "what was not completed is left");
});

test("a key that is held on a slider or a button is one step to undo", () => {
  const { at, down, up, leave, actions } = mirrorWith([slider(3), button("Hide")]);
  at("time").focus();
  actions();
  down("ArrowRight");
  for (const _ of [1, 2]) down("ArrowRight", { repeat: true });
  up("ArrowRight");
  assert.deepEqual(actions(), ["hold", "setValue 4", "setValue 5", "setValue 6", "release"]);
  at("Hide").focus();
  actions();
  down("Enter");
  up("Enter");
  assert.deepEqual(actions(), ["hold", "click", "release"]);
  down("Enter");
  leave();
  assert.deepEqual(actions(), ["hold", "click", "release"], "it comes up elsewhere");
});

test("Home and End go to the ends of a slider whose steps are long, wherever it shows itself", () => {
  const { at, down, up, actions } = mirrorWith([slider(0.3, { max: 0.5, step: 0.5 })]);
  at("time").focus();
  actions();
  down("End");
  up("End");
  assert.deepEqual(actions(), ["hold", "setValue 0.5", "release"]);
  down("Home");
  up("Home");
  assert.deepEqual(actions(), ["hold", "setValue 0", "release"]);
});

test("keys that are held when the focus moves come up where it is then", () => {
  const { at, down, up, asked } = mirrorWith([button("One frame on"), button("Play")]);
  at("Play").focus();
  asked.length = 0;
  down("Shift", { shiftKey: true });
  down("Tab", { shiftKey: true });
  assert.equal(at("Play").page.focused, at("One frame on"));
  up("Shift");
  assert.deepEqual(asked.filter(({ pressed }) => pressed), [
    { pressed: "keydown", key: "Shift", shift: true },
    { pressed: "keyup", key: "Shift", shift: false },
  ]);
});

test("the viewer hears when the focus leaves the page, so that it forgets what is held", () => {
  const { at, down, up, leave, asked } = mirrorWith([button("Play")]);
  at("Play").focus();
  down("Alt", { altKey: true });
  leave();
  asked.length = 0;
  at("Play").focus();
  up("Alt");
  assert.deepEqual(asked.filter(({ pressed }) => pressed), [], "what went down before is forgotten here too");
});

test("the focused grid names its active cell, which another key makes another one", () => {
  const cell = (id) => ({ ...RECORD, id, role: "gridcell", name: `key ${id}`, focusable: false });
  const row = (children) => ({ ...RECORD, id: "row", role: "row", focusable: false, clickable: false, place: 3, children });
  const grid = (active) => ({ ...RECORD, id: "grid", role: "grid", name: "Keys of all bones", of: 40, clickable: false, children: ["row"], active });
  const { at, tell, down, asked } = mirrorWith([cell("a"), row(["a"]), grid("a")]);
  at("grid").focus();
  const active = () => at("grid").getAttribute("aria-activedescendant");
  assert.equal(active(), at("a").id);
  assert.equal(at("a").textContent, "key a");
  assert.deepEqual([at("grid").getAttribute("aria-rowcount"), at("row").getAttribute("aria-rowindex")], ["40", "3"]);
  asked.length = 0;
  down("ArrowRight");
  assert.deepEqual(asked, [{ pressed: "keydown", key: "ArrowRight", shift: false }], "the viewer moves it");
  tell([cell("b"), row(["b"]), grid("b")], { removed: ["a"], children: ["grid"] });
  assert.equal(active(), at("b").id);
  assert.equal(at("b").parentElement, at("row"));
  const other = mirrorWith([cell("a"), row(["a"]), grid("a")]);
  assert.notEqual(other.at("a").id, at("b").id.replace(/b$/, "a"), "ids are the page's, and a page may have two mirrors");
});

test("a slider that moves by itself is read out when it rests, and one that a person moves at once", ({ mock }) => {
  mock.timers.enable({ apis: ["setTimeout"] });
  mock.method(performance, "now", () => 10_000);
  const { at, tell, down, actions } = mirrorWith([slider(0)]);
  const time = at("time");
  const spoken = () => time.getAttribute("aria-valuetext");
  tell([slider(1)]);
  assert.equal(spoken(), "1 s", "nobody listens");
  time.focus();
  for (const second of [2, 3, 4, 5]) {
    tell([slider(second)]);
    mock.timers.tick(250);
    assert.equal(spoken(), "1 s");
  }
  mock.timers.tick(600);
  assert.equal(spoken(), "5 s");
  tell([slider(7)]);
  actions();
  down("ArrowRight");
  assert.deepEqual(actions(), ["hold", "setValue 8"], "a step begins at the value of now");
  tell([slider(8)]);
  assert.equal(spoken(), "8 s");
});

for (const shadow of [false, true]) {
  test(`the focus of an element that is gone goes to the nearest${shadow ? ", in a shadow root too" : ""}`, ({ mock }) => {
    mock.timers.enable({ apis: ["setTimeout"] });
    const near = button("near", { bounds: [0, 20, 10, 10] });
    const far = button("far", { bounds: [0, 500, 10, 10] });
    const { at, tell, focused } = mirrorWith([far, near, button("gone")], { shadow });
    at("gone").focus();
    tell([], { removed: ["gone"], children: ["far", "near"] });
    tell([{ ...far, name: "Far" }], { children: ["far", "near"] });
    mock.timers.tick(400);
    assert.equal(focused(), at("near"));
  });
}

test("a dialog for files opens within the click, and the viewer is not asked for it too", () => {
  const picked = [];
  const { at, down, actions } = mirrorWith([button("Open files…", { control: "open-files" })], { pick: (what) => picked.push(what) });
  assert.equal(at("Open files…").getAttribute("data-control"), "open-files");
  at("Open files…").focus();
  actions();
  down("Enter");
  assert.deepEqual(picked, ["files"]);
  assert.ok(!actions().includes("click"));
  const without = mirrorWith([button("Open files…", { control: "open-files" })]);
  without.at("Open files…").click();
  assert.deepEqual(without.actions(), ["click"], "a page that opens none asks the viewer");
});

test("Shift and Tab go from the canvas to where Tab would come from, also after the browser's own controls", () => {
  const { at, canvas, tell, leave, down, actions } = mirrorWith([button("first"), button("last")]);
  at("last").focus();
  tell([], { focus: "last" });
  leave();
  actions();
  canvas.focus();
  assert.deepEqual(actions(), ["blur"], "the viewer lets go of what the keyboard has left");
  tell([], { focus: null });
  down("Tab");
  assert.equal(at("first").page.focused, at("first"));
});

test("Tab goes on from what was clicked on the canvas", () => {
  const { at, canvas, tell, down } = mirrorWith([button("first"), button("second"), button("third")]);
  for (const [shiftKey, next] of [[false, "third"], [true, "first"]]) {
    canvas.focus();
    tell([], { focus: null, start: "second" });
    down("Tab", { shiftKey });
    assert.equal(at(next).page.focused, at(next));
  }
});

test("who comes to the view by Tab sees that it has the focus; a script or a click shows nothing", () => {
  const { at, canvas, down } = mirrorWith([button("first")]);
  canvas.focus();
  assert.ok(["none", undefined].includes(canvas.style.outline), canvas.style.outline);
  at("first").focus();
  down("Tab", { shiftKey: true });
  assert.match(canvas.style.outline, /^2px solid/);
  canvas.dispatchEvent({ type: "pointerdown" });
  assert.equal(canvas.style.outline, "none");
  at("first").focus();
  down("Tab", { shiftKey: true });
  at("first").focus();
  assert.equal(canvas.style.outline, "none", "the focus went on");
});
