// Keys of the whole window: save, undo, redo.

import { isUnfinished, take } from "../keys";
import { request } from "./file";
import { places } from "./places";
import { isHome } from "./views";

const REQUESTS: Record<string, (event: KeyboardEvent) => "undo" | "redo" | "save"> = {
  z: (event) => (event.shiftKey ? "redo" : "undo"),
  y: () => "redo",
  s: () => "save",
};

function pressed(event: KeyboardEvent): void {
  // The text has keys of its own.
  if (isHome.peek() || !(event.ctrlKey || event.metaKey) || places.text.contains(event.target as Node)) return;
  const type = REQUESTS[event.key.toLowerCase()]?.(event);
  // A field takes back what is typed in it; what is saved has it.
  if (!type || (type !== "save" && isUnfinished(event.target))) return;
  event.preventDefault();
  if (type === "save") take(event.target);
  request({ type });
}

export const hearKeys = (): void => addEventListener("keydown", pressed);
