// web/element/bindpose-viewer.js where there is no page: a server that renders pages imports it too.

import assert from "node:assert/strict";
import { test } from "node:test";

test("the element's module can be imported where there are no elements", async () => {
  const { BindposeViewerElement } = await import("../../../web/element/bindpose-viewer.js");
  assert.equal(typeof BindposeViewerElement, "function");
  assert.equal(globalThis.customElements, undefined);
});
