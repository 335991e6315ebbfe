// Keys in the graph.

import { isInField } from "../keys";
import type { Deeds, Graph } from "./deeds";

// What is added has keys of its own, and buttons have theirs.
const isElsewhere = (target: Element, key: string): boolean =>
  isInField(target) ||
  target.closest("[role=dialog]") !== null ||
  (target.closest("button") !== null && (key === "Enter" || key === " "));

// What a key does at an object, by its id, or elsewhere in the graph; undefined: nothing.
function deedOf(event: KeyboardEvent, { objects, select }: Graph, deeds: Deeds): (() => void) | undefined {
  const { key } = event,
    isControl = event.ctrlKey || event.metaKey,
    target = event.target as SVGElement,
    id = target.closest<SVGElement>("[data-id]")?.dataset.id,
    object = objects.find((one) => one.id === id);
  if (key === "Delete" || key === "Backspace") return deeds.remove;
  if (isControl && key.toLowerCase() === "d") return deeds.duplicate;
  if (isControl && key.toLowerCase() === "a") return () => select(objects.map((one) => one.id));
  if (key === "Enter" || key === " ")
    return () => {
      const address = target.dataset.edge;
      if (address) deeds.setEdge(address);
      else if (object && deeds.joining) deeds.connect(deeds.joining, object, null);
      else if (id) select([id]);
    };
  if (key.toLowerCase() === "c" && id && !isControl) return () => deeds.setJoining(id);
  if (key === "F2" && id)
    return () => {
      select([id]);
      requestAnimationFrame(() => document.getElementById("object-name")?.focus());
    };
  return undefined;
}

export function pressed(event: KeyboardEvent, graph: Graph, deeds: Deeds): void {
  if (isElsewhere(event.target as Element, event.key)) return;
  if (event.key === "Escape") {
    deeds.setRefused("");
    deeds.setJoining(null);
    deeds.setEdge(null);
    deeds.setAdding(false);
    return;
  }
  const deed = deedOf(event, graph, deeds);
  if (!deed) return;
  event.preventDefault();
  deed();
}
