// A motion made of segments: what the program says of it, and its segments as the panel shows them.
//
// Places are those of the program, in SI units. Handles are told and moved in the units in which
// people count: degrees, millimetres, seconds.

import type { Step, Value } from "../tree";
import { find, member } from "../tree";

export interface Station {
  at: number;
  displacement: number;
  part: string;
  law: string;
}
export interface Peak {
  value: number;
  at: number;
}
export interface Jump {
  at: number;
  order: number;
  before: number;
  after: number;
}

// As `src/studio/motion.rs` tells it.
export interface Motion {
  form: "cam" | "plan";
  stations: Station[];
  phase: number;
  period: number | null;
  advance: number;
  range: [number, number];
  // Unit of the axis, and of displacement, velocity, acceleration and jerk.
  axis: string;
  units: [string, string, string, string];
  // Constant speed of the drive; null: the derivatives are those over the axis.
  speed: number | null;
  // Places, displacement, velocity, acceleration, jerk.
  columns: number[][];
  peaks: [Peak, Peak, Peak];
  jumps: Jump[];
}

export const DEFAULT_LAW = "cycloidal";

export interface Segment {
  // Its station, and the next one: where it ends.
  from: number;
  to: number;
  // Its ends along the axis of the text, and displacements there.
  ends: [number, number];
  levels: [number, number];
  // Its motion as the text has it, as JSON.
  law: string;
  name: string;
}

// The name of a unit that people count in, and how many of the SI unit it is.
export interface Unit {
  name: string;
  sign: string;
  factor: number;
}
const UNITS: Record<string, Unit> = {
  rad: { name: "deg", sign: "°", factor: Math.PI / 180 },
  m: { name: "mm", sign: " mm", factor: 1e-3 },
  s: { name: "s", sign: " s", factor: 1 },
};
export const unitOf = (si: string): Unit => UNITS[si] ?? { name: si, sign: ` ${si}`, factor: 1 };
export const round = (value: number, digits = 12): number => Number(value.toPrecision(digits)) + 0;
export const counted = (value: number, si: string): string =>
  `${round(value / unitOf(si).factor, 7)}${unitOf(si).sign}`.replace("-", "−");

// Where the text has the motion.
export const pathOf = (id: string, { form }: Motion, isDrive: boolean): Step[] => [
  "objects",
  id,
  isDrive ? "motion" : "position",
  form,
];

// The stations that begin a segment: one that closes the period is the first again.
export function open({ stations, period }: Motion): Station[] {
  const [first, last] = [stations[0], stations.at(-1)];
  const closes = period !== null && stations.length > 2 && Math.abs(last!.at - first!.at - period) < 1e-9 * period;
  return closes ? stations.slice(0, -1) : stations;
}

// The motion of each segment as the text has it; of a copy from the catalogue what the program says.
function lawAt(
  root: Value | undefined,
  path: Step[],
  text: string,
  { form, stations }: Motion,
  station: number,
): string {
  const own = find(root, path),
    raw = (value: Value | undefined) => value && text.slice(value.from, value.to);
  const { part, law: told } = stations[station]!,
    law = member(own, "law")?.value;
  if (form === "plan" || told === "dwell")
    return raw(find(own, ["stations", station, "motion"])) ?? JSON.stringify(told);
  return raw(member(law, part)?.value ?? law) ?? JSON.stringify(told);
}

export function segmentsOf(motion: Motion, root: Value | undefined, path: Step[], text: string): Segment[] {
  const all = open(motion),
    { period, advance } = motion,
    count = period === null ? all.length - 1 : all.length;
  const made = Array.from({ length: count }, (_, k): Segment => {
    const one = all[k]!,
      to = (k + 1) % all.length,
      next = all[to]!,
      round = to > k ? [0, 0] : [period ?? 0, advance];
    return {
      from: k,
      to,
      ends: [one.at, next.at + round[0]!],
      levels: [one.displacement, next.displacement + round[1]!],
      law: lawAt(root, path, text, motion, k),
      name: "",
    };
  });
  return named(made);
}

export const isDwell = ({ law }: { law: string }): boolean => law === '"dwell"';

// Rise, dwell, return, with a number where there are several.
function named(all: Segment[]): Segment[] {
  const sort = (one: Segment) =>
    one.levels[0] === one.levels[1] ? "dwell" : one.levels[1] > one.levels[0] ? "rise" : "return";
  const sorts = all.map(sort),
    count = (sort: string, until: number) => sorts.slice(0, until).filter((one) => one === sort).length;
  return all.map((one, k) => ({
    ...one,
    name: count(sorts[k]!, sorts.length) > 1 ? `${sorts[k]!} ${count(sorts[k]!, k) + 1}` : sorts[k]!,
  }));
}

// A place of the text on the axis that is drawn: within the cycle.
export function placed({ phase, period, range }: Motion, at: number): number {
  const place = at - phase;
  return period === null ? place : place - period * Math.floor((place - range[0]) / period + 1e-12);
}

// Steps of a handle: whole degrees along; the round number that is about a fiftieth of the stroke up.
const tenth = (value: number): number => 10 ** Math.floor(Math.log10(value) + 1e-9);
export function stepAlong({ axis, range }: Motion): number {
  return axis === "rad" ? unitOf("rad").factor : tenth((range[1] - range[0]) / 100);
}
export function stepUp({ columns, units }: Motion): number {
  const all = columns[1]!,
    stroke = Math.max(...all) - Math.min(...all),
    { factor } = unitOf(units[0]);
  return stroke > 0 ? factor * tenth(stroke / factor / 50) : factor;
}

// Stations that stay at one level: those that dwells join. Those of a cam's base stay at zero.
export function levelsOf(motion: Motion, segments: Segment[]): number[][] {
  const stations = open(motion),
    groups: number[][] = [];
  for (const [k] of stations.entries()) {
    const before = segments.find((one) => one.to === k);
    const joined =
      before && isDwell(before) && before.from < k ? groups.find((group) => group.includes(before.from)) : undefined;
    if (joined) joined.push(k);
    else groups.push([k]);
  }
  const last = segments.at(-1);
  // The dwell over the end of the cycle.
  if (last && last.to === 0 && isDwell(last) && groups.length > 1) groups[0]!.push(...groups.pop()!);
  const isBase = (k: number) => motion.form === "cam" && stations[k]!.displacement === 0;
  return groups.filter((group) => !group.some(isBase));
}
