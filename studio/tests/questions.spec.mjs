// The tabs of other questions: what they show is what the commands tell.

import { expect, test } from "@playwright/test";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { opened as openedAt, textOf, watched } from "./page.mjs";
import { Server, dam } from "./server.mjs";

const SCENES = {
  "shaper.json": "scenarios/linkages/shaper.json",
  "slider_crank.json": "scenarios/kinetostatics/slider_crank.json",
  "engine.json": "scenarios/steady/engine.json",
  "indexing_dwells.json": "scenarios/cams/indexing_dwells.json",
  "flat_tappet.json": "scenarios/cams/flat_tappet.json",
  "two_masses.json": "scenarios/rocker/two_masses.json",
};
let server, wrong;
test.beforeEach(async ({ page }) => {
  server = new Server(SCENES);
  await server.start();
  wrong = watched(page);
});
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});

const asking = (page) => page.locator("section.asking");
async function opened(page, scene) {
  await openedAt(page, server.address);
  await page.locator(".top select").selectOption(scene);
  await expect(page.locator(".top select")).toHaveValue(scene);
  await expect(page.locator(".status-line .verdict")).toHaveCount(1);
}
const done = (page) => expect(asking(page)).toHaveAttribute("aria-busy", "false", { timeout: 60_000 });
async function tab(page, name) {
  await asking(page).getByRole("tab", { name, exact: true }).click();
  await expect(page.locator(".found").locator("h2, .dam-plot, dl").first()).toBeVisible({ timeout: 60_000 });
  await done(page);
}
// The command's answer to a scene, as JSON and as its page.
function told(scene, command, ...options) {
  const run = (more) => {
    try {
      return execFileSync(dam, [...command.split(" "), ...(scene ? [server.path(scene)] : []), ...options, ...more], {
        encoding: "utf8",
        stdio: ["ignore", "pipe", "ignore"],
        maxBuffer: 1 << 28,
        timeout: 50_000,
      });
    } catch (error) {
      return error.stdout;
    }
  };
  const json = JSON.parse(run(["--json"])),
    out = join(server.base, `out-${Math.random()}`);
  // (The studio shows SI units until others are chosen.)
  run(["--out", out, "--quiet", "--units", "si"]);
  return { json, report: join(out, "report.html"), out };
}
// Everything that is read on a page or tab: words, and numbers with all their digits.
const read = (page, selector) =>
  page.evaluate((selector) => {
    const at = document.querySelector(selector);
    const titles = [...at.querySelectorAll("span[title]:not(.quantity)")].map((one) => one.title);
    const tables = [...at.querySelectorAll("tbody tr, dl.facts:not(.readings) > *")].map((one) =>
      one.textContent.trim(),
    );
    return { titles, tables, heads: [...at.querySelectorAll("h2")].map((one) => one.textContent) };
  }, selector);
// All numbers of a document.
function numbers(value, found = new Set()) {
  if (typeof value === "number") found.add(value);
  else if (value && typeof value === "object") for (const one of Object.values(value)) numbers(one, found);
  return found;
}
async function same(page, scene, command, ...options) {
  const { json, report } = told(scene, command, ...options),
    tab = await read(page, ".found"),
    other = await page.context().newPage();
  await other.goto(`file://${report}`);
  const own = await read(other, "main");
  await other.close();
  own.heads = own.heads.filter((head) => head !== "Scene");
  expect(tab).toEqual(own);
  expect(tab.titles.length + tab.tables.length).toBeGreaterThan(4);
  // Numbers that are shown in their own unit stand in the document to the last digit.
  const all = numbers(json),
    shown = tab.titles.map((title) => Number(title.split(" ")[0]));
  return { json, share: shown.filter((one) => all.has(one)).length / Math.max(1, shown.length), shown };
}

for (const [name, scene, command, options] of [
  ["Kinematics", "shaper.json", "kinematics", []],
  ["Forces", "slider_crank.json", "forces", []],
  ["Steady motion", "engine.json", "steady", []],
  ["Cam", "indexing_dwells.json", "cam", []],
  ["Laws", "flat_tappet.json", "law cycle", ["--of", "valve"]],
])
  test(`${command}: the tab shows what the command tells, to the last digit`, async ({ page }) => {
    await opened(page, scene);
    await tab(page, name);
    const { json, share, shown } = await same(page, scene, command, ...options);
    // The document is that of `--json`, all numbers of it.
    const download = page.waitForEvent("download");
    await asking(page)
      .getByRole("button", { name: `${command.split(" ")[0]}.json` })
      .click();
    expect(JSON.parse(readFileSync(await (await download).path(), "utf8"))).toEqual(json);
    // The others are counted from them: degrees, differences, shares.
    expect(shown.length).toBeGreaterThan(10);
    expect(share).toBeGreaterThan(0.7);
    await expect(page.locator(".found svg.dam-plot")).not.toHaveCount(0);
  });

