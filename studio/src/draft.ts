// A linkage as its text has it, in the position in which it is drawn, however much of it is
// missing: what the server cannot tell of a text that is not whole yet.
//
// Angles are the last known ones; places follow along the pairs.

import { angleOf, lengthOf, placed, type End, type Named, type Pair, type Point, type Sketch } from "./linkage";
import { find, member, type Value } from "./tree";

// Where links stand: place of the frame, cosine and sine of its angle.
export type Stance = [number, number, number, number];
// Those that are known of a linkage from when it was whole, or from its drawing.
export type Known = Map<string, Stance>;

const many = (count: number, word: string): string => `${count} ${word}${count === 1 ? "" : "s"}`;

function points(list: Value | undefined, dimensions: Value | undefined): Named[] {
  return (list?.members ?? []).flatMap(({ name, value }) => {
    const [x, y] = [0, 1].map((k) => lengthOf(value.items[k], dimensions));
    return x === null || x === undefined || y === null || y === undefined ? [] : [{ name, at: [x, y] as Point }];
  });
}

// A linkage of a text; null: its parts do not stand there.
export function drafted(id: string, own: Value, known: Known): Sketch | null {
  const part = (name: string): Value | undefined => member(own, name)?.value;
  if (!["ground", "links", "pairs"].some((name) => part(name)?.sort === "object")) return null;
  const dimensions = part("dimensions"),
    ground = points(part("ground"), dimensions);
  const links = (part("links")?.members ?? []).map(({ name, value }) => ({
    name,
    points: points(member(value, "points")?.value, dimensions),
  }));
  const end = (value: Value | undefined): End | null => {
    const [owner = "", name = ""] = value?.sort === "string" ? value.text.split(".") : [];
    const link = owner === "ground" ? null : links.findIndex((one) => one.name === owner);
    if (link === -1) return null;
    const own = link === null ? ground : links[link]!.points,
      at = link !== null && name === "origin" ? ([0, 0] as Point) : own.find((one) => one.name === name)?.at;
    return at ? { link, at } : null;
  };
  const inputs = (part("inputs")?.members ?? []).map(({ value }) => member(value, "pair")?.value.text),
    drivers = [part("driver")?.text, ...inputs];
  // The block's angle in its guide's frame is kept beside: only here it says how the block stands.
  const turned: number[] = [],
    pairs: Pair[] = [];
  for (const { name, value } of part("pairs")?.members ?? []) {
    const revolute = member(value, "revolute")?.value.items,
      sliding = member(value, "sliding")?.value;
    const inner = (which: string): Value | undefined => member(sliding, which)?.value;
    const on = end(revolute ? revolute[0] : inner("guide")),
      link = end(revolute ? revolute[1] : inner("block"));
    if (!on || !link || on.link === link.link) continue;
    const through = end(inner("through")),
      given = through
        ? Math.atan2(through.at[1] - on.at[1], through.at[0] - on.at[0])
        : (angleOf(inner("direction"), dimensions) ?? 0);
    const direction = revolute ? null : given;
    pairs.push({ name, on, link, direction, driven: drivers.includes(name) });
    turned.push(given + (angleOf(inner("angle"), dimensions) ?? 0));
  }
  const [n, p] = [links.length, pairs.length],
    freedom = 3 * n - 2 * p;
  const told = [
    `${many(n, "moving link")}, ${many(p, "pair")}: 3·${n} − 2·${p} = ${freedom} ${freedom === 1 ? "degree" : "degrees"} of freedom`,
  ];
  const sketch: Sketch = { id, told, links, ground, pairs, courses: [], draft: true };
  const poses = [
    pose(
      sketch,
      turned,
      (name) => known.get(name),
      (name) => angleOf(find(own, ["assembly", name, "angle"]), dimensions),
    ),
  ];
  sketch.courses = [{ name: "", unit: "rad", range: "", values: [0], start: 0, poses }];
  return sketch;
}

// Angles are those that are known, of a block that of its guide, else as the assembly says; places
// follow from the pairs, from the ground on.
function pose(
  { links, pairs }: Sketch,
  turned: number[],
  known: (name: string) => Stance | undefined,
  assembled: (name: string) => number | null,
): number[] {
  const all: number[] = links.flatMap(({ name }, index) => {
    const stance = known(name);
    if (stance) return stance;
    const guided = pairs.findIndex(
      (pair) => pair.direction !== null && pair.on.link === null && pair.link.link === index,
    );
    const angle = guided >= 0 ? turned[guided]! : (assembled(name) ?? 0);
    return [0, 0, Math.cos(angle), Math.sin(angle)];
  });
  const fixed = new Set<number | null>([null]);
  const hang = (own: End, there: End): boolean => {
    if (own.link === null || fixed.has(own.link) || !fixed.has(there.link)) return false;
    const [x, y] = placed(all, there.link, there.at),
      [u, v] = placed(all, own.link, own.at);
    all[4 * own.link]! += x - u;
    all[4 * own.link + 1]! += y - v;
    fixed.add(own.link);
    return true;
  };
  // Pins before guides, along which a block may be anywhere; then what hangs on nothing.
  const next = (): boolean =>
    pairs.some((pair) => pair.direction === null && (hang(pair.link, pair.on) || hang(pair.on, pair.link))) ||
    pairs.some(
      (pair) => pair.direction !== null && !known(links[pair.link.link ?? 0]!.name) && hang(pair.link, pair.on),
    ) ||
    links.some((_, index) => !fixed.has(index) && fixed.add(index) !== undefined);
  while (next());
  return all;
}

// How the links stand in a position.
export function stances(sketch: Sketch, pose: number[]): Known {
  return new Map(sketch.links.map(({ name }, index) => [name, pose.slice(4 * index, 4 * index + 4) as Stance]));
}
