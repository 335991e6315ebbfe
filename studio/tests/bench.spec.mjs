// The workbench: machine, play button, a chart and the number that is moved are in sight together, of
// every scenario; its parts are moved with mouse and keyboard, and stay where they were put.

import { expect, test } from "@playwright/test";
import { readdirSync } from "node:fs";
import { basename, join } from "node:path";
import { opened, slider, watched } from "./page.mjs";
import { root, Server } from "./server.mjs";

const files = readdirSync(join(root, "scenarios"), { recursive: true }),
  scenarios = files.filter((name) => name.endsWith(".json") && !name.includes("schema")).sort();
// All of them; EVERY=4 takes each fourth, which is enough on every change.
const every = Number(process.env.EVERY ?? 1);
// Its run stops at the first instant: nothing moves, and there is nothing to chart.
const STILL = [join("joint_friction", "jamming_block.json")];
let server, wrong;
test.use({ viewport: { width: 1280, height: 800 } });
test.beforeEach(({ page }) => {
  wrong = watched(page);
});
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});

// Within the window, and within what scrolls around it; how much of it is (pixels).
const seen = (locator) =>
  locator.evaluate((element) => {
    let { left, top, right, bottom } = element.getBoundingClientRect();
    for (let parent = element; parent; parent = parent.parentElement) {
      if (parent !== element && getComputedStyle(parent).overflow === "visible") continue;
      const box = parent.getBoundingClientRect();
      [left, top, right, bottom] = [
        Math.max(left, box.left),
        Math.max(top, box.top),
        Math.min(right, box.right),
        Math.min(bottom, box.bottom),
      ];
    }
    return {
      wide: Math.min(right, innerWidth) - Math.max(left, 0),
      high: Math.min(bottom, innerHeight) - Math.max(top, 0),
    };
  });

test("machine, play button, a chart and the moved slider of every scenario are in sight at 1280 × 800", async ({
  page,
}) => {
  test.setTimeout(600_000);
  // Tables that scenes read stand beside them.
  const tables = files
    .filter((name) => /\.(csv|txt|dat)$/.test(name))
    .map((name) => [basename(name), join("scenarios", name)]);
  server = new Server(
    Object.fromEntries([
      ...tables,
      ...scenarios.map((name) => [name.replaceAll(/[\\/]/g, "-"), join("scenarios", name)]),
    ]),
  );
  await server.start();
  await page.goto(server.address);
  const missing = [];
  for (const name of scenarios.filter((_, index) => index % every === 0)) {
    await page.locator(".top select[aria-label=scene]").selectOption(name.replaceAll(/[\\/]/g, "-"));
    await expect(page).toHaveTitle(`${name.replaceAll(/[\\/]/g, "-")} – dam studio`);
    await expect(page.locator(".status-line .verdict"), name).toBeVisible({ timeout: 60_000 });
    if (!STILL.includes(name))
      await expect(page.locator(".charts svg.dam-plot:visible").first(), name).toBeVisible({ timeout: 30_000 });
    const at = async (what, locator, wide, high) => {
      if (!(await locator.count())) {
        missing.push(`${name}: no ${what}`);
        return;
      }
      // Of several the one that is in sight most.
      let size = { wide: 0, high: 0 };
      for (const one of await locator.all()) {
        const own = await seen(one);
        if (own.high > size.high) size = own;
      }
      if (size.wide < wide || size.high < high)
        missing.push(`${name}: ${what} ${Math.round(size.wide)} × ${Math.round(size.high)}`);
    };
    if (!STILL.includes(name)) {
      await at("machine", page.locator(".machine .stations"), 300, 120);
      await at("play button", page.getByRole("button", { name: "play", exact: true }), 30, 15);
      await at("chart", page.locator(".charts svg.dam-plot:visible"), 300, 190);
    }
    // A number that is moved stays in sight: nothing above it grows.
    const bar = page.locator(".slider input[type=range]").first();
    if (!(await bar.count())) {
      missing.push(`${name}: no slider`);
      continue;
    }
    const before = await bar.boundingBox();
    await bar.press("ArrowRight");
    await page.waitForTimeout(50);
    await at("slider", bar, 100, 8);
    if ((await bar.boundingBox()).y !== before.y) missing.push(`${name}: the slider moved`);
  }
  expect(missing).toEqual([]);
});

test("bars between the parts are moved with mouse and keyboard, and stay where they were put", async ({ page }) => {
  server = new Server();
  await server.start();
  await opened(page, server.address, "Objects");
  const side = page.getByRole("separator", { name: "width of the numbers" }),
    canvas = page.getByRole("separator", { name: "height of the canvas" });
  const width = async () => (await page.locator(".pane-middle").boundingBox()).width,
    height = async () => (await page.locator(".machine").boundingBox()).height;
  const [w, h] = [await width(), await height()];
  const { x, y, height: tall } = await side.boundingBox();
  await page.mouse.move(x + 2, y + tall / 2);
  await page.mouse.down();
  await page.mouse.move(x + 62, y + tall / 2, { steps: 4 });
  await page.mouse.up();
  expect(Math.abs((await width()) - w - 62)).toBeLessThan(4);
  await canvas.focus();
  for (let k = 0; k < 4; k++) await page.keyboard.press("ArrowDown");
  expect(await height()).toBeGreaterThan(h + 30);
  const put = [await width(), await height()];
  await page.reload();
  await page.waitForSelector(".verdict");
  expect([await width(), await height()]).toEqual(put);
  await canvas.dblclick();
  expect(Math.abs((await height()) - h)).toBeLessThan(2);
});

