import fc from "fast-check";
import { expect, it } from "vitest";
import { planOf, type Plan } from "../src/drawing/dxf";

// The groups of a file: code and value in turn.
const file = (entities: string, { header = "", blocks = "", tables = "" } = {}): string =>
  [
    `0 SECTION 2 HEADER ${header} 0 ENDSEC`,
    `0 SECTION 2 TABLES ${tables} 0 ENDSEC`,
    `0 SECTION 2 BLOCKS ${blocks} 0 ENDSEC`,
    `0 SECTION 2 ENTITIES ${entities} 0 ENDSEC 0 EOF`,
  ]
    .join(" ")
    .split(/\s+/)
    .join("\r\n");
const shown = (text: string): Plan => {
  const plan = planOf(text, "plan.dxf");
  if (typeof plan === "string") throw new Error(plan);
  return plan;
};
// Corners of a path, from its lower left corner up.
const corners = ({ path, height }: Plan): number[][][] =>
  path
    .slice(1)
    .split("M")
    .map((line) => line.split("L").map((corner) => corner.split(" ").map(Number)))
    .map((line) => line.map(([x, y]) => [x!, height - y!]));
const near = (plan: Plan, expected: number[][][]) => {
  const found = corners(plan);
  expect(found.map((line) => line.length)).toEqual(expected.map((line) => line.length));
  found.forEach((line, k) => {
    line.forEach(([x, y], l) => {
      expect(x).toBeCloseTo(expected[k]![l]![0]!, 4);
      expect(y).toBeCloseTo(expected[k]![l]![1]!, 4);
    });
  });
};
const LINE = "0 LINE 8 0 10 5 20 5 11 25 21 15";

it("lines and polylines lie at their places, upright", () => {
  const closed = "0 LWPOLYLINE 8 0 90 3 70 1 10 5 20 5 10 45 20 5 10 45 20 35",
    old = "0 POLYLINE 8 0 70 0 0 VERTEX 8 0 10 5 20 5 0 VERTEX 8 0 10 15 20 35 0 SEQEND";
  const plan = shown(file(`${LINE} ${closed} ${old}`));
  expect([plan.width, plan.height, plan.unit]).toEqual([40, 30, null]);
  near(plan, [
    [
      [0, 0],
      [20, 10],
    ],
    [
      [0, 0],
      [40, 0],
      [40, 30],
      [0, 0],
    ],
    [
      [0, 0],
      [10, 30],
    ],
  ]);
});

it("corners of arcs, circles and bulges are on their circles", () => {
  const arc = shown(file("0 ARC 8 0 10 100 20 100 40 50 50 0 51 90"));
  expect(arc.width).toBeCloseTo(50, 6);
  for (const [x, y] of corners(arc)[0]!) expect(Math.hypot(x!, y!)).toBeCloseTo(50, 4);
  // Mirrored by its direction of extrusion.
  const mirrored = shown(file("0 ARC 8 0 10 100 20 100 40 50 50 0 51 90 210 0 220 0 230 -1"));
  for (const [x, y] of corners(mirrored)[0]!) expect(Math.hypot(50 - x!, y!)).toBeCloseTo(50, 4);
  const circle = shown(file("0 CIRCLE 8 0 10 1 20 2 40 3"));
  expect([circle.width, circle.height].map((one) => one.toFixed(6))).toEqual(["6.000000", "6.000000"]);
  for (const [x, y] of corners(circle)[0]!) expect(Math.hypot(x! - 3, y! - 3)).toBeCloseTo(3, 4);
  // A bulge of one is a half circle, here below its chord.
  const half = shown(file("0 LWPOLYLINE 8 0 90 2 70 0 10 0 20 0 42 1 10 10 20 0"));
  expect(half.width).toBeCloseTo(10, 6);
  expect(half.height).toBeCloseTo(5, 1);
  for (const [x, y] of corners(half)[0]!) expect(Math.hypot(x! - 5, y! - half.height)).toBeCloseTo(5, 4);
});

it("a mirrored polyline is mirrored", () => {
  const plan = shown(file("0 LWPOLYLINE 8 0 90 2 70 0 210 0 220 0 230 -1 10 0 20 0 10 10 20 5"));
  near(plan, [
    [
      [10, 0],
      [0, 5],
    ],
  ]);
});

it("a block is put in its places: turned, enlarged, in rows, in another block", () => {
  const block = "0 BLOCK 8 0 2 bar 70 0 10 5 20 5 0 LINE 8 0 10 5 20 5 11 15 21 5 0 ENDBLK 8 0",
    outer = "0 BLOCK 8 0 2 pair 70 0 10 1 20 0 0 INSERT 2 bar 10 1 20 0 0 ENDBLK 8 0";
  near(shown(file("0 INSERT 2 bar 10 100 20 50 41 2 42 2 50 90", { blocks: block })), [
    [
      [0, 0],
      [0, 20],
    ],
  ]);
  const rows = shown(file("0 INSERT 2 bar 10 0 20 0 70 2 71 3 44 20 45 4", { blocks: block }));
  expect(corners(rows).map((line) => line[0]!.map((one) => Math.round(one * 1e6) / 1e6))).toEqual([
    [0, 0],
    [20, 0],
    [0, 4],
    [20, 4],
    [0, 8],
    [20, 8],
  ]);
  near(shown(file("0 INSERT 2 pair 10 7 20 7", { blocks: `${block} ${outer}` })), [
    [
      [0, 0],
      [10, 0],
    ],
  ]);
});

