// The answer on the screen: sentence, tables, charts, the machine. It comes as bytes; charts and
// pictures stay where only their numbers are others.

import { Charts } from "./charts";
import type { Verdict } from "./expect";
import { patch } from "./patch";
import { Sheet } from "./sheet";
import { remeasure, reshow, type Sentence } from "./units";

export interface Figures {
  pair?: { separated_time?: number };
  delta_abs?: number;
}
export interface Answer {
  version: number;
  verdict: { sort: string; headline: Sentence; text: Sentence };
  coarse: boolean;
  // The name of the scene.
  title: string;
  warnings: Sentence[];
  // What is expected of the run, and how much is expected that it does not tell.
  expect: Verdict[];
  expect_others: number;
  tables: string;
  // The figures beside those of pinned runs.
  compared: string;
  // Names of the runs that are pinned, and of the columns of the record with their units.
  pins: string[];
  signals: [string, string][];
  // By object and name; numbers may stand in further ones.
  figures: Record<string, Figures>;
  // Of charts that are not in sight neither numbers nor what else differs come.
  lengths: (number | null)[];
  plots: (PlotData | null)[];
  moving: Moving | null;
  charts?: string;
  pictures?: string;
}

// A frame: the length of the head, the head, the columns.
function read(frame: ArrayBuffer): { head: Answer; columns: (number | null)[][] } {
  const length = new DataView(frame).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(frame, 4, length))) as Answer;
  return { head, columns: lazily(head.lengths, new Float64Array(frame, 4 + length)) };
}

// Columns are made where a chart asks for them.
function lazily(lengths: (number | null)[], values: Float64Array): (number | null)[][] {
  const starts: number[] = [],
    made: (number | null)[][] = [];
  lengths.reduce<number>((at, count, index) => {
    if (count !== null) starts[index] = at;
    return at + (count ?? 0);
  }, 0);
  return new Proxy(made, {
    get: (_, key) => {
      const index = typeof key === "string" ? Number(key) : NaN;
      if (!(index in starts)) return Reflect.get(made, key);
      return (made[index] ??= Array.from(values.subarray(starts[index]!, starts[index]! + lengths[index]!), (value) =>
        Number.isNaN(value) ? null : value,
      ));
    },
  });
}

// Rows of a table at first; the others come when they are asked for.
const ROWS = 100;
// Where all of them are shown.
const whole = new WeakSet<Element>();

function shorten(body: HTMLTableSectionElement): void {
  const { rows } = body,
    count = rows.length,
    width = rows[0]?.cells.length ?? 1;
  // A few more are no reason to hide them.
  if (count <= 1.5 * ROWS) return;
  while (rows.length > ROWS) rows[rows.length - 1]!.remove();
  const cell = body.insertRow().insertCell(),
    button = document.createElement("button");
  cell.colSpan = width;
  button.type = "button";
  button.className = "all-rows";
  button.textContent = `Show all ${count} rows`;
  cell.appendChild(button);
}

// Makes an element's content another one, and touches only what differs.
function retell(parent: Element, html: string): void {
  const wanted = document.createElement("template");
  wanted.innerHTML = html;
  if (!whole.has(parent)) for (const body of wanted.content.querySelectorAll("tbody")) shorten(body);
  reshow(wanted.content);
  patch(parent, wanted.content);
}

// Tables of more characters are made where they are shown.
const LONG = 100_000;

export class Board {
  readonly charts: Charts;
  private playing: Playing | null = null;
  private choices = "";
  private tables = "";
  private compared = "";
  // The tables as they stand on the page are those of an answer before.
  private isBehind = false;
  private isShown = false;
  private last: [Moving, PlotSource] | null = null;
  private readonly sheet = new Sheet("the machine moving");
  // The object that is looked at; null: none.
  private object: string | null = null;

