// The segments of a motion as a list: the law of each, and what changes their number.

import { counted, type Motion, type Segment } from "./motion";

interface Props {
  motion: Motion;
  segments: Segment[];
  laws: string[];
  give: (index: number, law: string) => void;
  split: (index: number) => void;
  remove: (index: number) => void;
}

// Motions that are no laws from rest to rest.
const OTHERS = ["dwell", "uniform", "smooth"];
// Stands in the list for a law that the text has in detail.
const OWN = "in detail";

export function Segments({ motion, segments, laws, give, split, remove }: Props) {
  const shown = (at: number) => counted(at - motion.phase, motion.axis),
    level = (value: number) => counted(value, motion.units[0]);
  return (
    <ol class="segments" aria-label="segments of the motion">
      {segments.map(({ name, ends, levels, law }, index) => {
        const own = law.startsWith('"') ? (JSON.parse(law) as string) : OWN,
          known = OTHERS.concat(laws);
        return (
          <li key={index} aria-label={name}>
            <span class="segment-name">
              <b>{name}</b> {shown(ends[0])} to {shown(ends[1])}
              {levels[0] === levels[1] ? `, at ${level(levels[0])}` : `, ${level(levels[0])} to ${level(levels[1])}`}
            </span>
            <select
              aria-label={`motion of ${name}`}
              value={own}
              onChange={(event) => give(index, JSON.stringify(event.currentTarget.value))}
            >
              {!known.includes(own) && (
                <option value={own} disabled>
                  {own}
                </option>
              )}
              {known.map((one) => (
                <option key={one} value={one}>
                  {one.replaceAll("_", " ")}
                </option>
              ))}
            </select>
            <button type="button" aria-label={`split ${name}`} title="split it in two" onClick={() => split(index)}>
              Split
            </button>
            <button
              type="button"
              class="drop"
              aria-label={`remove ${name}`}
              title="remove it: the segment before goes on"
              disabled={segments.length <= 2}
              onClick={() => remove(index)}
            >
              ×
            </button>
          </li>
        );
      })}
    </ol>
  );
}
