import { chromium } from "playwright-core";
const [,, file, backend = "webgl2", small = "", page = "http://127.0.0.1:8097/"] = process.argv;
const flags = { webgl2: ["--use-angle=swiftshader","--enable-unsafe-swiftshader","--ignore-gpu-blocklist"],
 webgpu: ["--use-angle=swiftshader","--enable-unsafe-swiftshader","--ignore-gpu-blocklist","--enable-unsafe-webgpu","--enable-gpu","--enable-features=Vulkan","--use-vulkan=swiftshader"] }[backend];
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: [...flags, "--no-sandbox"] });
const tab = await browser.newPage({ viewport: small ? { width: 200, height: 120 } : { width: 1000, height: 640 } });
tab.on("console", (m) => console.log("console", m.type(), m.text().slice(0, 300)));
tab.on("pageerror", (e) => console.log("pageerror", e.message.slice(0, 300)));
await tab.goto(`${page}?backend=${backend}`);
await tab.evaluate(() => bindpose.ready);
await tab.waitForFunction(() => bindpose.state().model, null, { timeout: 60000 });
await tab.evaluate((small) => { bindpose.pause(); if (small) { bindpose.setRenderScale(0.1); } }, small);
await tab.waitForTimeout(5000);
console.log("sample", JSON.stringify(await tab.evaluate(() => bindpose.state().timings)));
await tab.evaluate(() => {
  globalThis.longTasks = [];
  new PerformanceObserver((list) => { for (const e of list.getEntries()) longTasks.push([Math.round(e.startTime), Math.round(e.duration)]); }).observe({ type: "longtask" });
});
const input = await tab.evaluateHandle(() => { const i = document.createElement("input"); i.type = "file"; i.multiple = true; document.body.append(i); return i; });
await input.setInputFiles(file.split(","));
const opened = tab.evaluate(async (i) => {
  const begun = performance.now();
  try { const state = await bindpose.open(i.files); const ms = performance.now() - begun; bindpose.pause(); return { ms, begun, model: state.model?.name, error: state.error?.message }; }
  catch (e) { return { ms: performance.now() - begun, failed: String(e) }; }
}, input);
for (const at of [500, 1500, 3000]) { await new Promise((d) => setTimeout(d, at === 500 ? 500 : at === 1500 ? 1000 : 1500)); if (!small) await tab.screenshot({ path: `/tmp/big/${backend}-${at}.png` }).catch(() => {}); }
const result = await opened;
console.log(JSON.stringify(result));
await tab.waitForTimeout(3000);
if (!small) await tab.screenshot({ path: `/tmp/big/${backend}-end.png` });
console.log(JSON.stringify(await tab.evaluate(() => ({ tasks: longTasks, timings: bindpose.state().timings, marks: performance.getEntriesByType("mark").slice(-14).map((m) => [m.name, Math.round(m.startTime)]) }))));
await browser.close();
