// What nobody means to do, and somebody does: names that look like code, numbers that are none,
// files that go, texts that are no scenes. Nothing runs, nothing is lost, and a word is said of it.

import { expect, test } from "@playwright/test";
import { existsSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { box, field, opened, slider, textOf, undone, watched } from "./page.mjs";
import { Server } from "./server.mjs";

const ROCKER = "scenarios/rocker/two_masses.json";
let server, wrong, ran;
test.beforeEach(async ({ page }) => {
  server = new Server();
  wrong = watched(page);
  ran = [];
  // Whatever a name runs calls this.
  await page.exposeFunction("ran", (what) => ran.push(what));
  page.on("dialog", (dialog) => {
    ran.push(dialog.message());
    void dialog.dismiss();
  });
});
test.afterEach(async () => {
  await server.end();
  expect(ran).toEqual([]);
  expect(wrong).toEqual([]);
});

const scene = (change) => {
  const made = JSON.parse(server.read(ROCKER));
  change(made);
  return `${JSON.stringify(made, null, 2)}\n`;
};
const tab = (page, name) => page.getByRole("tab", { name, exact: true }).click();
// The text of the scene as a user pastes it over all that is there.
async function pasted(page, text) {
  await tab(page, "Text");
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+a");
  await page.evaluate((text) => {
    const data = new DataTransfer();
    data.setData("text/plain", text);
    document.activeElement.dispatchEvent(
      new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }),
    );
  }, text);
}
const errors = (page) => page.locator(".faults button.error");

// ---- names
const CODE = `<img src=x onerror="ran('img')">`;
const NAMES = {
  "an image with a handler": CODE,
  "a script": "</script><script>ran('script')</script>",
  "an SVG with a handler": "<svg onload=ran('svg')>",
  quotes: `" ' \` \\ & ; --`,
  "an emoji": "😀👩‍🔧",
  "right to left": "\u202Eגלגל מכונה\u202C",
};
for (const [what, name] of Object.entries(NAMES))
  test(`a scene whose name is ${what} shows it as it is`, async ({ page }) => {
    server.write(
      scene((made) => {
        made.name = name;
        made.expect = [{ figure: "rocker.delta_max", value: 1, within: 1, source: name }];
      }),
    );
    await server.start();
    await opened(page, server.address, "Objects");
    expect(await page.locator(".print-head h1").textContent()).toBe(name);
    for (const view of ["Dynamic model", "Equations", "Results", "Steady motion"]) {
      await tab(page, view);
      await page.waitForTimeout(200);
    }
    await page.getByRole("button", { name: "Home" }).click();
    await expect(page.locator(".first-page")).toContainText(name);
    expect(await page.locator("img, svg[onload], .studio script").count()).toBe(0);
  });

for (const id of ["__proto__", "constructor", "toString", "hasOwnProperty"])
  test(`an object called ${id} is an object like others, or is refused in words`, async ({ page }) => {
    server.write(server.read(ROCKER).replace('"rocker": {', `"${id}": {`));
    await server.start();
    await page.goto(server.address);
    await page.waitForSelector(".status-line");
    await expect(page.locator(".verdict").or(errors(page).first())).toBeVisible();
    await tab(page, "Text");
    expect(await textOf(page)).toBe(server.text());
    await tab(page, "Objects");
    await expect(page.locator(".object-box")).toHaveCount(2);
    await page.getByRole("button", { name: "Duplicate" }).isVisible();
  });

