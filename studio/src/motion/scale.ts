// Where the curves of a motion are drawn: one below the other over one axis.

import { placed, round, unitOf, type Motion } from "./motion";

export interface Lane {
  name: string;
  unit: string;
  factor: number;
  top: number;
  height: number;
  low: number;
  high: number;
}
export interface Frame {
  width: number;
  height: number;
  left: number;
  right: number;
  range: [number, number];
  lanes: Lane[];
}

const NAMES = ["displacement", "velocity", "acceleration", "jerk"];
const HEIGHTS = [104, 62, 62, 46],
  GAP = 20,
  TOP = 18,
  FOOT = 24,
  LEFT = 8,
  RIGHT = 10;
// Room above and below a curve, as a share of its height.
const ROOM = 0.08;

// The unit in which a curve is shown, as charts of the program choose it.
function shown(size: number, si: string): { unit: string; factor: number } {
  if (si !== "rad" && si !== "m") return numbers.scaleFor(size, si);
  const { name, factor } = unitOf(si);
  return { unit: name, factor };
}

export function frameOf({ columns, range, units }: Motion, width: number): Frame {
  let top = TOP;
  const lanes = NAMES.map((name, k) => {
    const values = columns[k + 1]!,
      height = HEIGHTS[k]!;
    const low = Math.min(0, ...values),
      high = Math.max(0, ...values),
      span = high - low || 1;
    const lane = {
      name,
      ...shown(Math.max(high, -low), units[k]!),
      top,
      height,
      low: low - ROOM * span,
      high: high + ROOM * span,
    };
    top += height + GAP;
    return lane;
  });
  return { width, height: top - GAP + FOOT, left: LEFT, right: width - RIGHT, range, lanes };
}

export const xOf = ({ left, right, range: [from, to] }: Frame, place: number): number =>
  left + ((right - left) * (place - from)) / (to - from || 1);
export const placeOf = ({ left, right, range: [from, to] }: Frame, x: number): number =>
  from + ((to - from) * (x - left)) / (right - left);
export const yOf = ({ top, height, low, high }: Lane, value: number): number =>
  top + (height * (high - value)) / (high - low);
export const valueAt = ({ top, height, low, high }: Lane, y: number): number =>
  high - ((high - low) * (y - top)) / height;

export function curve(frame: Frame, lane: Lane, { columns }: Motion, order: number): string {
  const [at, values] = [columns[0]!, columns[order + 1]!];
  return at
    .map((place, k) => `${k ? "L" : "M"}${xOf(frame, place).toFixed(1)} ${yOf(lane, values[k]!).toFixed(1)}`)
    .join("");
}

// Places of the axis that are named.
export function ticks({ range: [from, to], width }: Frame, axis: string): { place: number; label: string }[] {
  const { factor, sign } = unitOf(axis),
    count = Math.max(2, Math.floor(width / 60)),
    span = (to - from) / factor;
  const size =
    axis === "rad"
      ? ([10, 15, 30, 45, 60, 90, 180, 360].find((one) => span / one <= count) ?? 360)
      : nice(span / count);
  const first = Math.ceil(from / factor / size - 1e-9),
    last = Math.floor(to / factor / size + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, k) => ({
    place: (first + k) * size * factor,
    label: `${round((first + k) * size, 6)}${axis === "rad" ? sign : ""}`,
  }));
}
function nice(raw: number): number {
  const power = 10 ** Math.floor(Math.log10(raw));
  return power * ([1, 2, 5, 10].find((one) => one * power >= raw * (1 - 1e-9)) ?? 10);
}

// Where the level of some stations is held: in the middle of their dwell, else at the station.
export function gripOf(motion: Motion, ends: [number, number] | null, at: number): number {
  if (!ends) return placed(motion, at);
  const [from, length] = [placed(motion, ends[0]), ends[1] - ends[0]],
    to = motion.range[1];
  return from + length <= to
    ? from + length / 2
    : from + length - to > to - from
      ? (motion.range[0] + from + length - to + motion.range[0]) / 2
      : (from + to) / 2;
}
