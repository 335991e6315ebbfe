import { defineConfig } from "vite";

// One script and one style by plain names: the program has them in it.
export default defineConfig({
  // As modules, of which what nobody uses is left out.
  resolve: { alias: [{ find: "vecks", replacement: "vecks/src/index.js" }] },
  esbuild: { jsx: "automatic", jsxImportSource: "preact", legalComments: "none" },
  build: {
    target: "es2022",
    cssCodeSplit: false,
    modulePreload: false,
    reportCompressedSize: false,
    rollupOptions: {
      input: "src/main.tsx",
      output: { format: "iife", entryFileNames: "studio.js", assetFileNames: "studio.[ext]" },
    },
  },
});
