import { expect, it } from "vitest";
import { CHOICES, SYSTEMS } from "../src/unit-choices";

// NIST Special Publication 811 (2008), appendix B.8: factors to SI units, to the digits given there.
const NIST: [string, string, number][] = [
  ["m", "in", 2.54e-2],
  ["m/s", "in/s", 2.54e-2],
  ["m/s²", "in/s²", 2.54e-2],
  ["N", "lbf", 4.448222],
  ["N m", "lbf in", 1.129848e-1],
  ["J", "lbf in", 1.129848e-1],
  ["kg", "lb", 4.535924e-1],
  ["kg m²", "lb in²", 2.926397e-4],
  ["N/m", "lbf/in", 1.751268e2],
  ["Pa", "psi", 6.894757e3],
  ["Pa", "bar", 1e5],
  ["rad", "deg", 1.745329e-2],
  ["rad/s", "rpm", 1.047198e-1],
];

it("factors are those of NIST SP 811", () => {
  for (const [si, unit, factor] of NIST) {
    const own = CHOICES[si]?.[1].find(([name]) => name === unit)?.[1];
    expect(Number(own?.toPrecision(7)), `${unit} in ${si}`).toBe(factor);
  }
});

it("every system has a unit for every quantity, and the SI the SI unit", () => {
  for (const [name, units] of Object.entries(SYSTEMS)) {
    expect(Object.keys(units).sort(), name).toEqual(Object.keys(CHOICES).sort());
    for (const [si, unit] of Object.entries(units))
      expect(
        CHOICES[si]![1].map(([one]) => one),
        name,
      ).toContain(unit);
  }
  for (const [si, unit] of Object.entries(SYSTEMS.SI!)) {
    expect(unit).toBe(si);
    expect(CHOICES[si]![1].find(([one]) => one === unit)![1]).toBe(1);
  }
});
