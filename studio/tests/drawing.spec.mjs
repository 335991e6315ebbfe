// Linkages drawn with the mouse and with the keyboard: every act is an edit of the text.

import { expect, test } from "@playwright/test";
import { execFileSync } from "node:child_process";
import { begun as begin, button, click, drag, eachWatched, server, settled, sketch } from "./drawn.mjs";
import { textOf } from "./page.mjs";
import { dam } from "./server.mjs";

eachWatched();
const joint = (page, name) => page.locator(`.joint[data-joint~="${name}"]`);
const bodies = (page) => page.locator(".sketch .body");

// An empty page with a linkage that has no parts yet.
async function begun(page) {
  page.on("dialog", (dialog) => void dialog.accept("drawn.json"));
  await begin(page);
  await button(page, "New…").click();
  await expect(page.locator(".top select")).toHaveValue("drawn.json");
  await page.getByRole("tab", { name: "Drawing" }).click();
  await button(page, "New linkage").click();
  await settled(page);
}
// Where the joints are drawn (m).
const places = (page) =>
  page
    .locator(".joint")
    .evaluateAll((all) =>
      Object.fromEntries(
        all.flatMap((one) => one.dataset.joint.split(" ").map((name) => [name, one.dataset.at.split(" ").map(Number)])),
      ),
    );