for (const [name, scene, command, fields, options] of [
  [
    "Laws",
    "flat_tappet.json",
    "law compare",
    { law: "cycloidal\n3-4-5" },
    ["--at=valve.position.cam.law", "--law=cycloidal", "--law=3-4-5"],
  ],
  [
    "Laws",
    "flat_tappet.json",
    "law synthesize",
    { "run up": "sine", stroke: "10 mm", span: "90 deg", "uniform span": "0.2" },
    ["--run-up=sine", "--stroke=10 mm", "--span=90 deg", "--uniform-span=0.2"],
  ],
  ["Reduction", "two_masses.json", "reduce", { accuracy: "5 %" }, ["--accuracy=5 %"]],
])
  test(`${command}: with options that its tab gives, figures and file are those of the command`, async ({ page }) => {
    await opened(page, scene);
    await asking(page).getByRole("tab", { name, exact: true }).click();
    const part = asking(page).getByLabel(command, { exact: true });
    if (await part.count()) await part.check();
    const closed = asking(page).locator("details.options:not([open]) > summary");
    if (await closed.count()) await closed.click();
    for (const [label, text] of Object.entries(fields)) {
      const field = asking(page).getByLabel(label, { exact: true });
      await field.fill(text);
      await field.blur();
    }
    const { json, out } = told(command === "law synthesize" ? null : scene, command, ...options);
    // The scene that is left, else the document.
    const [file, own] =
      command === "reduce"
        ? ["reduced.json", JSON.parse(readFileSync(join(out, "reduced.json"), "utf8"))]
        : ["law.json", json];
    expect(numbers(json).size).toBeGreaterThan(10);
    await expect(page.locator(".found h2").first()).toBeVisible({ timeout: 60_000 });
    // What was asked on the way to these options may be answered before.
    await expect(async () => {
      await done(page);
      const download = page.waitForEvent("download", { timeout: 10_000 });
      await asking(page).getByRole("button", { name: file }).click();
      expect(JSON.parse(readFileSync(await (await download).path(), "utf8"))).toEqual(own);
    }).toPass({ timeout: 60_000 });
    const shown = (await read(page, ".found")).titles.map((title) => Number(title.split(" ")[0])),
      all = numbers(json);
    expect(shown.filter((one) => all.has(one)).length).toBeGreaterThan(4);
  });

test("methods: errors and evaluations of the tab are those of the command", async ({ page }) => {
  await opened(page, "two_masses.json");
  await asking(page).getByRole("tab", { name: "Methods", exact: true }).click();
  await asking(page).locator("summary", { hasText: "Options" }).click();
  const fill = async (label, text) => {
    const field = asking(page).getByLabel(label, { exact: true });
    await field.fill(text);
    await field.blur();
  };
  await fill("repeats", "1");
  await fill("tolerances", "1e-4,1e-6");
  await fill("methods", "exact,dop853");
  await expect(page.locator(".found .dam-plot").first()).toBeVisible({ timeout: 60_000 });
  await done(page);
  const { json } = told(
    "two_masses.json",
    "methods",
    "--repeats=1",
    "--tolerances=1e-4,1e-6",
    "--methods=exact,dop853",
  );
  // Times are another each time; what was computed is not.
  const points = json.methods.flatMap((method) => method.points);
  expect(points.length).toBeGreaterThan(1);
  // What was asked on the way to these options may be answered before.
  await expect(async () => {
    const text = await page.locator(".found").textContent();
    for (const point of points) expect(text).toContain(String(point.evaluations));
    expect(text).not.toContain("radau");
  }).toPass({ timeout: 30_000 });
});

test("an option is a field as the command declares it, and what is wrong is told in its words", async ({ page }) => {
  await opened(page, "shaper.json");
  await tab(page, "Kinematics");
  await asking(page).locator("summary", { hasText: "Options" }).click();
  const speed = asking(page).getByLabel("speed", { exact: true });
  await speed.fill("20 kg");
  await speed.blur();
  await expect(asking(page).locator(".refused")).toContainText("--speed");
  await expect(asking(page).locator(".stale-mark")).toBeVisible();
  await speed.fill("20 rpm");
  await speed.blur();
  await expect(asking(page).locator(".refused")).toHaveCount(0);
  await done(page);
  await same(page, "shaper.json", "kinematics", "--speed", "20 rpm");
  // The files are those of the command.
  const download = page.waitForEvent("download");
  await asking(page).getByRole("button", { name: "kinematics.json" }).click();
  const { json } = told("shaper.json", "kinematics", "--speed", "20 rpm");
  expect(JSON.parse(readFileSync(await (await download).path(), "utf8"))).toEqual(json);
});

