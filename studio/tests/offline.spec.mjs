// The studio as one file, opened from disk.

import { expect, test } from "@playwright/test";
import { deltaOf, slider, textOf, watched } from "./page.mjs";
import { Server } from "./server.mjs";
import { address, file, requested, WHY } from "./single.mjs";

test.skip(!file, WHY);

let server, wrong, requests;
test.beforeEach(({ page }) => {
  server = new Server();
  wrong = watched(page);
  requests = requested(page);
});
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
  expect(requests).toEqual([]);
});

const button = (page, name) => page.getByRole("button", { name, exact: true });
const view = (page, name) => page.getByRole("tab", { name, exact: true }).click();
const search = (page) => page.getByLabel("search scenes, templates and scenarios");
// A copy of a scenario, open.
async function begun(page, scenario = "rocker/two_masses", name = "mine.json") {
  await page.goto(address);
  await search(page).waitFor();
  page.once("dialog", (dialog) => void dialog.accept(name));
  await page.locator(".first-page .entry", { has: page.getByText(scenario, { exact: true }) }).click();
  await expect(page.locator(".status-line .verdict")).toHaveCount(1);
}
// The answer on the screen is that of the program to the same text, to the last digits.
const agrees = (page, id = "rocker") =>
  expect(async () => {
    const own = server.run(await textOf(page)).objects[id].delta_abs,
      shown = Number(await deltaOf(page, id));
    expect(Math.abs(shown - own)).toBeLessThanOrEqual(1e-12 * Math.abs(own));
  }).toPass({ timeout: 30_000 });

test("a scenario opens from disk, and its answer follows a slider", async ({ page }) => {
  await begun(page);
  await view(page, "Text");
  await agrees(page);
  const before = await deltaOf(page);
  await slider(page, "rocker.stiffness").focus();
  for (let k = 0; k < 20; k++) await page.keyboard.press("ArrowLeft");
  await expect.poll(() => deltaOf(page)).not.toBe(before);
  await agrees(page);
  const after = await deltaOf(page);
  await button(page, "Undo").click();
  await expect.poll(() => deltaOf(page)).toBe(before);
  // The steps have names here too.
  await button(page, "History").click();
  const steps = page.locator(".history-steps button");
  await expect(steps).toHaveText([/^rocker\.stiffness 1e7 → [\d.e]+ N m\/rad$/, "As opened"]);
  await steps.first().click();
  await expect.poll(() => deltaOf(page)).toBe(after);
});

test("what is saved is there when the page comes again, and what is not is offered", async ({ page }) => {
  await begun(page);
  await view(page, "Text");
  await page.getByLabel("text of the scene").click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("\n\n");
  await expect(page.locator(".unsaved")).toHaveCount(1);
  await button(page, "Save").click();
  await expect(page.locator(".unsaved")).toHaveCount(0);
  const saved = await textOf(page);
  await page.getByLabel("text of the scene").click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("\n");
  // At once: what was typed last is kept as the page goes.
  await page.reload();
  await expect(page.locator(".notices")).toContainText("draft");
  await button(page, "Restore the draft").click();
  await expect.poll(() => textOf(page)).toBe(`${saved}\n`);
  await button(page, "Home").click();
  await expect(page.locator(".first-page .entry", { hasText: "mine.json" })).toHaveCount(1);
});

test("a browser that has no room left is told so, and nothing goes without a question", async ({ page }) => {
  await begun(page);
  await page.evaluate(() => {
    for (let size = 1 << 20; size >= 1; size >>= 1)
      try {
        for (let k = 0; ; k++) localStorage.setItem(`full ${size} ${k}`, "x".repeat(size));
      } catch {
        /* Smaller pieces still fit. */
      }
  });
  await view(page, "Text");
  await page.getByLabel("text of the scene").click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type(" ".repeat(20));
  await button(page, "Save").click();
  await expect(page.locator(".notices")).toContainText("keeps nothing more");
  let asked = "";
  page.once("dialog", (dialog) => {
    asked = dialog.type();
    void dialog.accept();
  });
  await page.reload();
  expect(asked).toBe("beforeunload");
});

