// A linkage in one position, and what a dragged joint changes of its text.

import { member, type Value } from "./tree";

export type Point = [number, number];
export interface Named {
  name: string;
  at: Point;
}
export interface End {
  link: number | null;
  at: Point;
}
export interface Pair {
  name: string;
  on: End;
  link: End;
  direction: number | null;
  driven: boolean;
}
// The positions over one input, the others held where `start` of their own courses has them.
export interface Course {
  name: string;
  unit: string;
  range: string;
  values: number[];
  start: number;
  poses: (number[] | null)[];
}
export interface Sketch {
  id: string;
  told: string[];
  links: { name: string; points: Named[] }[];
  ground: Named[];
  pairs: Pair[];
  // One for each input, all through the same position.
  courses: Course[];
  // Links whose places are inputs themselves.
  floating?: number[];
  // Made of a text that is not whole: in the position in which it is drawn.
  draft?: boolean;
}

// A point of a link, or of the ground, at a position.
export function placed(pose: number[], link: number | null, [x, y]: Point): Point {
  if (link === null) return [x, y];
  const [u, v, c, s] = pose.slice(4 * link, 4 * link + 4) as [number, number, number, number];
  return [u + c * x - s * y, v + s * x + c * y];
}
// The way back.
export function within(pose: number[], link: number | null, [x, y]: Point): Point {
  if (link === null) return [x, y];
  const [u, v, c, s] = pose.slice(4 * link, 4 * link + 4) as [number, number, number, number];
  return [c * (x - u) + s * (y - v), -s * (x - u) + c * (y - v)];
}
export const far = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);
// Whether the origin of a link is a place of it: a pair is on it or may be, or there is not much else.
export const shows = ({ links, pairs, draft }: Sketch, index: number): boolean =>
  draft === true ||
  links[index]!.points.length < 2 ||
  pairs.some(({ on, link }) => [on, link].some((end) => end.link === index && end.at[0] === 0 && end.at[1] === 0));

// The values of all inputs at the position that the courses go through, and that position.
export const baseOf = ({ courses }: Sketch): number[] => courses.map(({ values, start }) => values[start]!);
export const basePose = ({ courses: [first] }: Sketch): number[] | null => first?.poses[first.start] ?? null;
// Which of its values is nearest to another.
export function nearest({ values }: Course, value: number): number {
  let best = 0;
  values.forEach((one, k) => {
    if (Math.abs(one - value) < Math.abs(values[best]! - value)) best = k;
  });
  return best;
}
// The inputs whose values are others.
const others = (one: number[], other: number[]): number[] => one.flatMap((value, k) => (value === other[k] ? [] : [k]));
// Whether the courses through one position lead to another.
export const leads = (from: number[], to: number[]): boolean => others(from, to).length < 2;
// The position at values of the inputs; undefined: no course leads there.
export function poseAt(sketch: Sketch, at: number[]): number[] | null | undefined {
  const from = baseOf(sketch),
    course = sketch.courses[others(from, at)[0] ?? 0];
  return course && leads(from, at) ? course.poses[nearest(course, at[sketch.courses.indexOf(course)]!)] : undefined;
}

// What is drawn at one place and goes together: named points, and origins of links.
export interface Joint {
  at: Point;
  points: { link: number | null; name: string; at: Point }[];
  origins: number[];
  names: string[];
}

export function joints(sketch: Sketch, pose: number[]): Joint[] {
  const size = sizeOf(sketch),
    all: Joint[] = [];
  const at = (place: Point): Joint => {
    let joint = all.find((one) => far(one.at, place) < 1e-7 * size);
    if (!joint) {
      joint = { at: place, points: [], origins: [], names: [] };
      all.push(joint);
    }
    return joint;
  };
  sketch.ground.forEach((point) => {
    const joint = at(point.at);
    joint.points.push({ link: null, ...point });
    joint.names.push(`ground.${point.name}`);
  });
  sketch.links.forEach((link, index) => {
    for (const point of link.points) {
      const joint = at(placed(pose, index, point.at));
      joint.points.push({ link: index, ...point });
      joint.names.push(`${link.name}.${point.name}`);
    }
  });
  sketch.links.forEach(({ name }, index) => {
    if (!shows(sketch, index)) return;
    const joint = at(placed(pose, index, [0, 0]));
    joint.origins.push(index);
    joint.names.push(`${name}.origin`);
  });
  return all;
}

