// What is used of `dxf`, which has no types of its own.

declare module "dxf/src/applyTransforms" {
  export interface Transform {
    x?: number;
    y?: number;
    scaleX?: number;
    scaleY?: number;
    // In degrees.
    rotation?: number;
    extrusionZ?: number;
  }
  export default function applyTransforms(line: [number, number][], transforms: Transform[]): [number, number][];
}

declare module "dxf/src/entityToPolyline" {
  export interface Entity {
    type: string;
    layer?: string;
    paperSpace?: number;
    visible?: boolean;
    extrusionZ?: number;
    // Of an ARC or ELLIPSE, in radians.
    startAngle?: number;
    endAngle?: number;
    degree?: number;
    polygonMesh?: boolean;
    polyfaceMesh?: boolean;
    // Of an INSERT.
    block?: string;
    rowCount?: number;
    columnCount?: number;
    rowSpacing?: number;
    columnSpacing?: number;
  }
  export default function entityToPolyline(entity: Entity): [number, number][];
}

declare module "dxf/src/parseString" {
  import type { Entity } from "dxf/src/entityToPolyline";
  export interface Parsed {
    header: { insUnits?: number };
    blocks: { name: string; x?: number; y?: number; entities?: Entity[] }[];
    entities: Entity[];
    tables: { layers: Record<string, { colorNumber?: number; flags?: number }> };
  }
  export default function parseString(text: string): Parsed;
}