test("what is typed into an option stays, whatever is told meanwhile", async ({ page }) => {
  await opened(page, "two_masses.json");
  await asking(page).getByRole("tab", { name: "Methods", exact: true }).click();
  await asking(page).locator("summary", { hasText: "Options" }).click();
  const tolerances = asking(page).getByLabel("tolerances", { exact: true }),
    now = () => asking(page).locator(".working").textContent();
  const before = await now();
  await tolerances.click();
  await page.keyboard.type("1e-4,");
  // The page was drawn anew in between.
  await expect.poll(now).not.toBe(before);
  await expect(tolerances).toHaveValue("1e-4,");
  await page.keyboard.type("1e-5");
  await tolerances.blur();
  await expect(tolerances).toHaveValue("1e-4,1e-5");
});

test("a tab follows the text, is stale while the scene has faults, and says why a scene does not fit", async ({
  page,
}) => {
  await opened(page, "slider_crank.json");
  await tab(page, "Forces");
  const before = await read(page, ".found");
  const cam = asking(page).getByRole("tab", { name: "Cam", exact: true });
  await expect(cam).toHaveAttribute("title", /describes its cam/);
  const text = server.text("slider_crank.json"),
    speed = /"speed": "?[\d.]+/.exec(text);
  expect(speed).not.toBeNull();
  // A digit more behind the number.
  await page.locator(".cm-line", { hasText: speed[0] }).first().click();
  const change = async (key) => {
    await page.keyboard.press(key);
  };
  await page.keyboard.press("Home");
  const column = await page.evaluate((wanted) => {
    const view =
      document.querySelector(".cm-content").cmTile?.view ?? document.querySelector(".cm-content").cmView.view;
    const line = view.state.doc.lineAt(view.state.selection.main.head);
    const at = line.from + line.text.indexOf(wanted) + wanted.length;
    view.dispatch({ selection: { anchor: at } });
    return at;
  }, speed[0]);
  expect(column).toBeGreaterThan(0);
  await change("Backspace");
  await page.keyboard.type("7");
  await expect.poll(async () => JSON.stringify(await read(page, ".found"))).not.toBe(JSON.stringify(before));
  await done(page);
  writeFileSync(server.path("changed.json"), await textOf(page));
  await same(page, "changed.json", "forces");
  await page.keyboard.type("x");
  await expect(page.locator(".status-line .stale-mark")).toBeVisible();
  await expect(page.locator(".found .dam-plot").first()).toBeVisible();
  await page.keyboard.press("Backspace");
  await expect(page.locator(".stale-mark")).toHaveCount(0);
  await done(page);
  await cam.click();
  await expect(asking(page).locator(".why")).toContainText("describes its cam");
  await asking(page).getByRole("tab", { name: "Workbench", exact: true }).click();
  await expect(page.locator(".charts svg.dam-plot:visible").first()).toBeVisible();
});

test("long work tells how far it is, and ends when something newer is asked", async ({ page }) => {
  await opened(page, "two_masses.json");
  await asking(page).getByRole("tab", { name: "Methods", exact: true }).click();
  await expect(asking(page).locator(".working")).toContainText(/exact|taylor|rodas|radau|dop|rk4|1e/, {
    timeout: 30_000,
  });
  // Methods would go on for long: what is newer need not wait for them.
  await asking(page).getByRole("tab", { name: "Laws", exact: true }).click();
  await asking(page).getByLabel("law show").check();
  await expect(page.locator(".found h2").first()).toBeVisible({ timeout: 20_000 });
  await expect(page.locator(".found .dam-plot").first()).toBeVisible();
  await done(page);
});

test("a tab's answer is told in the units that were chosen", async ({ page }) => {
  test.setTimeout(120_000);
  await opened(page, "shaper.json");
  await tab(page, "Kinematics");
  const quantities = () => page.locator(".found .verdict .quantity").allTextContents(),
    before = await quantities();
  expect(before.some((one) => one.endsWith(" deg"))).toBe(true);
  const values = await page
    .locator(".found .verdict .quantity")
    .evaluateAll((all) => all.map((one) => one.title.split(" ")));
  const choose = async (unit) => {
    await page.getByRole("button", { name: "Units", exact: true }).click();
    await page
      .getByRole("group", { name: "units shown" })
      .getByLabel("angles", { exact: true })
      .selectOption({ label: unit });
    await page.keyboard.press("Escape");
  };
  await choose("rad");
  await expect.poll(async () => (await quantities()).some((one) => one.endsWith(" deg"))).toBe(false);
  for (const [k, text] of (await quantities()).entries())
    if (values[k][1] === "rad")
      expect(Number(text.replace("−", "-").split(" ")[0])).toBeCloseTo(Number(values[k][0]), 5);
  // Cells that have degrees too.
  await expect(page.locator(".found td span[title$=' deg']").first()).toHaveText(/ rad$/);
  await choose("whichever reads best");
  await expect.poll(quantities).toEqual(before);
});
