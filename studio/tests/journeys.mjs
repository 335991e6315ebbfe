// How many acts it takes from nothing to a machine that runs: clicks, drags and filled fields are
// counted, and never more than two faults are in sight on the way.

import { expect, test } from "@playwright/test";
import { button, click, drag, server, settled } from "./drawn.mjs";
import { field, textOf } from "./page.mjs";

// A page on an empty folder, with a counter of what is done in it.
async function counted(page, begin, most) {
  test.setTimeout(120_000);
  page.on("dialog", (dialog) => void dialog.accept("made.json"));
  await begin(page);
  let acts = 0;
  return {
    act: async (done) => {
      acts++;
      await done;
      await textOf(page);
      expect(await page.locator(".faults button").count()).toBeLessThanOrEqual(2);
    },
    // It runs, is judged and has no fault; the file is what the program runs as well.
    judged: async (objects) => {
      await expect(page.locator(".status-line .verdict, .verdict").first()).toContainText(/\S/);
      await expect(page.locator(".faults button")).toHaveCount(0);
      await expect(page.locator(".machine svg").first()).toBeVisible();
      const run = server.run(await textOf(page));
      expect(Object.keys(run.objects)).toEqual(objects);
      console.log(`${acts} acts`);
      expect(acts).toBeLessThanOrEqual(most);
    },
  };
}

// `begin`: opens a page on an empty folder.
export function journeys(begin) {
  test("a cam lever with a spring and a slide behind it, from nothing to a judged run", async ({ page }) => {
    const { act, judged } = await counted(page, begin, 15);
    await act(button(page, "New…").click());
    await act(page.locator(".part", { hasText: "A rocker" }).first().click());
    await act(field(page, "rocker.inertia").fill("0.1 kg m^2"));
    await act(field(page, "rocker.stiffness").fill("1e6 N m/rad"));
    await act(field(page, "rocker.loads.spring.spring.preload").fill("600 N m"));
    await act(button(page, "Add object").click());
    await act(page.locator(".part", { hasText: "A slide" }).first().click());
    await act(field(page, "slider.inertia").fill("3 kg"));
    await act(field(page, "slider.stiffness").fill("8 kN/mm"));
    await act(field(page, "slider.lever_arm").fill("150 mm"));
    await judged(["drive", "rocker", "slider"]);
  });

  test("the lift-off speed of a lever is one act away", async ({ page }) => {
    await counted(page, begin, 0);
    await button(page, "New…").click();
    await page.locator(".part", { hasText: "A rocker" }).first().click();
    await expect(page.locator(".faults button")).toHaveCount(0);
    await page.getByRole("tab", { name: "Find" }).click();
    const told = page.locator(".asking .found .answer, .asking .found .verdict").first();
    await expect(told).toContainText(/rpm/, { timeout: 60_000 });
    // The program finds the same, and a run above it separates where one below does not.
    const speed = server.find(await textOf(page), "drive.motion.speed=75:1200 rpm", "rocker.pair.separations <= 0");
    expect(Number(/([0-9.]+) rpm/.exec(await told.textContent())[1])).toBeCloseTo(speed, 0);
  });

  test("a four-bar with a point of its coupler and a rocker that hangs on it", async ({ page }) => {
    const { act, judged } = await counted(page, begin, 14);
    await act(button(page, "New…").click());
    await act(page.getByRole("tab", { name: "Drawing" }).click());
    await act(button(page, "New linkage").click());
    await settled(page);
    await act(click(page, [0, 0]));
    await act(click(page, [200, 0]));
    await act(button(page, "Link").click());
    await act(drag(page, [0, 0], [0, 60]));
    await act(drag(page, [0, 60], [160, 130]));
    await act(drag(page, [160, 130], [200, 0]));
    await act(button(page, "Point").click());
    await act(drag(page, [80, 95], [80, 160]));
    await act(button(page, "Output").click());
    await act(click(page, [180, 65]));
    await judged(["drive", "linkage", "linkage.link_3", "rocker"]);
  });

  test("a five-bar with two drives", async ({ page }) => {
    const { act, judged } = await counted(page, begin, 14);
    await act(button(page, "New…").click());
    await act(page.getByRole("tab", { name: "Drawing" }).click());
    await act(button(page, "New linkage").click());
    await settled(page);
    await act(click(page, [0, 0]));
    await act(click(page, [150, 0]));
    await act(button(page, "Link").click());
    await act(drag(page, [0, 0], [0, 60]));
    await act(drag(page, [0, 60], [75, 180]));
    await act(drag(page, [75, 180], [150, 60]));
    await act(drag(page, [150, 60], [150, 0]));
    await act(button(page, "Drive").click());
    await act(click(page, [150, 0]));
    await judged(["drive", "drive_2", "linkage", "linkage.drive", "linkage.drive_2"]);
  });
}
