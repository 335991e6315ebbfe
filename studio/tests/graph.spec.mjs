// Objects, forms, dynamic model and equations: whatever is done there is an edit of the text.

import { expect, test } from "@playwright/test";
import { execFileSync } from "node:child_process";
import { agrees, box, deltaOf, field, opened, random, slider, textOf, undone, watched } from "./page.mjs";
import { dam, Server } from "./server.mjs";

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
const centre = async (locator) => {
  const { x, y, width, height } = await locator.boundingBox();
  return [x + width / 2, y + height / 2];
};
async function dragged(page, from, to) {
  await page.mouse.move(...(await centre(from)));
  await page.mouse.down();
  const [x, y] = await centre(to);
  await page.mouse.move(x - 20, y, { steps: 3 });
  await page.mouse.move(x, y, { steps: 3 });
  await page.mouse.up();
}
const output = (page, address) => page.locator(`[data-output="${address}"]`);
const input = (page, address) => page.locator(`[data-input="${address}"]`);
const button = (page, name) => page.getByRole("button", { name, exact: true });

test("the two-mass rocker is built from an empty page in 20 actions", async ({ page }) => {
  test.setTimeout(180_000);
  await started({});
  await page.goto(server.address);
  let actions = 0;
  const act = async (done) => {
    actions++;
    await done;
  };
  const type = (address, text) => act(field(page, address).fill(text));
  page.on("dialog", (dialog) => void dialog.accept("rocker.json"));
  await act(button(page, "New…").click());
  await act(page.locator(".part", { hasText: "A drive" }).click());
  await type("drive.motion.speed", "10 rev/s");
  await act(button(page, "Add object").click());
  await act(page.locator(".part", { hasText: "A rocker" }).first().click());
  // It runs as it is put down: what is another is changed.
  await act(page.getByLabel("rocker.position, by").selectOption("sine"));
  await type("rocker.position.sine.amplitude", "90 deg");
  await type("rocker.inertia", "0.1");
  await type("rocker.stiffness", "1e7");
  await type("rocker.damping_capacity", "0.4");
  await type("rocker.masses", "2");
  await act(page.getByLabel("rocker.loads.spring, by").selectOption("constant"));
  await type("rocker.loads.spring.constant", "-600");
  await act(page.getByLabel(/: more properties of rocker\.loads\.spring$/).click());
  await type("rocker.loads.spring.mass", "last");
  await act(button(page, "Scene and run").click());
  await type("run.duration", "0.5");
  await act(page.getByLabel(/: more properties of run$/).click());
  await type("run.tolerance", "1e-9");
  await act(button(page, "Save").click());
  console.log(`${actions} actions`);
  expect(actions).toBeLessThanOrEqual(20);
  await expect(page.locator(".faults button")).toHaveCount(0);
  await expect(page.locator(".verdict")).toContainText(/separates|lift off/);
  await agrees(page, server);
  expect(Number(await deltaOf(page))).toBeCloseTo(0.00750086, 8);
  await expect(page.locator(".top")).not.toContainText("not saved");
  const saved = server.text("rocker.json");
  expect(saved).toBe(await textOf(page));
  expect(server.run(saved).objects.rocker.delta_max).toBe(
    server.run(server.read("scenarios/rocker/two_masses.json")).objects.rocker.delta_max,
  );
});

test("ports are joined with the mouse and with the keyboard, and let go", async ({ page }) => {
  await started();
  await opened(page, server.address, "Objects");
  const before = await textOf(page);
  await page.locator(".object-box.drive").click();
  await button(page, "Duplicate").click();
  await expect(box(page, "shaft_2")).toBeVisible();
  await dragged(page, output(page, "shaft_2"), input(page, "rocker.input"));
  await expect.poll(() => textOf(page)).toContain('"input": "shaft_2"');
  // With the keyboard back again.
  await box(page, "shaft").focus();
  await page.keyboard.press("c");
  await expect(page.locator(".hint-line")).toContainText("Connect shaft to");
  await box(page, "rocker").focus();
  await page.keyboard.press("Enter");
  await expect.poll(() => textOf(page)).toContain('"input": "shaft",');
  // The connection alone is taken away, then its copy by the copy's name in the form.
  await page.locator('[data-edge="rocker.input"]').focus();
  await page.keyboard.press("Enter");
  await page.keyboard.press("Delete");
  await expect.poll(() => textOf(page)).not.toContain('"input"');
  await expect(box(page, "rocker").locator(".badge.error")).toBeVisible();
  await box(page, "rocker").click();
  await field(page, "rocker.input").selectOption("shaft_2");
  await expect(box(page, "rocker").locator(".badge")).toHaveCount(0);
  await agrees(page, server);
  await box(page, "shaft").click();
  await page.keyboard.press("Delete");
  await expect(page.locator(".object-box")).toHaveCount(2);
  // A name changes wherever it stands.
  await box(page, "rocker").click();
  await page.locator("#object-name").fill("lever");
  await page.locator("#object-name").press("Enter");
  await expect.poll(() => textOf(page)).toContain('"figure": "lever.delta_max"');
  await expect.poll(() => textOf(page)).not.toContain('"rocker.');
  await agrees(page, server, "lever");
  await undone(page);
  await expect.poll(() => textOf(page)).toBe(before);
});

