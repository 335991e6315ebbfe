// A linkage in one position, and what a dragged joint changes of its text.

import { find, member, type Change, type Edits, type Step, type Value } from "./tree";

export type Point = [number, number];
export interface Named { name: string; at: Point }
export interface End { link: number | null; at: Point }
export interface Pair { name: string; on: End; link: End; direction: number | null; driven: boolean }
export interface Sketch {
  id: string; told: string[]; range: string; unit: string;
  links: { name: string; points: Named[] }[]; ground: Named[]; pairs: Pair[];
  inputs: number[]; start: number; poses: (number[] | null)[];
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
export const shows = ({ links, pairs, draft }: Sketch, index: number): boolean => draft === true || links[index]!.points.length < 2
  || pairs.some(({ on, link }) => [on, link].some((end) => end.link === index && end.at[0] === 0 && end.at[1] === 0));

// What is drawn at one place and goes together: named points, and origins of links.
export interface Joint { at: Point; points: { link: number | null; name: string; at: Point }[]; origins: number[]; names: string[] }

export function joints(sketch: Sketch, pose: number[]): Joint[] {
  const size = sizeOf(sketch), all: Joint[] = [];
  const at = (place: Point): Joint => {
    let joint = all.find((one) => far(one.at, place) < 1e-7 * size);
    if (!joint) { joint = { at: place, points: [], origins: [], names: [] }; all.push(joint); }
    return joint;
  };
  sketch.ground.forEach((point) => { const joint = at(point.at); joint.points.push({ link: null, ...point }); joint.names.push(`ground.${point.name}`); });
  sketch.links.forEach((link, index) => {
    for (const point of link.points) { const joint = at(placed(pose, index, point.at)); joint.points.push({ link: index, ...point }); joint.names.push(`${link.name}.${point.name}`); }
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

const NAME = /^[A-Za-z_][A-Za-z0-9_-]*$/;
const LENGTHS: Record<string, number> = { m: 1, mm: 1e-3, cm: 1e-2, "µm": 1e-6 };
const ANGLES: Record<string, number> = { rad: 1, deg: Math.PI / 180, mrad: 1e-3, rev: 2 * Math.PI };
const MEASURE = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-zµ]*)\s*$/;
const NAMED = /^\s*(-?)\s*([A-Za-z_][A-Za-z0-9_-]*)\s*(?:([*/])\s*(\d+\.?\d*(?:[eE][-+]?\d+)?))?\s*$/;
const tidy = (value: number): string => String(Number(value.toPrecision(12)));

// A number of a text in SI units: with a unit, or by the name of a dimension; null: it is none.
function measured(value: Value | undefined, dimensions: Value | undefined, units: Record<string, number>): number | null {
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
export const lengthOf = (value: Value | undefined, dimensions: Value | undefined): number | null => measured(value, dimensions, LENGTHS);
export const angleOf = (value: Value | undefined, dimensions: Value | undefined): number | null => measured(value, dimensions, ANGLES);

// A length as text, in the unit of the one before it.
export function length(metres: number, before?: Value): string {
  const given = before?.sort === "string" ? MEASURE.exec(before.text)?.[2] : undefined, unit = given && given in LENGTHS ? given : undefined;
  if (unit) return JSON.stringify(`${tidy(metres / LENGTHS[unit]!)} ${unit}`);
  if (before?.sort === "number" && Number(before.text) !== 0) return tidy(metres);
  return Math.abs(metres) < 1e-12 ? "0" : JSON.stringify(`${tidy(metres * 1e3)} mm`);
}

export const COPY = "This linkage is a copy from the catalogue: its points do not stand in this text.";

// Moves a joint of a position; all others stay where they are, and all links keep their angles.
// Text: what cannot be done.
export function dragged(edits: Edits, sketch: Sketch, pose: number[], joint: Joint, to: Point, step: number): Change[] | string {
  const place: Point = [Math.round(to[0] / step) * step, Math.round(to[1] / step) * step];
  const shift: Point = [place[0] - joint.at[0], place[1] - joint.at[1]], path = ["objects", sketch.id];
  const own = find(edits.root, path);
  if (!member(own, "links")) return COPY;
  const moved = new Map<string, { path: Step[]; at: Point; was: Point }>();
  const set = (link: number | null, name: string, at: Point, was: Point) => {
    const where = link === null ? ["ground", name] : ["links", sketch.links[link]!.name, "points", name];
    moved.set(where.join(" "), { path: [...path, ...where], at, was });
  };
  // The frames that go with it: their other points are counted from elsewhere then.
  for (const origin of joint.origins) {
    const [, , c, s] = pose.slice(4 * origin, 4 * origin + 4) as [number, number, number, number];
    const back: Point = [c * shift[0] + s * shift[1], -s * shift[0] + c * shift[1]];
    for (const point of sketch.links[origin]!.points) set(origin, point.name, [point.at[0] - back[0], point.at[1] - back[1]], point.at);
    const inner = sketch.pairs.some(({ on, link, direction }) => direction !== null && (on.link === origin || link.link === origin));
    if (inner) return "A guide or block stands at the origin of a link here: its numbers are in the form.";
  }
  for (const point of joint.points) {
    const frame = point.link !== null && joint.origins.includes(point.link);
    if (!frame) set(point.link, point.name, within(pose, point.link, place), point.at);
  }
  const changes = new Map<number, Change>();
  for (const { path: where, at, was } of moved.values()) {
    const value = find(edits.root, where);
    if (value?.sort !== "array" || value.items.length !== 2) return `${where.slice(2).join(".")} stands elsewhere: its numbers are in the form.`;
    for (const k of [0, 1] as const) {
      if (Math.abs(at[k] - was[k]) < 1e-3 * step) continue;
      const item = value.items[k]!, name = item.text.replace(/^-/, ""), dimension = item.sort === "string" && NAME.test(name) ? find(edits.root, [...path, "dimensions", name]) : undefined;
      const target = dimension ?? item, metres = dimension && item.text.startsWith("-") ? -at[k] : at[k];
      const known = changes.get(target.from), insert = length(metres, target);
      // Of two that share a number the first has it; the other is written out.
      if (known && known.insert !== insert) changes.set(item.from, { from: item.from, to: item.to, insert: length(at[k]) });
      else changes.set(target.from, { from: target.from, to: target.to, insert });
    }
  }
  return [...changes.values()].sort((a, b) => a.from - b.from);
}

// A step that is as fine as the picture shows, and short to write.
export const stepOf = (metres: number): number => 10 ** Math.floor(Math.log10(Math.max(1e-9, metres)));

// The next of 1, 2, 5, 10, … that is as large at least.
export function gridOf(metres: number): number {
  const size = 10 ** Math.floor(Math.log10(Math.max(1e-9, metres)));
  return size * ([1, 2, 5].find((one) => one * size >= metres * (1 - 1e-9)) ?? 10);
}
export const snapped = ([x, y]: Point, grid: number): Point => [Math.round(x / grid) * grid, Math.round(y / grid) * grid];