const columns = (name) =>
  JSON.parse(
    execFileSync(dam, ["kinematics", server.path(name), "--turn", "--positions", "12", "--json", "--quiet"], {
      encoding: "utf8",
      maxBuffer: 1 << 26,
    }),
  ).columns;

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
  const text = await textOf(page),
    own = JSON.parse(text).objects.linkage;
  expect(server.text("drawn.json")).toBe(text);
  // The numbers are those of the grid, each part on a line of its own.
  expect(Object.values(own.ground)).toEqual([
    [0, 0],
    ["200 mm", 0],
  ]);
  expect(text).toContain('\n        "link_1": { "points": { "B": [0, "60 mm"] } },\n');
  expect(own.links.link_2.points).toEqual({ C: ["160 mm", "70 mm"] });
  expect(Object.keys(own.pairs)).toHaveLength(4);
  const told = columns("drawn.json"),
    input = page.getByLabel("input of the linkage");
  await button(page, "Select").click();
  let compared = 0;
  for (let k = 0; k < 12; k++) {
    await input.fill(String(15 * k));
    await expect(page.locator(".drawing output")).toHaveText(k ? `${30 * k} °` : /^0/);
    for (const [name, drawn] of Object.entries(await places(page))) {
      const [link, point] = name.split(".");
      if (!own.links[link]?.points[point]) continue;
      for (const [c, axis] of ["x", "y"].entries())
        expect(drawn[c], `${name} at ${30 * k} deg`).toBeCloseTo(told[`links.${name}.${axis}`].values[k], 12);
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
  const press = async (...keys) => {
    for (const key of keys) await page.keyboard.press(key);
  };
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

// A scene of the program in the drawing.
async function shown(page, scene) {
  await begin(page, { "scene.json": scene });
  await page.getByRole("tab", { name: "Drawing" }).click();
  await page.locator(".joint").first().waitFor();
  await settled(page);
}
// Pulls a joint by so many pixels of the screen.
async function pulled(page, name, [dx, dy]) {
  const before = await textOf(page),
    box = await joint(page, name).locator(".hit").boundingBox(),
    [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 3 });
  await page.mouse.up();
  await expect.poll(() => textOf(page)).not.toBe(before);
  await settled(page);
}
// How far the joints are from where they were (m).
const offs = (before, after) =>
  Object.fromEntries(Object.entries(after).map(([name, [x, y]]) => [name, [x - before[name][0], y - before[name][1]]]));
const still = (moved, ...names) => {
  for (const [name, [x, y]] of Object.entries(moved))
    if (!names.includes(name)) expect(Math.hypot(x, y), name).toBeLessThan(1e-9);
};

test("a five-bar goes with each of its inputs, and its joints are dragged where they have put it", async ({ page }) => {
  await shown(page, "scenarios/linkages/five_bar.json");
  await expect(page.locator(".structure")).toContainText("2 degrees of freedom");
  await expect(page.locator(".structure")).toContainText("input left");
  await expect(page.locator(".structure")).toContainText("while the others are held");
  const file = await textOf(page),
    start = await places(page),
    left = page.getByLabel("input left of the linkage"),
    right = page.getByLabel("input right of the linkage");
  const there = Number(await left.inputValue());
  await left.fill(String(there + 6));
  await settled(page);
  const one = await places(page);
  expect(Math.hypot(one["crank.A"][0], one["crank.A"][1])).toBeCloseTo(0.2, 12);
  expect(
    Math.atan2(one["crank.A"][1], one["crank.A"][0]) - Math.atan2(start["crank.A"][1], start["crank.A"][0]),
  ).toBeCloseTo((6 * Math.PI) / 90, 9);
  expect(one["servo.B"]).toEqual(start["servo.B"]);
  // The other input goes on from there.
  await right.fill(String(Number(await right.inputValue()) - 4));
  await settled(page);
  await expect.poll(async () => (await places(page))["servo.B"][0]).not.toBe(start["servo.B"][0]);
  const both = await places(page);
  for (const c of [0, 1]) expect(both["crank.A"][c]).toBeCloseTo(one["crank.A"][c], 12);
  expect(await textOf(page)).toBe(file);
  // A joint that is dragged here is the only one that moves.
  await pulled(page, "crank.A", [14, -9]);
  await expect(page.locator(".faults button.error")).toHaveCount(0);
  await expect.poll(async () => Math.hypot(...offs(both, await places(page))["crank.A"])).toBeGreaterThan(1e-3);
  const moved = offs(both, await places(page));
  still(moved, "crank.A", "rod.origin");
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(file);
});

test("a block is dragged along its guide, and a guide takes its block along", async ({ page }) => {
  await shown(page, "scenarios/linkages/slider_crank_spring.json");
  const start = await places(page);
  await pulled(page, "slide.origin", [25, 18]);
  await expect(page.locator(".faults button.error")).toHaveCount(0);
  await expect.poll(async () => Math.abs(offs(start, await places(page))["slide.origin"][0])).toBeGreaterThan(1e-3);
  const slid = offs(start, await places(page));
  still(slid, "slide.origin", "rod.B");
  expect(slid["rod.B"][1]).toBeCloseTo(0, 9);
  const before = await places(page);
  // The guide stands at the crank's pivot: its joint goes, and the block with it across the guide.
  await pulled(page, "ground.O", [5, -20]);
  await expect.poll(async () => Math.abs(offs(before, await places(page))["ground.O"][1])).toBeGreaterThan(1e-3);
  const across = offs(before, await places(page));
  expect(across["slide.origin"][1]).toBeCloseTo(across["ground.O"][1], 9);
  expect(across["slide.origin"][0]).toBeCloseTo(0, 9);
  still(across, "ground.O", "crank.origin", "slide.origin", "rod.B");
});

test("a block slides along a guide on a moving link", async ({ page }) => {
  await shown(page, "scenarios/kinetostatics/slotted_lever.json");
  await expect(page.locator(".sketch .guide-line")).toHaveCount(1);
  const start = await places(page),
    [x, y] = start["block.origin"],
    [u, v] = start["lever.origin"];
  await pulled(page, "block.origin", [4, -20]);
  await expect(page.locator(".faults button.error")).toHaveCount(0);
  await expect.poll(async () => Math.hypot(...offs(start, await places(page))["block.origin"])).toBeGreaterThan(1e-3);
  const moved = offs(start, await places(page)),
    [dx, dy] = moved["block.origin"];
  still(moved, "block.origin", "crank.A");
  // Along the lever, on which it stands.
  expect((dx * (y - v) - dy * (x - u)) / Math.hypot(x - u, y - v)).toBeCloseTo(0, 9);
});

test("of a frame that floats the inputs tell the place, its parts are dragged", async ({ page }) => {
  await shown(page, "scenarios/linkages/floating_slider_crank.json");
  await expect(page.getByLabel(/^input .* of the linkage$/)).toHaveCount(4);
  const file = await textOf(page),
    start = await places(page),
    tilt = page.getByLabel("input tilt of the linkage");
  await tilt.fill(String(Number(await tilt.inputValue()) + 10));
  await settled(page);
  await expect(page.locator(".drawing output", { hasText: "20 °" })).toHaveCount(1);
  await joint(page, "frame.origin").focus();
  await page.keyboard.press("ArrowRight");
  await expect(page.locator(".drawing .drawing-note")).toContainText("floats");
  expect(await textOf(page)).toBe(file);
  const tilted = await places(page);
  expect(tilted["slide.origin"][1]).toBeCloseTo(start["slide.origin"][0] * Math.sin(Math.PI / 9), 9);
  await pulled(page, "slide.origin", [-20, 0]);
  await expect.poll(async () => Math.hypot(...offs(tilted, await places(page))["slide.origin"])).toBeGreaterThan(1e-3);
  const [dx, dy] = offs(tilted, await places(page))["slide.origin"];
  expect(Math.atan2(-dy, -dx)).toBeCloseTo(Math.PI / 9, 9);
});

test("lengths of a link are typed at it; a formula is held back and shown", async ({ page }) => {
  await shown(page, "scenarios/linkages/slider_crank_spring.json");
  const file = await textOf(page),
    rod = page.locator(".sketch .body[data-link=rod]"),
    length = page.getByLabel("length A–B of rod", { exact: true });
  // By keys: a digit at the link begins its length.
  await rod.focus();
  await page.keyboard.type("1.2 m");
  await expect(length).toHaveValue("1.2 m");
  await page.keyboard.press("Enter");
  await settled(page);
  await expect.poll(() => textOf(page)).not.toBe(file);
  const far = async () => {
    const all = await places(page);
    return Math.hypot(all["rod.B"][0] - all["crank.A"][0], all["rod.B"][1] - all["crank.A"][1]);
  };
  await expect.poll(far).toBeCloseTo(1.2, 9);
  await expect(page.locator(".faults button.error")).toHaveCount(0);
  await expect(length).toHaveValue("1200 mm");
  // What is no length stays in the field with its reason, and the text stays.
  const before = await textOf(page);
  await length.fill("12 kg");
  await length.press("Enter");
  await expect(page.locator(".measure-fields .number-note")).toContainText("no length");
  expect(await textOf(page)).toBe(before);
  await page.keyboard.press("Escape");
  await expect(length).toHaveValue("1200 mm");
  await page.keyboard.press("Escape");
  await expect(rod).toBeFocused();
  await expect(length).toHaveCount(0);
  await page.keyboard.press("Escape");
  await expect(page.locator(".measures")).toHaveCount(0);
  await button(page, "Undo").click();
  await expect.poll(() => textOf(page)).toBe(file);
  await settled(page);
  // By the mouse: a press on the link, and its label.
  const [a, b] = await Promise.all(["crank.A", "rod.B"].map((name) => joint(page, name).locator(".hit").boundingBox()));
  const inner = (k, size) => 0.7 * (a[k] + a[size] / 2) + 0.3 * (b[k] + b[size] / 2);
  await page.mouse.click(inner("x", "width"), inner("y", "height"));
  await page.locator("[data-measure=B]").dblclick();
  await expect(length).toBeFocused();
  await page.keyboard.type("900");
  await page.keyboard.press("Enter");
  await settled(page);
  await expect.poll(far).toBeCloseTo(0.9, 9);
  // A number that is worked out of others is not written over.
  await page.getByRole("tab", { name: "Text" }).click();
  const formula = (await textOf(page)).replace('"objects"', '"parameters": { "half": "350 mm" },\n  "objects"');
  expect(formula).toContain("parameters");
  await page.getByLabel("text of the scene").click();
  await page.keyboard.press("Control+A");
  await page.keyboard.insertText(formula.replace(/("rod":.*?"B": \[)("[^"]*"|[\d.e-]+)/s, '$1"2*half"'));
  await page.getByRole("tab", { name: "Drawing" }).click();
  await settled(page);
  await expect.poll(far).toBeCloseTo(0.7, 9);
  const worked = await textOf(page);
  await page.getByLabel("lengths of", { exact: true }).selectOption("rod");
  const label = page.getByRole("button", { name: "700 mm, length A–B of rod" });
  await label.focus();
  await page.keyboard.press("Enter");
  await length.fill("850 mm");
  await length.press("Enter");
  await expect(page.locator(".drawing-note")).toContainText("it is “2*half”");
  expect(await textOf(page)).toBe(worked);
});

test("a picture lies below the drawing: moved, scaled by two points, kept by this browser and never sent", async ({
  page,
}) => {
  const sent = [];
  page.on("websocket", (socket) => socket.on("framesent", ({ payload }) => sent.push(String(payload))));
  await shown(page, "scenarios/linkages/slider_crank_spring.json");
  const file = await textOf(page),
    picture = page.locator(".sketch image"),
    bytes = await page.evaluate(() => {
      const canvas = document.createElement("canvas");
      canvas.width = 200;
      canvas.height = 100;
      canvas.getContext("2d").fillRect(20, 20, 100, 50);
      return canvas.toDataURL("image/png").split(",")[1];
    });
  const chosen = page.getByLabel("picture from a file");
  await chosen.setInputFiles({ name: "notes.txt", mimeType: "text/plain", buffer: Buffer.from("no picture") });
  await expect(page.locator(".picture-tools")).toContainText("notes.txt is no PNG, JPEG or DXF file.");
  await chosen.setInputFiles({ name: "broken.png", mimeType: "image/png", buffer: Buffer.from("no picture") });
  await expect(page.locator(".picture-tools")).toContainText("broken.png cannot be read");
  await chosen.setInputFiles({ name: "bars.png", mimeType: "image/png", buffer: Buffer.from(bytes, "base64") });
  await expect(picture).toBeVisible();
  const numbers = () =>
    picture.evaluate((one) => ["x", "y", "width", "height"].map((name) => Number(one.getAttribute(name))));
  const [x, y, width, height] = await numbers();
  expect(width / height).toBeCloseTo(2, 6);
  // By the arrow keys, and by the pointer.
  await button(page, "Move picture").click();
  await expect(sketch(page)).toBeFocused();
  await page.keyboard.press("ArrowRight");
  await expect.poll(async () => (await numbers())[0]).toBeGreaterThan(x);
  const box = await sketch(page).boundingBox(),
    at = (u, v) => [box.x + u * box.width, box.y + v * box.height];
  await page.mouse.move(...at(0.5, 0.5));
  await page.mouse.down();
  await page.mouse.move(...at(0.5, 0.6), { steps: 2 });
  await page.mouse.up();
  const moved = await numbers();
  expect(moved[1]).toBeGreaterThan(y);
  expect(moved.slice(2)).toEqual([width, height]);
  // Two places that are 300 mm apart.
  await button(page, "Scale picture").click();
  await page.mouse.click(...at(0.4, 0.5));
  await page.mouse.click(...at(0.6, 0.5));
  const distance = page.getByLabel("their distance");
  await expect(distance).toBeFocused();
  await page.keyboard.type("300 kg");
  await page.keyboard.press("Enter");
  await expect(page.locator(".picture-tools")).toContainText("no length");
  await distance.fill("300 mm");
  await page.keyboard.press("Enter");
  await expect(distance).toHaveCount(0);
  const scaled = await numbers(),
    perMetre = await page.evaluate(() => {
      const [a, b] = ["crank.A", "ground.O"].map((name) => document.querySelector(`.joint[data-joint~="${name}"]`));
      const off = (read) => Math.hypot(...[0, 1].map((k) => read(a, k) - read(b, k)));
      return (
        off((one, k) => Number(one.querySelector(".hit").getAttribute(k ? "cy" : "cx"))) /
        off((one, k) => Number(one.dataset.at.split(" ")[k]))
      );
    });
  const screen = await sketch(page).evaluate((own) => own.getScreenCTM().a);
  expect(scaled[2] / width).toBeCloseTo((0.3 * perMetre) / ((0.2 * box.width) / screen), 2);
  expect(scaled[2] / scaled[3]).toBeCloseTo(2, 6);
  await page.getByLabel("opacity of the picture").fill("0.8");
  await expect(picture).toHaveAttribute("opacity", "0.8");
  // It is there when the page comes again; the scene knows nothing of it, and nobody was sent it.
  expect(await textOf(page)).toBe(file);
  expect(sent.filter((one) => /"push"|image|png/.test(one))).toEqual([]);
  await page.reload();
  await page.getByRole("tab", { name: "Drawing" }).click();
  await expect(picture).toHaveAttribute("opacity", "0.8");
  expect(await numbers()).toEqual(scaled);
  await button(page, "Remove picture").click();
  await expect(picture).toHaveCount(0);
  // From the clipboard.
  await page.evaluate((bytes) => {
    const data = new DataTransfer(),
      raw = Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0));
    data.items.add(new File([raw], "pasted.png", { type: "image/png" }));
    document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true }));
  }, bytes);
  await expect(picture).toBeVisible();
});

