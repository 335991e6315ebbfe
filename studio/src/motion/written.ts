// What acts on a motion made of segments write into its text: where the text has it, in its units.
//
// A cam that is not rise, dwell, return and rest any more becomes a plan.

import { find, member, unitOf as indentOf, type Step, type Steps, type Value } from "../tree";
import { isDwell, open, round, unitOf, type Motion, type Station } from "./motion";

// The text of a motion, and what it is.
export interface Place {
  motion: Motion;
  path: Step[];
}
// A station, with the motion that begins there as JSON; empty: none does.
export type Own = Station;

export const DWELL = '"dwell"';

export function written(steps: Steps, place: Place, all: Own[]): string | null {
  const own = find(steps.root, place.path);
  if (own?.sort !== "object") return copied(steps, place, all);
  if (place.motion.form === "plan") return planned(steps, place, all);
  const wrong = asCam(steps, place, all);
  return wrong === undefined ? replaced(steps, place, all) : wrong;
}

// A number where the text has one, in its unit; an expression stays.
function number(steps: Steps, path: Step[], value: number, si: string): string | null {
  const before = find(steps.root, path),
    { name, factor } = unitOf(si);
  if (before?.sort === "string") {
    const [, size, unit = ""] =
      /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-zµ]*)\s*$/.exec(before.text) ?? [];
    const known = SIZES[si]?.[unit];
    if (size === undefined || known === undefined)
      return `${String(path.at(-1))} is “${before.text}”: change it in its field.`;
    if (round(Number(size) * known) !== round(value))
      steps.set(path, JSON.stringify(`${round(value / known)} ${unit}`));
    return null;
  }
  if (before?.sort === "number" && round(Number(before.text)) === round(value)) return null;
  if (before?.sort === "number" && Number(before.text) !== 0) steps.set(path, String(round(value)));
  else steps.set(path, sized(value, name, factor));
  return null;
}
const sized = (value: number, name: string, factor: number): string =>
  Math.abs(value) < 1e-12 ? "0" : JSON.stringify(`${round(value / factor)} ${name}`);
const quantity = (value: number, si: string): string => {
  const { name, factor } = unitOf(si);
  return sized(value, name, factor);
};
const SIZES: Record<string, Record<string, number>> = {
  rad: { rad: 1, deg: Math.PI / 180, mrad: 1e-3, rev: 2 * Math.PI },
  m: { m: 1, mm: 1e-3, cm: 1e-2, µm: 1e-6, in: 0.0254, ft: 0.3048 },
  s: { s: 1, ms: 1e-3, µs: 1e-6, min: 60, h: 3600 },
};

// What is refused first; null: nothing is.
const first = (all: (string | null)[]): string | null => all.find((one) => one !== null) ?? null;

// Stations of a plan: those that are new or gone, then all numbers that are others.
function planned(steps: Steps, { motion, path }: Place, all: Own[]): string | null {
  const list = [...path, "stations"],
    before = open(motion),
    closing = motion.stations.length > before.length;
  if (all.length > before.length)
    inserted(
      steps,
      list,
      all.findIndex((one, k) => one.at !== before[k]?.at),
      all,
      motion,
    );
  if (all.length < before.length) steps.remove([...list, before.findIndex((one, k) => one.at !== all[k]?.at)]);
  const wrong = all.map((one, k) => station(steps, [...list, k], one, motion));
  const end = { at: all[0]!.at + (motion.period ?? 0), displacement: all[0]!.displacement + motion.advance };
  return first([...wrong, closing ? station(steps, [...list, all.length], end, motion) : null]);
}

function station(
  steps: Steps,
  path: Step[],
  { at, displacement, law }: { at: number; displacement: number; law?: string },
  { axis, units }: Motion,
): string | null {
  const wrong = first([
    number(steps, [...path, "at"], at, axis),
    number(steps, [...path, "displacement"], displacement, units[0]),
  ]);
  const now = find(steps.root, [...path, "motion"]),
    raw = now ? steps.edits.text.slice(now.from, now.to) : DWELL;
  if (law && law !== raw) steps.set([...path, "motion"], law);
  return wrong;
}

const stationJson = ({ at, displacement, law }: Own, { axis, units }: Motion): string =>
  `{ "at": ${quantity(at, axis)}, "displacement": ${quantity(displacement, units[0])}, "motion": ${law || DWELL} }`;

// A station behind the one before it, apart from it as its neighbours are.
function inserted(steps: Steps, list: Step[], index: number, all: Own[], motion: Motion): void {
  steps.do(({ root, text }) => {
    const items = find(root, list)?.items ?? [],
      before = items[index - 1]!,
      [a, b] = items;
    const apart = a && b ? /\s*$/.exec(text.slice(a.to, b.from))![0] : " ";
    return [{ from: before.to, to: before.to, insert: `,${apart}${stationJson(all[index]!, motion)}` }];
  });
}

