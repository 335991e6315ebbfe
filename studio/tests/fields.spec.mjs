// Keys in fields, ports of all kinds, typed numbers, notices.

import { expect, test } from "@playwright/test";
import { box, field, opened, textOf, watched } from "./page.mjs";
import { Server } from "./server.mjs";

let server, wrong;
test.beforeEach(({ page }) => {
  wrong = watched(page);
});
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});
async function started(scenes) {
  server = new Server(scenes);
  await server.start();
}
const button = (page, name) => page.getByRole("button", { name, exact: true });
const middle = async (locator) => {
  const { x, y, width, height } = await locator.boundingBox();
  return [x + width / 2, y + height / 2];
};
async function dragged(page, from, [x, y]) {
  await page.mouse.move(...(await middle(from)));
  await page.mouse.down();
  await page.mouse.move(x - 20, y, { steps: 3 });
  await page.mouse.move(x, y, { steps: 3 });
  await page.mouse.up();
}

test("keys that are typed into the search of objects are text and nothing else", async ({ page }) => {
  await started();
  await opened(page, server.address, "Objects");
  const before = await textOf(page);
  await box(page, "rocker").click();
  await button(page, "Add object").click();
  const search = page.getByLabel("search kinds and catalogue");
  await expect(search).toBeFocused();
  await page.keyboard.type("a rockerx c");
  await expect(search).toHaveValue("a rockerx c");
  for (let k = 0; k < 3; k++) await page.keyboard.press("Backspace");
  await expect(search).toHaveValue("a rocker");
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Delete");
  await expect(search).toHaveValue("");
  await page.keyboard.press("Control+d");
  expect(await textOf(page)).toBe(before);
  await expect(page.locator(".object-box")).toHaveCount(2);
  // The palette closes by Escape; the buttons of the graph are pressed by the keyboard.
  await page.keyboard.press("Escape");
  await expect(page.locator(".palette")).toHaveCount(0);
  await button(page, "Add object").focus();
  await page.keyboard.press("Enter");
  await expect(page.locator(".palette")).toBeVisible();
  await page.keyboard.press("Escape");
  // The keys of the graph are those of the graph still.
  await box(page, "rocker").click();
  await page.keyboard.press("Backspace");
  await expect(page.locator(".object-box")).toHaveCount(1);
});

test("a field takes back what is typed in it, and what is saved has it", async ({ page }) => {
  await started();
  await opened(page, server.address);
  const before = await textOf(page),
    inertia = page.getByLabel("inertia", { exact: true });
  await inertia.click();
  await page.keyboard.type("0.3");
  await page.keyboard.press("Control+z");
  expect(await textOf(page)).toBe(before);
  await page.keyboard.press("Escape");
  await inertia.click();
  await page.keyboard.press("Control+a");
  await page.keyboard.type("0.4");
  await page.keyboard.press("Control+s");
  await expect.poll(() => server.text()).toContain('"inertia": 0.4');
  await expect(page.locator(".top")).not.toContainText("not saved");
  // What was given away is taken back in the scene.
  await page.keyboard.press("Control+z");
  await expect.poll(() => textOf(page)).toBe(before);
});

test("a linkage with one input has its port and its connection, and what cannot be connected says why", async ({
  page,
}) => {
  await started({ "press.json": "scenarios/kinetostatics/slider_crank.json" });
  await opened(page, server.address, "Objects");
  const scene = JSON.parse(await textOf(page)).objects;
  const press = Object.keys(scene).find((id) => scene[id].kind === "linkage"),
    drive = scene[press].input;
  expect(typeof drive).toBe("string");
  const port = page.locator(`[data-input="${press}.input"]`),
    line = page.locator(`[data-edge="${press}.input"]`);
  const [px, py] = await middle(port.locator("circle").last()),
    frame = await box(page, press).locator(".frame").boundingBox();
  expect(Math.abs(px - frame.x)).toBeLessThan(3);
  expect(py).toBeGreaterThan(frame.y);
  await expect(line).toHaveCount(1);
  await box(page, drive).click();
  await button(page, "Duplicate").click();
  await expect(page.locator(".object-box.chosen")).toHaveCount(1);
  const copy = await page.locator(".object-box.chosen").getAttribute("data-id");
  expect(copy).not.toBe(drive);
  const output = page.locator(`[data-output="${copy}"]`);
  await dragged(page, output, await middle(port.locator("circle").last()));
  await expect.poll(async () => JSON.parse(await textOf(page)).objects[press].input).toBe(copy);
  await expect(page.locator(".hint-line.refused")).toHaveCount(0);
  const said = page.locator(".hint-line.refused");
  await dragged(page, output, await middle(box(page, drive).locator(".frame")));
  await expect(said).toContainText("has no input");
  await dragged(page, output, await middle(box(page, copy).locator(".frame")));
  await expect(said).toContainText("cannot drive itself");
  await box(page, press).click();
  await expect(said).toHaveCount(0);
});

