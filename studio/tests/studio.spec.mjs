import { expect, test } from "@playwright/test";
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { agrees as agreesWith, deltaOf, opened as openedAt, random, slider, textOf, undone, watched } from "./page.mjs";
import { Server } from "./server.mjs";

let server, wrong;
test.beforeEach(async ({ page }) => {
  server = new Server();
  await server.start();
  wrong = watched(page);
});
test.afterEach(async () => {
  await server.end();
  // Nothing was thrown, and nothing broke the content security policy.
  expect(wrong).toEqual([]);
});

const opened = (page, address = server.address) => openedAt(page, address);
const agrees = (page) => agreesWith(page, server);

test("a scene opens with its answer, which is that of dam run", async ({ page }) => {
  await opened(page);
  await expect(page.locator(".verdict")).toContainText(/separates|lift off/);
  await expect(page.locator(".charts svg.dam-plot")).not.toHaveCount(0);
  await expect(page.locator(".machine svg.mechanism")).not.toHaveCount(0);
  expect(await textOf(page)).toBe(server.text());
  await agrees(page);
  // The token is out of the address and in this window alone.
  expect(page.url()).not.toContain("#");
  expect(await page.evaluate(() => document.cookie)).toBe("");
  await page.getByRole("button", { name: "play" }).click();
  await expect(page.locator(".machine output")).not.toHaveText("t 0 s");
});

test("a fault is told at its place, the answer stays as a stale one, and mending it makes it good", async ({
  page,
}) => {
  await opened(page);
  const line = page.locator(".cm-line", { hasText: '"kind": "rocker"' });
  await line.click();
  await page.keyboard.press("End");
  for (let k = 0; k < 8; k++) await page.keyboard.press("Backspace");
  await page.keyboard.type('"shafd",', { delay: 5 });
  await expect(page.locator(".stale-mark")).toContainText("1 fault");
  await expect(page.locator(".faults button.error")).toContainText("did you mean `shaft`?");
  await expect(page.locator(".cm-lintRange-error")).toHaveCount(1);
  await expect(page.locator(".verdict")).toContainText(/separates|lift off/);
  await page.locator(".faults button.error").click();
  await page.keyboard.type('"shaft"');
  await expect(page.locator(".stale-mark")).toHaveCount(0);
  await expect(page.locator(".faults button")).toHaveCount(0);
});

test("a slider changes its number alone, figures follow, and one drag is one step", async ({ page }) => {
  await opened(page);
  const before = server.text(),
    first = await deltaOf(page);
  const bar = slider(page, "rocker.inertia"),
    box = await bar.boundingBox();
  const at = (share) => [box.x + 8 + share * (box.width - 16), box.y + box.height / 2];
  await page.mouse.move(...at(1 / 3));
  await page.mouse.down();
  for (let k = 1; k <= 12; k++) await page.mouse.move(...at(1 / 3 + k / 40));
  await page.mouse.up();
  await expect.poll(() => deltaOf(page)).not.toBe(first);
  const text = await textOf(page);
  const lines = text
    .split("\n")
    .map((line, k) => [line, before.split("\n")[k]])
    .filter(([a, b]) => a !== b);
  expect(lines).toHaveLength(1);
  expect(lines[0][0].replace(/"inertia": [\d.e-]+/, "")).toBe(lines[0][1].replace(/"inertia": [\d.e-]+/, ""));
  await agrees(page);
  await expect(page.locator(".top")).toContainText("not saved");
  await page.getByRole("button", { name: "Undo" }).click();
  await expect.poll(() => textOf(page)).toBe(before);
  await expect(page.getByRole("button", { name: "Undo" })).toBeDisabled();
  await agrees(page);
  await page.getByRole("button", { name: "Redo" }).click();
  await expect.poll(() => textOf(page)).toBe(text);
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await expect(page.locator(".top")).not.toContainText("not saved");
  expect(server.text()).toBe(text);
});

test("numbers are typed with units", async ({ page }) => {
  await opened(page);
  const field = page.getByLabel("speed", { exact: true });
  await field.fill("540 rpm");
  await field.press("Enter");
  await expect.poll(() => textOf(page)).toContain('"speed": "540 rpm"');
  await field.fill("12");
  await field.press("Enter");
  await expect.poll(() => textOf(page)).toContain('"speed": "12 rpm"');
  await field.fill("fast");
  await field.press("Enter");
  await expect(field).toHaveAttribute("aria-invalid", "true");
  await agrees(page);
});

