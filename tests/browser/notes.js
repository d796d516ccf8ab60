// Pages of other people with viewers on them, and what tests ask of those.

import { readFileSync } from "node:fs";
import { BACKEND, FOLDER, SAMPLE } from "./harness.js";

export const FIGURE = 'src="web/sample/figure.m3d web/sample/figure_diff.png web/sample/figure_norm.png"';

/** Where the program without the interface is. */
export const SMALL = FOLDER.replace("pkg/", "pkg/element/");

/** The content policy that the package's README says is enough. */
const README = readFileSync(new URL("../../xtask/npm/README.md", import.meta.url), "utf8");
export const [, POLICY] = /A page with a content policy needs `([^`]+)`/.exec(README);

/** The same where nothing else is allowed but the page's own styles. */
export const STRICT = `default-src 'none'; style-src 'self'; ${POLICY}`;

/**
 * A page with this body. Events of its viewers are in `heard`, as `[id, type]`, and the last details of each type in `details`; `violations` has what the
 * page's policy forbade.
 */
export const pageOf = (body, { first = "", policy = "", sheet = "", backend = BACKEND } = {}) => ({
  query: "notes.html",
  bare: true,
  prepare: async (page) => {
    const html = `<!doctype html><title>Notes</title>${policy && `<meta http-equiv="Content-Security-Policy" content="${policy}">`}${first}
      <script type="module" src="/web/element/bindpose-viewer.js"></script>${body.replaceAll("<bindpose-viewer", `<bindpose-viewer backend="${backend}"`)}`;
    await page.route("**/notes.html", (route) => route.fulfill({ contentType: "text/html", body: html }));
    await page.route("**/notes.css", (route) => route.fulfill({ contentType: "text/css", body: sheet }));
    await page.addInitScript(() => {
      Object.assign(globalThis, { heard: [], details: {}, violations: [], namesBefore: null });
      const types = ["load", "progress", "error", "play", "pause", "ended", "timeupdate", "camera-change"];
      const hear = ({ target, type, detail }) => {
        if (target.localName !== "bindpose-viewer") return;
        heard.push([target.id, type]);
        (details[type] ??= []).push(detail);
      };
      for (const type of types) document.addEventListener(type, hear, true);
      const note = ({ violatedDirective, blockedURI }) => violations.push(`${violatedDirective} ${blockedURI}`);
      document.addEventListener("securitypolicyviolation", note);
      globalThis.namesBefore = new Set(Object.getOwnPropertyNames(globalThis));
    });
  },
});

/** For `prepare`: the file at this address comes once `letThrough` is set in the page. */
export const holding = (address) => (page) =>
  page.route(`**/${address}`, async (route) => {
    await page.waitForFunction(() => globalThis.letThrough).catch(() => {});
    await route.fulfill({ path: SAMPLE }).catch(() => {});
  });

/** Waits until a viewer has told of this as often. */
export const hears = (page, id, type, times = 1) =>
  page.waitForFunction(([id, type, times]) => heard.filter(([by, what]) => by === id && what === type).length >= times, [id, type, times], { polling: 50 });

/** What a viewer says of itself. */
export const seen = (page, id) =>
  page.evaluate((id) => {
    const viewer = document.getElementById(id);
    const { clip, clips, currentTime, duration, paused, playbackRate } = viewer;
    const { look, skeleton, camera, backend, link } = viewer.state();
    return { clip, clips: clips.length, currentTime, duration, paused, playbackRate, light: look?.light, bone: skeleton?.selected, bones: skeleton?.bonesVisible, yaw: camera?.yawRadians, backend, link };
  }, id);
