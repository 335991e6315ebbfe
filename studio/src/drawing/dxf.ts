// The lines of a DXF file, as one path to lie below the drawing.
//
// The file is read by `dxf`; blocks are put in their places here. What is not a line (texts, hatches,
// dimensions) is left out, and said to be.

import applyTransforms, { type Transform } from "dxf/src/applyTransforms";
import entityToPolyline, { type Entity } from "dxf/src/entityToPolyline";
import parseString, { type Parsed } from "dxf/src/parseString";
import type { Point } from "../linkage";

export interface Plan {
  // Of an SVG, from the upper left corner, in units of the file.
  path: string;
  width: number;
  height: number;
  // Metres in a unit of the file; null: it names none.
  unit: number | null;
  // Kinds that are not drawn, with how many there are.
  without: Map<string, number>;
}

const INCH = 0.0254;
// Of `$INSUNITS`.
const UNITS: Record<number, number> = {
  ...{ 1: INCH, 2: 0.3048, 8: 1e-6 * INCH, 9: 1e-3 * INCH, 10: 0.9144 },
  ...{ 4: 1e-3, 5: 1e-2, 6: 1, 7: 1e3, 12: 1e-9, 13: 1e-6, 14: 0.1 },
};
const LINES = ["LINE", "LWPOLYLINE", "POLYLINE", "CIRCLE", "ARC", "ELLIPSE", "SPLINE"],
  // Those that say nothing that can be seen.
  UNSEEN = ["VIEWPORT", "ATTDEF", "POINT"];
// More than this no browser moves smoothly.
const MOST = 200_000,
  DEEPEST = 16;

class TooLarge extends Error {}

// An entity's corners in its own block; null: something of it is no number, or cannot be meant.
function cornersOf(entity: Entity): Point[] | null {
  const { startAngle = 0, endAngle = 0, degree = 3 } = entity,
    isEndless = Math.max(Math.abs(startAngle), Math.abs(endAngle)) > 100 || degree > 25;
  if (entity.polygonMesh || entity.polyfaceMesh || isEndless) return null;
  try {
    const corners = entityToPolyline(entity);
    // That of the others is regarded by the reader.
    const isMirrored = entity.type.endsWith("POLYLINE") && entity.extrusionZ === -1,
      own = isMirrored ? applyTransforms(corners, [{ scaleX: -1 }]) : corners;
    return own.length > 1 && own.every((corner) => corner.every(Number.isFinite)) ? own : null;
  } catch {
    return null;
  }
}

class Reader {
  readonly without = new Map<string, number>();
  private readonly blocks: Map<string, Parsed["blocks"][number]>;
  private count = 0;

  constructor(private readonly file: Parsed) {
    this.blocks = new Map(file.blocks.map((block) => [block.name, block]));
  }

  lines(entities: Entity[], depth = 0): Point[][] {
    if (depth > DEEPEST) throw new TooLarge();
    return entities.flatMap((entity) => {
      if (entity.paperSpace || entity.visible === false || this.isOff(entity.layer)) return [];
      if (entity.type === "INSERT") return this.inserted(entity, depth);
      const corners = LINES.includes(entity.type) ? cornersOf(entity) : null;
      if (!corners) return this.leave(entity.type);
      this.add(corners.length);
      return [corners];
    });
  }

  // A block where it is put, once or in rows and columns.
  private inserted(entity: Entity & Transform, depth: number): Point[][] {
    const block = this.blocks.get(entity.block ?? "");
    this.add(1);
    if (!block) return this.leave("INSERT");
    const base = { x: -(block.x ?? 0), y: -(block.y ?? 0) },
      own = this.lines(block.entities ?? [], depth + 1),
      size = own.reduce((sum, line) => sum + line.length, 0),
      { rowCount = 1, columnCount = 1, rowSpacing = 0, columnSpacing = 0, rotation = 0 } = entity;
    if (![rowCount, columnCount].every((one) => one >= 0)) return this.leave("INSERT");
    this.add(size * Math.max(rowCount * columnCount - 1, 0));
    const made: Point[][] = [],
      [cos, sin] = [Math.cos((rotation * Math.PI) / 180), Math.sin((rotation * Math.PI) / 180)];
    for (let row = 0; size && row < rowCount; row++)
      for (let column = 0; column < columnCount; column++) {
        const [u, v] = [column * columnSpacing, row * rowSpacing],
          x = (entity.x ?? 0) + u * cos - v * sin,
          y = (entity.y ?? 0) + u * sin + v * cos;
        for (const line of own) made.push(applyTransforms(line, [base, { ...entity, x, y }]));
      }
    return made;
  }

  private leave(type: string): [] {
    if (!UNSEEN.includes(type)) this.without.set(type, (this.without.get(type) ?? 0) + 1);
    return [];
  }

  private add(count: number): void {
    this.count += count;
    if (this.count > MOST) throw new TooLarge();
  }

  private isOff(layer: string | undefined): boolean {
    const own = this.file.tables.layers[layer ?? ""];
    return own !== undefined && ((own.colorNumber ?? 0) < 0 || ((own.flags ?? 0) & 1) === 1);
  }
}

// The file's groups; text: why it is none.
function parsed(text: string, name: string): Parsed | string {
  if (text.startsWith("AutoCAD Binary DXF")) return `${name} is a binary DXF file: save it as ASCII DXF.`;
  if (/^AC10\d\d/.test(text)) return `${name} is a DWG file: save it as DXF.`;
  const lines = text.split(/\r\n|\r|\n/).map((line) => line.trim());
  if (!lines.includes("SECTION") || !lines.includes("ENTITIES"))
    return `${name} is no DXF file: it has no section of entities.`;
  if (!lines.includes("ENDSEC") || !lines.slice(-3).includes("EOF"))
    return `${name} ends in the middle: save it again.`;
  try {
    return parseString(lines.join("\n"));
  } catch {
    return `${name} cannot be read as DXF.`;
  }
}

// Text: why nothing of it can be shown.
export function planOf(text: string, name: string): Plan | string {
  const file = parsed(text, name);
  if (typeof file === "string") return file;
  const reader = new Reader(file);
  try {
    const lines = reader.lines(file.entities);
    const shape = pathOf(lines),
      size = Math.max(shape.width, shape.height);
    if (!(size > 0 && Number.isFinite(size))) return `${name} has no lines, arcs or polylines.`;
    return { ...shape, unit: UNITS[file.header.insUnits ?? 0] ?? null, without: reader.without };
  } catch (error) {
    if (error instanceof TooLarge) return `${name} is too large: at most ${MOST} corners of lines are shown.`;
    throw error;
  }
}

function pathOf(lines: Point[][]): Pick<Plan, "path" | "width" | "height"> {
  const ends = { left: Infinity, bottom: Infinity, right: -Infinity, top: -Infinity };
  for (const [x, y] of lines.flat()) {
    ends.left = Math.min(ends.left, x);
    ends.right = Math.max(ends.right, x);
    ends.bottom = Math.min(ends.bottom, y);
    ends.top = Math.max(ends.top, y);
  }
  const digits = (value: number) => String(Number(value.toPrecision(7)));
  return {
    path: lines
      .map((line) => `M${line.map(([x, y]) => `${digits(x - ends.left)} ${digits(ends.top - y)}`).join("L")}`)
      .join(""),
    width: ends.right - ends.left,
    height: ends.top - ends.bottom,
  };
}