test("numbers are worked out, or marked and held back", async ({ page }) => {
  await started();
  await opened(page, server.address);
  const inertia = page.getByLabel("inertia", { exact: true }),
    speed = page.getByLabel("speed", { exact: true });
  const enter = async (own, text) => {
    await own.fill(text);
    await own.press("Enter");
  };
  await enter(inertia, "2*3");
  await expect.poll(() => textOf(page)).toContain('"inertia": 6,');
  await enter(inertia, "1/4");
  await expect.poll(() => textOf(page)).toContain('"inertia": 0.25,');
  await enter(speed, "1/4 rev/s");
  await expect.poll(() => textOf(page)).toContain('"speed": "0.25 rev/s"');
  const before = await textOf(page);
  await enter(inertia, "1,5");
  await expect(inertia).toHaveAttribute("aria-invalid", "true");
  await expect(page.locator(".number-note")).toContainText("1.5");
  expect(await textOf(page)).toBe(before);
  await enter(inertia, "1/0");
  await expect(page.locator(".number-note")).toContainText("not a number");
  await inertia.press("Escape");
  await expect(page.locator(".number-note")).toHaveCount(0);
  // In the form of the object too.
  await page.getByRole("tab", { name: "Objects" }).click();
  await box(page, "rocker").click();
  const own = field(page, "rocker.inertia");
  await enter(own, "1,5");
  await expect(page.locator('[data-field="rocker.inertia"] .field-note.error')).toContainText("1.5");
  expect(await textOf(page)).toBe(before);
  await enter(own, "(1 + 2)/4");
  await expect.poll(() => textOf(page)).toContain('"inertia": 0.75,');
  await expect(page.locator('[data-field="rocker.inertia"] .field-note')).toHaveCount(0);
});

test("a fault at a field is as high as its words, and no style of reports reaches the interface", async ({ page }) => {
  await started();
  server.write(server.text().replace('"10 rev/s"', '"10 furlong"'));
  await page.goto(server.address);
  // It never had an answer.
  await expect(page.locator(".stale-mark")).toContainText("No answer yet: the text has 1 fault");
  await expect(page.locator(".stale-mark")).not.toContainText("last good");
  await page.getByRole("tab", { name: "Objects" }).click();
  await box(page, "shaft").click();
  const note = page.locator('[data-field="shaft.motion.speed"] .field-note');
  await expect(note).toContainText("furlong");
  const { height } = await note.boundingBox(),
    lines = await note.evaluate(
      (one) => one.getClientRects().length && one.scrollHeight / parseFloat(getComputedStyle(one).lineHeight),
    );
  expect(height).toBeLessThan(30 * Math.ceil(lines));
  expect(await note.evaluate((one) => getComputedStyle(one).borderTopWidth)).toBe("0px");
  // Names that both style sheets begin a rule with are those that the interface means to share.
  const shared = await page.evaluate(() => {
    const heads = (sheet) => {
      const names = new Set(),
        walk = (rules) => {
          for (const rule of rules) {
            if (rule.selectorText)
              for (const one of rule.selectorText.split(",")) {
                const match = /^(?:\.studio )?(?:[a-z]+)?\.([\w-]+)/.exec(one.trim());
                if (match) names.add(match[1]);
              }
            if (rule.cssRules && !rule.selectorText) walk(rule.cssRules);
          }
        };
      walk(sheet.cssRules);
      return names;
    };
    const of = (name) => heads([...document.styleSheets].find((one) => one.href?.endsWith(name)));
    const [look, own] = [of("/look.css"), of("/studio.css")];
    return [...own].filter((name) => look.has(name)).sort();
  });
  expect(shared).toEqual(["chart"]);
});

test("notices go when their cause is gone", async ({ page }) => {
  await started();
  await opened(page, server.address, "Objects");
  await box(page, "rocker").click();
  const name = page.locator("#object-name");
  await name.fill("shaft");
  await name.press("Enter");
  await expect(page.locator(".notices")).toContainText("There is an object shaft already");
  await name.fill("lever");
  await name.press("Enter");
  await expect(box(page, "lever")).toBeVisible();
  await expect(page.locator(".notices")).toHaveCount(0);
});