test("objects are copied and pasted, with the buttons and through the clipboard", async ({ page }) => {
  await started();
  await opened(page, server.address, "Objects");
  const before = await textOf(page),
    objects = async () => JSON.parse(await textOf(page)).objects;
  await box(page, "shaft").click();
  await box(page, "rocker").click({ modifiers: ["Shift"] });
  await button(page, "Copy").click();
  await button(page, "Paste").click();
  await expect(page.locator(".object-box")).toHaveCount(4);
  // The copies go together: what one says of the other is said of its copy.
  const own = await objects();
  expect(own.rocker_2).toEqual({ ...own.rocker, input: "shaft_2" });
  expect(own.shaft_2).toEqual(own.shaft);
  await agrees(page, server, "rocker_2");
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(before);
  // What is cut is gone, and comes back.
  await expect(page.locator(".object-box")).toHaveCount(2);
  await box(page, "rocker").click();
  await page.keyboard.press("Control+x");
  await expect(page.locator(".object-box")).toHaveCount(1);
  await page.keyboard.press("Control+v");
  await expect(box(page, "rocker")).toBeVisible();
  expect(await objects()).toEqual(JSON.parse(before).objects);
  // What is no object is not pasted.
  const whole = await textOf(page);
  await page.evaluate(() => {
    const data = new DataTransfer();
    data.setData("text/plain", '{ "a": 1 }');
    document.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data }));
  });
  expect(await textOf(page)).toBe(whole);
});

test("three faults are told at their objects and fields, and mended there", async ({ page }) => {
  await started();
  server.write(
    server
      .text()
      .replace('"kind": "rocker"', '"kind": "rockr"')
      .replace('"speed": "10 rev/s"', '"speed": "10 furlong"')
      .replace('"duration": 0.5', '"duration": -1'),
  );
  await page.goto(server.address);
  await expect(page.locator(".faults button.error")).toHaveCount(3);
  await expect(box(page, "rocker").locator(".badge.error")).toHaveText("1");
  await expect(box(page, "shaft").locator(".badge.error")).toHaveText("1");
  await box(page, "rocker").click();
  await expect(page.locator(".form .field-note.error").first()).toContainText("rockr");
  await page.locator("#object-kind").selectOption("rocker");
  await expect(box(page, "rocker").locator(".badge")).toHaveCount(0);
  await box(page, "shaft").click();
  await expect(page.locator('[data-field="shaft.motion.speed"] .field-note.error')).toContainText("furlong");
  await field(page, "shaft.motion.speed").fill("10 rev/s");
  await button(page, "Scene and run").click();
  await expect(page.locator('[data-field="run.duration"] .field-note.error')).toBeVisible();
  await field(page, "run.duration").fill("0.5");
  await field(page, "run.duration").press("Enter");
  await expect(page.locator(".faults button")).toHaveCount(0);
  await agrees(page, server);
  expect(await textOf(page)).toBe(server.read("scenarios/rocker/two_masses.json"));
});