test("every step has its name in a list, which goes back and forward to it by keys", async ({ page }) => {
  await opened(page);
  const before = await textOf(page),
    speed = page.getByLabel("speed", { exact: true });
  await speed.fill("540 rpm");
  await speed.press("Enter");
  const first = await slider(page, "rocker.inertia");
  await first.press("PageUp");
  await expect.poll(() => textOf(page)).toContain('"540 rpm"');
  const moved = await textOf(page);
  const inertia = /"inertia": ([\d.]+)/.exec(moved)[1];
  await page.locator(".cm-line").nth(1).click();
  await page.keyboard.press("End");
  await page.keyboard.type("x");
  const edited = await textOf(page);
  const names = [
      "text edited in line 2",
      `rocker.inertia 0.1 → ${inertia} kg m²`,
      "shaft.motion.speed 10 rev/s → 540 rpm",
      "As opened",
    ],
    history = page.getByRole("button", { name: "History" }),
    steps = page.locator(".history-steps button"),
    present = page.locator(".history-steps [aria-current=step]");
  const open = async () => {
    await history.focus();
    await page.keyboard.press("Enter");
  };
  await open();
  await expect(steps).toHaveText(names);
  await expect(present).toHaveText(names[0]);
  await expect(present).toBeFocused();
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  await expect.poll(() => textOf(page)).toBe(moved);
  await expect(present).toHaveText(names[1]);
  await expect(steps).toHaveText(names);
  await page.keyboard.press("End");
  await page.keyboard.press("Enter");
  await expect(present).toHaveText("As opened");
  expect(await textOf(page)).toBe(before);
  await page.keyboard.press("Escape");
  await expect(history).toBeFocused();
  // The steps are there when the page is loaded anew, and in another window.
  await page.reload();
  await page.waitForSelector(".verdict");
  await open();
  await expect(steps).toHaveText(names);
  await page.keyboard.press("Home");
  await page.keyboard.press("Enter");
  await expect.poll(() => textOf(page)).toBe(edited);
});

test("random edits and as many undos give the file back byte for byte", async ({ page }) => {
  const seed = Number(process.env.SEED ?? Date.now() % 1_000_000);
  console.log(`seed ${seed}`);
  const below = random(seed);
  server.write(server.text().replaceAll("\n", "\r\n"));
  await opened(page);
  const before = server.text();
  const sliders = await page
    .locator(".slider input[type=range]")
    .evaluateAll((all) => all.map((one) => one.ariaLabel).filter((name) => !name.startsWith("run")));
  for (let k = 0; k < 40; k++) {
    if (below(2)) {
      const bar = page.getByLabel(sliders[below(sliders.length)], { exact: true });
      if (await bar.count()) await bar.press(below(2) ? "ArrowLeft" : "PageUp");
    } else {
      await page.locator(".cm-line").nth(below(14)).click();
      await page.keyboard.press(["End", "Home"][below(2)]);
      await page.keyboard.press(["Enter", "Delete", "x", "Backspace", "Space"][below(5)]);
    }
  }
  await undone(page);
  await expect(page.locator(".top")).not.toContainText("not saved");
  expect(await textOf(page)).toBe(before.replaceAll("\r\n", "\n"));
  expect(server.text()).toBe(before);
});

test("two windows on one file share one document", async ({ page, context }) => {
  await opened(page);
  const other = await context.newPage();
  await opened(other);
  await page.locator(".cm-line").nth(3).click();
  await page.keyboard.press("End");
  await page.keyboard.type(" ");
  await slider(other, "shaft.motion.speed").press("ArrowRight");
  await slider(other, "shaft.motion.speed").press("ArrowRight");
  await page.keyboard.type(" ");
  await expect(async () => {
    const texts = [await textOf(page), await textOf(other)];
    expect(texts[0]).toBe(texts[1]);
    expect(texts[0]).not.toContain('"10 rev/s"');
    expect(texts[0]).toMatch(/"Rocker of a cam mechanism, two masses", {2}\n/);
  }).toPass();
  await agrees(page);
  await agrees(other);
  await other.getByRole("button", { name: "Save", exact: true }).click();
  await expect(page.locator(".top")).not.toContainText("not saved");
});

