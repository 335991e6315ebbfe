// Motions made of segments, drawn: with the mouse, with the keyboard, by their lists.

import { expect, test } from "@playwright/test";
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { begun, button, eachWatched, server } from "./drawn.mjs";
import { box, textOf } from "./page.mjs";
import { dam } from "./server.mjs";

eachWatched();
const panel = (page) => page.locator("section.motion");
const handle = (page, name) => panel(page).getByRole("slider", { name, exact: true });
const settled = async (page) => {
  await textOf(page);
  await expect(panel(page)).toHaveAttribute("aria-busy", "false");
};
const curve = (page, name = "displacement") => page.locator(`[data-curve="${name}"] .curve`).getAttribute("d");

// A scene with an object chosen, whose motion is drawn.
async function drawn(page, scenario, id, change = (text) => text) {
  await begun(page, {}, (server) => server.write(change(server.read(`scenarios/${scenario}.json`)), "scene.json"));
  await page.getByRole("tab", { name: "Objects" }).click();
  await box(page, id).click();
}
const shownOf = async (page, scenario, id, change) => {
  await drawn(page, scenario, id, change);
  await expect(panel(page).locator("svg")).toBeVisible();
  await settled(page);
};
// The cycle of the program, for the text as it is.
async function cycleOf(page, id) {
  const file = join(server.base, "asked.json");
  writeFileSync(file, await textOf(page));
  return JSON.parse(execFileSync(dam, ["law", "cycle", file, "--of", id, "--json", "--quiet"], { encoding: "utf8" }))
    .cycle;
}
const stationsIn = async (page, id = "valve") => JSON.parse(await textOf(page)).objects[id].position.plan.stations;
const middle = async (locator) => {
  const { x, y, width, height } = await locator.boundingBox();
  return [x + width / 2, y + height / 2];
};
// Degrees of a turn as pixels of the drawing.
const perDegree = async (page) => {
  const { width } = await panel(page).locator("svg").boundingBox();
  return (width - 18) / 360;
};
const noFaults = (page) => expect(page.locator(".faults button")).toHaveCount(0);

test("a boundary is dragged in whole degrees, the curves follow, and undo takes back all of it", async ({ page }) => {
  await shownOf(page, "valve_train/valve_lash", "valve");
  const before = await textOf(page),
    first = await curve(page),
    own = handle(page, "boundary between rise and dwell 1");
  await expect(own).toHaveAttribute("aria-valuetext", "70°");
  const [x, y] = await middle(own),
    step = await perDegree(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 4 * step, y, { steps: 2 });
  // While it is held.
  await expect.poll(() => curve(page)).not.toBe(first);
  await page.mouse.move(x - 10 * step, y, { steps: 4 });
  await page.mouse.up();
  await expect(own).toHaveAttribute("aria-valuetext", "60°");
  const after = await textOf(page);
  expect(after).toBe(before.replace('"at": "70 deg"', '"at": "60 deg"'));
  // Figures are those of `dam law cycle`.
  const speed =
    JSON.parse(after).objects.camshaft?.motion?.speed ??
    Object.values(JSON.parse(after).objects).find((one) => one.kind === "drive").motion.speed;
  const omega = /rpm/.test(speed) ? (parseFloat(speed) * 2 * Math.PI) / 60 : NaN,
    cycle = await cycleOf(page, "valve");
  const greatest = Math.max(cycle.acceleration.value, -cycle.deceleration.value) * omega ** 2;
  const shown = await panel(page).getByRole("group", { name: "greatest values" }).locator("dd").nth(1).textContent();
  expect(parseFloat(shown)).toBeCloseTo(Number(greatest.toPrecision(4)), 6);
  expect(shown).toMatch(/m\/s² at /);
  await noFaults(page);
  // It stays before its neighbour.
  await page.mouse.move(...(await middle(own)));
  await page.mouse.down();
  await page.mouse.move(x + 60 * step, y, { steps: 6 });
  await page.mouse.up();
  await expect(own).toHaveAttribute("aria-valuetext", "73°");
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(after);
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(before);
  await expect(button(page, "Undo")).toBeDisabled();
});

