// The gallery of templates and scenarios on the first page.

import { expect, test } from "@playwright/test";
import { watched } from "./page.mjs";
import { Server } from "./server.mjs";

let server, wrong;
test.beforeEach(async ({ page }) => {
  server = new Server({});
  wrong = watched(page);
});
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});
const gallery = (page) => page.getByRole("region", { name: "gallery" });
const card = (page, name) => page.locator(".card", { has: page.getByText(name, { exact: true }) });
const search = (page) => page.getByLabel("search scenes, templates and scenarios");
async function atHome(page) {
  await server.start({ home: true });
  await page.goto(server.address);
  await expect(gallery(page)).toBeVisible();
}
// Where the parts of the machine on a card are drawn at present.
const places = (own) =>
  own
    .locator(".card-picture svg")
    .first()
    .evaluate((svg) =>
      JSON.stringify(
        [...svg.querySelectorAll("g")].map((one) => {
          const { x, y, width, height } = one.getBoundingClientRect();
          return [x, y, width, height].map((value) => Math.round(10 * value));
        }),
      ),
    );
const time = (own) =>
  own
    .locator(".card-picture svg")
    .first()
    .evaluate((svg) => svg.getCurrentTime());
const isDrawn = (own) => expect(own).toHaveAttribute("data-picture", "drawn", { timeout: 30_000 });

test("every template and every scenario has a card with its title, by topics and by words", async ({ page }) => {
  await atHome(page);
  const cards = page.locator(".card"),
    topic = page.getByLabel("topic", { exact: true }),
    status = gallery(page).getByRole("status");
  await expect(cards).toHaveCount(102);
  await expect(status).toHaveText("102 scenes");
  const own = card(page, "valve_train/lift_off"),
    scene = JSON.parse(server.read("scenarios/valve_train/lift_off.json"));
  await expect(own.locator("b")).toHaveText(scene.name);
  await expect(own.locator(".card-words")).toHaveText(/\?$/);
  await topic.selectOption({ label: "Valve train" });
  await expect(cards).toHaveCount(5);
  await expect(status).toHaveText("5 scenes");
  await search(page).fill("lash");
  await expect(cards).toHaveCount(1);
  await expect(card(page, "valve_train/valve_lash")).toBeVisible();
  await topic.selectOption({ label: "Templates" });
  await expect(cards).toHaveCount(0);
  await search(page).fill("");
  await expect(cards).toHaveCount(5);
  await topic.selectOption({ label: "all" });
  await expect(cards).toHaveCount(102);
});

test("the machine of a card in sight is drawn, moves under the pointer and the focus, and stands still else", async ({
  page,
}) => {
  await atHome(page);
  const lever = card(page, "lever");
  await lever.scrollIntoViewIfNeeded();
  await isDrawn(lever);
  expect(
    await lever
      .locator(".card-picture svg")
      .first()
      .evaluate(
        (svg) =>
          [...svg.querySelectorAll("path, circle, line")].filter((one) =>
            one.checkVisibility({ visibilityProperty: true }),
          ).length,
      ),
  ).toBeGreaterThan(5);
  // It stands still.
  await page.mouse.move(2, 2);
  const still = await places(lever);
  expect(await time(lever)).toBe(0);
  await lever.hover();
  await expect.poll(() => places(lever)).not.toBe(still);
  await page.mouse.move(2, 2);
  await expect
    .poll(async () => {
      const before = await time(lever);
      await page.waitForTimeout(80);
      return (await time(lever)) - before;
    })
    .toBe(0);
  // By the keyboard.
  const before = await time(lever);
  await page.getByLabel("topic", { exact: true }).focus();
  await page.keyboard.press("Tab");
  await expect(lever).toBeFocused();
  await expect.poll(() => time(lever)).toBeGreaterThan(before);
  await page.keyboard.press("Tab");
  await expect(lever).not.toBeFocused();
  await expect
    .poll(async () => {
      const before = await time(lever);
      await page.waitForTimeout(80);
      return (await time(lever)) - before;
    })
    .toBe(0);
  // What is far from sight is not worked out.
  await expect(page.locator(".card").last()).toHaveAttribute("data-picture", "waits");
  await page.locator(".card").last().scrollIntoViewIfNeeded();
  await isDrawn(page.locator(".card").last());
});

test("who wants less motion sees the machines still", async ({ page }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  await atHome(page);
  const lever = card(page, "lever");
  await isDrawn(lever);
  await lever.hover();
  await lever.focus();
  await page.waitForTimeout(200);
  expect(await time(lever)).toBe(0);
});

test("a card opens its scene as a new file", async ({ page }) => {
  await atHome(page);
  page.on("dialog", (dialog) => void dialog.accept(dialog.defaultValue()));
  await search(page).fill("valve_lash");
  const own = card(page, "valve_train/valve_lash");
  await own.focus();
  await page.keyboard.press("Enter");
  await expect(page.locator(".top select[aria-label=scene]")).toHaveValue("valve_lash.json");
  await expect(page.locator(".verdict")).toBeVisible();
  expect(JSON.parse(server.text("valve_lash.json")).objects).toEqual(
    JSON.parse(server.read("scenarios/valve_train/valve_lash.json")).objects,
  );
});

for (const scheme of ["light", "dark"])
  test(`cards have the colours of the page, ${scheme}`, async ({ page }) => {
    await page.emulateMedia({ colorScheme: scheme });
    await atHome(page);
    for (const name of ["lever", "cam", "linkage"]) await isDrawn(card(page, name));
    // Nothing of a picture reaches out of its card, and the page is no wider than the window.
    expect(await page.evaluate(() => document.querySelector(".first-page").scrollWidth <= innerWidth)).toBe(true);
    // Machines are as large as their cards let them be, and have no ground of their own.
    const shares = await page.locator(".card[data-picture=drawn] .card-picture").evaluateAll((all) =>
      all.map((one) => {
        const place = one.getBoundingClientRect(),
          parts = [...one.querySelectorAll("path, circle, line")]
            .filter((part) => part.checkVisibility({ visibilityProperty: true }))
            .map((part) => part.getBoundingClientRect())
            .filter((box) => box.width + box.height > 0);
        const [left, right] = [
            Math.min(...parts.map((part) => part.left)),
            Math.max(...parts.map((part) => part.right)),
          ],
          [top, bottom] = [Math.min(...parts.map((part) => part.top)), Math.max(...parts.map((part) => part.bottom))];
        return Math.max((right - left) / place.width, (bottom - top) / place.height);
      }),
    );
    for (const share of shares) {
      expect(share).toBeGreaterThan(0.6);
      expect(share).toBeLessThan(1.02);
    }
    await expect(page.locator(".card-picture svg > rect:first-child")).toHaveCount(0);
    // No name is there twice.
    const ids = await page.evaluate(() => [...document.querySelectorAll("[id]")].map((one) => one.id));
    expect(new Set(ids).size).toBe(ids.length);
    if (process.env.PICTURES) await page.screenshot({ path: `${process.env.PICTURES}/gallery-${scheme}.png` });
  });
