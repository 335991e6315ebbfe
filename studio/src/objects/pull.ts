// A connection that is dragged from an output to an input, or the other way.

import { useState } from "preact/hooks";
import type { Outline } from "../graph";
import type { Deeds } from "./deeds";
import type { Sight } from "./view";

interface Place {
  x: number;
  y: number;
}
export interface Pull extends Place {
  output: string | null;
  input: string | null;
  ends: Place;
}
export type Begin = (event: PointerEvent, output: string | null, input: string | null, ends: Place) => void;

// How far a drag goes to be one (pixels).
const FAR = 12;

export function usePull(objects: Outline[], { svg, placeOf, now }: Sight, { connect, release, setRefused }: Deeds) {
  const [pull, setPull] = useState<Pull | null>(null);
  const begin: Begin = (event, output, input, ends) => {
    event.stopPropagation();
    event.preventDefault();
    setRefused("");
    svg.current!.setPointerCapture(event.pointerId);
    setPull({ output, input, ends, ...placeOf(event) });
  };
  const move = (event: PointerEvent) => {
    if (pull) setPull({ ...pull, ...placeOf(event) });
  };
  const drop = (event: PointerEvent) => {
    if (!pull) return;
    setPull(null);
    const there = placeOf(event),
      isFar = Math.hypot(there.x - pull.ends.x, there.y - pull.ends.y) * now.k > FAR;
    const under = document.elementFromPoint(event.clientX, event.clientY),
      id = under?.closest<SVGElement>("[data-id]")?.dataset.id,
      object = objects.find((one) => one.id === id);
    if (pull.output !== null) {
      if (object) connect(pull.output, object, under?.closest<SVGElement>("[data-input]")?.dataset.input ?? null);
      else if (isFar) setRefused(`Nothing is connected: drop ${pull.output} on an input.`);
      return;
    }
    const [owner] = pull.input!.split("."),
      output = under?.closest<SVGElement>("[data-output]")?.dataset.output ?? object?.id,
      target = objects.find((one) => one.id === owner);
    if (output && target) connect(output, target, pull.input);
    else if (!object && target?.inputs.some((one) => one.address === pull.input && one.output !== ""))
      release(pull.input!);
    else if (isFar) setRefused(`Nothing is connected: drop this input of ${owner} on an output.`);
  };
  return { pull, begin, move, drop, cancel: () => setPull(null) };
}
