// What a schema of the program is for a form.
//
// A form is made from the schema alone: a property that the program declares is in it, with
// unit and help.

import { typedNumber } from "./entry";
import type { Guide, Schema } from "./schema";

export interface Group {
  sort: "group";
  properties: Record<string, Schema>;
  required: string[];
  variants: string[];
}
export type Shape =
  | { sort: "choice"; options: string[] }
  | { sort: "flag" }
  | { sort: "scalar"; numbers: boolean; words: string[]; free: boolean; units: string[]; whole: boolean }
  | Group
  | { sort: "map"; inner: Schema; pattern: string }
  | { sort: "list"; inner: Schema; compound: boolean }
  | { sort: "either"; words: string[]; scalar: Shape | null; compound: Schema };

const isCompound = (schema: Schema): boolean =>
  schema.type === "object" ||
  schema.type === "array" ||
  (schema.anyOf ?? schema.oneOf ?? []).some((one: Schema) => isCompound(one) || one.$ref);

// Units out of the examples: "1 N m/rad".
const unitsOf = (schema: Schema): string[] =>
  (schema.examples ?? [])
    .filter((one): one is string => typeof one === "string" && /^1 /.test(one))
    .map((one) => one.slice(2));

export function shapeOf(guide: Guide, given: Schema | undefined): Shape {
  const schema = guide.resolved(given),
    alternatives: Schema[] = (schema.anyOf ?? schema.oneOf ?? []).map((one: Schema) => guide.resolved(one));
  if (Array.isArray(schema.enum)) return { sort: "choice", options: schema.enum.map(String) };
  if (schema.type === "boolean") return { sort: "flag" };
  if (schema.type === "array")
    return {
      sort: "list",
      inner: schema.items ?? {},
      compound:
        !!schema.items &&
        !schema.prefixItems &&
        isCompound(guide.resolved(schema.items)) &&
        guide.resolved(schema.items).type === "object",
    };
  if (schema.type === "object" && schema.properties) return groupOf(guide, schema);
  if (schema.type === "object")
    return {
      sort: "map",
      inner: typeof schema.additionalProperties === "object" ? schema.additionalProperties : {},
      pattern: schema.propertyNames?.pattern ?? "",
    };
  const compound = alternatives.find(isCompound),
    words = alternatives.flatMap((one) => (Array.isArray(one.enum) ? one.enum.map(String) : []));
  if (compound) {
    const plain = alternatives.filter((one) => !isCompound(one) && !Array.isArray(one.enum));
    const scalar = plain.length ? shapeOf(guide, { ...schema, anyOf: plain, oneOf: undefined }) : null;
    return { sort: "either", words, scalar, compound };
  }
  const all = alternatives.length ? alternatives : [schema];
  const numbers = all.some((one) => one.type === "number" || one.type === "integer");
  return {
    sort: "scalar",
    numbers,
    words,
    free: all.some((one) => one.type === "string" && !one.enum),
    units: unitsOf(schema),
    whole: numbers && all.every((one) => one.type !== "number"),
  };
}

export function groupOf(guide: Guide, given: Schema): Group {
  const schema = guide.resolved(given);
  // One of several properties that exclude each other.
  const one = [...(schema.allOf ?? []), ...(schema.then?.allOf ?? [])]
    .map((all: Schema) => all.oneOf ?? all.anyOf)
    .find((list: unknown) => Array.isArray(list) && list.every((item: Schema) => item.required?.length === 1));
  return {
    sort: "group",
    properties: schema.properties ?? {},
    required: [...(schema.required ?? []), ...(schema.then?.required ?? [])],
    variants: (one ?? []).flatMap((item) => item.required?.slice(0, 1) ?? []),
  };
}

// What was typed, as JSON: a number where it is one and may be one; or why it cannot be written.
export function literal(shape: Shape, typed: string): { json: string } | { why: string } {
  const text = typed.trim(),
    given = shape.sort === "scalar" && shape.numbers ? typedNumber(text) : null;
  if (given?.sort === "wrong") return { why: given.why };
  if (given?.sort !== "number") return { json: JSON.stringify(text) };
  const { number, unit } = given.entry;
  return { json: unit ? JSON.stringify(`${number} ${unit}`) : number };
}