test("the keyboard alone moves boundaries and levels, in whole steps and in tenths", async ({ page }) => {
  await shownOf(page, "valve_train/valve_lash", "valve");
  const before = await textOf(page),
    own = handle(page, "boundary between rise and dwell 1");
  await handle(page, "boundary between dwell 2 and rise").focus();
  await page.keyboard.press("Tab");
  await expect(own).toBeFocused();
  await page.keyboard.press("ArrowLeft");
  await expect(own).toHaveAttribute("aria-valuetext", "69°");
  await page.keyboard.press("Shift+ArrowRight");
  await expect(own).toHaveAttribute("aria-valuetext", "69.1°");
  await page.keyboard.press("ArrowRight");
  await expect(own).toHaveAttribute("aria-valuetext", "70°");
  await expect(own).toBeFocused();
  expect(await textOf(page)).toBe(before);
  await page.keyboard.press("PageDown");
  await expect(own).toHaveAttribute("aria-valuetext", "60°");
  // Both stations of the upper dwell go up together; the drawing has its name.
  const level = handle(page, "level of dwell 1");
  await level.focus();
  await expect(level).toHaveAttribute("aria-valuetext", "10.5 mm");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("ArrowUp");
  await expect(level).toHaveAttribute("aria-valuetext", "10.7 mm");
  expect((await stationsIn(page)).map((one) => one.displacement)).toEqual(["-0.2 mm", "10.7 mm", "10.7 mm", "-0.2 mm"]);
  // The base is a level too, over the end of the cycle.
  await handle(page, "level of dwell 2").focus();
  await page.keyboard.press("ArrowUp");
  await expect
    .poll(async () => (await stationsIn(page)).map((one) => one.displacement))
    .toEqual(["-0.1 mm", "10.7 mm", "10.7 mm", "-0.1 mm"]);
  await noFaults(page);
});

test("a level is dragged by the mouse", async ({ page }) => {
  await shownOf(page, "valve_train/in_working_order", "valve");
  const level = handle(page, "level of dwell 1"),
    [x, y] = await middle(level),
    before = await textOf(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y + 30, { steps: 5 });
  await page.mouse.up();
  await settled(page);
  const lift = /"lift": "([\d.]+) mm"/.exec(await textOf(page))[1];
  expect(Number(lift)).toBeLessThan(9);
  expect(await textOf(page)).toBe(before.replace('"10.5 mm"', `"${lift} mm"`));
  await expect(level).toHaveAttribute("aria-valuetext", `${lift} mm`);
  // The knob is where the pointer let it go, to half a step.
  expect(Math.abs((await middle(level))[1] - y)).toBeLessThan(60);
});

test("a cam keeps its properties: its start is a phase, its laws are apart, what it cannot be is a plan", async ({
  page,
}) => {
  await shownOf(page, "valve_train/in_working_order", "valve");
  const cam = async () => JSON.parse(await textOf(page)).objects.valve.position.cam;
  expect(await cam()).toMatchObject({ rise: "70 deg", dwell: "4 deg", return: "70 deg", phase: "-30 deg" });
  const start = handle(page, "boundary between dwell 2 and rise");
  await expect(start).toHaveAttribute("aria-valuetext", "30°");
  await start.focus();
  await page.keyboard.press("PageUp");
  await expect(start).toHaveAttribute("aria-valuetext", "40°");
  expect(await cam()).toMatchObject({ rise: "60 deg", dwell: "4 deg", return: "70 deg", phase: "-40 deg" });
  await handle(page, "boundary between rise and dwell 1").focus();
  await page.keyboard.press("ArrowLeft");
  await expect.poll(cam).toMatchObject({ rise: "59 deg", dwell: "5 deg", return: "70 deg", phase: "-40 deg" });
  await panel(page).getByLabel("motion of rise").selectOption("cycloidal");
  await expect.poll(async () => (await cam()).law).toEqual({ rise: "cycloidal", return: "4-5-6-7" });
  await settled(page);
  const peaks = async () => {
    const { acceleration, deceleration } = await cycleOf(page, "valve");
    return [acceleration.value, deceleration.value];
  };
  const before = await peaks();
  // The rise stops in its middle: no cam has that.
  await button(page, "split dwell 1").click();
  await expect.poll(async () => (await stationsIn(page)).length).toBe(5);
  await noFaults(page);
  const plan = JSON.parse(await textOf(page)).objects.valve.position;
  expect(Object.keys(plan)).toEqual(["plan"]);
  expect(plan.plan).toMatchObject({ period: "360 deg", phase: "-40 deg" });
  // It is the same motion.
  await settled(page);
  for (const [k, one] of (await peaks()).entries()) expect(one / before[k]).toBeCloseTo(1, 9);
  await expect(panel(page).locator(".segments li")).toHaveCount(5);
});

