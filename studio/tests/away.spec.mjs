// The server is away and comes back; texts that are too large.

import { expect, test } from "@playwright/test";
import { agrees, opened, textOf, watched } from "./page.mjs";
import { Server } from "./server.mjs";

let server, wrong;
test.beforeEach(async ({ page }) => {
  server = new Server();
  await server.start();
  wrong = watched(page);
});
test.afterEach(async () => {
  await server.end();
  expect(wrong).toEqual([]);
});
const set = async (page, label, value) => {
  await page.getByLabel(label, { exact: true }).fill(value);
  await page.getByLabel(label, { exact: true }).press("Enter");
};
const portOf = () => Number(new URL(server.address).port);

test("a window comes back to a server that was started again on its port, with all of its edits", async ({ page }) => {
  await opened(page, server.address);
  await set(page, "inertia", "0.17");
  await expect.poll(() => textOf(page)).toContain('"inertia": 0.17');
  const port = portOf();
  await server.kill();
  await expect(page.locator(".lost")).toContainText("The server is gone");
  await set(page, "damping capacity", "0.31");
  await expect(page.locator(".top")).toContainText("not saved");
  // What cannot be done is said.
  await page.keyboard.press("Control+s");
  await expect(page.locator(".notices")).toContainText("does not answer");
  const text = await textOf(page);
  expect(text).toContain('"inertia": 0.17');
  expect(text).toContain('"damping_capacity": 0.31');
  await server.start({ port });
  await expect(page.locator(".lost")).toHaveCount(0);
  await expect(page.locator(".notices")).toHaveCount(0);
  await expect.poll(() => textOf(page)).toBe(text);
  await agrees(page, server);
  await expect(page.locator(".top")).toContainText("not saved");
  await page.keyboard.press("Control+s");
  await expect.poll(() => server.text()).toBe(text);
  await expect(page.locator(".top")).not.toContainText("not saved");
  // A second time, and loaded anew.
  await server.kill();
  await server.start({ port });
  await expect(page.locator(".lost")).toHaveCount(0);
  await page.reload();
  await page.waitForSelector(".verdict");
  await page.getByRole("tab", { name: "Text" }).click();
  expect(await textOf(page)).toBe(text);
});

test("a file that was changed while the server was away is told of, and nothing is lost", async ({ page }) => {
  await opened(page, server.address);
  const port = portOf();
  await server.kill();
  await expect(page.locator(".lost")).toBeVisible();
  await set(page, "inertia", "0.19");
  const theirs = server.text().replace('"masses": 2', '"masses": 1');
  server.write(theirs);
  await server.start({ port });
  await expect(page.locator(".notices")).toContainText("changed while the server was away");
  expect(await textOf(page)).toContain('"inertia": 0.19');
  expect(server.text()).toBe(theirs);
  await page.getByRole("button", { name: "Undo", exact: true }).click();
  await expect.poll(() => textOf(page)).toBe(theirs);
});

test("edits of two windows, one of them cut off, become one text", async ({ page, context }) => {
  // The connection of this window is cut, not the server.
  await page.addInitScript(() => {
    const Own = WebSocket;
    window.sockets = [];
    window.WebSocket = class extends Own {
      constructor(...all) {
        if (window.cut) all[0] = String(all[0]).replace("/ws", "/none");
        super(...all);
        window.sockets.push(this);
      }
    };
  });
  await opened(page, server.address);
  const other = await context.newPage();
  await opened(other, server.address);
  await page.evaluate(() => {
    window.cut = true;
    for (const one of window.sockets) one.close();
  });
  await expect(page.locator(".lost")).toBeVisible();
  await set(page, "inertia", "0.21");
  await set(other, "damping capacity", "0.33");
  await set(other, "speed", "12 rev/s");
  await page.evaluate(() => {
    window.cut = false;
  });
  await expect(page.locator(".lost")).toHaveCount(0);
  await expect(async () => {
    const texts = [await textOf(page), await textOf(other)];
    expect(texts[0]).toBe(texts[1]);
    for (const part of ['"inertia": 0.21', '"damping_capacity": 0.33', '"12 rev/s"']) expect(texts[0]).toContain(part);
  }).toPass();
  wrong.length = 0;
});

test("a text of nearly 1 MB is taken, a larger one refused with words", async ({ page }) => {
  test.setTimeout(120_000);
  await opened(page, server.address);
  const before = await textOf(page);
  const paste = async (size) => {
    await page.locator(".cm-line").first().click();
    await page.keyboard.press("Control+Home");
    // Escapes make the message larger than the text.
    const line = `${'"\t\\ü"'.repeat(40)}\n`;
    await page.evaluate(
      (text) => {
        const data = new DataTransfer();
        data.setData("text/plain", text);
        document.activeElement.dispatchEvent(
          new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }),
        );
      },
      line.repeat(Math.round(size / (line.length + 40))),
    );
  };
  await paste(1_100_000);
  await expect(page.locator(".notices")).toContainText("at most 1 MB");
  expect(await textOf(page)).toBe(before);
  await expect(page.locator(".top")).not.toContainText("not saved");
  await paste(1_000_000);
  await expect(page.locator(".notices")).toHaveCount(0);
  await expect(page.locator(".top")).toContainText("not saved");
  await expect(page.locator(".lost")).toHaveCount(0);
  const text = await textOf(page);
  expect(text.length).toBeGreaterThan(700_000);
  await expect(page.getByRole("button", { name: "Save", exact: true })).toBeEnabled();
  await page.keyboard.press("Control+s");
  await expect.poll(() => server.text().length).toBe(text.length);
  expect(server.text()).toBe(text);
  await page.getByRole("button", { name: "Undo", exact: true }).click();
  await expect.poll(() => textOf(page)).toBe(before);
});