test("dynamic model and equations are those of dam show", async ({ page }) => {
  await started();
  await opened(page, server.address, "Dynamic model");
  const told = JSON.parse(execFileSync(dam, ["show", server.path(), "--json"], { encoding: "utf8" }));
  await expect(page.locator(".dam-model .mass")).toHaveCount(
    told.objects.flatMap((one) => (one.kind === "drive" ? [] : one.inertias)).length,
  );
  const rows = page.locator(".models table").first().locator("tbody tr");
  await expect(rows).toHaveCount(told.natural_frequencies.engaged.length);
  for (const [k, omega] of told.natural_frequencies.engaged.entries())
    await expect(rows.nth(k).locator("td").first()).toHaveText(String(Number(omega.toPrecision(6))));
  await page.getByRole("tab", { name: "Equations" }).click();
  await expect(page.locator("section.equations")).toHaveCount(told.objects.length);
  await expect(page.locator("section.equations[data-object=rocker] .equation").first()).toContainText("φ");
  await page.locator("section.equations[data-object=shaft]").hover();
  await expect(page.locator('section.equations[data-object=rocker] [data-of="shaft"].lit').first()).toBeVisible();
  // They follow the text.
  await slider(page, "rocker.inertia").focus();
  await page.keyboard.press("ArrowRight");
  await page.getByRole("tab", { name: "Dynamic model" }).click();
  await expect(rows.first().locator("td").first()).not.toHaveText(
    String(Number(told.natural_frequencies.engaged[0].toPrecision(6))),
  );
});

test("the level that is chosen and its error stand in the dynamic model", async ({ page }) => {
  await started();
  server.write(
    server
      .text()
      .replace('"masses": 2', '"masses": "auto"')
      .replace('"tolerance": 1e-9', '"tolerance": 1e-9, "accuracy": { "rocker.delta_max": "5 %" }'),
  );
  await opened(page, server.address, "Dynamic model");
  const told = server.run(server.text()),
    level = page.locator(".models table", { hasText: "less is not enough" });
  await expect(level).toContainText("rocker", { timeout: 60_000 });
  const { count, level: sort } = told.objects.rocker.model;
  expect(sort).toBe("masses");
  await expect(level).toContainText(`${count} mass`);
  // The picture is that of the level.
  await expect(page.locator(".dam-model .row", { hasText: "rocker" }).locator(".mass")).toHaveCount(count);
  await expect(page.locator(".models table").first()).toContainText("rocker.delta_max");
});

test("a joint of a linkage is dragged, the others stay, and the structure is told", async ({ page }) => {
  await started({ "press.json": "scenarios/kinetostatics/slider_crank.json" });
  await opened(page, server.address, "Drawing");
  const file = server.text("press.json");
  const sketch = () =>
    page.evaluate(async () => {
      const answer = await fetch("/api/linkages?scene=press.json", {
        headers: { Authorization: `Bearer ${sessionStorage.getItem("dam-studio-token")}` },
      });
      return (await answer.json()).linkages[0];
    });
  // Where every named point is at the start.
  const places = ({ links, ground, courses: [{ poses, start }] }) =>
    Object.fromEntries([
      ...ground.map((point) => [`ground.${point.name}`, point.at]),
      ...links.flatMap((link, k) =>
        link.points.map(({ name, at: [x, y] }) => {
          const [u, v, c, s] = poses[start].slice(4 * k, 4 * k + 4);
          return [`${link.name}.${name}`, [u + c * x - s * y, v + s * x + c * y]];
        }),
      ),
    ]);
  const before = places(await sketch());
  await expect(page.locator(".structure")).toContainText("1 degree of freedom");
  const joint = page.locator('[data-joint~="crank.A"]');
  await joint.locator(".hit").waitFor();
  const [x, y] = await centre(joint.locator(".hit"));
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 6, y - 4, { steps: 3 });
  await page.mouse.up();
  await expect.poll(() => textOf(page)).not.toBe(file);
  await expect(page.locator(".faults button.error")).toHaveCount(0);
  await expect(async () => {
    const after = places(await sketch()),
      size = Math.max(...Object.values(before).flat().map(Math.abs));
    for (const [name, [u, v]] of Object.entries(after)) {
      const off = Math.hypot(u - before[name][0], v - before[name][1]);
      // A step of the drawing is what lengths are rounded to.
      if (name === "crank.A") expect(off, name).toBeGreaterThan(0.004 * size);
      else expect(off, name).toBeLessThan(0.004 * size);
    }
  }).toPass({ timeout: 20_000 });
  // With the keyboard too; each is one step.
  const dragged = await textOf(page);
  await joint.focus();
  await page.keyboard.press("Shift+ArrowUp");
  await expect.poll(() => textOf(page)).not.toBe(dragged);
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(dragged);
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(file);
});

