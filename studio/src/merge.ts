// Texts of two sides that were one.

export interface Piece {
  from: number;
  to: number;
  insert: string;
}

// What makes a text another one: the piece that differs.
export function difference(before: string, after: string): Piece {
  const most = Math.min(before.length, after.length);
  let from = 0,
    end = 0;
  while (from < most && before[from] === after[from]) from++;
  while (end < most - from && before[before.length - 1 - end] === after[after.length - 1 - end]) end++;
  return { from, to: before.length - end, insert: after.slice(from, after.length - end) };
}

// The text with the changes of both sides; null: they changed the same place.
export function merged(base: string, own: string, theirs: string): string | null {
  const a = difference(base, own),
    b = difference(base, theirs);
  if ((a.from < b.to && b.from < a.to) || a.from === b.from)
    return own === theirs || own === base ? theirs : theirs === base ? own : null;
  const [first, second] = a.from < b.from ? [a, b] : [b, a];
  return (
    base.slice(0, first.from) + first.insert + base.slice(first.to, second.from) + second.insert + base.slice(second.to)
  );
}
