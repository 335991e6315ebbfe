// The first page, the tour, expectations, units, printing.

import { expect, test } from "@playwright/test";
import { existsSync, writeFileSync } from "node:fs";
import { opened, slider, textOf, undone, watched } from "./page.mjs";
import { Server } from "./server.mjs";

let server, wrong;
const SCENES = {
  "two_masses.json": "scenarios/rocker/two_masses.json",
  "lift_off.json": "scenarios/valve_train/lift_off.json",
};
test.beforeEach(async ({ page }) => {
  server = new Server(SCENES);
  wrong = watched(page);
});
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});

const button = (page, name) => page.getByRole("button", { name, exact: true });
const entry = (page, text) => page.locator(".first-page .entry", { hasText: text });
const home = (page) => page.getByRole("region", { name: "first page" });
const shownScene = (page) => page.locator(".top select[aria-label=scene]");
const search = (page) => page.getByLabel("search scenes, templates and scenarios");
// The page of a folder, its lists there.
async function atHome(page) {
  await server.start({ home: true });
  await page.goto(server.address);
  await expect(search(page)).toBeVisible();
}

// One scene, open in the text view.
async function alone(page) {
  server.remove("lift_off.json");
  await server.start();
  await opened(page, server.address);
}

test("a folder opens with its scenes, templates and scenarios, searched together", async ({ page }) => {
  await atHome(page);
  await expect(search(page)).toBeFocused();
  await expect(page.getByRole("region", { name: "Opened last" })).toHaveCount(0);
  await expect(entry(page, "lift_off.json")).toContainText("Valve train");
  await expect(entry(page, "A crank press on a motor")).toContainText("press");
  await expect(page.locator(".gallery h3")).toHaveCount(11);
  await expect(button(page, "Undo")).toHaveCount(0);
  await search(page).fill("clutch hard");
  await expect(page.locator(".first-page .entry")).toHaveCount(1);
  await search(page).fill("no such machine anywhere");
  await expect(page.locator(".first-page [role=status]")).toContainText("Nothing here");
  await search(page).press("Escape");
  await expect(search(page)).toHaveValue("");
  await entry(page, "two_masses.json").first().click();
  await expect(page.locator(".verdict")).toContainText(/separates|lift off/);
  await expect(home(page)).toHaveCount(0);
  await expect(shownScene(page)).toHaveValue("two_masses.json");
});

test("what was opened last comes first, is kept over a new start, and is gone with its file", async ({
  page,
  context,
}) => {
  await atHome(page);
  await entry(page, "two_masses.json").click();
  await page.waitForSelector(".verdict");
  await shownScene(page).selectOption("lift_off.json");
  await expect(page.locator(".verdict")).toBeVisible();
  const recent = (own) => own.getByRole("region", { name: "Opened last" }).locator(".entry b");
  // It is written beside what is shown.
  await expect(async () => {
    await button(page, "Home").click();
    await expect(recent(page)).toHaveText(["lift_off.json", "two_masses.json"], { timeout: 500 });
  }).toPass({ timeout: 20_000 });
  // The window comes back to where it was.
  await page.reload();
  await expect(search(page)).toBeVisible();
  await server.kill();
  await server.start({ home: true });
  const again = await context.newPage();
  await again.goto(server.address);
  await expect(recent(again)).toHaveText(["lift_off.json", "two_masses.json"]);
  server.remove("lift_off.json");
  await again.reload();
  await expect(recent(again)).toHaveText(["two_masses.json"]);
  await recent(again).first().click();
  await again.waitForSelector(".verdict");
  await again.reload();
  await expect(shownScene(again)).toHaveValue("two_masses.json");
  await again.close();
});

