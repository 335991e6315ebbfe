// An object that is put down runs at once: it begins with values of its kind (`starters.rs`) and
// hangs on what is chosen, else on the last object, else on a drive that comes with it.

import { freeName, type Outline } from "./graph";
import type { Part, Parts } from "./kinds";
import { find, laid, type Steps } from "./tree";

type Motion = "rotation" | "swing" | "travel";
// Null: it cannot be driven by what moves so.
export type Begins = Record<Exclude<Motion, "rotation">, Record<string, unknown> | null> & {
  rotation: Record<string, unknown>;
  gives: Motion;
};

// What an object is hung on: the first of its further outputs, else itself; with the motion there.
function hookOf(object: Outline, parts: Parts): Hook {
  const [own, further] = object.outputs,
    chosen = further ?? own;
  if (!chosen) return { output: object.id, motion: "rotation" };
  const gives = parts.kinds.find((one) => one.kind === object.kind)?.begins.gives ?? "rotation";
  const turns = further ? "swing" : gives === "travel" ? "rotation" : gives;
  return { output: chosen.address, motion: chosen.coordinate === "sliding" ? "travel" : turns };
}

function isHung(object: Record<string, unknown>): boolean {
  const inputs = Object.values((object.inputs ?? {}) as Record<string, { object?: string }>);
  return object.input === "" || inputs.some((input) => input.object === "");
}

// Properties in the order in which scenes have them; the program tells them by the alphabet.
const ORDER = ["from", "kind", "input", "inputs", "driver", "motion", "position", "lever_arm"].concat([
  "ground",
  "links",
  "pairs",
  "assembly",
  "inertia",
  "stiffness",
  "masses",
  "damping_capacity",
  "pair",
  "loads",
]);
function ordered(object: Record<string, unknown>): Record<string, unknown> {
  const placeOf = (name: string) => (ORDER.indexOf(name) + ORDER.length + 1) % (ORDER.length + 1);
  return Object.fromEntries(Object.entries(object).sort(([a], [b]) => placeOf(a) - placeOf(b)));
}

function hung(object: Record<string, unknown>, output: string): Record<string, unknown> {
  const own = ordered(structuredClone(object));
  if (own.input === "") own.input = output;
  for (const input of Object.values((own.inputs ?? {}) as Record<string, { object?: string }>))
    if (input.object === "") input.object = output;
  return own;
}

function nameOf(part: Part, taken: string[]): string {
  const stem = part.from
    ? part.from
        .split("/")[1]!
        .split("-")
        .slice(0, 2)
        .join("_")
        .replace(/[^A-Za-z0-9_]/g, "_")
    : part.kind;
  return freeName(/^[A-Za-z_]/.test(stem) ? stem : part.kind, taken);
}

// Where an object hangs, and what moves there.
export interface Hook {
  output: string;
  motion: Motion;
}
const NO_DRIVER: Hook = { output: "", motion: "rotation" };

const partOf = (kind: string, parts: Parts): Part => parts.kinds.find((one) => one.kind === kind)!;
const idsOf = ({ root }: Steps): string[] => find(root, ["objects"])?.members.map((one) => one.name) ?? [];

function set(steps: Steps, part: Part, { output, motion }: Hook): string {
  const id = nameOf(part, idsOf(steps));
  steps.set(["objects", id], laid(hung(part.begins[motion] ?? part.begins.rotation, output), steps.edits.text, 2));
  return id;
}

// A drive: its name.
export const driveOf = (steps: Steps, parts: Parts): string => set(steps, partOf("drive", parts), NO_DRIVER);

// Puts an object of a kind down where it hangs: its name.
export const addBehind = (steps: Steps, kind: string, parts: Parts, hook: Hook): string =>
  set(steps, partOf(kind, parts), hook);

// Puts a part down behind an object, or behind a drive that comes with it: its name.
export function put(steps: Steps, part: Part, parts: Parts, driver: Outline | null): string {
  const hook = driver && hookOf(driver, parts);
  if (hook && part.begins[hook.motion]) return set(steps, part, hook);
  const output = isHung(part.begins.rotation) ? driveOf(steps, parts) : "";
  return set(steps, part, { output, motion: "rotation" });
}
