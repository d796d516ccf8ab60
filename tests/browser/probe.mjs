import { chromium } from "playwright-core";
const [,, file, backend = "webgl2", page = "http://127.0.0.1:8097/"] = process.argv;
const flags = { webgl2: ["--use-angle=swiftshader","--enable-unsafe-swiftshader","--ignore-gpu-blocklist"],
 webgpu: ["--use-angle=swiftshader","--enable-unsafe-swiftshader","--ignore-gpu-blocklist","--enable-unsafe-webgpu","--enable-gpu","--enable-features=Vulkan","--use-vulkan=swiftshader"] }[backend];
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: [...flags, "--no-sandbox"] });
const tab = await browser.newPage({ viewport: { width: 1000, height: 640 } });
tab.on("console", (m) => console.log("console", m.type(), m.text()));
tab.on("pageerror", (e) => console.log("pageerror", e.message));
await tab.goto(`${page}?backend=${backend}`);
await tab.evaluate(() => bindpose.ready);
await tab.waitForFunction(() => bindpose.state().model, null, { timeout: 60000 });
await tab.waitForTimeout(1500);
await tab.evaluate(() => { bindpose.pause(); });
await tab.waitForTimeout(3000);
await tab.setContent; 
await tab.evaluate(() => {
  globalThis.longTasks = [];
  new PerformanceObserver((list) => { for (const e of list.getEntries()) longTasks.push([Math.round(e.startTime), Math.round(e.duration)]); }).observe({ type: "longtask" });
});
const input = await tab.evaluateHandle(() => { const i = document.createElement("input"); i.type = "file"; i.multiple = true; document.body.append(i); return i; });
await input.setInputFiles(file.split(","));
const before = await tab.evaluate(() => bindpose.state().framesRendered);
const opened = tab.evaluate(async (i) => {
  const begun = performance.now();
  try { const state = await bindpose.open(i.files); return { ms: performance.now() - begun, begun, model: state.model?.name, error: state.error?.message, longTasks }; }
  catch (e) { return { ms: performance.now() - begun, failed: String(e), longTasks }; }
}, input);
for (const at of [500, 1500, 3000]) { await new Promise((d) => setTimeout(d, at === 500 ? 500 : at === 1500 ? 1000 : 1500)); await tab.screenshot({ path: `/tmp/big/${backend}-${at}.png` }).catch(() => {}); }
const result = await opened;
console.log(JSON.stringify(result));
await tab.waitForTimeout(3000);
await tab.screenshot({ path: `/tmp/big/${backend}-end.png` });
console.log(JSON.stringify(await tab.evaluate(() => ({ tasks: longTasks, heap: performance.memory?.usedJSHeapSize }))));
await browser.close();
