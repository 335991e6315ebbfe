import { defineConfig } from "vitest/config";

// What needs no page: texts, numbers, trees. Laws are tried on texts made at random.
export default defineConfig({
  test: { include: ["unit/**/*.test.ts"], setupFiles: ["unit/setup.ts"], environment: "node", testTimeout: 60_000 },
});
