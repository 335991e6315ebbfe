// What the tests do with a page of the studio.

import { expect } from "@playwright/test";
import { join } from "node:path";
import { root } from "./server.mjs";

export async function opened(page, address, view = "Text") {
  await page.goto(address);
  await page.waitForSelector(".verdict");
  await page.getByRole("tab", { name: view }).click();
}
// Nothing may be thrown, and nothing may break the content security policy.
export function watched(page) {
  const wrong = [];
  // With DIST=1 the interface is the one that `npm run build` made, and not that of the program.
  if (process.env.DIST)
    for (const name of ["studio.js", "studio.css"])
      void page.route(`**/${name}`, (route) => route.fulfill({ path: join(root, "studio/dist", name) }));
  page.on("pageerror", (error) => wrong.push(error.message));
  page.on("console", (message) => {
    // What the browser says of a server that went away, also while it owed an answer.
    const isGone = /WebSocket|ERR_CONNECTION|ERR_EMPTY_RESPONSE/.test(message.text());
    if (message.type() === "error" && !isGone) wrong.push(message.text());
  });
  return wrong;
}
export const slider = (page, address) => page.getByLabel(`${address}, slider`, { exact: true });
// The text as the editor holds it, all of its lines, once what is dragged has come there.
export const textOf = async (page) => {
  await page.waitForFunction(() => !document.querySelector("[aria-busy=true]"));
  return held(page);
};
const held = (page) =>
  page.evaluate(
    () =>
      document.querySelector(".cm-content").cmTile?.view?.state.doc.toString() ??
      document.querySelector(".cm-content").cmView.view.state.doc.toString(),
  );
export const deltaOf = (page, id = "rocker") =>
  page
    .locator(".figures tbody tr", { has: page.locator(`a[href="#object-${id}"]`) })
    .first()
    .locator("td span[title]")
    .first()
    .getAttribute("title")
    .then((text) => text.split(" ")[0]);
export const field = (page, address) => page.locator(`[id="field ${address}"]`);
export const box = (page, id) => page.locator(`.object-box[data-id="${id}"]`);

// The answer on the screen is that of the program to the same text, to the last digit.
export async function agrees(page, server, id = "rocker") {
  await expect(async () => {
    const figures = server.run(await textOf(page)).objects[id];
    expect(Number(await deltaOf(page, id))).toBe(figures.delta_abs);
  }).toPass({ timeout: 30_000 });
}
// Numbers from a seed.
export function random(seed) {
  let state = seed;
  return (most) => {
    state = (state * 1103515245 + 12345) % 2147483648;
    return Math.floor((state / 2147483648) * most);
  };
}
// Everything is undone. (The button may be behind what was just undone: a click on one that is
// disabled does nothing here, where that of the mouse would wait for ever.)
export async function undone(page) {
  const undo = page.getByRole("button", { name: "Undo", exact: true });
  for (;;) {
    await undo.evaluate((one) => one.click());
    await page.waitForTimeout(20);
    if (await undo.isEnabled()) continue;
    await textOf(page);
    await page.waitForTimeout(200);
    if (await undo.isDisabled()) return;
  }
}
