// What plot.js, and player.js with picture.js before it, the scripts of all pages of dam, leave for the studio.

interface PlotSource {
  columns: (number | null)[][];
  plots: Record<number, PlotData> | PlotData[];
}
interface PlotAxis {
  name: string;
  unit: string;
  ends: [number, number];
}
interface PlotSeries {
  label: string;
  x: number;
  y: number;
}
interface PlotField {
  x: number[];
  y: number[];
  strip: boolean;
  notes: string[];
}
interface PlotData {
  id: string;
  title: string;
  x: PlotAxis;
  y: PlotAxis;
  series: PlotSeries[];
  field?: PlotField;
}
interface PlotChart {
  svg: SVGElement;
  group: SVGElement;
  data: PlotData;
  columns: (number | null)[][];
  mark(x: number | null, y: number | null): void;
  draw(): void;
  stale: boolean;
  width?: number;
}
declare const live: {
  make(root: Element, source: PlotSource, width?: number): PlotChart[];
  update(made: PlotChart[], source: PlotSource, visible?: (chart: PlotChart) => boolean): void;
  alike(made: PlotChart[], source: PlotSource): boolean;
  renew(made: PlotChart[], source: PlotSource): void;
  drop(made: PlotChart[]): void;
  draw(): void;
};
interface Moving {
  magnify: { choices: number[] } | null;
  columns: unknown[];
  sets: unknown[];
}
// `running`: the drawing as an SVG that runs by itself.
interface Playing {
  update(moving: Moving, source: PlotSource, pictures?: string): void;
  stop(): void;
  running(): string;
}
// Pictures as files: a copy with all colours in it, as text, and what the browser saves.
declare const picture: {
  alone(svg: SVGElement): SVGElement;
  written(svg: SVGElement): string;
  save(name: string, content: BlobPart): void;
};
declare const machine: { player(figure: Element, moving: Moving, source: PlotSource): Playing | null };
declare const numbers: {
  withUnit(value: number, unit: string, digits: number): string;
  significant(value: number, digits: number): string;
  scaleFor(magnitude: number, unit: string): { unit: string; factor: number };
  prefer(scales: (unit: string) => { unit: string; factor: number } | undefined): void;
};
declare module "*.css";
