// The page as a screen reader has it: elements with roles, names and states, no places. And what axe finds in every state of it.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { assertSound } from "./axe.js";
import { FIXTURES, call, dropAndWait, keep, panicAtStart, settled, state, test, until, turnPhone } from "./harness.js";

/** A control by the start of its name, whatever it is: a button, a tab, a choice of several. */
const control = (page, start, roles = ["button", "radio", "tab", "combobox", "menuitem", "menuitemradio", "option"]) => {
  const name = new RegExp(`^${start}`);
  return roles.map((role) => page.getByRole(role, { name })).reduce((one, other) => one.or(other)).first();
};

/** Operates a control as a person without a mouse does. */
async function press(page, start, key = "Enter") {
  await control(page, start).focus();
  await page.keyboard.press(key);
}

/** What has the focus: its role and name. */
const focused = (page) =>
  page.evaluate(() => {
    const { activeElement: element } = document;
    const role = element.getAttribute("role") ?? { button: "button", canvas: "canvas" }[element.localName] ?? element.type ?? element.localName;
    return [role, element.ariaLabel ?? element.textContent];
  });

/** Waits until a screen reader has been given words like these. */
const spoken = (page, words, region = "status") => page.getByRole(region).filter({ hasText: words }).first().waitFor({ state: "attached" });

/** Waits for the focus to be on something with such a name. */
async function focusOn(page, name) {
  for (const deadline = Date.now() + 20_000; ; ) {
    const [role, called] = await focused(page);
    if (name.test(called)) return role;
    assert.ok(Date.now() < deadline, `the focus is on ${role} ${called}, not on ${name}`);
    await page.waitForTimeout(50);
  }
}

test("by roles and names alone a model is opened, played, scrubbed, a bone's matrix read, the light changed, a picture saved", { own: true }, async (page) => {
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), press(page, "Open files")]);
  await chooser.setFiles(`${FIXTURES}good/d3d12_skinned.m3d`);
  const { model } = await until(page, (now) => now.model.name === "d3d12_skinned.m3d");
  await spoken(page, /^d3d12_skinned\.m3d is open: /);

  await press(page, "Play", "Space");
  await until(page, ({ playing }) => playing);
  await spoken(page, /^Playing/);
  await press(page, "Pause", "Space");
  const { timeSecs } = await until(page, ({ playing }) => !playing);
  assert.ok(timeSecs >= 0);
  await spoken(page, /^Paused at \d/);
  await page.getByRole("slider", { name: /^Time/ }).focus();
  await page.keyboard.press("End");
  await until(page, (now) => Math.abs(now.timeSecs - model.clips[0].endSecs) < 1e-3);

  await press(page, "(Panel: )?Skeleton", "Space");
  const rows = page.getByRole("treeitem");
  await rows.first().waitFor({ state: "attached" });
  await rows.first().focus();
  await page.keyboard.press("Enter");
  await until(page, ({ skeleton }) => skeleton.selected !== null);
  await spoken(page, /^Bone /);
  const row = page.getByRole("list", { name: "Final transform" }).getByRole("listitem").first();
  await row.waitFor({ state: "attached" });
  assert.match(await row.textContent(), /^row 1:( -?\d+(\.\d+)?){4}$/);
  await page.getByRole("application", { name: /bone \d/ }).waitFor({ state: "attached" });

  await press(page, "Light(ing)?:");
  await control(page, "(Light: |Lighting: )?Book").waitFor({ state: "attached" });
  await press(page, "(Light: |Lighting: )?Book", "Space");
  await until(page, ({ look }) => look.light === "book");
  await spoken(page, /^Light: /);
  await page.keyboard.press("Escape");
  await focusOn(page, /^Light(ing)?:/);

  await press(page, "Picture…");
  await control(page, "Save").waitFor({ state: "attached" });
  const [saved] = await Promise.all([page.waitForEvent("download"), press(page, "Save")]);
  assert.match(saved.suggestedFilename(), /^d3d12_skinned-.*\.png$/);
  await spoken(page, /^Saved d3d12_skinned.*\.png, \d+ × \d+\.$/);
});