test("an object gets no name that is code, or that is too long to be read", async ({ page }) => {
  await server.start();
  await opened(page, server.address, "Objects");
  const before = server.text();
  await box(page, "rocker").click();
  for (const name of [CODE, "", " ", "2fast", "a b", "__proto__.x", "😀"]) {
    const entry = page.locator("#object-name");
    await entry.fill(name);
    await entry.press("Enter");
    await expect(page.locator(".notices")).toContainText("is no name");
    await page.locator(".notices button", { hasText: "Close" }).click();
  }
  expect(await textOf(page)).toBe(before);
  const long = "n".repeat(10_000);
  await page.locator("#object-name").fill(long);
  await page.locator("#object-name").press("Enter");
  await expect.poll(() => textOf(page)).toContain(long);
  await expect(box(page, long)).toBeVisible();
  // Nothing of the page is pushed away by it.
  const [width, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  expect(width).toBeLessThanOrEqual(inner);
  await page.getByRole("button", { name: "Undo", exact: true }).click();
  await expect.poll(() => textOf(page)).toBe(before);
});

test("names of properties and values that are code are words in faults and fields", async ({ page }) => {
  await server.start();
  await opened(page, server.address);
  await pasted(
    page,
    scene((made) => {
      made.objects.rocker[CODE] = CODE;
      made.objects.rocker.loads = { [CODE]: { constant: CODE } };
    }),
  );
  await expect(errors(page).first()).toBeVisible();
  await expect(page.locator(".faults")).toContainText("<img");
  await tab(page, "Objects");
  await box(page, "rocker").click();
  await expect(page.locator(".form")).toBeVisible();
  expect(await page.locator("img").count()).toBe(0);
});

// ---- numbers
test("wrong numbers are marked where they are typed, and change nothing", async ({ page }) => {
  await server.start();
  await opened(page, server.address, "Text");
  const before = server.text(),
    entry = page.locator('[id="number rocker.inertia"]');
  for (const text of ["1e999", "NaN", "Infinity", "0x10", "--", "", "1,5", "1/0", "9".repeat(400), CODE]) {
    await entry.fill(text);
    await entry.press("Enter");
    await expect(page.locator(".number-note"), text.slice(0, 20)).toBeVisible();
    await entry.press("Escape");
  }
  await box(page, "rocker").waitFor({ state: "detached" });
  expect(await textOf(page)).toBe(before);
  await tab(page, "Objects");
  await box(page, "rocker").click();
  for (const text of ["1e999", "0x10", "1,5", "1/0"]) {
    await field(page, "rocker.inertia").fill(text);
    await field(page, "rocker.inertia").press("Enter");
    await expect(page.locator('[data-field="rocker.inertia"] .field-note'), text).toBeVisible();
    await field(page, "rocker.inertia").press("Escape");
  }
  expect(await textOf(page)).toBe(before);
});

for (const [what, number, isFault] of [
  ["larger than a number can be", "1e999", true],
  ["no JSON", "NaN", true],
  ["hexadecimal", "0x10", true],
  ["two signs", "--", true],
  ["below zero", "-0.1", true],
  ["of 5 000 digits", "9".repeat(5000), true],
  ["the smallest there is", "5e-324", false],
])
  test(`a number in the text that is ${what} is a fault or an answer, and its undo the scene`, async ({ page }) => {
    await server.start();
    await opened(page, server.address);
    const before = server.text(),
      text = before.replace(/"inertia": [^,\n]*/, `"inertia": ${number}`);
    expect(text).not.toBe(before);
    await pasted(page, text);
    expect(await textOf(page)).toBe(text);
    if (isFault) await expect(errors(page).first()).toBeVisible();
    // With an answer or without one the reader is told.
    else
      await expect(
        errors(page).first().or(page.locator(".verdict")).or(page.locator(".notices p")).first(),
      ).toBeVisible();
    await undone(page);
    await expect(errors(page)).toHaveCount(0);
    expect(await textOf(page)).toBe(before);
  });

// ---- texts that are no scenes
for (const [what, text] of [
  ["nothing", " "],
  ["a list", "[1, 2]"],
  ["half a scene", '{ "dam": 1, "objects": { "a": {'],
  ["brackets 20 000 deep", "[".repeat(20_000)],
  ["a page", `<!doctype html><body onload="ran('page')">${CODE}`],
  ["control characters", '{ "name": "\u0000\u0007\u001b[31m" }'],
])
  test(`a text that is ${what} is told of, and taken back whole`, async ({ page }) => {
    await server.start();
    await opened(page, server.address);
    const before = server.text();
    await pasted(page, text);
    await expect(errors(page).first()).toBeVisible();
    await expect(page.locator(".stale-mark")).toBeVisible();
    // Every view stands it.
    for (const view of ["Objects", "Drawing", "Dynamic model", "Properties", "Numbers"]) await tab(page, view);
    await tab(page, "Text");
    await undone(page);
    await expect.poll(() => textOf(page)).toBe(before);
    await expect(page.locator(".stale-mark")).toHaveCount(0);
  });

// ---- files and servers
test("a file that is removed while it is open is told of, and saved anew", async ({ page }) => {
  await server.start();
  await opened(page, server.address);
  const before = server.text();
  server.remove();
  await expect(page.getByRole("alert")).toContainText("The file is gone");
  expect(await textOf(page)).toBe(before);
  await slider(page, "rocker.inertia").press("ArrowRight");
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await expect.poll(() => existsSync(server.path())).toBe(true);
  expect(server.text()).toBe(await textOf(page));
  await expect(page.getByRole("alert")).toHaveCount(0);
});

test("a file that becomes a folder, or no text, is told of, and nothing of the window is lost", async ({ page }) => {
  await server.start();
  await opened(page, server.address);
  const before = await textOf(page);
  writeFileSync(server.path(), Buffer.from([0xff, 0xfe, 0x00, 0xd8]));
  await expect(page.locator(".notices p")).not.toHaveCount(0);
  expect(await textOf(page)).toBe(before);
  server.remove();
  mkdirSync(server.path());
  await expect(page.locator(".notices p")).not.toHaveCount(0);
  await page.getByRole("button", { name: "Save", exact: true }).click({ force: true });
  expect(await textOf(page)).toBe(before);
  rmSync(server.path(), { recursive: true });
});

test("edits made while the server is killed and started again arrive, in order", async ({ page }) => {
  await server.start();
  await opened(page, server.address);
  const port = new URL(server.address).port;
  await server.kill();
  await expect(page.locator(".lost")).toBeVisible();
  for (let k = 0; k < 5; k++) await slider(page, "rocker.inertia").press("ArrowRight");
  await page.getByRole("button", { name: "Undo", exact: true }).click({ force: true });
  const text = await textOf(page);
  expect(text).not.toBe(server.text());
  await server.start({ port });
  await expect(page.locator(".lost")).toHaveCount(0, { timeout: 30_000 });
  await expect.poll(() => textOf(page)).toBe(text);
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await expect.poll(() => server.text()).toBe(text);
});

test("what a server owed when it was killed is asked for again", async ({ page }) => {
  let owed = 0;
  await page.route(/api.(parts|scenes)/, (route) => (owed-- > 0 ? route.abort("connectionreset") : route.continue()));
  await server.start();
  await page.goto(server.address);
  await page.waitForSelector(".verdict");
  // Without the list of scenes this one is opened all the same; that of what can be added is waited for.
  owed = 2;
  await page.reload();
  await page.waitForSelector(".verdict");
  const add = page.getByRole("button", { name: "Add object" }),
    kinds = page.locator(".palette .parts button");
  await add.click();
  await expect(page.locator(".palette")).toBeVisible();
  expect(await kinds.count()).toBe(0);
  const port = new URL(server.address).port;
  await server.kill();
  await expect(page.locator(".lost")).toBeVisible();
  await server.start({ port });
  await expect(page.locator(".lost")).toHaveCount(0, { timeout: 30_000 });
  await expect.poll(() => kinds.count()).toBeGreaterThan(5);
});

test("two windows that type at one place keep the letters of both", async ({ page, context }) => {
  await server.start();
  await opened(page, server.address);
  const other = await context.newPage();
  watched(other);
  await opened(other, server.address);
  for (const window of [page, other]) {
    await window.locator(".cm-line").nth(2).click();
    await window.keyboard.press("End");
  }
  await Promise.all([
    page.keyboard.type("aaaaaaaaaa", { delay: 15 }),
    other.keyboard.type("bbbbbbbbbb", { delay: 20 }),
  ]);
  await expect(async () => {
    const [own, theirs] = [await textOf(page), await textOf(other)];
    expect(own).toBe(theirs);
    expect([own.split("a").length, own.split("b").length]).toEqual(
      ["a", "b"].map((letter) => server.text().split(letter).length + 10),
    );
  }).toPass();
});

test("names of files that are none are refused in words", async ({ page }) => {
  await server.start();
  page.removeAllListeners("dialog");
  const answers = ["../out.json", "/tmp/out.json", "a\u0000b.json", `${"n".repeat(5000)}.json`, CODE];
  await opened(page, server.address);
  for (const answer of answers) {
    page.once("dialog", (dialog) => dialog.accept(answer));
    await page.getByRole("button", { name: "Save as…" }).click();
    await expect(page.locator(".notices p"), answer.slice(0, 20)).not.toHaveCount(0);
    await page.locator(".notices button", { hasText: "Close" }).click();
  }
  await expect(page.locator(".top select[aria-label=scene]")).toHaveValue("two_masses.json");
});
