// What is done to a motion made of segments. The acts work on its stations; `written.ts` brings what
// they make of them into the text, and leaves all else of it as it is.

import type { Edits, Steps } from "../tree";
import { DEFAULT_LAW, isDwell, open, round, segmentsOf, unitOf, type Motion, type Segment } from "./motion";
import { DWELL, written, type Own, type Place } from "./written";

const LAW = JSON.stringify(DEFAULT_LAW);

const segmentsIn = (edits: Edits, { motion, path }: Place): Segment[] =>
  segmentsOf(motion, edits.root, path, edits.text);
function ownIn(edits: Edits, place: Place): Own[] {
  const segments = segmentsIn(edits, place);
  // No segment begins at the end of a plan that does not repeat.
  return open(place.motion).map((station, k) => ({ ...station, law: segments[k]?.law ?? "" }));
}

// ---- acts: what cannot be done is said

// A boundary at another place, between its neighbours.
export function moved(steps: Steps, place: Place, station: number, at: number, least: number): string | null {
  const { motion } = place,
    all = ownIn(steps.edits, place),
    { period } = motion,
    count = all.length;
  const before = all[station - 1]?.at ?? (period === null ? -Infinity : all[count - 1]!.at - period);
  const after = all[station + 1]?.at ?? (period === null ? Infinity : all[0]!.at + period);
  all[station]!.at = Math.min(after - least, Math.max(before + least, at));
  return written(steps, place, all);
}

// Stations at another level, all by the same.
export function lifted(steps: Steps, place: Place, group: number[], level: number): string | null {
  const all = ownIn(steps.edits, place),
    before = all[group[0]!]!.displacement;
  if (place.motion.form === "cam" && Math.abs(level) < 1e-12) return "A cam needs a lift.";
  // Over the end of a cycle that gains some displacement they differ by that.
  for (const k of group)
    all[k]!.displacement = all[k]!.displacement === before ? level : all[k]!.displacement + level - before;
  return written(steps, place, all);
}

// A segment in two: what goes from rest to rest comes to rest between them.
export function split(steps: Steps, place: Place, index: number): string | null {
  const all = ownIn(steps.edits, place),
    segment = segmentsIn(steps.edits, place)[index]!,
    [from, to] = segment.ends;
  const { factor } = unitOf(place.motion.axis),
    middle = (from + to) / 2,
    whole = Math.round(middle / factor) * factor;
  const at = place.motion.axis === "rad" && whole > from && whole < to ? whole : middle;
  const displacement = round((segment.levels[0] + segment.levels[1]) / 2);
  all.splice(index + 1, 0, { at, displacement, part: "", law: segment.law });
  return written(steps, place, all);
}

// Without a segment: the one before it goes on to its end.
export function removed(steps: Steps, place: Place, index: number): string | null {
  const all = ownIn(steps.edits, place);
  if (all.length <= 2) return "A motion has two segments at least.";
  all.splice(index, 1);
  return written(steps, place, fitting(all, place.motion));
}

// Another motion of a segment. A dwell takes what comes after it to its own level.
export function given(steps: Steps, place: Place, index: number, law: string): string | null {
  const all = ownIn(steps.edits, place),
    { period, advance } = place.motion,
    { levels, to } = segmentsIn(steps.edits, place)[index]!;
  all[index]!.law = law;
  if (law === DWELL) {
    const last = all.length - 1,
      level = to > index ? levels[0] : levels[0] - advance;
    for (let k = to, count = 0; count < last; count++, k = (k + 1) % all.length) {
      all[k]!.displacement = k >= to ? level : level - advance;
      if (all[k]!.law !== DWELL || k === index || (period === null && k === last)) break;
    }
  }
  return written(steps, place, fitting(all, place.motion));
}

// Dwells stay at their level, and what stays is a dwell.
function fitting(all: Own[], { period, advance }: Motion): Own[] {
  return all.map((one, k) => {
    const next = all[k + 1] ?? (period === null ? undefined : { displacement: all[0]!.displacement + advance });
    if (!next) return one;
    const stays = Math.abs(next.displacement - one.displacement) < 1e-12;
    return stays === isDwell(one) || (stays && one.law === '"smooth"') ? one : { ...one, law: stays ? DWELL : LAW };
  });
}
