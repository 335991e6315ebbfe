// The built interface is at most 300 kB compressed.

import { readdirSync, readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const sizes = readdirSync("dist").map((name) => gzipSync(readFileSync(`dist/${name}`), { level: 9 }).length);
const all = sizes.reduce((sum, one) => sum + one, 0);
console.log(`${(all / 1000).toFixed(0)} kB compressed`);
if (all > 300_000) process.exitCode = 1;
