// Firefox and WebKit, each driven by what drives it on Linux, behind the same few calls.

import { spawn } from "node:child_process";
import { writeFileSync } from "node:fs";
import { createServer } from "node:net";
import puppeteer from "puppeteer-core";
import webdriver from "selenium-webdriver";

/** The window, as wide as that of the Chromium tests, so that the interface stands in the same places. */
const VIEWPORT = { width: 960, height: 600 };

/** How long a page may take for one answer: a software GPU draws a picture in seconds. */
const PATIENCE_MS = 120_000;

/** Firefox takes a software GPU for none at all, unless it is told otherwise. */
const FIREFOX_PREFERENCES = { "webgl.force-enabled": true, "gfx.x11-egl.force-enabled": true };

/** In the page: waits until what came by now was drawn. A drag that is over within one frame is none. */
const twoFrames = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));

/** Starts the browser of this name. All calls of what it gives are asynchronous. */
export function launch(name, program) {
  return name === "firefox" ? firefox(program) : webkit(program);
}

async function firefox(program) {
  const browser = await puppeteer.launch({
    browser: "firefox",
    executablePath: program,
    headless: false,
    extraPrefsFirefox: FIREFOX_PREFERENCES,
    protocolTimeout: PATIENCE_MS,
  });
  const [page] = await browser.pages();
  // The tab that was there from the start has the size of the window.
  await page.setViewport(VIEWPORT);
  return {
    open: (address) => page.goto(address),
    /** Calls a function in the page, which may be asynchronous. */
    evaluate: (body, ...values) => page.evaluate(body, ...values),
    click: ([x, y]) => page.mouse.click(x, y),
    async drag([fromX, fromY], [toX, toY]) {
      await page.mouse.move(fromX, fromY);
      await page.mouse.down();
      await page.evaluate(twoFrames);
      await page.mouse.move(toX, toY, { steps: 5 });
      await page.evaluate(twoFrames);
      await page.mouse.up();
    },
    press: (key) => page.keyboard.press(key === "Space" ? " " : key),
    /** Chooses a file as the dialog of an input does. */
    choose: async (selector, path) => (await page.$(selector)).uploadFile(path),
    async screenshot(path) {
      await page.evaluate(twoFrames);
      await page.screenshot({ path });
    },
    close: () => browser.close(),
  };
}

/** `program`: WebKit's small browser. Its driver is on the `PATH`. */
async function webkit(program) {
  const port = await freePort();
  const driver = spawn("WebKitWebDriver", [`--port=${port}`], { stdio: "ignore" });
  await listening(driver, port);
  const session = await new webdriver.Builder()
    .usingServer(`http://127.0.0.1:${port}`)
    .withCapabilities({ browserName: "MiniBrowser", "webkitgtk:browserOptions": { binary: program, args: ["--automation"] } })
    .build();
  await session.manage().setTimeouts({ script: PATIENCE_MS, pageLoad: PATIENCE_MS });
  // The window has a frame and a bar of its own; the page is what is left.
  const inner = () => session.executeScript("return [innerWidth, innerHeight]");
  await session.manage().window().setRect({ x: 0, y: 0, ...VIEWPORT });
  const [width, height] = await inner();
  await session.manage().window().setRect({ width: 2 * VIEWPORT.width - width, height: 2 * VIEWPORT.height - height });
  const at = ([x, y]) => ({ x: Math.round(x), y: Math.round(y), origin: webdriver.Origin.VIEWPORT });
  return {
    open: (address) => session.get(address),
    evaluate: async (body, ...values) => {
      const { value, thrown } = await session.executeAsyncScript(
        `const done = arguments[arguments.length - 1];
         Promise.resolve().then(() => (${body})(...Array.from(arguments).slice(0, -1)))
           .then((value) => done({ value }), (error) => done({ thrown: String(error?.message ?? error) }));`,
        ...values,
      );
      if (thrown !== undefined) throw new Error(thrown);
      return value;
    },
    click: (place) => session.actions().move(at(place)).click().perform(),
    async drag(from, to) {
      await session.actions().move(at(from)).press().perform();
      await session.executeAsyncScript(`(${twoFrames})().then(arguments[0])`);
      await session.actions().move({ ...at(to), duration: 200 }).perform();
      await session.executeAsyncScript(`(${twoFrames})().then(arguments[0])`);
      await session.actions().release().perform();
    },
    press: (key) => session.actions().sendKeys(webdriver.Key[key.toUpperCase()] ?? key).perform(),
    choose: async (selector, path) => (await session.findElement(webdriver.By.css(selector))).sendKeys(path),
    async screenshot(path) {
      await session.executeAsyncScript(`(${twoFrames})().then(arguments[0])`);
      writeFileSync(path, await session.takeScreenshot(), "base64");
    },
    async close() {
      await session.quit();
      driver.kill();
    },
  };
}

/** A port that nothing listens on. */
function freePort() {
  return new Promise((done, fail) => {
    const server = createServer().once("error", fail);
    server.listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => done(port));
    });
  });
}

/** Waits until the driver answers. */
async function listening(driver, port) {
  let failure = null;
  driver.once("error", (error) => (failure = error));
  driver.once("exit", (code) => (failure ??= new Error(`WebKitWebDriver ended with ${code}`)));
  for (const deadline = Date.now() + PATIENCE_MS; ; ) {
    if (failure) throw failure;
    if (await fetch(`http://127.0.0.1:${port}/status`).then(() => true, () => false)) return;
    if (Date.now() > deadline) throw new Error("WebKitWebDriver does not answer");
    await new Promise((done) => setTimeout(done, 50));
  }
}