test("random edits from every view and as many undos give the file back byte for byte", async ({ page }) => {
  const edits = Number(process.env.EDITS ?? 100);
  test.setTimeout(60_000 + 4000 * edits);
  const seed = Number(process.env.SEED ?? Date.now() % 1_000_000),
    below = random(seed);
  console.log(`seed ${seed}`);
  await started();
  server.write(server.text().replaceAll("\n", "\r\n"));
  const file = server.text();
  await opened(page, server.address, "Objects");
  const lines = (text) => text.split("\n");
  const one = async (locator) => {
    const count = await locator.count();
    return count ? locator.nth(below(count)) : null;
  };
  const tab = (name) => page.getByRole("tab", { name }).click();
  // With the keyboard: boxes of many objects may lie out of sight.
  const chosen = async (object) => {
    await object.focus();
    await page.keyboard.press("Enter");
  };
  // Each is one edit, where the scene has room for it.
  const ways = {
    async slider() {
      await tab("Numbers");
      const bar = await one(page.locator('.slider input[type=range]:not([aria-label^="run"])'));
      if (!bar) return;
      await bar.focus();
      await page.keyboard.press(["ArrowRight", "ArrowLeft", "PageUp", "Home"][below(4)]);
    },
    async form() {
      const object = await one(page.locator(".object-box"));
      if (object) await chosen(object);
      else await button(page, "Scene and run").click();
      const entry = await one(page.locator(".form .entry input[type=text]:visible:not([id='object-name'])"));
      if (!entry) return;
      await entry.fill(["0.25", "3 deg", "2", 'µ "x" \\ 😀'][below(4)]);
      await entry.press("Enter");
    },
    async add() {
      if ((await page.locator(".palette").count()) === 0) await button(page, "Add object").click();
      await (await one(page.locator(".part"))).click();
    },
    async duplicate() {
      const object = await one(page.locator(".object-box"));
      if (!object) return;
      await chosen(object);
      await button(page, "Duplicate").click();
    },
    async remove() {
      const object = await one(page.locator(".object-box"));
      if (!object || (await page.locator(".object-box").count()) < 3) return;
      await chosen(object);
      await button(page, "Delete").click();
    },
    async rename() {
      const object = await one(page.locator(".object-box"));
      if (!object) return;
      await chosen(object);
      await page.locator("#object-name").fill(`n${below(1000)}`);
      await page.locator("#object-name").press("Enter");
    },
    async connect() {
      const from = await one(page.locator("[data-output]")),
        to = await one(page.locator("[data-input]"));
      if (from && to) await dragged(page, from.locator(".hit"), to.locator(".hit"));
    },
    async type() {
      await tab("Text");
      await page.locator(".cm-line").nth(below(8)).click();
      await page.keyboard.press("End");
      await page.keyboard.type("  ", { delay: 2 });
      await tab("Objects");
    },
  };
  let changed = 0;
  for (let k = 0; k < edits; k++) {
    const before = await textOf(page),
      names = Object.keys(ways),
      name = names[below(names.length)];
    await ways[name]();
    await page.waitForTimeout(120);
    const after = await textOf(page);
    // The next one is made on the graph of this text.
    const ids = Object.keys(JSON.parse(after).objects);
    if (await page.locator(".objects").count()) {
      await expect(page.locator(".object-box")).toHaveCount(ids.length);
      for (const id of ids) await expect(box(page, id)).toBeVisible();
    }
    if (after === before) continue;
    changed++;
    // Lines that the edit is not about are where they were, as they were.
    const [a, b] = [lines(before), lines(after)],
      left = new Map();
    for (const line of b) left.set(line, (left.get(line) ?? 0) + 1);
    const gone = a.filter((line) => {
      const there = left.get(line) ?? 0;
      left.set(line, there - 1);
      return there <= 0;
    });
    // What is taken out has all of its lines, and what it drove another one.
    const most = { rename: 20, remove: a.length - b.length + ids.length }[name] ?? 3;
    expect(gone.length, `${name}: ${gone.join(" | ")}`).toBeLessThanOrEqual(most);
  }
  expect(changed).toBeGreaterThan(edits / 3);
  await undone(page);
  await expect.poll(() => textOf(page)).toBe(file.replaceAll("\r\n", "\n"));
  await expect(page.locator(".top")).not.toContainText("not saved");
  expect(server.text()).toBe(file);
});
