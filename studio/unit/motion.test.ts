import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { given, lifted, moved, removed, split } from "../src/motion/edits";
import { levelsOf, placed, segmentsOf, type Motion } from "../src/motion/motion";
import { placeOf, valueAt, xOf, yOf } from "../src/motion/scale";
import type { Place } from "../src/motion/written";
import { Edits, find, parse, plain, Steps } from "../src/tree";
import { applied, inverse } from "./scenes";

const DEGREE = Math.PI / 180;

// A plan over one turn, as a text and as the program says it: rises, returns and dwells at whole
// degrees and millimetres.
const anyPlan = fc
  .tuple(
    fc.uniqueArray(fc.integer({ min: 1, max: 359 }), { minLength: 2, maxLength: 6 }),
    fc.array(fc.integer({ min: 0, max: 40 }), { minLength: 7, maxLength: 7 }),
  )
  .map(([at, levels]) => {
    const places = [0, ...at.sort((a, b) => a - b)];
    return places.map((degrees, k) => ({ degrees, mm: levels[k]! }));
  });
type Stations = { degrees: number; mm: number }[];

function scene(all: Stations): { text: string; place: Place } {
  const law = (k: number) => (all[k]!.mm === all[(k + 1) % all.length]!.mm ? "dwell" : "cycloidal");
  const lines = all.map(
    ({ degrees, mm }, k) => `          { "at": "${degrees} deg", "displacement": "${mm} mm", "motion": "${law(k)}" }`,
  );
  const text = `{
  "objects": {
    "follower": {
      "kind": "follower",
      "position": {
        "plan": { "stations": [
${lines.join(",\n")}
        ], "period": "360 deg" }
      }
    }
  }
}
`;
  const motion: Motion = {
    form: "plan",
    stations: all.map(({ degrees, mm }, k) => ({
      at: degrees * DEGREE,
      displacement: mm * 1e-3,
      part: "",
      law: law(k),
    })),
    phase: 0,
    period: 2 * Math.PI,
    advance: 0,
    range: [0, 2 * Math.PI],
    axis: "rad",
    units: ["m", "m/rad", "m/rad²", "m/rad³"],
    speed: null,
    columns: [],
    peaks: [] as never,
    jumps: [],
  };
  return { text, place: { motion, path: ["objects", "follower", "position", "plan"] } };
}
const stepsOf = (text: string) => new Steps(new Edits(text, parse(text)!));
interface Written {
  at: string;
  displacement: string;
  motion: string;
}
const stationsIn = (text: string): Written[] =>
  plain(find(parse(text)!, ["objects", "follower", "position", "plan", "stations"])!) as Written[];
const degreesOf = (all: Written[]) => all.map((one) => parseFloat(one.at));

