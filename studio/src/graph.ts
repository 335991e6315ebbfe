// The mechanism's graph as it is drawn: columns follow the flow of motion, rows spread what hangs
// on the same driver.

export interface Input {
  name: string;
  address: string;
  output: string;
}
export interface Output {
  address: string;
  coordinate: "turning" | "sliding" | null;
}
export interface Outline {
  id: string;
  kind: string;
  from: string;
  detail: string;
  inputs: Input[];
  open: boolean;
  outputs: Output[];
}

export const BOX = { width: 150, head: 58, port: 17 };
const COLUMN = 204,
  GAP = 24;

export interface Box {
  object: Outline;
  x: number;
  y: number;
  height: number;
}

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

// How far each object is from what drives nothing before it.
function columnsOf(objects: Outline[], known: Map<string, Outline>): Map<string, number> {
  const column = new Map<string, number>(),
    busy = new Set<string>();
  const driversOf = (id: string): string[] =>
    known
      .get(id)!
      .inputs.map((input) => ownerOf(input.output))
      .filter((one) => known.has(one));
  for (const { id: first } of objects) {
    const waiting = [first];
    while (waiting.length) {
      const id = waiting.at(-1)!,
        drivers = driversOf(id);
      if (column.has(id)) {
        waiting.pop();
        continue;
      }
      // A circle is drawn as far as it goes.
      const open = busy.has(id) ? [] : drivers.filter((one) => !column.has(one) && !busy.has(one));
      busy.add(id);
      if (open.length) {
        waiting.push(...open.reverse());
        continue;
      }
      column.set(id, 1 + Math.max(-1, ...drivers.map((one) => column.get(one) ?? -1)));
      waiting.pop();
    }
  }
  return column;
}

// Those that a part of the drawing has, and what lies around it by a margin.
export function within(
  all: Box[],
  { left, top, right, bottom }: { left: number; top: number; right: number; bottom: number },
): Set<string> {
  const margin = BOX.width,
    inside = all.filter(
      ({ x, y, height }) =>
        x < right + margin && x + BOX.width > left - margin && y < bottom + margin && y + height > top - margin,
    );
  return new Set(inside.map((box) => box.object.id));
}

export function boxes(objects: Outline[]): Box[] {
  const known = new Map(objects.map((one) => [one.id, one]));
  const column = columnsOf(objects, known);
  const followers = new Map<string, Outline[]>(),
    roots: Outline[] = [];
  for (const object of objects) {
    const first = object.inputs
      .map((input) => ownerOf(input.output))
      .find((id) => known.has(id) && column.get(id)! < column.get(object.id)!);
    const own = first === undefined ? roots : (followers.get(first) ?? []);
    own.push(object);
    if (first !== undefined) followers.set(first, own);
  }
  const top = new Map<string, number>();
  let next = 0;
  // What an object's followers take, the object in the middle of them: followers first, on a
  // stack of their own, since chains are long.
  const middleOf = (object: Outline): number => top.get(object.id)! + heightOf(object) / 2;
  const place = (object: Outline): void => {
    const own = followers.get(object.id) ?? [],
      height = heightOf(object);
    if (!own.length) {
      top.set(object.id, next);
      next += height + GAP;
      return;
    }
    const middle = (middleOf(own[0]!) + middleOf(own.at(-1)!)) / 2;
    top.set(object.id, middle - height / 2);
    next = Math.max(next, middle + height / 2 + GAP);
  };
  const waiting = [...roots].reverse().map((object) => ({ object, isOpen: false }));
  for (let at: (typeof waiting)[number] | undefined; (at = waiting.pop()); ) {
    if (at.isOpen) {
      place(at.object);
      continue;
    }
    waiting.push({ object: at.object, isOpen: true });
    for (const one of [...(followers.get(at.object.id) ?? [])].reverse()) waiting.push({ object: one, isOpen: false });
  }
  return objects.map((object) => ({
    object,
    x: COLUMN * column.get(object.id)!,
    y: top.get(object.id) ?? 0,
    height: heightOf(object),
  }));
}

// A name that is free.
export function freeName(wanted: string, taken: Iterable<string>): string {
  const all = new Set(taken);
  if (!all.has(wanted)) return wanted;
  let number = 2;
  while (all.has(`${wanted}_${number}`)) number++;
  return `${wanted}_${number}`;
}
