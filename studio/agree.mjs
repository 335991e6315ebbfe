// The program in a tab against the program itself, over all scenarios: `node agree.mjs KERNEL.wasm DAM`.
//
// Texts, verdicts and counts of events are equal, numbers within 1e-12 of the greatest of their sort in the object.
// Two machines round differently: sines are those of another library, and WebAssembly multiplies and adds
// with two roundings. So methods that choose their steps may take others; their numbers are within a hundred
// times the tolerance of the run, which bounds the error of a step, and not of all. Remainders of checks, and
// what is zero, are rounding on both sides; of checks the verdicts are compared.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Kernel } from "./kernel.mjs";

const [wasm, dam] = process.argv.slice(2);
const program = readFileSync(wasm),
  folder = mkdtempSync(join(tmpdir(), "dam-agree-")),
  file = join(folder, "scene.json");
const native = (args) => {
  const out = join(folder, "out");
  rmSync(out, { recursive: true, force: true });
  try {
    execFileSync(dam, ["run", file, "--out", out, "--quiet", ...args], { stdio: "ignore" });
  } catch {
    /* What was found is there. */
  }
  return {
    figures: JSON.parse(readFileSync(join(out, "summary.json"), "utf8")),
    record: readFileSync(join(out, "record.csv"), "utf8"),
  };
};
const WITHIN = 1e-12;
// What is rounding, and how it was computed.
const LEFT_OUT =
  /^\.run\.(energy_error|equations|why|steps|evaluations|rejected|factorisations|jacobians|passes)|^\.checks\.\d+\.(value|bound|note|text)|^\.expect\.\d+\.message/;
// The sort of a figure: the last word of its name.
const sort = (name) =>
  ({ abs: "delta", min: "delta", max: "delta", sigma: "delta" })[name.split("_").at(-1)] ?? name.split("_").at(-1);
const walk = function* (value, at = "") {
  if (value && typeof value === "object")
    for (const [key, inner] of Object.entries(value)) yield* walk(inner, `${at}.${key}`);
  else yield [at, value];
};
const object = (at) => at.split(".").slice(0, 3).join(".");
// The greatest number of every sort of every object.
function scales(document) {
  const found = {};
  for (const [at, value] of walk(document))
    if (typeof value === "number") {
      const key = `${object(at)} ${sort(at.split(".").at(-1))}`;
      found[key] = Math.max(found[key] ?? 0, Math.abs(value));
    }
  return (at) => found[`${object(at)} ${sort(at.split(".").at(-1))}`] ?? 0;
}
const rows = (csv) =>
  csv
    .trim()
    .split("\n")
    .map((line) => line.split(","));
// How far numbers are apart, as shares of their scales, and what else differs.
function compare(own, found) {
  const other = Object.fromEntries(walk(JSON.parse(found.figures))),
    scale = scales(own.figures),
    wrong = [];
  let most = 0,
    worst = "";
  const meet = (at, one, two, scale) => {
    const share = Math.abs(one - two) / (scale || 1);
    if (share > most) {
      most = share;
      worst = `${at}: ${one} and ${two}`;
    }
  };
  for (const [at, value] of walk(own.figures)) {
    if (LEFT_OUT.test(at)) continue;
    if (typeof value !== "number" || Number.isInteger(value)) {
      if (value !== other[at] && !(typeof value === "number" && Math.abs(value - other[at]) <= WITHIN * scale(at)))
        wrong.push(`${at}: ${JSON.stringify(value)} and ${JSON.stringify(other[at])}`);
    } else meet(at, value, other[at], scale(at));
  }
  const [a, b] = [rows(own.record), rows(found.record)];
  if (a.length !== b.length) wrong.push(`record: ${a.length} and ${b.length} rows`);
  const greatest = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
  const all = greatest(a.slice(1).flat().map(Number));
  if (a.length === b.length)
    a[0].forEach((name, column) => {
      const [one, two] = [a, b].map((table) => table.slice(1).map((row) => Number(row[column])));
      const scale = greatest(one);
      if (Math.max(scale, greatest(two)) < WITHIN * all) return;
      one.forEach((value, row) => {
        if (Number.isFinite(value)) meet(`record ${name}, row ${row + 1}`, value, two[row], scale);
      });
    });
  return { most, worst, wrong };
}

const told = await Kernel.of(program),
  of = { version: 0, name: "scene.json", text: "" };
const get = (kernel, path, text, query = {}) => {
  const reply = JSON.parse(kernel.ask({ ask: "get", number: 1, path, of: { ...of, text }, query }).at(-1));
  if (reply.error) throw new Error(reply.error);
  return reply.value;
};
const { scenarios } = get(told, "/api/first", "");
const counts = { equal: 0, close: 0, wrong: 0 };
for (const { name } of scenarios) {
  const kernel = await Kernel.of(program);
  const text = JSON.parse(kernel.ask({ ask: "begin", number: 1, from: { scenario: name } })[0]).value;
  writeFileSync(file, text);
  const question = JSON.stringify({ command: "run", options: {} });
  const asked = (part) => get(kernel, "/api/file", text, { question, name: part });
  const own = native([]),
    { most, worst, wrong } = compare(own, { figures: asked("summary.json"), record: asked("record.csv") });
  const tolerance = own.figures.run.tolerance ?? 1e-6;
  const verdict = wrong.length || most > 100 * tolerance ? "wrong" : most > WITHIN ? "close" : "equal";
  counts[verdict]++;
  if (verdict !== "equal")
    console.log(
      `${name}: ${verdict}, ${most.toExponential(1)} of the scale apart (tolerance ${tolerance}), ${worst}${wrong.length ? `; ${wrong.slice(0, 3).join("; ")}` : ""}`,
    );
}
rmSync(folder, { recursive: true });
console.log(
  `${scenarios.length} scenarios: ${counts.equal} within ${WITHIN}, ${counts.close} within 100 tolerances of the run, ${counts.wrong} not`,
);
if (counts.wrong) process.exitCode = 1;