test("an object that is clicked in the machine or in a table has its charts below", async ({ page }) => {
  server = new Server({ "scene.json": "scenarios/press/ejector.json" });
  await server.start();
  await opened(page, server.address, "Objects");
  const charts = page.locator(".charts section.object:visible h2"),
    of = page.locator(".seen-beside label", { hasText: /^Charts of/ }).locator("select");
  // The one that is separated longest.
  await expect(charts).toHaveText([/^ejector/]);
  // What tells the most comes first.
  const tops = await page.locator(".charts .chart:visible").evaluateAll((all) =>
    all
      .map((one) => [
        one.getBoundingClientRect().top,
        one.getBoundingClientRect().left,
        one.querySelector(".title").textContent,
      ])
      .sort((a, b) => a[0] - b[0] || a[1] - b[1])
      .map((one) => one[2]),
  );
  expect(tops.slice(0, 2)).toEqual([expect.stringContaining("δ"), expect.stringContaining("N")]);
  await page.locator('.machine .station[data-object="flywheel"]').first().click();
  await expect(charts).toHaveText([/^flywheel/]);
  await expect(page.locator('.object-box.chosen[data-id="flywheel"]')).toBeVisible();
  await page.getByRole("tab", { name: "Results" }).click();
  await page.locator('.figures a[href="#object-ram"]').first().click();
  await expect(page.getByRole("tab", { name: "Workbench" })).toHaveAttribute("aria-selected", "true");
  await expect(charts).toHaveText([/^ram/]);
  await of.selectOption({ label: "all objects" });
  await expect(charts).toHaveCount(5);
});

test("the charts of one object are shown in every scene, and stay while a number moves", async ({ page }) => {
  // Two scenes whose loaded objects have one name.
  server = new Server({ "a.json": "scenarios/rocker/two_masses.json", "b.json": "scenarios/rocker/two_masses.json" });
  await server.start();
  await opened(page, server.address, "Objects");
  const charts = page.locator(".charts section.object:visible h2");
  await expect(charts).toHaveText([/^rocker/]);
  await page.locator(".top select[aria-label=scene]").selectOption("b.json");
  await expect(page).toHaveTitle("b.json – dam studio");
  await expect(page.locator(".charts svg.dam-plot:visible").first()).toBeVisible();
  await expect(charts).toHaveText([/^rocker/]);
  // Nothing separates any more: the object stays all the same.
  await page
    .locator(".seen-beside label", { hasText: /^Charts of/ })
    .locator("select")
    .selectOption("shaft");
  await slider(page, "rocker.loads.closing.constant").press("Home");
  await page.waitForTimeout(500);
  await expect(charts).toHaveText([/^shaft/]);
});

test("the machine is enlarged and moved in its place with wheel, mouse and keys", async ({ page }) => {
  server = new Server();
  await server.start();
  await opened(page, server.address, "Objects");
  const room = page.locator(".sheet-room"),
    wide = async () => (await page.locator(".sheet-content svg.mechanism").boundingBox()).width;
  const before = await wide(),
    { x, y, width, height } = await room.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.wheel(0, -200);
  await expect.poll(wide).toBeGreaterThan(1.1 * before);
  const left = async () => (await page.locator(".sheet-content svg.mechanism").boundingBox()).x,
    from = await left();
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + 50, y + height / 2 + 10, { steps: 4 });
  await page.mouse.up();
  expect(Math.abs((await left()) - from - 50)).toBeLessThan(1);
  await room.focus();
  await page.keyboard.press("0");
  expect(Math.abs((await wide()) - before)).toBeLessThan(1);
});

test("numbers are found by their words, and those with a star stand on top after a reload", async ({ page }) => {
  server = new Server();
  await server.start();
  await opened(page, server.address, "Objects");
  const rows = page.locator(".slider");
  const search = page.getByRole("searchbox", { name: "search numbers" });
  await search.fill("damp rocker");
  await expect(rows).toHaveCount(1);
  await expect(rows).toHaveAttribute("data-address", "rocker.damping_capacity");
  await page.getByRole("button", { name: "star of rocker.damping_capacity" }).click();
  await search.press("Escape");
  await expect(rows.first()).toHaveAttribute("data-address", "rocker.damping_capacity");
  await page.reload();
  await page.waitForSelector(".verdict");
  await expect(rows.first()).toHaveAttribute("data-address", "rocker.damping_capacity");
  await expect(page.locator('[data-address="rocker.damping_capacity"]')).toHaveCount(1);
  await slider(page, "rocker.damping_capacity").press("ArrowRight");
  await search.fill("nothing of this name");
  await expect(page.locator(".sliders [role=status]")).toContainText("No number is called");
});