test("what another window has saved is not written over", async ({ page, context }) => {
  await begun(page);
  const other = await context.newPage();
  await other.goto(address);
  await other.locator(".first-page .entry", { hasText: "mine.json" }).click();
  const typed = async (page, text) => {
    await view(page, "Text");
    await page.getByLabel("text of the scene").click();
    await page.keyboard.press("Control+End");
    await page.keyboard.type(text);
    await expect(page.locator(".unsaved")).toHaveCount(1);
  };
  await typed(other, "\n\n");
  await typed(page, "\n");
  await button(other, "Save").click();
  await expect(other.locator(".unsaved")).toHaveCount(0);
  await expect(page.locator(".notices")).toContainText("changed by another");
  await button(page, "Save").click();
  await expect(page.locator(".notices")).toContainText("another window");
  await button(page, "Reload it").click();
  expect(await textOf(page)).toBe(await textOf(other));
  page.once("dialog", (dialog) => void dialog.accept("a/b"));
  await button(page, "New…").click();
  await expect(page.locator(".notices")).toContainText("no slash");
});

test("a scene is passed on in an address and as a file", async ({ page, context }) => {
  await begun(page);
  await view(page, "Text");
  const text = await textOf(page);
  await context.grantPermissions(["clipboard-read", "clipboard-write"]).catch(() => {});
  let shared = "";
  page.on("dialog", (dialog) => {
    shared = dialog.defaultValue();
    void dialog.dismiss();
  });
  await button(page, "Share").click();
  await expect
    .poll(async () => (shared ||= await page.evaluate(() => navigator.clipboard.readText().catch(() => ""))))
    .toContain("#scene=");
  const other = await context.newPage();
  await other.goto(shared);
  await expect(other.locator(".status-line .verdict")).toHaveCount(1);
  await view(other, "Text");
  expect(await textOf(other)).toBe(text);
  await other.goto(`${address}#scene=AAAA`);
  await other.reload();
  await expect(other.locator(".notices")).toContainText("cannot be read");
  await other.goto(`${address}#scenario=rocker/ten_masses`);
  await other.reload();
  await expect(other.locator(".top select[aria-label=scene]")).toHaveValue("ten_masses.json");
  await page.getByLabel("scene from a file").setInputFiles({
    name: "from disk.json",
    mimeType: "application/json",
    buffer: Buffer.from(text.replace("10 rev/s", "11 rev/s")),
  });
  await expect(page.locator(".top select[aria-label=scene]")).toHaveValue("from disk.json");
});

test("faults, map and questions answer as with a server", async ({ page }) => {
  test.setTimeout(240_000);
  await begun(page);
  await button(page, "Map over two numbers").click();
  await expect(page.locator(".map-view")).toContainText("400 points", { timeout: 150_000 });
  const asking = page.locator("section.asking");
  await asking.getByRole("tab", { name: "Methods", exact: true }).click();
  await expect(page.locator(".found").locator("h2, .dam-plot, dl").first()).toBeVisible({ timeout: 60_000 });
  await view(page, "Text");
  await page.getByLabel("text of the scene").click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("?");
  await expect(page.locator(".faults")).toContainText("error");
});

test("a run that takes long ends when the text changes, and a small memory is told", async ({ page }) => {
  await begun(page);
  await view(page, "Text");
  const text = await textOf(page),
    long = text.replace(/"duration": 0.5/, '"duration": 1e5');
  expect(long).not.toBe(text);
  const put = async (text) => {
    await page.getByLabel("text of the scene").click();
    await page.keyboard.press("Control+a");
    await page.evaluate((text) => {
      const data = new DataTransfer();
      data.setData("text/plain", text);
      document
        .querySelector(".cm-content")
        .dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
    }, text);
  };
  await put(long);
  await page.waitForTimeout(1000);
  await put(text.replace('"masses": 2', '"masses": 3'));
  await agrees(page);
});

test("an old browser is told what it lacks", async ({ page }) => {
  await page.addInitScript(() => {
    delete globalThis.WebAssembly;
  });
  await page.goto(address);
  await expect(page.locator("#studio")).toContainText("WebAssembly");
  // It ends there on purpose.
  wrong.length = 0;
});
