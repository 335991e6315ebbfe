// Runs that are pinned, a signal over another, and what is exported.

import { expect, test } from "@playwright/test";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { agrees, deltaOf, opened as openedAt, slider, textOf, watched } from "./page.mjs";
import { Server, dam } from "./server.mjs";

let server, wrong;
test.beforeEach(async ({ page }) => {
  server = new Server();
  await server.start();
  wrong = watched(page);
});
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});
const opened = (page) => openedAt(page, server.address);
const chart = (page, title) =>
  page.locator(".charts .chart", { has: page.locator("svg.dam-plot", { hasText: title }) }).first();
const text = async (download) => readFileSync(await (await download).path(), "utf8");
async function moved(page, key = "ArrowRight", times = 5) {
  const before = await deltaOf(page);
  await slider(page, "rocker.inertia").focus();
  for (let k = 0; k < times; k++) await page.keyboard.press(key);
  await expect.poll(() => deltaOf(page)).not.toBe(before);
  await textOf(page);
}
// Exports a chart and returns what was saved.
async function exported(page, place, way) {
  await place.scrollIntoViewIfNeeded();
  await place.locator(".export summary").click();
  const download = page.waitForEvent("download");
  await place.locator(".export button", { hasText: way }).click();
  return download;
}
const table = (csv) => {
  const [head, ...rows] = csv.trimEnd().split("\n");
  return { head: head.split(","), columns: head.split(",").map((_, k) => rows.map((row) => row.split(",")[k])) };
};

test("a pinned run stays in the charts and beside the figures", async ({ page }) => {
  await opened(page);
  const delta = chart(page, "Positioning error");
  await expect(delta).toBeVisible();
  const first = await deltaOf(page),
    alone = table(await text(exported(page, delta, "CSV")));
  await page.getByRole("button", { name: "Pin this run" }).click();
  await expect(page.getByLabel("name of pinned run 1")).toHaveValue("run 1");
  await moved(page);
  await expect(delta.locator(".legend .entry")).toHaveCount(2);
  await expect(delta.locator(".legend")).toContainText("now");
  // Both curves: the pinned one is that of before, the other one is not.
  const both = table(await text(exported(page, delta, "CSV")));
  expect(both.head.filter((name) => name.includes("now"))).toHaveLength(1);
  const pinned = both.head.findIndex((name) => name.includes("run 1"));
  expect(both.columns[pinned].filter(Boolean)).toEqual(alone.columns[1]);
  const now = both.columns[both.head.findIndex((name) => name.includes("now"))].filter(Boolean);
  expect(now).not.toEqual(alone.columns[1]);
  // Figures side by side: the pinned one to the last digit, with the difference.
  const row = page.locator(".compared tr", { hasText: "greatest |δ|" }).first();
  const titles = await row.locator("td span[title]").evaluateAll((all) => all.map((one) => one.title.split(" ")[0]));
  expect(titles[1]).toBe(first);
  expect(Number(titles[0])).toBe(server.run(await textOf(page)).objects.rocker.delta_abs);
  await expect(row).toContainText("%");
  // A curve is switched off in the legend.
  const curve = delta.locator(".inside path[data-series='1']");
  await expect(curve).toBeVisible();
  await delta.locator(".legend .entry text", { hasText: "run 1" }).click();
  await expect(delta.locator(".legend .entry", { hasText: "run 1" })).toHaveClass(/off/);
  // Another name, a second pin, and both go again.
  const name = page.getByLabel("name of pinned run 1");
  await name.fill("before");
  await name.blur();
  await expect(delta.locator(".legend")).toContainText("before");
  await page.getByRole("button", { name: "Pin this run" }).click();
  await expect(delta.locator(".legend .entry")).toHaveCount(3);
  await moved(page, "ArrowLeft", 2);
  await expect(delta.locator(".legend .entry")).toHaveCount(3);
  // Loaded anew, the page has them still.
  await page.reload();
  await expect(page.getByLabel("name of pinned run 1")).toHaveValue("before");
  await expect(page.getByLabel("name of pinned run 2")).toHaveValue("run 2");
  await expect(delta.locator(".legend .entry")).toHaveCount(3);
  await page.getByRole("button", { name: "unpin before" }).click();
  await expect(delta.locator(".legend .entry")).toHaveCount(2);
  await page.getByRole("button", { name: "unpin run 2" }).click();
  await expect(page.locator(".seen-beside .pin")).toHaveCount(0);
  await expect(page.locator(".charts .legend .entry", { hasText: "now" })).toHaveCount(0);
});