it("the unit of the file is that of its header", () => {
  for (const [code, unit] of [
    [0, null],
    [1, 0.0254],
    [2, 0.3048],
    [4, 1e-3],
    [5, 1e-2],
    [6, 1],
    [99, null],
  ] as const)
    expect(shown(file(LINE, { header: `9 $INSUNITS 70 ${code}` })).unit).toBe(unit);
});

it("layers that are off or frozen, and sheets of paper, are not shown; other kinds are counted", () => {
  const tables =
    "0 TABLE 2 LAYER 70 2 0 LAYER 2 off 70 0 62 -7 0 LAYER 2 cold 70 1 62 7 0 LAYER 2 seen 70 0 62 7 0 ENDTAB";
  const entity = (layer: string, more = "") => `0 LINE 8 ${layer} ${more} 10 0 20 0 11 1 21 1`,
    text = "0 TEXT 8 seen 10 0 20 0 40 1 1 word";
  const plan = shown(
    file([entity("seen"), entity("off"), entity("cold"), entity("seen", "67 1"), text, text].join(" "), { tables }),
  );
  expect(corners(plan)).toHaveLength(1);
  expect([...plan.without]).toEqual([["TEXT", 2]]);
});

it("a file that cannot be shown has a word for its reason", () => {
  const word = (text: string) => planOf(text, "bad.dxf");
  expect(word("")).toContain("is no DXF file");
  expect(word("%PDF-1.4")).toContain("is no DXF file");
  expect(word("AutoCAD Binary DXF\r\n\x1a\x00")).toContain("save it as ASCII DXF");
  expect(word("AC1032\x00")).toContain("DWG file");
  expect(word(file(LINE).slice(0, -10))).toContain("ends in the middle");
  expect(word(file("0 TEXT 8 0 10 0 20 0 1 word"))).toContain("has no lines");
  expect(word(file("0 LINE 8 0 10 5 20 5 11 5 21 5"))).toContain("has no lines");
  expect(word(file("0 LINE 8 0 10 abc 20 5 11 25 21 15"))).toContain("has no lines");
  // None of these takes for ever.
  expect(word(file("0 ARC 8 0 10 0 20 0 40 1 50 0 51 1e15"))).toContain("has no lines");
  expect(word(file("0 INSERT 2 bar 10 0 20 0 70 30000 71 30000", { blocks: BAR }))).toContain("too large");
  expect(word(file("0 INSERT 2 bar 10 0 20 0 70 abc", { blocks: BAR }))).toContain("has no lines");
  const own = "0 BLOCK 8 0 2 own 70 0 10 0 20 0 0 INSERT 2 own 10 1 20 1 0 ENDBLK 8 0";
  expect(word(file("0 INSERT 2 own 10 0 20 0", { blocks: own }))).toContain("too large");
  const many = Array.from(
    { length: 12 },
    (_, k) => `0 BLOCK 8 0 2 b${k} 70 0 10 0 20 0 ${`0 INSERT 2 b${k + 1} 10 0 20 0 `.repeat(10)} 0 ENDBLK 8 0`,
  ).join(" ");
  expect(word(file("0 INSERT 2 b0 10 0 20 0", { blocks: many }))).toContain("too large");
});
const BAR = "0 BLOCK 8 0 2 bar 70 0 10 0 20 0 0 LINE 8 0 10 0 20 0 11 1 21 1 0 ENDBLK 8 0";

it("what is not as it should be is shown, or has a word: nothing is thrown", () => {
  const whole = file(
    `${LINE} 0 LWPOLYLINE 8 0 90 2 70 1 10 5 20 5 42 0.5 10 45 20 5 0 CIRCLE 8 0 10 1 20 2 40 3 0 INSERT 2 bar 10 0 20 0
     0 SPLINE 8 0 71 3 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 10 0 20 0 10 1 20 1 10 2 20 1 10 3 20 0`,
    { blocks: BAR, header: "9 $INSUNITS 70 4" },
  ).split("\r\n");
  expect(shown(whole.join("\n")).without.size).toBe(0);
  fc.assert(
    fc.property(
      fc.array(
        fc.tuple(fc.nat(whole.length - 1), fc.constantFrom("", "0", "-1", "1e300", "NaN", "ENDSEC", "BLOCK", "70")),
        {
          minLength: 1,
          maxLength: 4,
        },
      ),
      (changes) => {
        const lines = [...whole];
        for (const [at, value] of changes) lines[at] = value;
        const plan = planOf(lines.join("\n"), "plan.dxf");
        if (typeof plan === "string") expect(plan).toMatch(/^plan\.dxf .*\.$/);
        else expect(plan.path).not.toMatch(/NaN|Infinity/);
      },
    ),
    { numRuns: 300 },
  );
});