export function sizeOf({ links, ground }: Sketch): number {
  const all = [...ground, ...links.flatMap((link) => link.points)].map((point) => Math.hypot(...point.at));
  return Math.max(1e-9, ...all);
}

export const NAME = /^[A-Za-z_][A-Za-z0-9_-]*$/;
export const LENGTHS: Record<string, number> = { m: 1, mm: 1e-3, cm: 1e-2, µm: 1e-6, in: 0.0254, ft: 0.3048 };
export const ANGLES: Record<string, number> = { rad: 1, deg: Math.PI / 180, mrad: 1e-3, rev: 2 * Math.PI };
const MEASURE = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-zµ]*)\s*$/;
const NAMED = /^\s*(-?)\s*([A-Za-z_][A-Za-z0-9_-]*)\s*(?:([*/])\s*(\d+\.?\d*(?:[eE][-+]?\d+)?))?\s*$/;
const tidy = (value: number): string => String(Number(value.toPrecision(12)));

// A number of a text in SI units: with a unit, or by the name of a dimension; null: it is none.
function measured(
  value: Value | undefined,
  dimensions: Value | undefined,
  units: Record<string, number>,
): number | null {
  if (value?.sort === "number") return Number(value.text);
  if (value?.sort !== "string") return null;
  const [, number, unit = ""] = MEASURE.exec(value.text) ?? [];
  if (number !== undefined) return unit in units ? Number(number) * units[unit]! : null;
  const [, sign, name, by, factor] = NAMED.exec(value.text) ?? [];
  const named = name === undefined ? undefined : member(dimensions, name)?.value;
  const found = named ? measured(named, undefined, units) : null;
  if (found === null) return null;
  return (sign ? -1 : 1) * (by === "*" ? found * Number(factor) : by === "/" ? found / Number(factor) : found);
}
export const lengthOf = (value: Value | undefined, dimensions: Value | undefined): number | null =>
  measured(value, dimensions, LENGTHS);
export const angleOf = (value: Value | undefined, dimensions: Value | undefined): number | null =>
  measured(value, dimensions, ANGLES);

// Whether a number of a text is worked out of others.
export const isFormula = (value: Value): boolean => value.sort === "string" && !MEASURE.test(value.text);

// A length as text, in the unit of the one before it.
export function length(metres: number, before?: Value): string {
  const given = before?.sort === "string" ? MEASURE.exec(before.text)?.[2] : undefined,
    unit = given && given in LENGTHS ? given : undefined;
  if (unit) return JSON.stringify(`${tidy(metres / LENGTHS[unit]!)} ${unit}`);
  if (before?.sort === "number" && Number(before.text) !== 0) return tidy(metres);
  return Math.abs(metres) < 1e-12 ? "0" : JSON.stringify(`${tidy(metres * 1e3)} mm`);
}

export const COPY = "This linkage is a copy from the catalogue: its points do not stand in this text.";

// A step that is as fine as the picture shows, and short to write.
export const stepOf = (metres: number): number => 10 ** Math.floor(Math.log10(Math.max(1e-9, metres)));

// The next of 1, 2, 5, 10, … that is as large at least.
export function gridOf(metres: number): number {
  const size = 10 ** Math.floor(Math.log10(Math.max(1e-9, metres)));
  return size * ([1, 2, 5].find((one) => one * size >= metres * (1 - 1e-9)) ?? 10);
}
export const snapped = ([x, y]: Point, grid: number): Point => [
  Math.round(x / grid) * grid,
  Math.round(y / grid) * grid,
];
