// What the program finds in the text: faults, objects with their ports, the schema.

import { computed, signal } from "@preact/signals";
import type { Outline } from "../graph";
import type { Parts } from "../kinds";
import type { Heard } from "../messages";
import type { Fault } from "../objects/box";
import type { Guide } from "../schema";
import { renew } from "./steady";
import { editor } from "./text";

// A fault with its place in the text.
export interface Found extends Fault {
  from: number;
  to: number;
}

export const faults = signal<Found[]>([]);
export const errorCount = computed(() => faults.value.filter((fault) => fault.severity === "error").length);
export const objects = signal<Outline[]>([]);
// Kinds and objects of the catalogue that a scene can be built of.
export const NO_PARTS: Parts = { kinds: [], objects: [] };
export const parts = signal(NO_PARTS);
export const guide = signal<Guide | null>(null);
// The version of the text that was checked last, and whether it has errors.
export const newest = signal(0),
  isFaulty = signal(false);

// Takes what was found in a version; false: the text is another by now.
export function check(message: Heard["checked"]): boolean {
  if (!editor.peek()!.check(message)) return false;
  isFaulty.value = message.faults.some((fault) => fault.severity === "error");
  renew(faults, message.faults);
  // While a number moves nothing of it is another.
  if (message.objects) renew(objects, message.objects);
  newest.value = message.version;
  return true;
}
