import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { BOX, boxes, freeName, heightOf, ownerOf, portAt, within, type Outline } from "../src/graph";

const object = (id: string, drivers: string[]): Outline => ({
  id,
  kind: "rocker",
  from: "",
  detail: "",
  open: false,
  inputs: drivers.map((driver, k) => ({ name: `input ${k}`, address: `${id}.inputs.${k}`, output: driver })),
  outputs: [{ address: id, coordinate: "turning" }],
});
// Objects driven by any others, circles and what is not there among them.
const anyGraph = fc.array(fc.array(fc.integer({ min: -1, max: 14 }), { maxLength: 3 }), { maxLength: 14 }).map((all) =>
  all.map((drivers, k) =>
    object(
      `o${k}`,
      drivers.map((one) => `o${one}.end`),
    ),
  ),
);
// Each is driven by those before it alone.
const anyFlow = fc
  .array(fc.array(fc.nat(), { maxLength: 3 }), { maxLength: 14 })
  .map((all) => all.map((drivers, k) => object(`o${k}`, k ? drivers.map((one) => `o${one % k}`) : [])));

describe("the graph of a mechanism", () => {
  it("has a box of every object, none over another", () => {
    fc.assert(
      fc.property(anyGraph, (objects) => {
        const all = boxes(objects);
        expect(all.map((one) => one.object.id)).toEqual(objects.map((one) => one.id));
        for (const [k, a] of all.entries())
          for (const b of all.slice(k + 1)) {
            const isApart =
              a.x + BOX.width <= b.x || b.x + BOX.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
            expect(isApart, `${a.object.id} and ${b.object.id}`).toBe(true);
          }
      }),
    );
  });
  it("flows from left to right where nothing goes in circles", () => {
    fc.assert(
      fc.property(anyFlow, (objects) => {
        const at = new Map(boxes(objects).map((one) => [one.object.id, one]));
        for (const { id, inputs } of objects)
          for (const { output } of inputs) expect(at.get(ownerOf(output))!.x).toBeLessThan(at.get(id)!.x);
      }),
    );
  });
  it("has its ports on its boxes", () => {
    fc.assert(
      fc.property(anyGraph, (objects) => {
        for (const box of boxes(objects)) {
          expect(box.height).toBe(heightOf(box.object));
          box.object.inputs.forEach((_, k) => {
            const { x, y } = portAt(box, "in", k);
            expect(x).toBe(box.x);
            expect(y).toBeGreaterThan(box.y);
            expect(y).toBeLessThan(box.y + box.height);
          });
        }
      }),
    );
  });
  it("is drawn where it is in sight, and all of it in a large window", () => {
    fc.assert(
      fc.property(anyGraph, (objects) => {
        const all = boxes(objects),
          large = { left: -1e9, top: -1e9, right: 1e9, bottom: 1e9 };
        expect(within(all, large).size).toBe(all.length);
        for (const { object, x, y } of all)
          expect(within(all, { left: x, top: y, right: x + 1, bottom: y + 1 }).has(object.id)).toBe(true);
      }),
    );
  });
  it("of a chain of 20 000 objects is drawn too", () => {
    const chain = Array.from({ length: 20_000 }, (_, k) => object(`o${k}`, k ? [`o${k - 1}`] : []));
    expect(boxes(chain).at(-1)!.x).toBeGreaterThan(1e6);
  });
});

it("a free name is none that is taken, and the wanted one where it can be", () => {
  fc.assert(
    fc.property(fc.array(fc.stringMatching(/^a(_\d)?$/)), (taken) => {
      const name = freeName("a", taken);
      expect(taken).not.toContain(name);
      if (!taken.includes("a")) expect(name).toBe("a");
    }),
  );
});