// The properties of a cam, where rise, dwell, return and rest are still what it is made of; undefined: it is none.
function asCam(steps: Steps, { motion: { units }, path }: Place, all: Own[]): string | null | undefined {
  const at = (part: string): Own | undefined => all.find((one) => one.part === part),
    [rise, back] = [at("rise"), at("return")];
  const [dwell, rest] = [at("dwell"), at("rest")];
  if (!rise || !back || all.some((one) => one.part === "") || all[0] !== rise) return undefined;
  if (
    [dwell, rest].some((one) => one && !isDwell(one)) ||
    [rise, back].some((one) => ['"dwell"', '"uniform"', '"smooth"'].includes(one.law))
  )
    return undefined;
  const turn = 2 * Math.PI,
    lift = back.displacement;
  if (rise.displacement !== 0 || (rest?.displacement ?? 0) !== 0 || (dwell?.displacement ?? lift) !== lift)
    return undefined;
  const end = rest?.at ?? rise.at + turn;
  const angles: [string, number][] = [
    ["rise", (dwell ?? back).at - rise.at],
    ["dwell", dwell ? back.at - dwell.at : 0],
    ["return", end - back.at],
    ["rest", rise.at + turn - end],
  ];
  const given = (name: string): boolean => find(steps.root, [...path, name]) !== undefined;
  const wrong = angles.map(([name, angle]) =>
    (angle < 1e-9 && !given(name)) || (name === "rest" && !given(name))
      ? null
      : number(steps, [...path, name], angle, "rad"),
  );
  const phase = phaseOf(steps, path) - rise.at;
  if (Math.abs(rise.at) > 1e-12) wrong.push(number(steps, [...path, "phase"], phase, "rad"));
  laws(steps, [...path, "law"], rise.law, back.law);
  return first([...wrong, number(steps, [...path, "lift"], lift, units[0])]);
}

// The phase as the text has it (rad).
function phaseOf(steps: Steps, path: Step[]): number {
  const value = find(steps.root, [...path, "phase"]);
  if (value?.sort === "number") return Number(value.text);
  const [, size = "0", unit = "rad"] = /^\s*(\S+)\s*(\S*)\s*$/.exec(value?.text ?? "") ?? [];
  return Number(size) * (SIZES.rad![unit] ?? 0);
}

function laws(steps: Steps, path: Step[], rise: string, back: string): void {
  const law = find(steps.root, path),
    raw = (value: Value): string => steps.edits.text.slice(value.from, value.to),
    apart = law && member(law, "rise");
  if (!apart && (rise === back || !law)) {
    if (!law || raw(law) !== rise) steps.set(path, rise);
    return;
  }
  if (!apart) {
    steps.set(path, `{ "rise": ${rise}, "return": ${back} }`);
    return;
  }
  for (const [name, own] of [
    ["rise", rise],
    ["return", back],
  ] as const)
    if (raw(member(find(steps.root, path), name)!.value) !== own) steps.set([...path, name], own);
}

// A whole plan, each station on a line of its own, in as many lines as `indent` begins.
function planJson(all: Own[], motion: Motion, text: string, place: number): string {
  const indent = /^[ \t]*/.exec(text.slice(text.lastIndexOf("\n", place - 1) + 1))![0],
    unit = indentOf(text),
    inner = `\n${indent}${unit}${unit}`;
  const ends = [
    `"period": ${quantity(motion.period ?? 0, motion.axis)}`,
    ...(motion.phase ? [`"phase": ${quantity(motion.phase, motion.axis)}`] : []),
  ];
  return `{\n${indent}${unit}"stations": [${all.map((one) => inner + stationJson(one, motion)).join(",")}\n${indent}${unit}],\n${indent}${unit}${ends.join(", ")}\n${indent}}`;
}

// A plan in place of a cam.
function replaced(steps: Steps, { motion, path }: Place, all: Own[]): null {
  steps.do(({ root, text }) => {
    const own = member(find(root, path.slice(0, -1)), "cam")!;
    return [{ from: own.from, to: own.to, insert: `"plan": ${planJson(all, motion, text, own.from)}` }];
  });
  return null;
}

// The whole motion where the text has none of its own: a copy of the catalogue.
function copied(steps: Steps, { motion, path }: Place, all: Own[]): null {
  const owner = path.slice(0, -1),
    object = find(steps.root, owner.slice(0, -1));
  steps.set(owner, `{ "plan": ${planJson(all, motion, steps.edits.text, object?.from ?? 0)} }`);
  return null;
}
