// Pictures of the studio for its guide, and of every view, light and dark, to be looked at.
//
//     DAM=target/release/dam npm --prefix studio run screenshots
//
// Writes docs/site/pictures/studio-objects.png and the like, those of all views into studio/screenshots.

import { chromium } from "@playwright/test";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { browser as options, root, Server } from "./tests/server.mjs";

const SIZE = { width: 1280, height: 800 };
// Name, scene, tab, and whether the guide shows it.
const VIEWS = [
  ["objects", "scenarios/fan_out/sewing_machine.json", "Objects", true],
  ["text", "scenarios/rocker/two_masses.json", "Text", true],
  ["drawing", "scenarios/kinetostatics/slider_crank.json", "Drawing", true],
  ["model", "scenarios/rocker/two_masses.json", "Dynamic model", false],
  ["equations", "scenarios/press/ejector.json", "Equations", true],
];
const all = join(root, "studio/screenshots");
mkdirSync(all, { recursive: true });

const chrome = await chromium.launch(options);
for (const [name, scene, tab, shown] of VIEWS) {
  const server = new Server({ "scene.json": scene });
  await server.start();
  for (const colorScheme of ["light", "dark"]) {
    const page = await chrome.newPage({ viewport: SIZE, colorScheme });
    await page.goto(server.address);
    await page.waitForSelector(".verdict");
    await page.getByRole("tab", { name: tab }).click();
    // What is drawn late has come: nothing is busy, and the charts are there.
    await page.waitForSelector("figure svg, .chart svg, .object-box, .sketch, math", { state: "visible" });
    await page.waitForFunction(() => !document.querySelector("[aria-busy=true]"));
    await page.waitForLoadState("networkidle");
    await page.screenshot({ path: join(all, `${name}-${colorScheme}.png`) });
    if (shown && colorScheme === "light")
      await page.screenshot({ path: join(root, "docs/site/pictures", `studio-${name}.png`) });
    await page.close();
  }
  await server.end();
}
await chrome.close();
