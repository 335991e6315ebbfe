// What the tools of a drawing do to the text of a linkage: ground points, links, points of links
// and guides are added, and taken away. Everything is drawn at the input that the assembly holds
// at: frames of new links stand there as the ground's does, so that their numbers are the drawing's.
//
// Edits follow one after the other (`Steps`). The assembly mode of a new link is the angle
// zero. An act waits until the drawing shows the text that it changes.

import type { Known } from "./draft";
import { freeName } from "./graph";
import type { Parts } from "./kinds";
import { COPY, far, length, shows, snapped, within, type Joint, type Point, type Sketch } from "./linkage";
import { driveOf } from "./starter";
import { find, member, unitOf, type Step, type Steps, type Value } from "./tree";

// A linkage as it is drawn, and what it is drawn on.
export interface Board {
  sketch: Sketch;
  pose: number[];
  joints: Joint[];
  grid: number;
  known: Known;
  parts: Parts;
}
// A place of it: a joint, a link, or neither.
export interface Spot {
  at: Point;
  joint: Joint | null;
  link: number | null;
}
// An end of a pair in the text, with the letter that is told there.
interface Hold {
  point: string;
  letter: string;
  ground: boolean;
}

const LETTERS = [..."ABCDEFGHIJKLMNPQRSTUVWXYZ"];
export const pathOf = ({ sketch }: Board, ...inner: Step[]): Step[] => ["objects", sketch.id, ...inner];
const at = ([x, y]: Point): string => `[${length(x)}, ${length(y)}]`;
const namesOf = (value: Value | undefined): string[] => value?.members.map((one) => one.name) ?? [];

// The nearest joint within reach of a place, else a link whose outline runs there, else a place on the grid.
export function spotAt({ sketch, joints, grid }: Board, place: Point, reach: number): Spot {
  const near = joints.map((joint) => ({ joint, off: far(joint.at, place) })).sort((a, b) => a.off - b.off)[0];
  if (near && near.off <= reach) return { at: near.joint.at, joint: near.joint, link: null };
  const free = snapped(place, grid);
  const link = sketch.links.findIndex((_, index) => {
    const own = joints.filter(
      (joint) => joint.origins.includes(index) || joint.points.some((point) => point.link === index),
    );
    return own.some((a, k) => own.slice(k + 1).some((b) => beside(place, a.at, b.at) < reach / 2));
  });
  return { at: free, joint: null, link: link < 0 ? null : link };
}

// How far a place is from a line between two others.
function beside(place: Point, a: Point, b: Point): number {
  const [u, v] = [b[0] - a[0], b[1] - a[1]],
    share = ((place[0] - a[0]) * u + (place[1] - a[1]) * v) / (u * u + v * v || 1);
  const on = Math.min(1, Math.max(0, share));
  return far(place, [a[0] + on * u, a[1] + on * v]);
}

// A letter that nothing of the linkage has.
function letter(steps: Steps, board: Board): string {
  const own = find(steps.root, pathOf(board)),
    points = [
      member(own, "ground")?.value,
      ...(member(own, "links")?.value.members ?? []).map((link) => member(link.value, "points")?.value),
    ];
  const taken = new Set([...points.flatMap(namesOf), ...namesOf(member(own, "pairs")?.value)]);
  return LETTERS.find((one) => !taken.has(one)) ?? freeName("A", taken);
}

// A numbered name: link_1, link_2, …
function numbered(stem: string, taken: string[]): string {
  let number = 1;
  while (taken.includes(`${stem}_${number}`)) number++;
  return `${stem}_${number}`;
}

// Whether it stands in the text: what is told if not.
export const own = (steps: Steps, board: Board): string | null =>
  member(find(steps.root, pathOf(board)), "from") ? COPY : null;

// A linkage without any parts, and a drive for it where there is none: its name.
export function begun(steps: Steps, all: Parts): string {
  const objects = find(steps.root, ["objects"]),
    taken = namesOf(objects),
    [one, two, three] = [1, 2, 3].map((depth) => unitOf(steps.edits.text).repeat(depth));
  let drive = objects?.members.find((object) => member(object.value, "kind")?.value.text === "drive")?.name;
  drive ??= driveOf(steps, all);
  const id = freeName("linkage", taken),
    parts = ["ground", "links", "pairs", "assembly"].map((name) => `,\n${three}"${name}": {\n${three}}`);
  steps.set(
    ["objects", id],
    `{\n${three}"kind": "linkage",\n${three}"input": ${JSON.stringify(drive)}${parts.join("")}\n${two ?? one}}`,
  );
  return id;
}

