// Builds the studio as one file that opens from disk: `node offline.mjs KERNEL.wasm OUT.html`.
//
// The file holds the interface, the styles and scripts of the pages, and the program as WebAssembly.

import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { createHash } from "node:crypto";
import { Kernel } from "./kernel.mjs";

const [wasm, out] = process.argv.slice(2);
if (!out) throw new Error("usage: node offline.mjs KERNEL.wasm OUT.html");
const program = readFileSync(wasm),
  kernel = await Kernel.of(program);
const { value: look } = JSON.parse(kernel.ask({ ask: "look", number: 0 })[0]);
const built = (name) => readFileSync(new URL(`node_modules/.offline/${name}`, import.meta.url), "utf8");
// A third smaller than by gzip. (The reader knows this sum alone.)
const packed = execFileSync("xz", ["-6", "--check=crc32", "--stdout", wasm], { maxBuffer: 64e6 });
// What stands in a script must not end it.
const script = (text) => text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const scripts = [look["plot.js"], look["player.js"], built("studio.js")].map(script);
const sum = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
// Nothing is fetched, and nothing runs but what is in the file.
const policy = [
  "default-src 'none'",
  `script-src ${scripts.map(sum).join(" ")} blob: data: 'wasm-unsafe-eval'`,
  "style-src 'unsafe-inline'",
  "img-src data: blob:",
  "worker-src blob: data:",
  "connect-src 'none'",
  "form-action 'none'",
  "base-uri 'none'",
].join("; ");
const page = `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>dam studio</title>
<link rel="icon" href="data:,">
<style>${look["look.css"]}</style>
<style>${built("studio.css")}</style>
</head>
<body>
<div id="studio"></div>
<noscript>The studio needs JavaScript.</noscript>
<script id="kernel" type="text/plain">${packed.toString("base64")}</script>
${scripts.map((text) => `<script>${text}</script>`).join("\n")}
</body>
</html>
`;
writeFileSync(out, page);
const size = gzipSync(page, { level: 9 }).length;
console.log(`${out}: ${(size / 1e6).toFixed(2)} MB compressed`);
if (size > 4e6) process.exitCode = 1;