test("pinned runs are there again after the program was killed", async ({ page, context }) => {
  await opened(page);
  const first = await deltaOf(page);
  await page.getByRole("button", { name: "Pin this run" }).click();
  await expect(page.getByLabel("name of pinned run 1")).toHaveValue("run 1");
  await moved(page);
  await agrees(page, server);
  const second = await deltaOf(page);
  await page.getByRole("button", { name: "Pin this run" }).click();
  const name = page.getByLabel("name of pinned run 2");
  await name.fill("heavier");
  await name.blur();
  const row = (one) => one.locator(".compared tr", { hasText: "greatest |δ|" }).first();
  const titles = (one) =>
    row(one)
      .locator("td span[title]")
      .evaluateAll((all) => all.map((each) => each.title.split(" ")[0]));
  await expect.poll(() => titles(page)).toContain(second);
  await expect(page.locator(".compared")).toContainText("heavier");
  const before = await titles(page);
  await expect.poll(() => server.pinned()).toEqual(["run 1", "heavier"]);
  await page.close();
  await server.kill();
  // Another port, another tab: the text is that of the file, the pinned figures are those of before.
  const port = Number(new URL(server.address).port),
    later = await context.newPage(),
    late = watched(later);
  await server.start({ port: port === 65535 ? port - 1 : port + 1 });
  await openedAt(later, server.address);
  await expect(later.getByLabel("name of pinned run 1")).toHaveValue("run 1");
  await expect(later.getByLabel("name of pinned run 2")).toHaveValue("heavier");
  await expect.poll(() => titles(later)).toContain(second);
  const after = await titles(later),
    columns = await row(later).locator("td").count();
  expect(columns).toBeGreaterThan(2);
  expect([first, second].map((one) => after.includes(one))).toEqual([true, true]);
  expect(after.slice(1, 3).sort()).toEqual(before.slice(1, 3).sort());
  expect(late).toEqual([]);
});

test("a signal over another is a chart of the record's columns", async ({ page }) => {
  await opened(page);
  const tools = page.getByRole("group", { name: "beside the run" });
  await tools.getByLabel("over").selectOption("rocker.displacement");
  await tools.getByLabel("Chart of").selectOption("rocker.speed");
  const portrait = chart(page, "rocker.speed over rocker.displacement");
  await expect(portrait).toBeVisible();
  const csv = table(await text(exported(page, portrait, "CSV")));
  expect(csv.head).toEqual(["rocker.displacement [rad]", "rocker.speed over rocker.displacement [rad/s]"]);
  const own = async (name) =>
    table(await text(exported(page, page.locator("#object-rocker .chart", { hasText: name }).first(), "CSV")));
  const displacement = await own("Displacement"),
    speed = await own("Speed");
  expect(csv.columns[0]).toEqual(displacement.columns[1]);
  expect(csv.columns[1]).toEqual(speed.columns[1]);
  await moved(page);
  await expect(portrait).toBeVisible();
  await tools.getByLabel("Chart of").selectOption("");
  await expect(portrait).toHaveCount(0);
});