test("a template and a scenario become new files of the folder, and none is written over", async ({ page }) => {
  test.setTimeout(120_000);
  await atHome(page);
  const asked = [],
    answers = [];
  page.on("dialog", (dialog) => {
    asked.push(dialog.defaultValue());
    void dialog.accept(answers.shift() ?? dialog.defaultValue());
  });
  await entry(page, "A lever on a cam").click();
  await expect(shownScene(page)).toHaveValue("lever.json");
  await expect(page.locator(".verdict")).toBeVisible();
  expect(server.text("lever.json")).toBe(server.read("src/frontend/scene/templates/lever.json"));
  // A scenario, under a name that is there: refused, nothing is changed.
  const before = server.text("two_masses.json");
  writeFileSync(server.path("two_masses.json"), `${before}\n`);
  answers.push("two_masses.json");
  await button(page, "Home").click();
  await entry(page, "rocker/two_masses").first().click();
  await expect(page.locator(".notices")).toContainText("there already");
  expect(server.text("two_masses.json")).toBe(`${before}\n`);
  await expect(home(page)).toBeVisible();
  // Out of the folder neither.
  answers.push("../out.json");
  await entry(page, "contact/claw_clutch").click();
  await expect(page.locator(".notices")).toContainText("no such");
  expect(existsSync(server.path("../out.json"))).toBe(false);
  await entry(page, "rocker/two_masses").first().click();
  await expect(shownScene(page)).toHaveValue("two_masses-2.json");
  const text = server.text("two_masses-2.json");
  expect(text).not.toContain("$schema");
  expect(text.replace(/\s/g, "")).toBe(before.replace(/"\$schema".*\n/, "").replace(/\s/g, ""));
  await expect(page.locator(".expectations summary")).toContainText("11 of 11 met");
  expect(asked).toEqual(["lever.json", "two_masses-2.json", "claw_clutch.json", "two_masses-2.json"]);
});

test("the tour goes through the page by the keyboard, and Escape ends it", async ({ page }) => {
  test.setTimeout(120_000);
  await atHome(page);
  const card = page.getByRole("dialog", { name: "tour" }),
    title = card.locator("h2");
  await button(page, "New here? A tour of two minutes").click();
  await expect(title).toHaveText("Open a scene");
  await expect(button(page, "Next")).toBeDisabled();
  // Opening one goes on.
  await entry(page, "two_masses.json").first().click();
  await expect(title).toHaveText("Move a number");
  await page.waitForSelector(".verdict");
  await expect(page.locator(".charts svg.dam-plot:visible").first()).toBeVisible();
  const seen = [];
  for (let k = 0; k < 14 && (await card.count()); k++) {
    const now = await title.textContent();
    seen.push(now);
    await expect(page.locator(".tour-light .tour-ring")).toBeVisible();
    await expect(button(page, now === "Save" ? "Done" : "Next")).toBeFocused();
    await page.keyboard.press("Enter");
    if (seen.length < 11) await expect(title).not.toHaveText(now);
  }
  expect(seen).toEqual([
    "Move a number",
    "Read the verdict",
    "See it move",
    "Charts of an object",
    "Map two numbers",
    "The mechanism as a graph",
    "Its equations",
    "The text behind it all",
    "Figures",
    "Take it back",
    "Save",
  ]);
  await expect(card).toHaveCount(0);
  // Seen: the first page does not urge any more; from the top bar it starts with the scene.
  await button(page, "Home").click();
  await expect(button(page, "New here? A tour of two minutes")).toHaveCount(0);
  await page.getByRole("button", { name: /^Back to/ }).click();
  await page.locator(".top").getByRole("button", { name: "Tour" }).click();
  await expect(title).toHaveText("Move a number");
  // The page is in use meanwhile.
  await slider(page, "rocker.inertia").press("ArrowRight");
  await expect(page.locator(".top")).toContainText("not saved");
  await page.keyboard.press("Escape");
  await expect(card).toHaveCount(0);
  await undone(page);
});