test("segments are split, removed and made dwells, and the scene stays right", async ({ page }) => {
  await shownOf(page, "cams/indexing_dwells", "table");
  const text = await textOf(page),
    stations = () => stationsIn(page, "table"),
    list = panel(page).locator(".segments li");
  await expect(list).toHaveCount(6);
  await button(page, "split rise 2").click();
  await expect(list).toHaveCount(7);
  expect((await stations())[3]).toEqual({ at: "150 deg", displacement: "16 deg", motion: "cycloidal" });
  // On a line of its own, as the others; all else stays.
  const lines = (await textOf(page)).split("\n");
  expect(lines.filter((line) => !/150 deg/.test(line)).join("\n")).toBe(text);
  await noFaults(page);
  await button(page, "remove rise 3").click();
  await expect(list).toHaveCount(6);
  expect(await textOf(page)).toBe(text);
  // A rise that becomes a dwell takes the dwell behind it along.
  await panel(page).getByLabel("motion of rise 2").selectOption("dwell");
  await expect
    .poll(async () => (await stations()).map((one) => one.displacement))
    .toEqual([0, "10 deg", "10 deg", "10 deg", "10 deg", 0]);
  await noFaults(page);
  await settled(page);
  await button(page, "remove dwell 1").click();
  await expect(list).toHaveCount(5);
  await noFaults(page);
  // Without the return its dwell has to come down.
  await settled(page);
  await panel(page).getByRole("button", { name: "remove return" }).click();
  await expect(list).toHaveCount(4);
  await noFaults(page);
  await expect(page.locator(".verdict")).toBeVisible();
});

test("jumps of velocity and acceleration are marked, with their size in words", async ({ page }) => {
  await shownOf(page, "indexing/soft_shock", "lever");
  const words = panel(page).getByRole("list", { name: "matching at the boundaries" }).locator("li");
  await expect(words).toHaveCount(2);
  const { jumps } = await cycleOf(page, "lever"),
    soft = jumps.filter((one) => one.order === 2),
    omega = (200 * 2 * Math.PI) / 60;
  for (const [k, jump] of soft.entries()) {
    const size = Number((Math.abs(jump.after - jump.before) * omega ** 2).toPrecision(4));
    await expect(words.nth(k)).toContainText(
      `Acceleration jumps by ${size} rad/s² at ${Math.round((jump.at * 180) / Math.PI)}°`,
    );
  }
  await expect(panel(page).locator('.jump[data-order="2"]')).toHaveCount(2);
  await panel(page).getByLabel("motion of rise").selectOption("uniform");
  await expect(words.first()).toContainText(/^Velocity jumps by [\d.]+ rad\/s at 20°: a hard shock/);
  await panel(page).getByLabel("motion of rise").selectOption("cycloidal");
  await expect(words).toHaveText(["Velocity and acceleration are continuous."]);
  await expect(panel(page).locator(".jump")).toHaveCount(0);
});

