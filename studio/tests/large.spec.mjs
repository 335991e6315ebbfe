// Scenes of many objects: only what is in sight is built.

import { expect, test } from "@playwright/test";
import { box, watched } from "./page.mjs";
import { Server } from "./server.mjs";

let server, wrong;
test.beforeEach(({ page }) => {
  wrong = watched(page);
});
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});
async function started(page, objects) {
  server = new Server({});
  server.write(JSON.stringify({ dam: 1, name: "many", objects, run: { duration: "0.1 s" } }, null, 1), "many.json");
  await server.start();
  await page.goto(server.address);
  await page.waitForSelector(".verdict", { timeout: 60_000 });
}
const count = (page, selector) => page.locator(selector).count();
const drive = { kind: "drive", motion: { speed: "60 rpm" } };

test("a machine of 1000 objects is built where it is in sight", async ({ page }) => {
  test.setTimeout(180_000);
  const objects = { drive };
  for (let k = 0; k < 1000; k++)
    objects[`lever_${k}`] = {
      kind: "rocker",
      input: "drive",
      position: { sine: { amplitude: "10 deg" } },
      inertia: 0.1,
      stiffness: 1e7,
    };
  await started(page, objects);
  await expect(page.locator(".figures")).toContainText("of 1001 objects");
  expect(await count(page, ".object-box")).toBeLessThan(120);
  expect(await count(page, ".charts *")).toBeLessThan(12_000);
  expect(await count(page, ".slider")).toBe(0);
  expect(await count(page, ".figures tbody tr")).toBe(101);
  await page.getByRole("tab", { name: "Results" }).click();
  await page.getByRole("button", { name: "Show all 1001 rows" }).click();
  expect(await count(page, ".figures tbody tr")).toBe(1001);
  expect(await count(page, ".connection")).toBeLessThan(120);
  await page.getByRole("tab", { name: "Workbench" }).click();
  expect(await count(page, ".seen-beside option")).toBeLessThan(10);
  // What is moved into sight is built, and can be used.
  const canvas = await page.locator(".objects-graph").boundingBox(),
    seen = () => page.locator(".object-box").evaluateAll((all) => all.map((one) => one.dataset.id));
  const before = await seen();
  await page.mouse.move(canvas.x + 10, canvas.y + canvas.height - 30);
  await page.mouse.down();
  await page.mouse.move(canvas.x + 10, canvas.y - 2 * canvas.height, { steps: 4 });
  await page.mouse.up();
  const after = await seen();
  expect(after.length).toBeGreaterThan(3);
  expect(after.filter((id) => !before.includes(id)).length).toBeGreaterThan(3);
  const there = after.find((id) => id.startsWith("lever_")),
    frame = box(page, there).locator(".frame");
  await frame.evaluate((one) => one.closest("g").focus());
  await page.keyboard.press("Enter");
  await expect(page.locator(".object-box.chosen")).toHaveCount(1);
  // Its numbers are shown once they are asked for, and follow.
  await page.getByRole("tab", { name: "Numbers" }).click();
  await page.locator(".sliders summary", { hasText: /^lever_7 / }).click();
  await expect(page.locator(".slider")).not.toHaveCount(0);
  const inertia = page.locator('.slider[data-address="lever_7.inertia"] input[type=text]');
  await inertia.fill("0.2");
  await inertia.press("Enter");
  await expect(page.locator(".top")).toContainText("not saved");
  await page.keyboard.press("Control+s");
  await expect.poll(() => JSON.parse(server.text("many.json")).objects.lever_7.inertia).toBe(0.2);
});

test("a chain of 3000 objects is drawn", async ({ page }) => {
  test.setTimeout(180_000);
  const objects = { drive };
  for (let k = 0; k < 3000; k++)
    objects[`shaft_${k}`] = { kind: "shaft", input: k ? `shaft_${k - 1}` : "drive", inertia: 0.01, stiffness: 1e5 };
  await started(page, objects);
  const built = await count(page, ".object-box");
  expect(built).toBeGreaterThan(3);
  expect(built).toBeLessThan(120);
  // Neighbours of the chain stand beside each other, joined.
  const places = await page
    .locator(".object-box")
    .evaluateAll((all) =>
      all
        .map((one) => [Number(one.dataset.id.split("_")[1]), one.querySelector(".frame").getBoundingClientRect().left])
        .sort((a, b) => a[0] - b[0]),
    );
  for (let k = 1; k < places.length; k++)
    if (places[k][0] === places[k - 1][0] + 1) expect(places[k][1]).toBeGreaterThan(places[k - 1][1]);
  expect(await count(page, ".connection")).toBeGreaterThan(3);
});
