// Every view can be used without a mouse and with a screen reader, in light and in dark: no rule of
// axe (WCAG 2 A and AA, and good practice) is broken, but for minor ones (heads of tables with formulas alone). Tabs, regions and the skip link go by the keyboard.

import { AxeBuilder } from "@axe-core/playwright";
import { expect, test } from "@playwright/test";
import { box, opened, watched } from "./page.mjs";
import { Server } from "./server.mjs";

let server, wrong;
const started = async (page, scenes, options) => {
  server = new Server(scenes);
  await server.start(options);
  wrong = watched(page);
};
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});

const ROCKER = { "two_masses.json": "scenarios/rocker/two_masses.json" };
const tab = (page, name) => page.getByRole("tab", { name, exact: true }).click();
// What axe finds, one line for each rule: its weight, the elements. A box of the graph shortens the
// words that its name has whole; of a mass axe joins the two lines that its name has one after the other.
async function found(page, view) {
  const axe = new AxeBuilder({ page }).exclude(".cm-editor"),
    isDark = await page.evaluate(() => matchMedia("(prefers-color-scheme: dark)").matches);
  // In the dark colours alone are others.
  const { violations } = await (isDark ? axe.withRules(["color-contrast"]) : axe).analyze();
  return violations.flatMap(({ id, impact, nodes }) => {
    if (impact === "minor") return [];
    const all = nodes.filter(
      ({ html }) => id !== "label-content-name-mismatch" || !/^<g class="(object-box|mass)/.test(html),
    );
    const words = all
      .slice(0, 4)
      .map(({ target, failureSummary }) => `${target.join(" ")} (${failureSummary?.split("\n")[1]?.trim()})`);
    return all.length ? [`${view}: ${impact} ${id}: ${words.join("; ")} [${all.length}]`] : [];
  });
}

// Tabs of a list, by the arrow keys.
test("tabs go by the arrow keys, and the Tab key leaves them", async ({ page }) => {
  await started(page, ROCKER);
  await opened(page, server.address, "Objects");
  const views = page.getByRole("tablist", { name: "views of the scene" }),
    chosen = (name) => expect(views.getByRole("tab", { name, selected: true })).toBeFocused();
  await views.getByRole("tab", { name: "Objects" }).focus();
  for (const [key, name] of [
    ["ArrowRight", "Drawing"],
    ["ArrowRight", "Text"],
    ["ArrowLeft", "Drawing"],
    ["End", "Equations"],
    ["ArrowRight", "Objects"],
    ["ArrowLeft", "Equations"],
    ["Home", "Objects"],
  ]) {
    await page.keyboard.press(key);
    await chosen(name);
  }
  // One of them alone is in the order of the Tab key.
  await expect(views.locator("[role=tab][tabindex='0']")).toHaveCount(1);
  await page.keyboard.press("Tab");
  await expect(page.getByRole("button", { name: "Add object" })).toBeFocused();
  const questions = page.getByRole("tablist", { name: "questions" });
  await questions.getByRole("tab", { name: "Workbench" }).focus();
  await page.keyboard.press("ArrowRight");
  await expect(page.getByRole("tab", { name: "Results", selected: true })).toBeFocused();
  await expect(page.locator(".results")).toBeVisible();
});

test("the first key leads past the bar, and the address stays", async ({ page }) => {
  await started(page, ROCKER);
  await page.goto(server.address);
  await page.waitForSelector(".verdict");
  await page.locator("body").press("Tab");
  const skip = page.getByRole("button", { name: "Skip the bar" });
  await expect(skip).toBeFocused();
  await expect(skip).toBeInViewport();
  const address = page.url();
  await page.keyboard.press("Enter");
  await expect(page.locator("main")).toBeFocused();
  await page.keyboard.press("Tab");
  await expect(page.getByRole("tab", { name: "Numbers" })).toBeFocused();
  expect(page.url()).toBe(address);
  await expect(skip).not.toBeInViewport();
});

