import { chromium } from "@playwright/test";
import { spawn } from "node:child_process";
import { browser, dam } from "./tests/server.mjs";
const b = await chromium.launch(browser);
for (const f of process.argv.slice(2)) {
  const child = spawn(dam, ["studio", f, "--no-open"], { env: { ...process.env, XDG_STATE_HOME: "/tmp/bigstate" } });
  let err = "";
  const address = await new Promise((ok) => child.stderr.on("data", (d) => { err += d; const m = /http:\S+/.exec(err); if (m) ok(m[0]); }));
  child.on("exit", (c, s) => console.log("exit", c, s, err.slice(-200)));
  const page = await b.newPage({ viewport: { width: 1280, height: 900 } });
  page.on("pageerror", (e) => console.log("pageerror", e.message.slice(0, 200)));
  const t = Date.now();
  await page.goto(address);
  try {
    await page.waitForSelector(".verdict", { timeout: 40000 });
    console.log(f, "verdict", Date.now() - t, "nodes", await page.evaluate(() => ["*", ".charts *", ".objects-graph *", ".slider", ".sliders *", ".figures *", "main *", ".map-view *", ".seen-beside *", ".machine *"].map((s) => `${s} ${document.querySelectorAll(s).length}`).join("; ")));
    const t2 = Date.now();
    const input = page.locator(".slider input[type=text]").first();
    if (await input.count()) { await input.evaluate((e) => { e.focus(); }); await page.keyboard.type("70 rpm"); const t3 = Date.now(); await page.keyboard.press("Enter"); await page.waitForFunction(() => document.querySelector(".top").textContent.includes("not saved")); console.log("edit", Date.now() - t3); }
  } catch (e) { console.log(f, "FAIL", e.message.slice(0, 200)); }
  await page.screenshot({ path: "/tmp/big_" + f.split("/").pop() + ".png" }).catch(() => console.log("no screenshot"));
  await page.close().catch(() => {});
  child.kill("SIGKILL");
}
await b.close();
