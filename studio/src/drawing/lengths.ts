// Lengths and directions of a link, from its first place to each other one, and what a typed one
// changes of the text: the numbers of that point, or the dimensions that they name.

import { typedNumber } from "../entry";
import { pointsWritten } from "../drag";
import { ANGLES, COPY, far, LENGTHS, shows, sizeOf, type Joint, type Point, type Sketch } from "../linkage";
import { find, member, type Change, type Edits } from "../tree";

// Of a link, or of the ground (null), in its own frame (m, rad).
export interface Measure {
  link: number | null;
  point: string;
  // Its ends in words, as they are named in the drawing.
  name: string;
  from: Point;
  to: Point;
  length: number;
  angle: number;
}

export function measuresOf(sketch: Sketch, link: number | null, joints: Joint[]): Measure[] {
  const points = link === null ? sketch.ground : sketch.links[link]!.points;
  const origin = joints.find((joint) => link !== null && joint.origins.includes(link)),
    own = { name: origin?.points[0]?.name ?? "origin", at: [0, 0] as Point };
  const [first, ...others] = link !== null && shows(sketch, link) ? [own, ...points] : points;
  if (!first) return [];
  // Those at which pairs are come first.
  const isHeld = ({ at }: { at: Point }): boolean =>
    sketch.pairs.some(({ on, link: end }) => [on, end].some((one) => one.link === link && far(one.at, at) === 0));
  return [...others.filter(isHeld), ...others.filter((one) => !isHeld(one))].flatMap(({ name: point, at }) => {
    const length = far(first.at, at);
    if (length < 1e-12 * sizeOf(sketch)) return [];
    const angle = Math.atan2(at[1] - first.at[1], at[0] - first.at[0]);
    return [{ link, point, name: `${first.name}–${point}`, from: first.at, to: at, length, angle }];
  });
}

// Gives a measure another length or direction. Text: why it cannot be.
export function resized(
  edits: Edits,
  sketch: Sketch,
  { link, point, from, to, ...was }: Measure,
  asked: { length?: number; angle?: number },
): Change[] | string {
  if (!member(find(edits.root, ["objects", sketch.id]), "links")) return COPY;
  const { length, angle } = { ...was, ...asked },
    least = 1e-12 * Math.max(sizeOf(sketch), length);
  const place = [from[0] + length * Math.cos(angle), from[1] + length * Math.sin(angle)].map(
    // A right angle is one, though its cosine is not quite zero.
    (value) => (Math.abs(value) < least ? 0 : value),
  ) as Point;
  const path = link === null ? ["ground", point] : ["links", sketch.links[link]!.name, "points", point];
  return pointsWritten(edits, sketch, [{ path, at: place, was: to }], 1e3 * least);
}

// A value as it was typed, in SI units; text: why it is none.
export function typedMeasure(text: string, sort: "length" | "angle", unit: string): number | string {
  const units = sort === "length" ? LENGTHS : ANGLES,
    given = typedNumber(text);
  if (given.sort === "wrong") return given.why;
  const one = given.sort === "number" ? units[given.entry.unit || unit] : undefined;
  if (given.sort !== "number" || one === undefined)
    return `“${text.trim()}” is no ${sort}: write a number, or one in ${Object.keys(units).join(", ")}.`;
  const value = Number(given.entry.number) * one;
  return sort === "length" && value <= 0 ? "A length is above zero." : value;
}
