import { defineConfig } from "@playwright/test";
import { browser } from "./tests/server.mjs";

// The program is a built one, DAM=…; the browser Chromium, CHROMIUM=… or Debian's.
export default defineConfig({
  testDir: "tests",
  outputDir: "test-results",
  timeout: 60_000,
  // What hangs is told, and does not hold up all that comes behind it.
  globalTimeout: 22 * 60_000,
  expect: { timeout: 15_000 },
  // Each test has a program, a folder and a browser window of its own.
  workers: 2,
  // A loaded machine may hold a page up for seconds. What passes at a second try is listed as flaky.
  retries: 2,
  reporter: "list",
  use: { actionTimeout: 20_000, viewport: { width: 1280, height: 900 }, launchOptions: browser },
});