test("expectations are shown, and made from the run as one step of undo", async ({ page }) => {
  test.setTimeout(120_000);
  await alone(page);
  const summary = page.locator(".expectations summary");
  await expect(summary).toContainText("11 of 11 met");
  await slider(page, "rocker.inertia").press("PageUp");
  await expect(summary).toContainText(/ [0-9]+ of 11 met/);
  await expect(summary).not.toContainText("11 of 11");
  // The line at the foot says it too, and leads to the results.
  await page.locator(".status-line button.failed").click();
  await expect(page.getByRole("tab", { name: "Results" })).toHaveAttribute("aria-selected", "true");
  await summary.click();
  await expect(page.locator(".expectations tr.failed").first()).toBeVisible();
  await expect(page.locator(".expectations tr.failed").first()).toContainText("not met");
  await undone(page);
  await expect(summary).toContainText("11 of 11 met");
  const before = await textOf(page);
  // A new one, on a line of its own as the others.
  await button(page, "Expect a figure of this run…").click();
  const figure = page.locator(".expectations select");
  await expect(figure).toBeVisible({ timeout: 30_000 });
  await figure.selectOption("rocker.peak_speed");
  await expect(page.locator(".expectations .offer")).toContainText("±");
  await button(page, "Write it into the scene").click();
  await expect(summary).toContainText("12 of 12 met");
  const text = await textOf(page),
    lines = text.split("\n");
  const line = lines.find((one) => one.includes("rocker.peak_speed"));
  expect(line).toMatch(
    /^ {4}\{ "figure": "rocker\.peak_speed", "value": [\d.]+, "within": [1-9]?\d*e?-?[\d.]+, "source": "a run of dam [\d.]+" \}$/,
  );
  const { value, within } = JSON.parse(line);
  expect(Math.abs(value - server.run(text).objects.rocker.peak_speed)).toBeLessThanOrEqual(within);
  expect(within).toBeLessThan(1e-4 * value);
  // All else stands as it stood, but for the comma before.
  expect(
    lines
      .filter((one) => one !== line)
      .join("\n")
      .replace(/\},(\n {2}\])/, "}$1"),
  ).toBe(before);
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(before);
  await expect(button(page, "Undo")).toBeDisabled();
  // Of a figure that is expected already value and bound are written anew.
  await button(page, "Expect a figure of this run…").click();
  await expect(figure).toBeVisible({ timeout: 30_000 });
  await figure.selectOption("rocker.delta_max");
  await button(page, "Write it into the scene").click();
  await expect.poll(() => textOf(page)).not.toContain("0.001 %");
  expect((await textOf(page)).match(/rocker\.delta_max/g)).toHaveLength(1);
  await expect(summary).toContainText("11 of 11 met");
});

test("a scene without expectations gets its first", async ({ page }) => {
  server.write(server.read("src/frontend/scene/templates/shaft.json"), "two_masses.json");
  await alone(page);
  await page.waitForSelector(".verdict");
  expect(await textOf(page)).not.toContain('"expect"');
  await page.getByRole("tab", { name: "Results" }).click();
  await expect(async () => {
    await button(page, "Expect a figure of this run…").click({ timeout: 500 });
  }).toPass();
  await expect(button(page, "Write it into the scene")).toBeVisible({ timeout: 30_000 });
  await button(page, "Write it into the scene").click();
  await expect(page.locator(".expectations summary")).toContainText("1 of 1 met");
  expect(JSON.parse(await textOf(page)).expect).toHaveLength(1);
});

