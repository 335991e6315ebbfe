// The answer on the screen: sentence, tables, charts, the machine. It comes as bytes; charts and
// pictures stay where only their numbers are others.

export interface Answer {
  version: number;
  verdict: { sort: string; headline: string; text: string };
  coarse: boolean;
  warnings: string[];
  tables: string;
  figures: Record<string, any>;
  lengths: number[];
  plots: PlotData[];
  moving: Moving | null;
  charts?: string;
  pictures?: string;
}

// A frame: the length of the head, the head, the columns.
export function read(frame: ArrayBuffer): { head: Answer; columns: (number | null)[][] } {
  const length = new DataView(frame).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(frame, 4, length))) as Answer;
  const values = new Float64Array(frame, 4 + length);
  let at = 0;
  const columns = head.lengths.map((count) => Array.from(values.subarray(at, at += count), (value) => Number.isNaN(value) ? null : value));
  return { head, columns };
}

export class Board {
  private made: PlotChart[] = [];
  private playing: Playing | null = null;
  private choices = "";
  private tables = "";
  private readonly seen = new Set<Element>();
  private readonly watch: IntersectionObserver;

  constructor(private readonly parts: { tables: Element; charts: Element; machine: Element }, scroller: Element) {
    this.watch = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        if (isIntersecting) this.seen.add(target); else this.seen.delete(target);
        const chart = this.made.find((one) => one.svg === target);
        if (isIntersecting && chart?.stale) chart.draw();
      }
    }, { root: scroller, rootMargin: "120px" });
  }

  show(frame: ArrayBuffer): Answer {
    const { head, columns } = read(frame), source = { columns, plots: head.plots };
    if (head.charts !== undefined) {
      live.drop(this.made);
      this.watch.disconnect();
      this.seen.clear();
      this.parts.charts.innerHTML = head.charts;
      this.made = live.make(this.parts.charts, source);
      for (const chart of this.made) { this.seen.add(chart.svg); this.watch.observe(chart.svg); }
    } else live.update(this.made, source, (chart) => this.seen.has(chart.svg));
    this.move(head, source);
    if (head.tables !== this.tables) {
      this.tables = head.tables;
      this.parts.tables.innerHTML = head.tables;
    }
    return head;
  }

  private move({ moving, pictures }: Answer, source: PlotSource): void {
    const { machine: place } = this.parts, choices = JSON.stringify([moving?.magnify?.choices, moving?.columns.length]);
    if (this.playing && moving && choices === this.choices) { this.playing.update(moving, source, pictures); return; }
    this.playing?.stop();
    this.playing = null;
    const before = place.querySelector(".stations");
    const drawn = pictures ?? before?.outerHTML ?? "";
    place.replaceChildren();
    this.choices = choices;
    if (!moving || !drawn) return;
    const figure = document.createElement("figure");
    figure.className = "moving";
    figure.innerHTML = `${drawn}<div class="bar controls"></div>`;
    place.appendChild(figure);
    this.playing = machine.player(figure, moving, source);
  }

  // Nothing of a document before stays.
  clear(): void {
    live.drop(this.made);
    this.playing?.stop();
    this.playing = null;
    this.made = [];
    this.tables = "";
    for (const part of Object.values(this.parts)) part.replaceChildren();
  }
}