test("a motion over time, of a drive, and one that an expression holds", async ({ page }) => {
  const plan =
    '{ "plan": { "stations": [{ "at": 0, "displacement": 0, "motion": "cycloidal" }, { "at": "0.5 s", "displacement": "90 deg", "motion": "dwell" }, { "at": "1 s", "displacement": "90 deg" }] } }';
  await shownOf(page, "valve_train/valve_lash", "camshaft", (text) =>
    text.replace(/("kind": "drive", "motion": )\{[^}]*\}/, `$1${plan}`).replace('"70 deg"', '"2*35 deg"'),
  );
  const own = handle(page, "boundary between rise and dwell");
  await expect(own).toHaveAttribute("aria-valuetext", "0.5 s");
  await own.focus();
  await page.keyboard.press("ArrowRight");
  await expect(own).toHaveAttribute("aria-valuetext", "0.51 s");
  expect(await textOf(page)).toContain('"at": "0.51 s"');
  await expect(panel(page).getByRole("group", { name: "greatest values" })).toContainText("rad/s²");
  await box(page, "valve").click();
  await expect(panel(page)).toHaveAttribute("aria-label", "motion of valve");
  await settled(page);
  await expect(panel(page)).toContainText("Per radian of the drive");
  const before = await textOf(page);
  await handle(page, "boundary between rise and dwell 1").focus();
  await page.keyboard.press("ArrowLeft");
  await expect(panel(page).getByRole("status")).toContainText("at is “2*35 deg”: change it in its field.");
  expect(await textOf(page)).toBe(before);
});

test("an object without a motion is given one that is drawn on", async ({ page }) => {
  await drawn(page, "valve_train/in_working_order", "valve", (text) => {
    const scene = JSON.parse(text);
    delete scene.objects.valve.position;
    return JSON.stringify(scene, null, 2);
  });
  await expect(page.locator(".faults button").first()).toContainText("position");
  await button(page, "Draw the motion").focus();
  await page.keyboard.press("Enter");
  await expect(panel(page).locator("svg")).toBeVisible();
  await noFaults(page);
  await expect(panel(page).locator(".segments li")).toHaveCount(4);
  await expect(page.locator(".verdict")).toBeVisible();
  expect(JSON.parse(await textOf(page)).objects.valve.position).toEqual({
    cam: { lift: "10 mm", rise: "90 deg", dwell: "90 deg", return: "90 deg", law: "cycloidal" },
  });
  await expect(panel(page).locator(".matching")).toContainText("are continuous");
});

for (const scheme of ["light", "dark"])
  test(`the drawing fits its pane and is seen, ${scheme}`, async ({ page }) => {
    await page.emulateMedia({ colorScheme: scheme });
    await shownOf(page, "cams/indexing_dwells", "table");
    const found = await page.evaluate(() => {
      const pane = document.querySelector(".side"),
        svg = document.querySelector(".motion-curves").getBoundingClientRect();
      const channel = (one) => ((one /= 255) <= 0.03928 ? one / 12.92 : ((one + 0.055) / 1.055) ** 2.4);
      const light = (colour) => {
        const [r, g, b] = colour
          .match(/[\d.]+/g)
          .map(Number)
          .map(channel);
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const paper = light(getComputedStyle(document.body).backgroundColor);
      const contrast = (selector, property) => {
        const own = light(getComputedStyle(document.querySelector(selector))[property]);
        return (Math.max(own, paper) + 0.05) / (Math.min(own, paper) + 0.05);
      };
      return {
        isWithin: pane.scrollWidth <= pane.clientWidth && svg.right <= pane.getBoundingClientRect().right,
        width: svg.width,
        curves: [".c0", ".c1", ".c2", ".c3"].map((one) => contrast(one, "stroke")),
        words: contrast(".motion-curves .size", "fill"),
        knob: contrast(".boundary .knob", "stroke"),
      };
    });
    expect(found.isWithin).toBe(true);
    expect(found.width).toBeGreaterThan(230);
    for (const one of [...found.curves, found.knob]) expect(one).toBeGreaterThan(3);
    expect(found.words).toBeGreaterThan(4.5);
    // Every control has a name.
    const names = await panel(page)
      .locator("button, select, [role=slider]")
      .evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
    expect(names.every((name) => name) && new Set(names).size === names.length).toBe(true);
    if (process.env.PICTURES) await page.screenshot({ path: `${process.env.PICTURES}/motion-${scheme}.png` });
  });