test("units are those that were chosen, and the text stays as it is", async ({ page, context }) => {
  test.setTimeout(120_000);
  await alone(page);
  await expect(page.locator(".verdict")).toContainText(/separates|lift off/);
  const before = await textOf(page),
    deltaOn = (own) => own.locator(".figures tbody td span[title]").first(),
    delta = deltaOn(page);
  await expect(delta).toContainText("mrad");
  const field = page.getByLabel("speed", { exact: true }),
    { delta_abs: size } = server.run(before).objects.rocker;
  await expect(field).toHaveValue("10 rev/s");
  const choose = async (name, unit, own = page) => {
    await button(own, "Units").click();
    await own
      .getByRole("group", { name: "units shown" })
      .getByLabel(name, { exact: true })
      .selectOption({ label: unit });
    await own.keyboard.press("Escape");
    await expect(button(own, "Units")).toBeFocused();
  };
  await choose("angles", "deg");
  await choose("angular speeds", "rpm");
  await expect(delta).toHaveText(/ deg$/);
  const shown = Number((await delta.textContent()).split(" ")[0]);
  expect(shown).toBeCloseTo((size * 180) / Math.PI, 6);
  await expect(page.locator(".charts svg.dam-plot:visible").filter({ hasText: /, deg/ }).first()).toBeVisible();
  await expect(page.locator(".charts")).not.toContainText("mrad");
  // The answer's sentence too, to as many digits as it has.
  await expect(page.locator(".status-line .verdict")).toContainText(/separates .*, [\d.]+ m?s in all/);
  await choose("times", "ms");
  await expect(page.locator(".status-line .verdict")).toContainText(
    /separates .*, [\d.]+ ms in all, the longest [\d.]+ ms/,
  );
  const told = /, ([\d.]+) ms in all/.exec(await page.locator(".status-line .verdict").textContent());
  const { separated_time: whole } = server.run(before).objects.rocker.pair;
  expect(Number(told[1])).toBeCloseTo(Number((1000 * whole).toPrecision(4)), 9);
  await expect(field).toHaveValue("600 rpm");
  expect(await textOf(page)).toBe(before);
  // What is typed goes into the text in the unit that it has there.
  await field.fill("660");
  await field.press("Enter");
  await expect.poll(() => textOf(page)).toContain('"speed": "11 rev/s"');
  await expect(field).toHaveValue("660 rpm");
  await expect(delta).toHaveText(/ deg$/);
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(before);
  await page.reload();
  await page.waitForSelector(".verdict");
  await expect(delta).toHaveText(/ deg$/);
  // A whole system at once, and back; the text stays.
  const system = async (name) => {
    await button(page, "Units").click();
    await page.getByLabel("system of units").selectOption({ label: name });
    await page.keyboard.press("Escape");
  };
  await system("in, lbf, deg");
  const inertia = page.locator('[id="number rocker.inertia"]'),
    own = JSON.parse(before).objects.rocker.inertia;
  await expect(inertia).toHaveValue(/ lb in²$/);
  expect(parseFloat(await inertia.inputValue()) * 2.926397e-4).toBeCloseTo(own, 6);
  await expect(
    page
      .locator(".charts svg.dam-plot:visible")
      .filter({ hasText: /, lbf in/ })
      .first(),
  ).toBeVisible();
  await inertia.fill("400");
  await inertia.press("Enter");
  await expect.poll(async () => JSON.parse(await textOf(page)).objects.rocker.inertia).toBeCloseTo(0.1170559, 6);
  await button(page, "Undo").click();
  await system("mm, N, deg");
  await expect(field).toHaveValue("600 rpm");
  await expect(
    page
      .locator(".charts svg.dam-plot:visible")
      .filter({ hasText: /, N mm/ })
      .first(),
  ).toBeVisible();
  expect(await textOf(page)).toBe(before);
  // A later program has them too, on another port, where the browser has nothing.
  await server.kill();
  await server.start();
  const again = await context.newPage();
  await opened(again, server.address);
  await expect(deltaOn(again)).toHaveText(/ deg$/);
  await choose("angles", "whichever reads best", again);
  await expect(deltaOn(again)).toHaveText(/ mrad$/);
});

test("what is printed is the report, of the scene as it is", async ({ page }) => {
  test.setTimeout(120_000);
  await alone(page);
  await expect(page.locator(".verdict")).toContainText(/separates|lift off/);
  await slider(page, "rocker.inertia").press("ArrowRight");
  // At rest all charts have their numbers, in sight or not.
  await expect(page.locator(".charts .behind")).toHaveCount(0);
  await page.emulateMedia({ media: "print" });
  for (const gone of [".top", ".pane-left", ".pane-middle", ".expectations .tools"])
    await expect(page.locator(gone).first()).toBeHidden();
  await expect(page.locator(".print-head h1")).toHaveText("Rocker of a cam mechanism, two masses");
  await expect(page.locator(".print-head")).toContainText("changes not saved");
  for (const there of [".verdict", ".figures table", ".charts svg.dam-plot"])
    await expect(page.locator(there).last()).toBeVisible();
  // All of it stands one below the other, and nothing is cut off.
  const sizes = await page.evaluate(() => ({
    answers: document.querySelector(".answers").getBoundingClientRect().height,
    last: document.querySelector(".charts").getBoundingClientRect().bottom,
  }));
  expect(sizes.last).toBeGreaterThan(1500);
  expect(Math.abs(sizes.answers - sizes.last)).toBeLessThan(60);
  await page.emulateMedia({ media: null });
  const pdf = await page.pdf({ format: "A4" });
  expect(pdf.toString("latin1").match(/\/Type\s*\/Page[^s]/g).length).toBeGreaterThan(1);
  if (process.env.PICTURES) writeFileSync(`${process.env.PICTURES}/printed.pdf`, pdf);
});