test("a server that is killed loses nothing, on another port neither", async ({ page, context }) => {
  await opened(page);
  await page.getByLabel("inertia", { exact: true }).fill("0.17");
  await page.getByLabel("inertia", { exact: true }).press("Enter");
  await expect.poll(() => textOf(page)).toContain('"inertia": 0.17');
  const text = await textOf(page);
  await expect
    .poll(() => {
      try {
        return readdirSync(join(server.base, "state/dam/drafts")).filter((one) => one.endsWith(".json")).length;
      } catch {
        return 0;
      }
    })
    .toBe(1);
  const port = new URL(server.address).port;
  await server.kill();
  await expect(page.getByRole("alert")).toContainText("The server is gone");
  await server.start();
  expect(new URL(server.address).port).not.toBe(port);
  const again = await context.newPage();
  await opened(again);
  await expect(again.getByRole("alert")).toContainText("holds changes that were not saved");
  expect(await textOf(again)).toBe(server.text());
  await again.getByRole("button", { name: "Restore the draft" }).click();
  await expect.poll(() => textOf(again)).toBe(text);
  await agrees(again);
  await again.getByRole("button", { name: "Undo" }).click();
  await expect.poll(() => textOf(again)).toBe(server.text());
});

test("a file that others change is noticed and not written over", async ({ page }) => {
  await opened(page);
  await page.getByLabel("inertia", { exact: true }).fill("0.2");
  await page.getByLabel("inertia", { exact: true }).press("Enter");
  const theirs = server.text().replace('"masses": 2', '"masses": 1');
  server.write(theirs);
  await expect(page.getByRole("alert")).toContainText("changed by another program");
  await page.keyboard.press("Control+s");
  await expect(page.locator(".notices")).toContainText("decide first");
  expect(server.text()).toBe(theirs);
  await page.getByRole("button", { name: "Keep mine" }).click();
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await expect.poll(() => server.text()).toContain('"inertia": 0.2');
  server.write(theirs);
  await page.getByRole("button", { name: "Reload it" }).click();
  await expect.poll(() => textOf(page)).toBe(theirs);
});

test("the map marks where the scene stands, and a click in it sets both numbers", async ({ page }) => {
  test.setTimeout(180_000);
  await opened(page);
  await page.getByRole("button", { name: "Map over two numbers" }).click();
  await expect(page.locator(".map-place svg")).toBeVisible({ timeout: 60_000 });
  await expect(page.locator(".map-view")).toContainText("400 points", { timeout: 150_000 });
  const cross = page.locator(".map-place path.here");
  const before = await cross.getAttribute("d");
  expect(before).toMatch(/^M/);
  // What stands above the map may still take or leave a line.
  let box = null;
  await expect
    .poll(
      async () => {
        const last = box;
        box = await page.locator(".map-place .pad").boundingBox();
        return last?.y === box.y;
      },
      { intervals: [300] },
    )
    .toBe(true);
  await page.mouse.click(box.x + 0.25 * box.width, box.y + 0.75 * box.height);
  await expect.poll(() => cross.getAttribute("d")).not.toBe(before);
  const text = await textOf(page);
  expect(Number(/"speed": "([\d.]+) rev/.exec(text)[1])).toBeCloseTo(5, 1);
  expect(Number(/"inertia": ([\d.]+)/.exec(text)[1])).toBeCloseTo(0.075, 2);
  await agrees(page);
  await page.getByRole("button", { name: "Undo" }).click();
  await expect.poll(() => textOf(page)).toBe(server.text());
});

test("completion and help come from the schema", async ({ page }) => {
  await opened(page);
  await page.locator(".cm-line", { hasText: '"kind": "rocker"' }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(' "pos');
  await expect(page.locator(".cm-tooltip-autocomplete")).toContainText("position");
  await page.keyboard.press("Escape");
  await page.locator(".cm-content").getByText('"stiffness"').hover();
  await expect(page.locator(".cm-help")).toContainText("N m/rad");
});

test("the keyboard reaches everything", async ({ page }) => {
  await opened(page);
  const reached = new Set();
  await page.locator("body").press("Tab");
  for (let k = 0; k < 80; k++) {
    reached.add(
      await page.evaluate(() => {
        const at = document.activeElement;
        return at?.getAttribute("aria-label") ?? at?.textContent?.slice(0, 30) ?? "";
      }),
    );
    if (
      await page.evaluate(
        () => document.activeElement?.closest(".cm-editor") !== null && document.activeElement !== null,
      )
    )
      await page.keyboard.press("Escape");
    await page.keyboard.press("Tab");
  }
  for (const name of [
    "scene",
    "Save as…",
    "text of the scene",
    "rocker.inertia, slider",
    "Map over two numbers",
    "play",
  ])
    expect([...reached]).toContain(name);
  await slider(page, "rocker.inertia").focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Control+z");
  await expect.poll(() => textOf(page)).toBe(server.text());
});

test("a window without the token is told how to get one and sees nothing", async ({ page }) => {
  await page.goto(new URL(server.address).origin);
  await expect(page.getByRole("alert")).toContainText("not opened by dam studio");
  await expect(page.locator(".verdict")).toHaveCount(0);
  wrong.length = 0;
});
