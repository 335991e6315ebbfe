import { effect, signal } from "@preact/signals";
import fc from "fast-check";
import { expect, it } from "vitest";
import { renew, steady } from "../src/store/steady";

const anyValues = fc.array(fc.oneof(fc.nat(2), fc.array(fc.nat(1), { maxLength: 2 })), { minLength: 1 });

it("a steady value is told once while it says the same", () => {
  fc.assert(
    fc.property(anyValues, (values) => {
      const own = signal<unknown>(values[0]),
        kept = steady(() => own.value),
        told: unknown[] = [],
        end = effect(() => {
          told.push(kept.value);
        });
      for (const one of values.slice(1)) own.value = structuredClone(one);
      end();
      const words = values.map((one) => JSON.stringify(one));
      expect(told.map((one) => JSON.stringify(one))).toEqual(words.filter((one, k) => one !== words[k - 1]));
    }),
  );
});

it("renewing by what says the same keeps the object", () => {
  const own = signal({ a: [1] }),
    before = own.value;
  renew(own, { a: [1] });
  expect(own.value).toBe(before);
  renew(own, { a: [2] });
  expect(own.value).toEqual({ a: [2] });
});
