// What the fields of a form have in common: the text that they edit, and their place in it.

import type { ComponentChildren, ComponentType } from "preact";
import type { Fault } from "../objects/box";
import type { Guide, Schema } from "../schema";
import { address, type Change, type Edits, type Step, type Value } from "../tree";

export interface Desk {
  guide: Guide;
  root: Value;
  text: string;
  faults: Fault[];
  // Outputs of objects that may drive others.
  outputs: string[];
  edit: (make: (edits: Edits) => Change[]) => boolean;
}

export interface Place {
  desk: Desk;
  path: Step[];
  write: (path: Step[], json: string) => void;
}
export interface FieldProps extends Place {
  schema: Schema;
  name: string;
  required: boolean;
  remove: boolean;
}
// Fields within fields.
export interface Nesting {
  Nested: ComponentType<FieldProps>;
}
export type Children = ComponentChildren;

export const shown = (name: string): string => name.replaceAll("_", " ");
export const helpOf = (schema: Schema): string => String(schema.description ?? "");

export const faultsAt = (desk: Desk, path: Step[]): Fault[] => {
  const own = address(path);
  return desk.faults.filter((fault) => fault.path === own);
};
export const faultsIn = (desk: Desk, path: Step[]): Fault[] => {
  const own = address(path);
  return desk.faults.filter(
    (fault) => fault.path === own || fault.path.startsWith(`${own}.`) || fault.path.startsWith(`${own}[`),
  );
};