test("the findings say what the books' programs make of a file, and the report is saved", {}, async (page) => {
  await dropAndWait(page, [`${FIXTURES}good/clip_names.m3d`]);
  const { book, notices } = await state(page);
  assert.deepEqual([book.d3d11.line, book.d3d12.line, book.d3d12.reads], [9, 56, false]);
  await press(page, "Books: D3D12 demo: cannot read it");
  const line = control(page, "D3D12 demo: cannot read it");
  assert.equal(await line.getAttribute("aria-expanded"), "false");
  await line.focus();
  await page.keyboard.press("Enter");
  await page.getByText(/^One sees: It crashes at its first frame/).first().waitFor({ state: "attached" });
  assert.equal(await line.getAttribute("aria-expanded"), "true");
  await assertSound(page, "the findings");
  await keep(page, "findings");
  const [saved] = await Promise.all([page.waitForEvent("download"), press(page, "Save report")]);
  assert.equal(saved.suggestedFilename(), "clip_names.sarif");
  const { version, runs: [run] } = JSON.parse(readFileSync(await saved.path(), "utf8"));
  assert.deepEqual([version, run.tool.driver.name], ["2.1.0", "bindpose"]);
  const limits = book.d3d11.limits.length + book.d3d12.limits.length;
  assert.equal(run.results.length, notices.length + 2 + limits);
  assert.deepEqual(run.results.filter(({ ruleId }) => ruleId === "book-stops").map(({ locations: [at] }) => at.physicalLocation.region.startLine), [9, 56]);
  await spoken(page, /^Saved clip_names\.sarif\.$/);
  await page.keyboard.press("Escape");
});

