// Linkages drawn with the mouse and with the keyboard: every act is an edit of the text.

import { expect, test } from "@playwright/test";
import { execFileSync } from "node:child_process";
import { textOf, watched } from "./page.mjs";
import { dam, Server } from "./server.mjs";

let server, wrong;
test.beforeEach(({ page }) => { wrong = watched(page); });
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});
const button = (page, name) => page.getByRole("button", { name, exact: true });
const sketch = (page) => page.locator("svg.sketch");
const joint = (page, name) => page.locator(`.joint[data-joint~="${name}"]`);
const bodies = (page) => page.locator(".sketch .body");
// What was done has come to the drawing.
const settled = (page) => expect(sketch(page)).toHaveAttribute("aria-busy", "false");

// An empty page with a linkage that has no parts yet.
async function begun(page) {
  server = new Server({});
  await server.start();
  page.on("dialog", (dialog) => void dialog.accept("drawn.json"));
  await page.goto(server.address);
  await button(page, "New…").click();
  await expect(page.locator(".top select")).toHaveValue("drawn.json");
  await page.getByRole("tab", { name: "Drawing" }).click();
  await button(page, "New linkage").click();
  await settled(page);
}
// A place of the drawing (mm) on the screen: half a metre is seen at first, from -125 mm on.
async function at(page, [x, y]) {
  const box = await sketch(page).boundingBox(), scale = Math.min(box.width / 500, box.height / 330);
  return [box.x + box.width / 2 + (x + 125 - 250) * scale, box.y + box.height / 2 + (165 - y - 125) * scale];
}
async function click(page, place) {
  await page.mouse.click(...await at(page, place));
  await settled(page);
}
async function drag(page, from, to) {
  await page.mouse.move(...await at(page, from));
  await page.mouse.down();
  await page.mouse.move(...await at(page, to), { steps: 4 });
  await page.mouse.up();
  await settled(page);
}
// Where the joints are drawn (m).
const places = (page) => page.locator(".joint").evaluateAll((all) => Object.fromEntries(all.flatMap((one) => one.dataset.joint.split(" ").map((name) => [name, one.dataset.at.split(" ").map(Number)]))));
const columns = (name) => JSON.parse(execFileSync(dam, ["kinematics", server.path(name), "--turn", "--positions", "12", "--json", "--quiet"], { encoding: "utf8", maxBuffer: 1 << 26 })).columns;

test("a four-bar drawn with the mouse stands at 12 angles where dam kinematics has it", async ({ page }) => {
  test.setTimeout(120_000);
  await begun(page);
  await click(page, [0, 0]);
  await click(page, [200, 0]);
  await expect(page.locator(".structure")).toContainText("0 moving links");
  await button(page, "Link").click();
  await drag(page, [0, 0], [0, 60]);
  // One link that is driven is whole; a second one is loose, and it is told.
  await expect(page.locator(".structure")).toContainText("1 degree of freedom");
  await drag(page, [0, 60], [160, 130]);
  await expect(page.locator(".structure")).toContainText("2 degrees of freedom");
  await expect(page.locator(".faults button.error").first()).toContainText("free to move");
  // By two clicks.
  await click(page, [160, 130]);
  await click(page, [200, 0]);
  await expect(page.locator(".faults button.error")).toHaveCount(0);
  await expect(page.locator(".structure")).toContainText("3 moving links, 4 pairs: 3·3 − 2·4 = 1 degree of freedom");
  await expect(page.locator(".structure")).toContainText("dyad RRR");
  await button(page, "Save").click();
  await expect(page.locator(".top")).not.toContainText("not saved");
  const text = await textOf(page), own = JSON.parse(text).objects.linkage;
  expect(server.text("drawn.json")).toBe(text);
  // The numbers are those of the grid, each part on a line of its own.
  expect(Object.values(own.ground)).toEqual([[0, 0], ["200 mm", 0]]);
  expect(text).toContain('\n        "link_1": { "points": { "B": [0, "60 mm"] } },\n');
  expect(own.links.link_2.points).toEqual({ C: ["160 mm", "70 mm"] });
  expect(Object.keys(own.pairs)).toHaveLength(4);
  const told = columns("drawn.json"), input = page.getByLabel("input of the linkage");
  await button(page, "Select").click();
  let compared = 0;
  for (let k = 0; k < 12; k++) {
    await input.fill(String(15 * k));
    await expect(page.locator(".drawing output")).toHaveText(k ? `${30 * k} °` : /^0/);
    for (const [name, drawn] of Object.entries(await places(page))) {
      const [link, point] = name.split(".");
      if (!own.links[link]?.points[point]) continue;
      for (const [c, axis] of ["x", "y"].entries()) expect(drawn[c], `${name} at ${30 * k} deg`).toBeCloseTo(told[`links.${name}.${axis}`].values[k], 12);
      compared++;
    }
  }
  expect(compared).toBe(36);
  // Each act was one step of undo.
  const undo = button(page, "Undo");
  for (const count of [2, 1, 0]) {
    await undo.click();
    await settled(page);
    await expect(bodies(page)).toHaveCount(count);
  }
  for (let k = 0; k < 3; k++) await undo.click();
  await expect(undo).toBeDisabled();
  await expect.poll(() => textOf(page)).not.toContain("linkage");
});

