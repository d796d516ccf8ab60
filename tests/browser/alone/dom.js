// As much of a page as web/mirror.js touches, so that it runs without a browser: elements in a tree, the focus with its events, events
// that bubble, and what a browser does by itself with the keys of a button, a slider and Tab.

class Element {
  #attributes = new Map();
  #listeners = [];
  constructor(localName, page) {
    Object.assign(this, { localName, page, ownerDocument: page.document, children: [], parentElement: null, style: {}, dataset: {}, textContent: "" });
  }
  getAttribute(name) {
    return this.#attributes.get(name) ?? null;
  }
  setAttribute(name, value) {
    this.#attributes.set(name, String(value));
  }
  removeAttribute(name) {
    this.#attributes.delete(name);
  }
  get tabIndex() {
    return Number(this.getAttribute("tabindex") ?? -1);
  }
  set tabIndex(index) {
    this.setAttribute("tabindex", index);
  }
  get valueAsNumber() {
    return Number(this.value);
  }
  get nextElementSibling() {
    const { children } = this.parentElement;
    return children[children.indexOf(this) + 1] ?? null;
  }
  append(child) {
    this.insertBefore(child, null);
  }
  insertBefore(child, next) {
    child.remove();
    child.parentElement = this;
    this.children.splice(next ? this.children.indexOf(next) : this.children.length, 0, child);
  }
  remove() {
    if (this.contains(this.page.focused)) this.page.focused = null;
    this.parentElement?.children.splice(this.parentElement.children.indexOf(this), 1);
    this.parentElement = null;
  }
  contains(other) {
    return Boolean(other) && (other === this || this.contains(other.parentElement));
  }
  all() {
    return [this, ...this.children.flatMap((child) => child.all())];
  }
  querySelectorAll() {
    return this.all().filter((element) => element !== this && element.getAttribute("tabindex") === "0");
  }
  closest() {
    return this.dataset.mirror === undefined ? this.parentElement?.closest() : this;
  }
  matches() {
    return this.localName === "input" && this.type === "text";
  }
  getBoundingClientRect() {
    const [left, top, width, height] = ["left", "top", "width", "height"].map((side) => Number.parseFloat(this.style[side]) || 0);
    return { left, top, width, height };
  }
  getRootNode() {
    return this.page.scope;
  }
  addEventListener(type, listener) {
    this.#listeners.push([type, listener]);
  }
  removeEventListener(type, listener) {
    this.#listeners = this.#listeners.filter(([known, other]) => known !== type || other !== listener);
  }
  dispatchEvent(event) {
    const happened = event.target ? event : Object.assign({ type: event.type, bubbles: event.bubbles, preventDefault() { this.prevented = true; } }, event, { target: this });
    for (const [type, listener] of this.#listeners) if (type === happened.type) listener(happened);
    if (happened.bubbles) this.parentElement?.dispatchEvent(happened);
    return !happened.prevented;
  }
  focus() {
    const before = this.page.focused;
    if (before === this) return;
    before?.dispatchEvent({ type: "blur", relatedTarget: this });
    before?.dispatchEvent({ type: "focusout", bubbles: true, relatedTarget: this });
    this.page.focused = this;
    this.dispatchEvent({ type: "focus", relatedTarget: before });
    this.dispatchEvent({ type: "focusin", bubbles: true, relatedTarget: before });
  }
  click() {
    this.dispatchEvent({ type: "click", bubbles: true });
  }
}

/** A page with a canvas and the viewer's hidden input behind it; with `shadow` both stand in a shadow root. */
export function pageOf({ shadow = false } = {}) {
  const page = { focused: null, window: [] };
  page.document = { createElement: (name) => new Element(name, page) };
  page.document.body = new Element("body", page);
  page.scope = { get activeElement() { return page.focused ?? (shadow ? null : page.document.body); } };
  const [host, canvas, input] = ["div", "canvas", "input"].map(page.document.createElement);
  [canvas, input].forEach((element) => host.append(element));
  canvas.tabIndex = 0;
  globalThis.document = page.document;
  globalThis.addEventListener = (type, listener) => type === "keydown" && page.window.push(listener);
  globalThis.removeEventListener = () => {};

  const keyEvent = (type, key, more) => ({ type, bubbles: true, key, code: key, ctrlKey: false, altKey: false, metaKey: false, shiftKey: false, repeat: false, ...more });
  /** A key goes down on what has the focus, and the browser does its part. */
  const down = (key, more = {}) => {
    const target = page.focused;
    page.window.forEach((listener) => listener({ ...keyEvent("keydown", key, more), stopImmediatePropagation() {} }));
    if (key === "Tab") {
      const stops = host.all().filter((element) => element.tabIndex === 0);
      return void stops[stops.indexOf(page.focused) + (more.shiftKey ? -1 : 1)]?.focus();
    }
    if (!target.dispatchEvent(keyEvent("keydown", key, more))) return;
    if (target.localName === "button" && key === "Enter") target.click();
    if (target.type === "range" && key.startsWith("Arrow")) {
      target.value = Number(target.value) + Number(target.step);
      target.dispatchEvent({ type: "input", bubbles: true });
    }
  };
  const up = (key) => page.focused?.dispatchEvent(keyEvent("keyup", key));
  /** The window loses the focus to another, or to the browser's own controls. */
  const leave = () => {
    page.focused?.dispatchEvent({ type: "focusout", bubbles: true, relatedTarget: null });
    page.focused = null;
  };
  return { host, canvas, down, up, leave, focused: () => page.scope.activeElement };
}
