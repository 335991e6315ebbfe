import { readFileSync } from "node:fs";
import { defineConfig } from "vite";
import own from "./vite.config.mjs";

const { version } = JSON.parse(readFileSync(new URL("package.json", import.meta.url), "utf8"));

// The interface of the single file: the program in the tab answers it, and not a server.
export default defineConfig({
  ...own,
  define: { PROGRAM: JSON.stringify(version) },
  resolve: {
    alias: [
      ...own.resolve.alias,
      { find: /^\.\.?\/connection$/, replacement: new URL("src/offline/connection.tsx", import.meta.url).pathname },
    ],
  },
  build: { ...own.build, outDir: "node_modules/.offline", emptyOutDir: true, copyPublicDir: false },
  worker: { format: "iife" },
});