// What a pair at a spot can be with: the ground where it can be, a point of a link, its origin; on
// a link between its points a new one.
export function hold(steps: Steps, board: Board, { at: place, joint, link }: Spot): Hold | null {
  const { sketch, pose } = board;
  if (joint) {
    const point = joint.points.find((one) => one.link === null) ?? joint.points[0];
    const word = joint.points[0]?.name ?? letter(steps, board);
    if (point)
      return {
        point: `${point.link === null ? "ground" : sketch.links[point.link]!.name}.${point.name}`,
        letter: word,
        ground: point.link === null,
      };
    return { point: `${sketch.links[joint.origins[0]!]!.name}.origin`, letter: word, ground: false };
  }
  if (link === null) return null;
  const name = letter(steps, board),
    owner = sketch.links[link]!.name;
  steps.set(pathOf(board, "links", owner, "points", name), at(within(pose, link, place)));
  return { point: `${owner}.${name}`, letter: name, ground: false };
}

// A pin between what is held and a point of a link: its name.
function pinned(steps: Steps, board: Board, { point, letter: word }: Hold, other: string): string {
  const name = freeName(word, namesOf(find(steps.root, pathOf(board, "pairs"))));
  steps.set(pathOf(board, "pairs", name), `{ "revolute": ${JSON.stringify([point, other]).replace(",", ", ")} }`);
  return name;
}

// A point of the ground; at a joint that has none it holds the joint.
export function grounded(steps: Steps, board: Board, spot: Spot): string | null {
  const wrong = own(steps, board),
    held = spot.joint?.points.some((point) => point.link === null);
  if (wrong || held) return wrong ?? "The ground has a point there already.";
  const other = hold(steps, board, spot),
    first = !board.sketch.ground.length && !board.sketch.links.length;
  const name = first
    ? "O"
    : other && !namesOf(find(steps.root, pathOf(board, "ground"))).includes(other.letter)
      ? other.letter
      : letter(steps, board);
  steps.set(pathOf(board, "ground", name), at(spot.at));
  if (other)
    drives(steps, board, pinned(steps, board, { point: `ground.${name}`, letter: name, ground: true }, other.point));
  return null;
}

// The first pin on the ground is the one that is driven: true where it becomes that.
function drives(steps: Steps, board: Board, pair: string): boolean {
  const linkage = find(steps.root, pathOf(board));
  if (member(linkage, "driver") || member(linkage, "inputs")) return false;
  steps.set(pathOf(board, "driver"), JSON.stringify(pair));
  return true;
}

// A link between two spots, pinned to what is there: its frame is at the first that is held.
export function linked(steps: Steps, board: Board, from: Spot, to: Spot): string | null {
  const wrong = own(steps, board);
  if (wrong) return wrong;
  if (far(from.at, to.at) < board.grid / 2) return "Both ends of the link are at one place.";
  const name = numbered("link", namesOf(find(steps.root, pathOf(board, "links"))));
  const [first, second] = [hold(steps, board, from), hold(steps, board, to)];
  const turned = !first && second !== null,
    [start, end] = turned ? [to, from] : [from, to],
    [held, other] = turned ? [second, first] : [first, second];
  const point = other?.letter ?? letter(steps, board),
    shift: Point = [end.at[0] - start.at[0], end.at[1] - start.at[1]];
  steps.set(pathOf(board, "links", name), `{ "points": { ${JSON.stringify(point)}: ${at(shift)} } }`);
  // What hangs on nothing has a point at both of its ends.
  if (!held) steps.set(pathOf(board, "links", name, "points", letter(steps, board)), "[0, 0]");
  board.known.set(name, [...start.at, 1, 0]);
  const pins = [
    [held, "origin"],
    [other, point],
  ] as const;
  let driven = false;
  for (const [one, inner] of pins)
    if (one) {
      const pair = pinned(steps, board, one, `${name}.${inner}`);
      if (one.ground && !driven) driven = drives(steps, board, pair);
    }
  if (!driven) steps.set(pathOf(board, "assembly", name), '{ "angle": 0 }');
  return null;
}

// A further point of a link.
export function pointed(steps: Steps, board: Board, from: Spot, to: Spot): string | null {
  const wrong = own(steps, board);
  if (wrong) return wrong;
  if (from.link === null) return "Press on a link, and let go where its point is to be.";
  hold(steps, board, { ...to, joint: null, link: from.link });
  return null;
}

