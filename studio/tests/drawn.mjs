// A studio for each test of a file that draws, and the mouse in the drawing.

import { expect, test } from "@playwright/test";
import { watched } from "./page.mjs";
import { Server } from "./server.mjs";

// That of the test at present.
export let server;

// Nothing may be thrown, and nothing may stay, in every test of the file.
export function eachWatched() {
  let wrong;
  test.beforeEach(({ page }) => {
    wrong = watched(page);
  });
  test.afterEach(async () => {
    await server.end();
    expect(wrong).toEqual([]);
  });
}

// A page on a folder with these scenes, or with what is put there; or the single file at its address,
// which needs no server: the program is asked for its own answers alone.
export async function begun(page, scenes = {}, prepare = () => {}, file = "") {
  server = new Server(scenes);
  prepare(server);
  if (!file) await server.start();
  await page.goto(file || server.address);
}

export const button = (page, name) => page.getByRole("button", { name, exact: true });
export const sketch = (page) => page.locator("svg.sketch");
// What was done has come to the drawing.
export const settled = (page) => expect(sketch(page)).toHaveAttribute("aria-busy", "false");

// A place of the drawing (mm) on the screen: half a metre is seen at first, from -125 mm on.
async function at(page, [x, y]) {
  const box = await sketch(page).boundingBox(),
    scale = Math.min(box.width / 500, box.height / 330);
  return [box.x + box.width / 2 + (x + 125 - 250) * scale, box.y + box.height / 2 + (165 - y - 125) * scale];
}
export async function click(page, place) {
  await page.mouse.click(...(await at(page, place)));
  await settled(page);
}
export async function drag(page, from, to) {
  await page.mouse.move(...(await at(page, from)));
  await page.mouse.down();
  await page.mouse.move(...(await at(page, to)), { steps: 4 });
  await page.mouse.up();
  await settled(page);
}