describe("acts on a motion made of segments", () => {
  it("a boundary that is moved stays between its neighbours, and all else stays", () => {
    fc.assert(
      fc.property(anyPlan, fc.nat(), fc.integer({ min: -100, max: 500 }), (all, pick, to) => {
        const { text, place } = scene(all),
          k = 1 + (pick % (all.length - 1)),
          steps = stepsOf(text);
        expect(moved(steps, place, k, to * DEGREE, DEGREE)).toBeNull();
        const after = applied(text, steps.changes),
          degrees = degreesOf(stationsIn(after));
        expect(degrees[k]).toBeGreaterThan(degrees[k - 1]!);
        expect(degrees[k]).toBeLessThan(degrees[k + 1] ?? 360);
        expect(degrees.filter((_, i) => i !== k)).toEqual(all.map((one) => one.degrees).filter((_, i) => i !== k));
        expect(steps.changes.length).toBeLessThanOrEqual(1);
        expect(applied(after, inverse(text, steps.changes))).toBe(text);
      }),
    );
  });
  it("a boundary that is moved to where it is leaves the text alone", () => {
    fc.assert(
      fc.property(anyPlan, fc.nat(), (all, pick) => {
        const { text, place } = scene(all),
          k = pick % all.length,
          steps = stepsOf(text);
        moved(steps, place, k, all[k]!.degrees * DEGREE, 0.5 * DEGREE);
        expect(applied(text, steps.changes)).toBe(text);
      }),
    );
  });
  it("a segment split in two and one of them removed has the boundaries of before", () => {
    fc.assert(
      fc.property(anyPlan, fc.nat(), (all, pick) => {
        const { text, place } = scene(all),
          k = pick % all.length,
          steps = stepsOf(text);
        expect(split(steps, place, k)).toBeNull();
        const cut = applied(text, steps.changes),
          degrees = degreesOf(stationsIn(cut));
        expect(degrees).toHaveLength(all.length + 1);
        expect([...degrees].sort((a, b) => a - b)).toEqual(degrees);
        const again = stepsOf(cut);
        const whole: Motion = {
          ...place.motion,
          stations: stationsIn(cut).map((one) => ({
            at: parseFloat(one.at) * DEGREE,
            displacement: parseFloat(one.displacement) * 1e-3,
            part: "",
            law: one.motion,
          })),
        };
        expect(removed(again, { ...place, motion: whole }, k + 1)).toBeNull();
        expect(degreesOf(stationsIn(applied(cut, again.changes)))).toEqual(all.map((one) => one.degrees));
      }),
    );
  });
  it("what stays is a dwell and what does not is none, whatever is done", () => {
    fc.assert(
      fc.property(anyPlan, fc.nat(), fc.constantFrom("removed", "dwell"), (all, pick, act) => {
        const { text, place } = scene(all),
          k = pick % all.length,
          steps = stepsOf(text);
        fc.pre(all.length > 2);
        if (act === "removed") removed(steps, place, k);
        else given(steps, place, k, '"dwell"');
        const made = stationsIn(applied(text, steps.changes));
        made.forEach((one, i) => {
          const next = made[(i + 1) % made.length]!;
          expect(one.motion === "dwell", JSON.stringify(made)).toBe(one.displacement === next.displacement);
        });
      }),
    );
  });
  it("two segments are the fewest", () => {
    const { text, place } = scene([
      { degrees: 0, mm: 0 },
      { degrees: 180, mm: 10 },
    ]);
    expect(removed(stepsOf(text), place, 1)).toContain("two segments");
  });
  it("a level that is lifted takes along what dwells at it", () => {
    fc.assert(
      fc.property(anyPlan, fc.nat(), fc.integer({ min: 50, max: 90 }), (all, pick, mm) => {
        const { text, place } = scene(all),
          groups = levelsOf(place.motion, segmentsOf(place.motion, parse(text)!, place.path, text)),
          group = groups[pick % groups.length]!,
          steps = stepsOf(text);
        expect(lifted(steps, place, group, mm * 1e-3)).toBeNull();
        const made = stationsIn(applied(text, steps.changes)).map((one) => parseFloat(one.displacement));
        made.forEach((level, k) => {
          expect(level).toBeCloseTo(group.includes(k) ? mm : all[k]!.mm, 9);
        });
      }),
    );
  });
});

describe("segments and places", () => {
  it("segments go from station to station around the cycle without a gap", () => {
    fc.assert(
      fc.property(anyPlan, (all) => {
        const { text, place } = scene(all),
          segments = segmentsOf(place.motion, parse(text)!, place.path, text);
        expect(segments).toHaveLength(all.length);
        segments.forEach(({ ends }, k) => {
          expect(ends[1]).toBeGreaterThan(ends[0]);
          const next = segments[k + 1];
          expect(ends[1]).toBeCloseTo(next ? next.ends[0] : segments[0]!.ends[0] + 2 * Math.PI, 12);
        });
        const names = segments.map((one) => one.name);
        expect(new Set(names).size).toBe(names.length);
      }),
    );
  });
  it("a place of the text is drawn within the cycle, whole turns apart", () => {
    fc.assert(
      fc.property(fc.double({ min: -40, max: 40, noNaN: true }), (at) => {
        const { motion } = scene([
          { degrees: 0, mm: 0 },
          { degrees: 180, mm: 10 },
        ]).place;
        const own = placed(motion, at);
        expect(own).toBeGreaterThanOrEqual(-1e-9);
        expect(own).toBeLessThan(2 * Math.PI + 1e-9);
        expect(Math.abs(Math.sin((own - at) / 2))).toBeLessThan(1e-9);
      }),
    );
  });
  it("places and values of the picture are inverse to those of the motion", () => {
    const lane = { name: "", unit: "m", factor: 1, top: 20, height: 80, low: -1, high: 4 },
      frame = { width: 300, height: 200, left: 8, right: 290, range: [0, 6] as [number, number], lanes: [lane] };
    fc.assert(
      fc.property(fc.double({ min: 0, max: 6, noNaN: true }), (at) => {
        expect(placeOf(frame, xOf(frame, at))).toBeCloseTo(at, 9);
        expect(valueAt(lane, yOf(lane, at))).toBeCloseTo(at, 9);
      }),
    );
  });
});