  constructor(
    private readonly parts: { tables: Element; compared: Element; charts: Element; machine: Element },
    scroller: Element,
    told: (sight: number[]) => void,
    choose: (id: string) => void,
  ) {
    this.charts = new Charts(parts.charts, scroller, told);
    for (const part of [parts.tables, parts.compared])
      part.addEventListener("click", ({ target }) => {
        if (!(target as Element).matches(".all-rows")) return;
        whole.add(part);
        this.again();
      });
    parts.tables.addEventListener("click", (event) => {
      const link = (event.target as Element).closest<HTMLAnchorElement>('a[href^="#object-"]');
      if (!link) return;
      event.preventDefault();
      choose(decodeURIComponent(link.hash.slice("#object-".length)));
    });
    parts.machine.addEventListener("click", (event) => {
      const id = (event.target as Element).closest<SVGElement>("[data-object]")?.dataset.object;
      if (id) choose(id);
    });
    matchMedia("print").addEventListener("change", () => this.retell());
  }

  // The object that is looked at: its charts, and the machine marks it.
  only(object: string | null): void {
    this.object = object;
    this.charts.only(object);
    this.mark();
  }
  private mark(): void {
    for (const one of this.parts.machine.querySelectorAll<SVGElement>("[data-object]"))
      one.classList.toggle("chosen", one.dataset.object === this.object);
  }

  // Shows an answer. Which object is looked at may depend on those that have charts.
  show(frame: ArrayBuffer, choose: (head: Answer, charted: string[]) => string | null): Answer {
    const { head, columns } = read(frame);
    this.object = this.charts.show(head, columns, (charted) => choose(head, charted));
    this.move(head, this.charts.source(columns));
    this.isBehind ||= head.tables !== this.tables || head.compared !== this.compared;
    this.tables = head.tables;
    this.compared = head.compared;
    this.retell();
    return head;
  }

  // Whether the results are shown.
  results(isShown: boolean): void {
    this.isShown = isShown;
    this.retell();
  }
  private retell(): void {
    const isLong = this.tables.length + this.compared.length > LONG;
    if (!this.isBehind || (isLong && !this.isShown && !matchMedia("print").matches)) return;
    this.isBehind = false;
    retell(this.parts.tables, this.tables);
    retell(this.parts.compared, this.compared);
  }

  // Other units, or more rows.
  again(): void {
    this.isBehind = true;
    this.retell();
    live.draw();
    remeasure(this.parts.machine);
    if (this.last) this.playing?.update(...this.last);
  }

  private move({ moving, pictures }: Answer, source: PlotSource): void {
    const { machine: place } = this.parts,
      choices = JSON.stringify([moving?.magnify?.choices, moving?.columns.length, moving?.sets.length]);
    this.last = moving && [moving, source];
    if (this.playing && moving && choices === this.choices) {
      this.playing.update(moving, source, pictures);
      // Other pictures, in the units that they were drawn with.
      if (pictures !== undefined) {
        remeasure(place);
        this.playing.update(moving, source);
        this.mark();
      }
      return;
    }
    this.playing?.stop();
    this.playing = null;
    const before = place.querySelector(".stations");
    const drawn = pictures ?? before?.outerHTML ?? "";
    place.replaceChildren();
    this.choices = choices;
    if (!moving || !drawn) return;
    const figure = document.createElement("figure");
    figure.className = "moving";
    this.sheet.content.innerHTML = drawn;
    figure.append(this.sheet.room, Object.assign(document.createElement("div"), { className: "bar controls" }));
    place.appendChild(figure);
    this.mark();
    remeasure(place);
    this.playing = machine.player(figure, moving, source);
  }

  // Nothing of a document before stays.
  clear(): void {
    this.charts.clear();
    this.playing?.stop();
    this.playing = null;
    this.tables = this.compared = "";
    this.object = null;
    this.sheet.fit();
    for (const part of Object.values(this.parts)) {
      part.replaceChildren();
      whole.delete(part);
    }
  }
}