// A block at a joint of a link that slides along the ground, in a direction of five degrees' step.
export function guided(steps: Steps, board: Board, from: Spot, to: Spot): string | null {
  const wrong = own(steps, board);
  if (wrong) return wrong;
  if (!from.joint && from.link === null)
    return "Press at a joint of a link, and let go in the direction in which it is to slide.";
  if (from.joint?.points.some((point) => point.link === null)) return "The ground holds this joint: it cannot slide.";
  const reach = far(from.at, to.at) || 10 * board.grid,
    degrees = 5 * Math.round((Math.atan2(to.at[1] - from.at[1], to.at[0] - from.at[0]) * 36) / Math.PI);
  const angle = (degrees * Math.PI) / 180,
    held = hold(steps, board, from)!;
  const ground = letter(steps, board);
  steps.set(
    pathOf(board, "ground", ground),
    at([from.at[0] + reach * Math.cos(angle), from.at[1] + reach * Math.sin(angle)]),
  );
  const block = numbered("block", namesOf(find(steps.root, pathOf(board, "links"))));
  steps.set(pathOf(board, "links", block), "{}");
  board.known.set(block, [...from.at, Math.cos(angle), Math.sin(angle)]);
  pinned(steps, board, held, `${block}.origin`);
  const guide = freeName(ground, namesOf(find(steps.root, pathOf(board, "pairs"))));
  const direction = degrees ? `, "direction": "${degrees} deg"` : "";
  steps.set(
    pathOf(board, "pairs", guide),
    `{ "sliding": { "guide": "ground.${ground}", "block": "${block}.origin"${direction} } }`,
  );
  return null;
}

// Names in a part of a linkage that say what it is about.
const ABOUT = [
  "point",
  "from",
  "to",
  "angle",
  "x",
  "y",
  "link",
  "pair",
  "guide",
  "block",
  "through",
  "revolute",
  "driver",
];

function isAbout(value: Value, fits: (name: string) => boolean, at = ""): boolean {
  if (value.sort === "string") return ABOUT.includes(at) && fits(value.text);
  return (
    value.items.some((one) => isAbout(one, fits, at)) || value.members.some((one) => isAbout(one.value, fits, one.name))
  );
}

// Takes away the pairs that are about something, and what is about those or about what goes with them.
function loosened(
  steps: Steps,
  board: Board,
  ofPair: (name: string) => boolean,
  gone: (name: string) => boolean,
): void {
  const loose: string[] = [],
    lost = (name: string): boolean => gone(name) || loose.includes(name);
  for (const part of ["pairs", "inputs", "outputs", "forces", "assembly"]) {
    for (const one of find(steps.root, pathOf(board, part))?.members ?? []) {
      const goes =
        part === "pairs" ? isAbout(one.value, ofPair) : part === "assembly" ? gone(one.name) : isAbout(one.value, lost);
      if (!goes) continue;
      if (part === "pairs") loose.push(one.name);
      steps.remove(pathOf(board, part, one.name));
    }
  }
  const driver = find(steps.root, pathOf(board, "driver"));
  if (driver && loose.includes(driver.text)) steps.remove(pathOf(board, "driver"));
}

// Takes away what is at a spot: the pairs and points of a joint, or a link.
export function removed(steps: Steps, board: Board, { joint, link }: Spot): string | null {
  const wrong = own(steps, board),
    { sketch } = board;
  if (wrong) return wrong;
  if (!joint && link === null) return "There is nothing to delete here.";
  if (!joint) {
    const name = sketch.links[link!]!.name,
      about = (word: string): boolean => word === name || word.startsWith(`${name}.`);
    loosened(steps, board, about, about);
    steps.remove(pathOf(board, "links", name));
    return null;
  }
  // A link keeps two places.
  const going = joint.points.filter(
    (point) => point.link === null || sketch.links[point.link]!.points.length + (shows(sketch, point.link) ? 1 : 0) > 2,
  );
  const owner = (link: number | null): string => (link === null ? "ground" : sketch.links[link]!.name);
  const ends = new Set(joint.names),
    gone = new Set(going.map((point) => `${owner(point.link)}.${point.name}`));
  loosened(
    steps,
    board,
    (word) => ends.has(word),
    (word) => gone.has(word),
  );
  for (const { link: index, name } of going)
    steps.remove(index === null ? pathOf(board, "ground", name) : pathOf(board, "links", owner(index), "points", name));
  return null;
}

// Makes a pair the one that is driven.
export function driven(steps: Steps, board: Board, pair: string): string | null {
  const wrong = own(steps, board);
  if (!wrong) steps.set(pathOf(board, "driver"), JSON.stringify(pair));
  return wrong;
}
