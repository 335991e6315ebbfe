import { defineConfig } from "vite";

// One script and one style by plain names: the program has them in it.
export default defineConfig({
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
