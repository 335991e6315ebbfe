// The answer on the screen: sentence, tables, charts, the machine. It comes as bytes; charts and
// pictures stay where only their numbers are others.

import type { Verdict } from "./expect";
import { offer } from "./export";
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
export function read(frame: ArrayBuffer): { head: Answer; columns: (number | null)[][] } {
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

// How long nothing is changed before the charts out of sight get their numbers too.
const REST = 1000;

// Quantities that tell the most of an object, whose charts come first.
const FIRST = ["N", "δ"];

// Where a chart stands among those of the answer.
const placeOf = (chart: PlotChart): number => Number(chart.group.dataset.plot);

export class Board {
  private made: PlotChart[] = [];
  private playing: Playing | null = null;
  private choices = "";
  private tables = "";
  private compared = "";
  // The charts as they were last told of.
  private plots: PlotData[] = [];
  private readonly seen = new Set<Element>();
  private readonly watch: IntersectionObserver;
  private last: [Moving, PlotSource] | null = null;
  private rest = 0;
  private all = false;
  private readonly sheet = new Sheet("the machine moving");
  // The object whose charts are shown; null: those of all.
  private object: string | null = null;

  constructor(
    private readonly parts: { tables: Element; compared: Element; charts: Element; machine: Element },
    scroller: Element,
    private readonly told: (sight: number[]) => void,
    choose: (id: string) => void,
  ) {
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
    this.watch = new IntersectionObserver(
      (entries) => {
        for (const { target, isIntersecting } of entries) {
          if (isIntersecting) this.seen.add(target);
          else this.seen.delete(target);
          const chart = this.made.find((one) => one.svg === target);
          if (isIntersecting && chart?.stale) chart.draw();
        }
        // The numbers of what has come into sight come then.
        this.look();
      },
      { root: scroller, rootMargin: "120px" },
    );
  }

  private look(): void {
    this.told(this.made.filter((chart) => this.seen.has(chart.svg)).map(placeOf));
  }

  // Charts whose numbers did not come, since nobody sees them, are printed: at rest they come.
  private follow(head: Answer): void {
    clearTimeout(this.rest);
    const behind = this.made.filter((chart) => !head.plots[placeOf(chart)]);
    for (const chart of this.made) chart.svg.parentElement?.classList.toggle("behind", behind.includes(chart));
    if (behind.length)
      this.rest = setTimeout(() => {
        this.all = true;
        this.told(this.made.map(placeOf));
      }, REST);
    else if (this.all) {
      this.all = false;
      this.look();
    }
  }

  // Shows the charts of one object, or of all, and what belongs to none.
  only(object: string | null): void {
    this.object = object;
    this.separate();
  }
  private separate(): void {
    const sections = [...this.parts.charts.querySelectorAll<HTMLElement>("section.object")];
    const isThere = sections.some((one) => one.id === `object-${this.object}`);
    for (const one of sections)
      one.hidden = isThere && one.id.startsWith("object-") && one.id !== `object-${this.object}`;
    this.mark();
  }
  // The object that was chosen, in the picture of the machine.
  private mark(): void {
    for (const one of this.parts.machine.querySelectorAll<SVGElement>("[data-object]"))
      one.classList.toggle("chosen", one.dataset.object === this.object);
  }

  show(frame: ArrayBuffer): Answer {
    const { head, columns } = read(frame);
    if (head.charts !== undefined) this.plots = [];
    head.plots.forEach((plot, place) => {
      if (plot) this.plots[place] = plot;
    });
    const source = { columns, plots: this.plots };
    if (head.charts !== undefined) {
      live.drop(this.made);
      this.watch.disconnect();
      this.seen.clear();
      this.parts.charts.innerHTML = head.charts;
      this.separate();
      this.made = live.make(this.parts.charts, source);
      for (const { svg, data } of this.made)
        if (svg.closest("[id^=object-]"))
          svg.parentElement!.style.order = String(
            -1 - FIRST.findIndex((symbol) => data.title.split(" ").includes(symbol)),
          );
      offer(this.made);
      for (const chart of this.made) {
        this.seen.add(chart.svg);
        this.watch.observe(chart.svg);
      }
    } else {
      const fresh = this.made.filter((chart) => head.plots[placeOf(chart)]);
      for (const chart of this.made) chart.stale = true;
      live.update(fresh, source, (chart) => this.seen.has(chart.svg));
    }
    this.follow(head);
    this.move(head, source);
    if (head.tables !== this.tables) {
      this.tables = head.tables;
      retell(this.parts.tables, head.tables);
    }
    if (head.compared !== this.compared) {
      this.compared = head.compared;
      retell(this.parts.compared, head.compared);
    }
    return head;
  }

  // Other units.
  again(): void {
    retell(this.parts.tables, this.tables);
    retell(this.parts.compared, this.compared);
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
    live.drop(this.made);
    this.playing?.stop();
    this.playing = null;
    this.made = [];
    this.plots = [];
    this.tables = this.compared = "";
    this.object = null;
    this.sheet.fit();
    for (const part of Object.values(this.parts)) {
      part.replaceChildren();
      whole.delete(part);
    }
  }
}
