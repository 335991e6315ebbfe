// The mechanism's graph as it is drawn: columns follow the flow of motion, rows spread what hangs
// on the same driver.

export interface Input { name: string; address: string; output: string }
export interface Output { address: string; coordinate: "turning" | "sliding" | null }
export interface Outline { id: string; kind: string; from: string; detail: string; inputs: Input[]; open: boolean; outputs: Output[] }

export const BOX = { width: 150, head: 58, port: 17 };
const COLUMN = 204, GAP = 24;

export interface Box { object: Outline; x: number; y: number; height: number }

// The object that a reference names.
export const ownerOf = (reference: string): string => reference.split(".")[0]!;

export function heightOf({ inputs, outputs, open }: Outline): number {
  return BOX.head + BOX.port * Math.max(0, inputs.length + (open ? 1 : 0) - 2, outputs.length - 2);
}

// Places of ports along the side of a box.
export function portAt(box: Box, side: "in" | "out", index: number): { x: number; y: number } {
  const count = side === "in" ? box.object.inputs.length + (box.object.open ? 1 : 0) : box.object.outputs.length;
  const pitch = Math.min(24, (box.height - 14) / Math.max(1, count));
  return { x: box.x + (side === "in" ? 0 : BOX.width), y: box.y + box.height / 2 + (index - (count - 1) / 2) * pitch };
}

export function boxes(objects: Outline[]): Box[] {
  const known = new Map(objects.map((one) => [one.id, one]));
  const column = new Map<string, number>(), busy = new Set<string>();
  const depth = (id: string): number => {
    const there = column.get(id), object = known.get(id);
    // A circle is drawn as far as it goes.
    if (there !== undefined || !object || busy.has(id)) return there ?? -1;
    busy.add(id);
    const found = 1 + Math.max(-1, ...object.inputs.map((input) => depth(ownerOf(input.output))));
    busy.delete(id);
    column.set(id, found);
    return found;
  };
  for (const { id } of objects) depth(id);
  const followers = new Map<string, Outline[]>(), roots: Outline[] = [];
  for (const object of objects) {
    const first = object.inputs.map((input) => ownerOf(input.output)).find((id) => known.has(id) && column.get(id)! < column.get(object.id)!);
    if (first === undefined) roots.push(object); else followers.set(first, [...(followers.get(first) ?? []), object]);
  }
  const top = new Map<string, number>();
  let next = 0;
  // What an object's followers take, the object in the middle of them.
  const place = (object: Outline): number => {
    const own = followers.get(object.id) ?? [], height = heightOf(object);
    if (!own.length) { top.set(object.id, next); next += height + GAP; return top.get(object.id)! + height / 2; }
    const middles = own.map(place), middle = (middles[0]! + middles.at(-1)!) / 2;
    top.set(object.id, middle - height / 2);
    next = Math.max(next, middle + height / 2 + GAP);
    return middle;
  };
  roots.forEach(place);
  return objects.map((object) => ({ object, x: COLUMN * column.get(object.id)!, y: top.get(object.id) ?? 0, height: heightOf(object) }));
}

// A name that is free.
export function freeName(wanted: string, taken: Iterable<string>): string {
  const all = new Set(taken);
  if (!all.has(wanted)) return wanted;
  let number = 2;
  while (all.has(`${wanted}_${number}`)) number++;
  return `${wanted}_${number}`;
}
