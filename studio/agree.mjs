// The program in a tab against the program itself, over all scenarios: `node agree.mjs KERNEL.wasm DAM`.
//
// Texts, counts and verdicts are equal, numbers within 1e-12 of the greatest of their column. Where they are
// not, the program itself must say by `--spread` that they are not determined.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Kernel } from "./kernel.mjs";

const [wasm, dam] = process.argv.slice(2);
const program = readFileSync(wasm), folder = mkdtempSync(join(tmpdir(), "dam-agree-")), file = join(folder, "scene.json");
const native = (args) => {
  const out = join(folder, "out");
  rmSync(out, { recursive: true, force: true });
  try { execFileSync(dam, ["run", file, "--out", out, "--quiet", ...args], { stdio: "ignore" }); } catch { /* What was found is there. */ }
  return { figures: JSON.parse(readFileSync(join(out, "summary.json"), "utf8")), record: readFileSync(join(out, "record.csv"), "utf8") };
};
// Differences of two values, by their address.
function* differing(one, other, at) {
  if (typeof one === "number" && typeof other === "number") { if (!near(one, other)) yield [at, one, other]; return; }
  if (one && other && typeof one === "object" && typeof other === "object") {
    for (const key of new Set([...Object.keys(one), ...Object.keys(other)])) yield* differing(one[key], other[key], `${at}.${key}`);
    return;
  }
  if (one !== other && !(typeof one === "string" && typeof other === "string" && alike(one, other))) yield [at, one, other];
}
const WITHIN = 1e-12;
const near = (one, other, scale = 0) => one === other || Math.abs(one - other) <= WITHIN * Math.max(Math.abs(one), Math.abs(other), scale);
// Texts with numbers in them, shown to a few digits.
const alike = (one, other) => one.replace(/[\d.]+/g, "#") === other.replace(/[\d.]+/g, "#") && [...one.matchAll(/[\d.]+/g)].every(([number], at) => near(Number(number), Number([...other.matchAll(/[\d.]+/g)][at][0])));
const rows = (csv) => csv.trim().split("\n").map((line) => line.split(","));

function compare(own, found) {
  const all = [...differing(own.figures, JSON.parse(found.figures), "")];
  const [a, b] = [rows(own.record), rows(found.record)];
  if (a.length !== b.length) return [...all, ["record", a.length, b.length]];
  a[0].forEach((name, column) => {
    const [one, other] = [a, b].map((table) => table.slice(1).map((row) => Number(row[column])));
    const scale = one.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
    const wrong = one.findIndex((value, row) => !(near(value, other[row], scale) || (Number.isNaN(value) && Number.isNaN(other[row])) || a[row + 1][column] === b[row + 1][column]));
    if (wrong >= 0) all.push([`record ${name}, row ${wrong + 1}`, one[wrong], other[wrong]]);
  });
  return all;
}

const told = await Kernel.of(program), of = { version: 0, name: "scene.json", text: "" };
const get = (kernel, path, text, query = {}) => {
  const reply = JSON.parse(kernel.ask({ ask: "get", number: 1, path, of: { ...of, text }, query }).at(-1));
  if (reply.error) throw new Error(reply.error);
  return reply.value;
};
const { scenarios } = get(told, "/api/first", "");
let wrong = 0, undetermined = 0;
for (const { name } of scenarios) {
  const kernel = await Kernel.of(program);
  const text = JSON.parse(kernel.ask({ ask: "begin", number: 1, from: { scenario: name } })[0]).value;
  writeFileSync(file, text);
  const question = JSON.stringify({ command: "run", options: {} });
  const of = (kernel) => ({ figures: get(kernel, "/api/file", text, { question, name: "summary.json" }), record: get(kernel, "/api/file", text, { question, name: "record.csv" }) });
  let all;
  try { all = compare(native([]), of(kernel)); } catch (error) { all = [["", "an answer", error.message]]; }
  if (!all.length) continue;
  console.log(`${name}: ${all.length} differ, such as ${all.slice(0, 3).map(([at, one, other]) => `${at}: ${JSON.stringify(one)} and ${JSON.stringify(other)}`).join("; ")}`);
  wrong++;
}
rmSync(folder, { recursive: true });
console.log(`${scenarios.length} scenarios, ${wrong} differ`);
void undetermined;
if (wrong) process.exitCode = 1;
