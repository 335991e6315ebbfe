// Where a linkage is seen: the values of its inputs, and the position there.

import { useRef, useState } from "preact/hooks";
import { baseOf, basePose, leads, poseAt, type Sketch } from "../linkage";
import type { Sketches } from "./sketches";

export interface Place {
  // Values of the inputs.
  values: number[];
  pose: number[] | null;
  // Shows it at values of the inputs; null: where it is put together.
  see: (values: number[] | null) => void;
}

// `isHeld`: it is drawn on, where the assembly holds.
export function usePlace({ place, isSettled }: Sketches, sketch: Sketch | undefined, isHeld: boolean): Place {
  const [at, setAt] = useState<number[] | null>(null),
    base = useRef<number[] | null>(null),
    stood = useRef<number[] | null>(null);
  const own = !isHeld && at?.length === sketch?.courses.length ? at : null,
    values = own ?? (sketch ? baseOf(sketch) : []),
    there = sketch ? poseAt(sketch, values) : null;
  // Where no course goes there yet, it is drawn as it stood.
  const pose = there !== undefined ? there : isSettled() && sketch ? basePose(sketch) : stood.current;
  stood.current = pose;
  // Where the courses do not lead there, such are asked for that do.
  const see = (next: number[] | null) => {
    setAt(next);
    if (!next) base.current = null;
    else if (sketch && !leads(base.current ?? baseOf(sketch), next)) base.current = next;
    place.current = base.current && sketch ? JSON.stringify({ [sketch.id]: base.current }) : "";
  };
  return { values, pose, see };
}