test("a DXF plan lies below the drawing in its own size, and bad files have a word", async ({ page }) => {
  const sent = [];
  page.on("websocket", (socket) => socket.on("framesent", ({ payload }) => sent.push(String(payload))));
  await shown(page, "scenarios/linkages/slider_crank_spring.json");
  const text = await textOf(page),
    plan = page.locator(".sketch path.underlay"),
    tools = page.locator(".picture-tools"),
    chosen = page.getByLabel("picture from a file");
  const file = (unit, entities) =>
    ["0 SECTION 2 HEADER", `9 $INSUNITS 70 ${unit}`, "0 ENDSEC 0 SECTION 2 ENTITIES", entities, "0 ENDSEC 0 EOF"]
      .join(" ")
      .split(" ")
      .join("\n");
  const put = (name, content) =>
    chosen.setInputFiles({ name, mimeType: "application/octet-stream", buffer: Buffer.from(content) });
  await put("half.dxf", file(4, "0 LINE 10 0 20 0 11 300 21 0").slice(0, -5));
  await expect(tools).toContainText("half.dxf ends in the middle");
  await put("words.dxf", file(4, "0 TEXT 10 0 20 0 1 word"));
  await expect(tools).toContainText("words.dxf has no lines, arcs or polylines.");
  await put("part.dwg", "AC1032 and more");
  await expect(tools).toContainText("save it as DXF");
  await expect(plan).toHaveCount(0);
  await put(
    "frame.dxf",
    file(4, "0 LINE 10 50 20 50 11 350 21 50 0 CIRCLE 10 350 20 110 40 60 0 TEXT 10 0 20 0 1 word"),
  );
  await expect(tools).toContainText("frame.dxf is 360 mm wide and 120 mm high. Not shown: 1 TEXT.");
  // 360 mm of the plan are as long as 360 mm between joints.
  const perMetre = await page.evaluate(() => {
    const [a, b] = ["crank.A", "ground.O"].map((name) => document.querySelector(`.joint[data-joint~="${name}"]`));
    const off = (read) => Math.hypot(...[0, 1].map((k) => read(a, k) - read(b, k)));
    return (
      off((one, k) => Number(one.querySelector(".hit").getAttribute(k ? "cy" : "cx"))) /
      off((one, k) => Number(one.dataset.at.split(" ")[k]))
    );
  });
  const size = () =>
    plan.evaluate((own) => {
      const { a } = own.transform.baseVal.consolidate().matrix,
        { width, height } = own.getBBox();
      return [a * width, a * height];
    });
  const [width, height] = await size();
  expect(width / perMetre).toBeCloseTo(0.36, 3);
  expect(height / perMetre).toBeCloseTo(0.12, 3);
  // Its lines are seen in light and in dark.
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    await page.screenshot({ path: test.info().outputPath(`plan-${colorScheme}.png`) });
    const [line, ground] = await plan.evaluate((own) => [
      getComputedStyle(own).stroke,
      getComputedStyle(document.body).backgroundColor,
    ]);
    expect(line).not.toBe(ground);
  }
  // Without a unit it is scaled by two places.
  await put("bare.dxf", file(0, "0 LINE 10 0 20 0 11 10 21 0 0 LINE 10 10 20 0 11 10 21 5"));
  await expect(tools).toContainText("bare.dxf names no unit");
  await button(page, "Scale picture").click();
  const box = await plan.boundingBox();
  await page.mouse.click(box.x + 1, box.y + box.height - 1);
  await page.mouse.click(box.x + box.width - 1, box.y + box.height - 1);
  await page.getByLabel("their distance").fill("200 mm");
  await page.keyboard.press("Enter");
  await expect.poll(async () => (await size())[0] / perMetre).toBeCloseTo(0.2, 2);
  const scaled = await size();
  // It is there when the page comes again; the scene knows nothing of it, and nobody was sent it.
  expect(await textOf(page)).toBe(text);
  expect(sent.filter((one) => /"push"|LINE|M0/.test(one))).toEqual([]);
  await page.reload();
  await page.getByRole("tab", { name: "Drawing" }).click();
  await expect.poll(size).toEqual(scaled);
  await button(page, "Remove picture").click();
  await expect(plan).toHaveCount(0);
});
