// The numbers of the text: where they stand, how far they may be moved, how they are written.

import { StateEffect, StateField, type ChangeSpec, type EditorState } from "@codemirror/state";
import { typedNumber } from "./entry";

// A number as the server tells of it; places are those of the text as it is at present.
export interface Field {
  address: string;
  // What it is in words, where its object is named beside it.
  label: string;
  value_at: [number, number];
  number_at: [number, number];
  value: number;
  unit: string;
  quantity: string;
  si: string;
  units: string[];
  bounds: [number | null, number | null];
  included: [boolean, boolean];
  factor: number | null;
  whole: boolean;
}

export const setFields = StateEffect.define<Field[]>();

// They move with the text until the server tells of them anew.
export const fields = StateField.define<Field[]>({
  create: () => [],
  update(all, transaction) {
    for (const effect of transaction.effects) if (effect.is(setFields)) return effect.value;
    if (!transaction.docChanged) return all;
    const { changes } = transaction;
    const place = ([from, to]: [number, number]): [number, number] => [changes.mapPos(from, -1), changes.mapPos(to, 1)];
    return all.map((field) => {
      const number_at = place(field.number_at),
        value_at = place(field.value_at);
      const text = transaction.state.doc.sliceString(number_at[0], number_at[1]);
      const value = text.trim() === "" ? NaN : Number(text);
      return { ...field, number_at, value_at, value: Number.isFinite(value) ? value : field.value };
    });
  },
});

export const fieldOf = (state: EditorState, address: string): Field | undefined =>
  state.field(fields).find((field) => field.address === address);

export interface Span {
  low: number;
  high: number;
  log: boolean;
}

// From the size of a number, within its bounds; logarithmic where it is above zero anyway.
export function spanOf(field: Field): Span {
  const { value, whole } = field,
    size = Math.abs(value),
    factor = field.factor ?? 1;
  const [least, most] = field.bounds.map((bound) => (bound === null ? null : bound / factor));
  const positive = least === 0 && !field.included[0];
  let low = value - (size || 1),
    high = value + (size || 1),
    log = false;
  if (whole) {
    low = 0;
    high = Math.max(10, 2 * value);
  } else if (positive && value > 0) {
    low = value / 10;
    high = value * 10;
    log = true;
  } else if (least !== null && least !== undefined && least >= 0) {
    low = 0;
    high = value > 0 ? 3 * value : 1;
  }
  if (least !== null && least !== undefined && low < least) low = least;
  if (most !== null && most !== undefined && high > most) high = most;
  if (!(high > low)) high = low + 1;
  return { low, high, log };
}

export const shareOf = ({ low, high, log }: Span, value: number): number =>
  Math.min(1, Math.max(0, log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low)));

export function valueAt({ low, high, log }: Span, share: number): number {
  return log ? low * (high / low) ** share : low + (high - low) * share;
}

// A number as text, about as its author wrote the one before it.
export function written(value: number, before: string, whole: boolean, span?: Span): string {
  if (whole) return String(Math.round(value));
  let rounded = Number(value.toPrecision(4));
  if (span && !span.log) {
    const step = 10 ** Math.floor(Math.log10((span.high - span.low) / 500));
    // Of the smallest numbers there are no steps.
    if (step > 0) rounded = Number((Math.round(value / step) * step).toPrecision(6));
  }
  if (rounded === 0) return "0";
  const size = Math.abs(rounded);
  const wide = /e/i.test(before) ? size >= 1e4 || size < 1e-2 : size >= 1e15 || size < 1e-6;
  return (wide ? rounded.toExponential() : String(rounded)).replace("e+", "e");
}

// The change of the text that makes a field what was typed; text: why that cannot be.
export function typed(field: Field, text: string): ChangeSpec | string {
  const given = typedNumber(text);
  if (given.sort !== "number") return given.sort === "wrong" ? given.why : `“${text.trim()}” is not a number.`;
  const { number, unit } = given.entry;
  if (field.whole && !(Number.isInteger(Number(number)) && unit === "")) return "This is a whole number.";
  if (unit === "" || unit === field.unit) return { from: field.number_at[0], to: field.number_at[1], insert: number };
  return { from: field.value_at[0], to: field.value_at[1], insert: JSON.stringify(`${number} ${unit}`) };
}