test("points of links, guides and deleting keep the rest of the text", async ({ page }) => {
  test.setTimeout(120_000);
  await begun(page);
  await click(page, [0, 0]);
  await button(page, "Link").click();
  await drag(page, [0, 0], [50, 0]);
  await drag(page, [50, 0], [200, 0]);
  await button(page, "Guide").click();
  await drag(page, [200, 0], [250, 0]);
  await expect(page.locator(".faults button.error")).toHaveCount(0);
  await expect(page.locator(".structure")).toContainText("dyad RRP");
  await expect(page.locator(".sketch .block")).toHaveCount(1);
  const crank = await textOf(page);
  await button(page, "Point").click();
  await drag(page, [120, 0], [120, 60]);
  await expect.poll(() => textOf(page)).not.toBe(crank);
  const pointed = JSON.parse(await textOf(page)).objects.linkage.links.link_2.points;
  expect(Object.values(pointed)).toContainEqual(["70 mm", "60 mm"]);
  // What is deleted takes along what is about it, and nothing else.
  const before = await textOf(page);
  await button(page, "Delete").click();
  await click(page, [120, 60]);
  await expect.poll(() => textOf(page)).toBe(crank);
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(before);
  await settled(page);
  await click(page, [25, 0]);
  await expect(bodies(page)).toHaveCount(2);
  const left = JSON.parse(await textOf(page)).objects.linkage;
  expect(Object.keys(left.links)).toEqual(["link_2", "block_1"]);
  expect(left.driver).toBeUndefined();
  expect(JSON.stringify(left.pairs)).not.toContain("link_1");
  await expect(page.locator(".faults button.error").first()).toContainText("does not say what moves it");
  // The joint that lost its link still is where it was, and a link to the ground makes it whole.
  await button(page, "Link").click();
  await drag(page, [0, 0], [50, 0]);
  await expect(page.locator(".faults button.error")).toHaveCount(0);
  await expect(page.locator(".structure")).toContainText("1 degree of freedom");
});

test("the keyboard draws a link and deletes a joint", async ({ page }) => {
  test.setTimeout(120_000);
  await begun(page);
  const press = async (...keys) => { for (const key of keys) await page.keyboard.press(key); };
  await button(page, "Ground").focus();
  await press("Enter");
  await sketch(page).focus();
  await press("ArrowRight", "Enter");
  await expect(page.locator(".joint")).toHaveCount(1);
  await button(page, "Link").focus();
  await press("Enter");
  await page.locator(".joint").first().focus();
  await press("Enter", "Shift+ArrowRight", "ArrowUp", "Enter");
  await expect(bodies(page)).toHaveCount(1);
  await settled(page);
  await expect(page.locator(".structure")).toContainText("1 degree of freedom");
  await button(page, "Select").focus();
  await press("Enter");
  await joint(page, "ground.O").focus();
  await press("Delete");
  await settled(page);
  await expect.poll(async () => JSON.parse(await textOf(page)).objects.linkage.pairs).toEqual({});
  expect(JSON.parse(await textOf(page)).objects.linkage.ground).toEqual({});
});