test("findings are filtered, and one leads to its clip, time and bone, and stays when the file comes again", {}, async (page) => {
  await dropAndWait(page, [`${FIXTURES}check/loop-jumps.m3d`]);
  await call(page, "play");
  await press(page, "(Panel: )?Model");
  await press(page, "Findings: 1 note");
  await press(page, "Only 1 note");
  const row = page.getByRole("listitem", { name: /^note loop-jumps/ }).or(control(page, "note loop-jumps")).first();
  await row.focus();
  await page.keyboard.press("Enter");
  const { timeSecs, skeleton } = await until(page, ({ playing, skeleton }) => !playing && skeleton.selected !== null);
  const [{ endSecs }] = (await state(page)).model.clips;
  assert.deepEqual([timeSecs, skeleton.selected, skeleton.bonesVisible], [endSecs, 1, true]);
  await page.getByText(/86 \|\s+Bone1 #Keyframes: 5/).first().waitFor({ state: "attached" });
  await dropAndWait(page, [`${FIXTURES}check/loop-jumps.m3d`]);
  await page.getByText(/86 \|\s+Bone1 #Keyframes: 5/).first().waitFor({ state: "attached" });
  assert.equal((await state(page)).skeleton.selected, 1);
  await page.keyboard.press("Escape");
});

test("all that steps the time is a button, and where it led is spoken", {}, async (page) => {
  const { model } = await state(page);
  const [{ endSecs, keysPerSec }] = model.clips;
  await call(page, "pause");
  await call(page, "seek", 0);
  for (const [button, frame] of [
    ["One frame on", 1],
    ["One frame on", 2],
    ["One frame back", 1],
    ["Last frame", endSecs * keysPerSec],
    ["First frame", 0],
  ]) {
    await press(page, button);
    await until(page, ({ timeSecs }) => Math.abs(timeSecs * keysPerSec - frame) < 1e-2);
    await spoken(page, new RegExp(`^${(frame / keysPerSec).toFixed(2)} s, frame ${Math.round(frame)}\\.$`));
  }
});

test("what is typed into a field of the mirror is in the viewer, and Tab goes on from a field on the canvas", {}, async (page) => {
  await press(page, "(Panel: )?Skeleton", "Space");
  const search = page.getByRole("textbox", { name: "Search bones" });
  await search.focus();
  await page.keyboard.type("12");
  const only = page.getByRole("treeitem", { name: /^Bone 12\b/ });
  await only.waitFor({ state: "attached" });
  await page.waitForFunction(() => ![...document.querySelectorAll("[role=treeitem]")].some((row) => /^Bone 20\b/.test(row.ariaLabel)));
  assert.equal(await search.inputValue(), "12");
  assert.equal((await state(page)).playing, false, "letters in a field are no keys of the viewer");

  const { x, y, width, height } = await search.boundingBox();
  await page.mouse.click(x + width / 2, y + height / 2);
  await settled(page);
  await page.keyboard.press("Backspace");
  await page.waitForFunction(() => document.querySelector("[data-mirror][aria-label='Search bones']").value === "1");
  await page.keyboard.press("Tab");
  await focusOn(page, /^Names and branches/);
  await page.keyboard.press("Shift+Tab");
  await focusOn(page, /^Search bones/);
});

test("the mouse meets each control where its element is", {}, async (page) => {
  for (const [start, holds] of [
    ["Play", ({ playing }) => playing],
    ["Pause", ({ playing }) => !playing],
    ["Last frame", ({ timeSecs, model }) => Math.abs(timeSecs - model.clips[0].endSecs) < 1e-3],
    ["Light(ing)?:", null],
    ["(Light: |Lighting: )?Book", ({ look }) => look.light === "book"],
  ]) {
    await control(page, start).waitFor({ state: "attached" });
    const { x, y, width, height } = await control(page, start).boundingBox();
    await page.mouse.click(x + width / 2, y + height / 2);
    if (holds) await until(page, holds);
    await settled(page);
  }
});

test("keys that a control has no use for are the viewer's", {}, async (page) => {
  await control(page, "Play").focus();
  for (const [key, holds] of [
    ["x", ({ look }) => look.overlays.includes("axes")],
    ["x", ({ look }) => !look.overlays.includes("axes")],
    ["Space", ({ playing }) => playing],
    ["Space", ({ playing }) => !playing],
  ]) {
    await page.keyboard.press(key);
    await until(page, holds);
  }
  await focusOn(page, /^Play/);
});

test("Tab goes through the viewer in order, and leaves it at both ends", { own: true }, async (page) => {
  await page.evaluate(() => {
    for (const [place, words] of [["before", "Before"], ["after", "Behind"]]) {
      const button = Object.assign(document.createElement("button"), { textContent: words });
      document.getElementById("view")[place](button);
    }
  });
  await page.getByRole("button", { name: "Before" }).focus();
  await page.keyboard.press("Tab");
  await focusOn(page, /^figure\.m3d/);
  await page.keyboard.press("Tab");
  assert.equal(await focusOn(page, /^View mode/), "button");
  await page.keyboard.press("Tab");
  await focusOn(page, /^Light/);
  for (const name of [/^View mode/, /^figure\.m3d/, /^Before/]) {
    await page.keyboard.press("Shift+Tab");
    await focusOn(page, name);
  }
  await page.locator("#view [tabindex='0']").last().focus();
  await page.keyboard.press("Tab");
  await focusOn(page, /^Behind/);
  await page.waitForTimeout(600);
  await focusOn(page, /^Behind/);
});

test("what opens takes the focus and gives it back, and the focus is never on what is not there", {}, async (page) => {
  await press(page, "View from…");
  await focusOn(page, /^Three-quarter/);
  await page.keyboard.press("Escape");
  await focusOn(page, /^View from…/);
  await press(page, "View from…");
  await focusOn(page, /^Three-quarter/);
  await press(page, "Front");
  await focusOn(page, /^View from…/);

  await press(page, "(Panel: )?Skeleton", "Space");
  await page.getByRole("treeitem").nth(3).focus();
  await page.keyboard.press("Enter");
  await until(page, ({ skeleton }) => skeleton.selected !== null);
  await page.keyboard.press("ArrowDown");
  await focusOn(page, /^Bone 4\b/);
  await page.keyboard.press("Escape");
  await until(page, ({ skeleton }) => skeleton.selected === null);
  assert.notEqual((await focused(page))[0], "body");
});

test("a slider that stands still while a clip plays elsewhere is not made anew, and values come some times a second", {}, async (page) => {
  await page.evaluate(() => {
    globalThis.slider = document.querySelector("[aria-label^=Time]");
    globalThis.changes = 0;
    new MutationObserver((records) => (globalThis.changes += records.length)).observe(globalThis.slider, { attributes: true, attributeFilter: ["aria-valuenow"] });
  });
  await call(page, "play");
  await page.waitForTimeout(2000);
  const [same, changes] = await page.evaluate(() => [globalThis.slider.isConnected, globalThis.changes]);
  await call(page, "pause");
  assert.equal(same, true);
  assert.ok(changes <= 12, `${changes} changes in 2 s`);
});

test("a failure is spoken at once, and why", { expectErrors: true }, async (page) => {
  const { name } = (await state(page)).model;
  await dropAndWait(page, [`${FIXTURES}bad/parent_not_a_number.m3d`]);
  await spoken(page, new RegExp(`parent_not_a_number\\.m3d was not opened: .*${name} stays open`), "alert");
});

test("axe finds nothing in any state of the page", { own: true, expectErrors: true, viewport: { width: 1280, height: 800 } }, async (page) => {
  await assertSound(page, "a model is open");
  for (const name of ["View mode", "Light(ing)?:", "Lines over", "View from…", "Picture…", "Clip\\b", "Speed"]) {
    await press(page, name);
    await page.waitForTimeout(300);
    await assertSound(page, name);
    await page.keyboard.press("Escape");
    await page.waitForTimeout(300);
  }
  await press(page, "Help");
  await assertSound(page, "the table of keys");
  await press(page, "Help");
  await press(page, "Dope sheet");
  await assertSound(page, "the dope sheet");
  await press(page, "(Sheet: )?Curves", "Space");
  await assertSound(page, "the curves");
  await press(page, "Shell");
  await assertSound(page, "a subset");
  await page.keyboard.press("Escape");
  await press(page, "(Panel: )?Skeleton", "Space");
  await page.getByRole("treeitem").nth(2).focus();
  await page.keyboard.press("Enter");
  await assertSound(page, "a bone");
  await page.keyboard.press("F2");
  await assertSound(page, "a bone's name is typed");
  await page.keyboard.press("Escape");
  await press(page, "(Panel: )?Model", "Space");
  await press(page, "(Diagnostics|Findings)");
  await assertSound(page, "the findings");
  await page.keyboard.press("Escape");
  await dropAndWait(page, [`${FIXTURES}bad/parent_not_a_number.m3d`]);
  await assertSound(page, "a file that cannot be read");
  await page.keyboard.press("Escape");
  await call(page, "play");
  await assertSound(page, "playing");
  await call(page, "pause");
});

test("axe finds nothing on a phone", { phone: true }, async (page) => {
  await assertSound(page, "a model is open");
  await turnPhone(page, 844, 390);
  await assertSound(page, "on its side");
});

test("axe finds nothing before the viewer is there", {
  bare: true,
  prepare: (page) =>
    page.route("**/*_bg.wasm", async (route) => {
      await page.waitForFunction(() => globalThis.letWasmThrough).catch(() => {});
      await route.continue().catch(() => {});
    }),
}, async (page) => {
  await page.waitForSelector("#open-files");
  await assertSound(page, "loading");
  await page.evaluate(() => (globalThis.letWasmThrough = true));
  await until(page, ({ model }) => model !== null);
});

test("axe finds nothing when the viewer stops", {
  bare: true,
  expectErrors: true,
  prepare: panicAtStart,
}, async (page) => {
  await page.waitForSelector("#fault:not([hidden])");
  await assertSound(page, "a failure");
});

test("at 200 % nothing is lost", { viewport: { width: 720, height: 450 }, fine: true }, async (page) => {
  await settled(page);
  await keep(page, "zoomed-720x450");
  const outside = await page.locator("#view [tabindex='0']").evaluateAll((elements) =>
    elements
      .filter((element) => !element.matches("canvas"))
      .map((element) => [element.ariaLabel, element.getBoundingClientRect()])
      .filter(([, { left, top, right, bottom }]) => left < -1 || top < -1 || right > innerWidth + 1 || bottom > innerHeight + 1)
      .map(([name]) => name),
  );
  assert.deepEqual(outside, [], "every control is in the window");
});
