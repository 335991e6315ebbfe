// What a dragged joint changes of the text of its linkage: points, frames that are there, and what
// guides make go with it. All links keep their angles, so that the position stays that of its inputs.
//
// The points of the links that meet in the joint change so that at the inputs shown all other
// joints and all angles stay. If a link has its frame there, its other points are computed
// anew. Positions come as courses, one over each input with the others held
// (`report/mechanism/sketch/courses.rs`). If several inputs are moved, courses through that
// position are requested.

import {
  COPY,
  far,
  isFormula,
  length,
  NAME,
  placed,
  sizeOf,
  within,
  type Joint,
  type Pair,
  type Point,
  type Sketch,
} from "./linkage";
import { find, member, type Change, type Edits, type Step } from "./tree";

const HELD = "Guides hold this joint: their numbers are in the form.";
const FLOATS = "This link floats: where it is its inputs say.";
const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1]];
const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1];
const none: Point = [0, 0];

// A guide in a position: the joints at its point and at its block, and its direction.
interface Guide {
  pair: Pair;
  on: Joint;
  block: Joint;
  along: Point;
  through: Joint | null;
}

function guidesOf(edits: Edits, { id, pairs }: Sketch, pose: number[], joints: Joint[]): Guide[] {
  const at = (place: Point): Joint | undefined => [...joints].sort((a, b) => far(a.at, place) - far(b.at, place))[0];
  return pairs.flatMap((pair) => {
    const on = at(placed(pose, pair.on.link, pair.on.at)),
      block = at(placed(pose, pair.link.link, pair.link.at));
    if (pair.direction === null || !on || !block || on === block) return [];
    const zero = placed(pose, pair.on.link, none),
      along = minus(placed(pose, pair.on.link, [Math.cos(pair.direction), Math.sin(pair.direction)]), zero);
    const second = find(edits.root, ["objects", id, "pairs", pair.name, "sliding", "through"])?.text,
      through = joints.find((joint) => second !== undefined && joint.names.includes(second));
    return [{ pair, on, block, along, through: through && through !== on ? through : null }];
  });
}

// How far each joint goes when one of them goes somewhere: a block along its guide, unless an input
// says how far it has slid; with a guide goes its block as far as it must. Text: what holds it.
function shiftsOf(joint: Joint, to: Point, guides: Guide[], step: number): Map<Joint, Point> | string {
  let shift: Point = [Math.round(to[0] / step) * step - joint.at[0], Math.round(to[1] / step) * step - joint.at[1]];
  for (const { pair, block, on, along } of guides) {
    if (block !== joint || pair.driven) continue;
    // Whole steps along it, counted from the guide's point.
    const slid = dot(minus(joint.at, on.at), along),
      by = Math.round((slid + dot(shift, along)) / step) * step - slid;
    shift = [by * along[0], by * along[1]];
  }
  const shifts = new Map([[joint, shift]]),
    get = (one: Joint): Point => shifts.get(one) ?? none;
  const near = 1e-6 * step,
    apart = ({ pair, on, block, along: [c, s] }: Guide): boolean => {
      const [x, y] = minus(get(block), get(on));
      return pair.driven ? Math.hypot(x, y) > near : Math.abs(c * y - s * x) > near;
    };
  // Each joint is moved once: what does not agree then cannot be.
  for (let more = true; more; ) {
    more = false;
    const go = (one: Joint, by: Point) => {
      if (!shifts.has(one) && Math.hypot(...by) > near) {
        shifts.set(one, by);
        more = true;
      }
    };
    for (const guide of guides) {
      const { pair, on, block, along, through } = guide;
      if (through && shifts.has(on)) go(through, get(on));
      if (pair.driven && shifts.has(block)) go(on, get(block));
      if (!shifts.has(on) || shifts.has(block)) continue;
      const [x, y] = get(on),
        slid = pair.driven ? 0 : dot([x, y], along);
      go(block, [x - slid * along[0], y - slid * along[1]]);
    }
  }
  return guides.some(apart) ? HELD : shifts;
}

// Moves a joint of a position to a place, in steps of the drawing. Text: what cannot be done.
export function dragged(
  edits: Edits,
  sketch: Sketch,
  pose: number[],
  joints: Joint[],
  joint: Joint,
  to: Point,
  step: number,
): Change[] | string {
  if (!member(find(edits.root, ["objects", sketch.id]), "links")) return COPY;
  const shifts = shiftsOf(joint, to, guidesOf(edits, sketch, pose, joints), step);
  if (typeof shifts === "string") return shifts;
  const moved: { path: Step[]; at: Point; was: Point }[] = [],
    shiftOf = new Map<string, Point>(),
    frames = new Map<number, Point>();
  for (const [one, shift] of shifts) {
    for (const index of one.origins) frames.set(index, shift);
    for (const { link, name } of one.points) shiftOf.set(`${link} ${name}`, shift);
  }
  if ([...frames.keys()].some((index) => sketch.floating?.includes(index))) return FLOATS;
  for (const { name, at } of sketch.ground) {
    const shift = shiftOf.get(`null ${name}`);
    if (shift) moved.push({ path: ["ground", name], at: [at[0] + shift[0], at[1] + shift[1]], was: at });
  }
  // Of a link's points those that are moved, or counted from a frame that is.
  sketch.links.forEach((link, index) => {
    for (const { name, at } of link.points) {
      const own = shiftOf.get(`${index} ${name}`) ?? none,
        frame = frames.get(index) ?? none,
        place = placed(pose, index, at);
      if (own === frame) continue;
      moved.push({
        path: ["links", link.name, "points", name],
        at: within(pose, index, [place[0] + own[0] - frame[0], place[1] + own[1] - frame[1]]),
        was: at,
      });
    }
  });
  return pointsWritten(edits, sketch, moved, Math.min(step, 1e-3 * sizeOf(sketch)));
}

// Writes points of a linkage; what changes by less than a thousandth of the step stays. Text: what cannot be.
export function pointsWritten(
  edits: Edits,
  sketch: Sketch,
  moved: { path: Step[]; at: Point; was: Point }[],
  step: number,
): Change[] | string {
  const path = ["objects", sketch.id],
    changes = new Map<number, Change>();
  for (const { path: where, at, was } of moved) {
    const value = find(edits.root, [...path, ...where]);
    if (value?.sort !== "array" || value.items.length !== 2)
      return `${where.join(".")} stands elsewhere: its numbers are in the form.`;
    for (const k of [0, 1] as const) {
      if (Math.abs(at[k] - was[k]) < 1e-3 * step) continue;
      const item = value.items[k]!,
        name = item.text.replace(/^-/, ""),
        dimension =
          item.sort === "string" && NAME.test(name) ? find(edits.root, [...path, "dimensions", name]) : undefined;
      const target = dimension ?? item,
        metres = dimension && item.text.startsWith("-") ? -at[k] : at[k];
      if (isFormula(target))
        return `${where.join(".")} is worked out: it is “${target.text}”. Change the numbers of that formula.`;
      const known = changes.get(target.from),
        insert = length(metres, target);
      // Of two that share a number the first has it; the other is written out.
      if (known && known.insert !== insert)
        changes.set(item.from, { from: item.from, to: item.to, insert: length(at[k]) });
      else changes.set(target.from, { from: target.from, to: target.to, insert });
    }
  }
  return [...changes.values()].sort((a, b) => a.from - b.from);
}