test("charts, the report and the scene are saved as files", async ({ page }) => {
  await opened(page);
  const delta = chart(page, "Positioning error");
  const csv = table(await text(exported(page, delta, "CSV")));
  // The chart's own numbers, all of them to the last digit.
  expect(csv.head).toEqual(["t [s]", "Positioning error δ [rad]"]);
  const greatest = Math.max(...csv.columns[1].map((value) => Math.abs(Number(value))));
  const figures = server.run(server.text()).objects.rocker;
  expect(greatest).toBeLessThanOrEqual(figures.delta_abs);
  expect(greatest).toBeGreaterThan(0.9 * figures.delta_abs);
  const svg = await text(exported(page, delta, "SVG"));
  expect(svg).toContain('xmlns="http://www.w3.org/2000/svg"');
  expect(svg).not.toContain("var(--");
  await page.evaluate((svg) => {
    const parsed = new DOMParser().parseFromString(svg, "image/svg+xml");
    if (parsed.querySelector("parsererror")) throw new Error("no SVG");
  }, svg);
  const png = readFileSync(await (await exported(page, delta, "PNG")).path());
  expect(png.subarray(1, 4).toString()).toBe("PNG");
  expect(png.length).toBeGreaterThan(5000);
  const saved = async (name) => {
    const download = page.waitForEvent("download");
    await page.getByRole("button", { name }).click();
    return text(download);
  };
  expect(await saved("Export scene")).toBe(server.text());
  const report = await saved("Export report");
  // The page is that of the command, byte for byte.
  const out = join(server.base, "out");
  // A pair that opens ends the command with status 1.
  try {
    execFileSync(dam, ["run", server.path(), "--out", out, "--quiet", "--units", "si"], { stdio: "ignore" });
  } catch {
    /* told by its files */
  }
  expect(report).toBe(readFileSync(join(out, "report.html"), "utf8"));
  const record = table(await saved("Export record"));
  expect(record.columns[0].length).toBeGreaterThan(100);
});

test("a map is saved with what is told of every cell", async ({ page }) => {
  await opened(page);
  await page.getByRole("button", { name: "Map over two numbers" }).click();
  await expect(page.locator(".map-view")).toContainText("400 points", { timeout: 60_000 });
  const csv = await text(exported(page, page.locator(".map-place .chart"), "CSV"));
  const [head, ...rows] = csv.trimEnd().split("\n");
  expect(head).toMatch(/^[^,]+ from[^,]*,[^,]+ to[^,]*,[^,]+ from[^,]*,[^,]+ to[^,]*,told/);
  expect(rows).toHaveLength(400);
  expect(rows[0]).toMatch(/rad/);
});

// Frames of a GIF, their time (1/100 s) and its size, by its blocks.
function film(bytes) {
  const found = { size: [bytes.readUInt16LE(6), bytes.readUInt16LE(8)], frames: 0, time: 0 };
  let at = 13 + 3 * 2 ** ((bytes[10] & 7) + 1);
  const skip = () => {
    while (bytes[at] > 0) at += 1 + bytes[at];
    at++;
  };
  while (bytes[at] !== 0x3b) {
    if (bytes[at] === 0x2c) {
      found.frames++;
      at += 11;
    } else {
      if (bytes[at + 1] === 0xf9) found.time += bytes.readUInt16LE(at + 4);
      at += 2;
    }
    skip();
  }
  return { ...found, end: at + 1 === bytes.length };
}

test("the moving machine is saved as an SVG that runs by itself and as a GIF of one turn", async ({ page }) => {
  await opened(page);
  const saved = async (kind) => {
    const download = page.waitForEvent("download");
    await page.locator(".machine figure.moving").getByRole("button", { name: kind, exact: true }).click();
    return readFileSync(await (await download).path());
  };
  const svg = (await saved("SVG")).toString();
  expect(svg).not.toMatch(/var\(|href=/);
  const [wrongs, turns, wide, high] = await page.evaluate((svg) => {
    const read = new DOMParser().parseFromString(svg, "image/svg+xml"),
      turns = [...read.querySelectorAll("animateTransform[type=rotate]")].map((one) =>
        one.getAttribute("values").split(";").map(Number),
      );
    return [
      read.querySelectorAll("parsererror").length,
      turns,
      +read.documentElement.getAttribute("width"),
      +read.documentElement.getAttribute("height"),
    ];
  }, svg);
  expect(wrongs).toBe(0);
  // The drive turns once, counterclockwise.
  expect(turns[0].at(-1) - turns[0][0]).toBeCloseTo(-360, 1);
  // Two seconds and a half a turn, 25 frames a second.
  const gif = film(await saved("GIF"));
  expect(gif).toMatchObject({ size: [wide, high], time: 250, end: true });
  expect(Math.abs(gif.frames - 62.5)).toBeLessThan(1);
});