for (const colorScheme of ["light", "dark"]) {
  test.describe(colorScheme, () => {
    test.use({ colorScheme });
    // Views one after the other, and all that is found in them at once.
    const visited = async (page, views) => {
      const all = [];
      for (const [view, go] of Object.entries(views)) {
        await go();
        await page.waitForTimeout(150);
        all.push(...(await found(page, view)));
      }
      expect(all).toEqual([]);
    };

    test(`first page, gallery and tour, ${colorScheme}`, async ({ page }) => {
      await started(page, ROCKER, { home: true });
      await page.goto(server.address);
      await visited(page, {
        "first page": () => expect(page.locator(".card-picture").first()).toBeVisible(),
        search: () => page.getByRole("searchbox").first().fill("cam"),
        "nothing found": () => page.getByRole("searchbox").first().fill("no such scene"),
        tour: () => page.getByRole("button", { name: /tour/i }).last().click(),
      });
    });

    test(`the workbench and its views, ${colorScheme}`, async ({ page }) => {
      test.setTimeout(400_000);
      await started(page, ROCKER);
      await opened(page, server.address, "Objects");
      await visited(page, {
        objects: () => box(page, "rocker").waitFor(),
        "an object's properties": () => box(page, "rocker").click(),
        "more properties": () => page.locator(".more > summary").last().click(),
        "adding an object": () => page.getByRole("button", { name: "Add object" }).click(),
        "scene and run": async () => {
          await page.keyboard.press("Escape");
          await page.getByRole("button", { name: "Scene and run" }).click();
        },
        drawing: () => tab(page, "Drawing"),
        text: () => tab(page, "Text"),
        "dynamic model": async () => {
          await tab(page, "Dynamic model");
          await page.locator(".models-place table, .models-place svg").first().waitFor();
        },
        equations: async () => {
          await tab(page, "Equations");
          await page.locator("math").first().waitFor();
        },
        numbers: () => tab(page, "Numbers"),
        "a wrong number": async () => {
          const entry = page.locator('[id="number rocker.inertia"]');
          await entry.fill("--");
          await entry.press("Enter");
          await expect(page.locator(".number-note")).toBeVisible();
        },
        map: async () => {
          await page.getByRole("button", { name: "Map over two numbers" }).click();
          await page.locator(".map-place svg").first().waitFor();
        },
        "a pinned run": async () => {
          await page.getByRole("button", { name: "Pin this run" }).click();
          await page.getByRole("button", { name: "unpin run 1" }).or(page.locator(".pin")).first().waitFor();
        },
        units: () => page.getByRole("button", { name: "Units" }).click(),
        results: async () => {
          await page.keyboard.press("Escape");
          await tab(page, "Results");
          await page.locator(".figures table").first().waitFor();
        },
        expectations: async () => {
          await page.getByRole("button", { name: "Expect a figure of this run…" }).click();
          await page.getByRole("button", { name: "Write it into the scene" }).waitFor();
        },
        "expectations, written": async () => {
          await page.getByRole("button", { name: "Write it into the scene" }).click();
          await page.locator(".expectations summary").click();
        },
      });
    });

    test(`faults, notices and a file that was changed, ${colorScheme}`, async ({ page }) => {
      test.setTimeout(200_000);
      await started(page, ROCKER);
      await opened(page, server.address);
      await visited(page, {
        "a fault": async () => {
          await page.locator(".cm-line", { hasText: '"kind": "rocker"' }).click();
          await page.keyboard.press("End");
          for (let k = 0; k < 8; k++) await page.keyboard.press("Backspace");
          await page.keyboard.type('"shafd",', { delay: 5 });
          await expect(page.locator(".faults button.error")).toBeVisible();
        },
        history: async () => {
          await page.getByRole("button", { name: "History" }).click();
          await page.locator(".history-steps [aria-current=step]").waitFor();
        },
        "a fault at its object": () => tab(page, "Objects"),
        "a fault at its field": () => box(page, "rocker").click(),
        "a changed file": async () => {
          server.write(server.text().replace("Rocker", "A rocker"));
          await expect(page.getByText("The file was changed by another program.")).toBeVisible();
        },
        "a server that is gone": async () => {
          await server.kill();
          await expect(page.locator(".lost")).toBeVisible();
        },
      });
    });

    test(`drawing, motion and every question, ${colorScheme}`, async ({ page }) => {
      test.setTimeout(400_000);
      await started(page, {
        "a_cam.json": "scenarios/cams/flat_tappet.json",
        "b_linkage.json": "scenarios/linkages/slider_crank_spring.json",
      });
      await opened(page, server.address, "Objects");
      const names = await page.getByRole("tablist", { name: "questions" }).getByRole("tab").allTextContents();
      await visited(page, {
        "the motion panel": async () => {
          await page.locator(".object-box").nth(1).click();
          await page.waitForTimeout(800);
        },
        ...Object.fromEntries(
          names.map((name) => [
            name,
            async () => {
              await tab(page, name);
              await page.waitForFunction(() => !document.querySelector(".asking[aria-busy=true]"), null, {
                timeout: 60_000,
              });
            },
          ]),
        ),
        "a linkage": async () => {
          await tab(page, "Workbench");
          await page.locator(".top select[aria-label=scene]").selectOption("b_linkage.json");
          await tab(page, "Drawing");
          await page.locator(".joint").first().waitFor();
          await page.locator(".sketch .body").first().press("1");
          await page.locator(".measure-fields").waitFor();
        },
        "a picture below the drawing": async () => {
          const bytes = await page.evaluate(() => document.createElement("canvas").toDataURL().split(",")[1]);
          const buffer = Buffer.from(bytes, "base64");
          await page.getByLabel("picture from a file").setInputFiles({ name: "a.png", mimeType: "image/png", buffer });
          await page.getByRole("button", { name: "Scale picture" }).click();
          await page.keyboard.press("Enter");
          await page.keyboard.press("ArrowRight");
          await page.keyboard.press("Enter");
          await page.getByLabel("their distance").waitFor();
        },
      });
    });
  });
}
