// The charts of an answer: those of one object or of all. What is not shown is not built, and what is
// out of sight is not drawn; on paper there are all of them.

import { offer } from "./export";

// How long nothing is changed before the charts out of sight get their numbers too.
const REST = 1000;

// Quantities that tell the most of an object, whose charts come first.
const FIRST = ["N", "δ"];

// What an answer says of its charts: those out of sight come without numbers.
interface Told {
  charts?: string;
  plots: (PlotData | null)[];
}
// The charts of an object, or some that belong to none; null: they are still to be made.
interface Section {
  node: Element;
  id: string | null;
  made: PlotChart[] | null;
}

// Where a chart stands among those of the answer.
const placeOf = (chart: PlotChart): number => Number(chart.group.dataset.plot);

export class Charts {
  private sections: Section[] = [];
  private plots: PlotData[] = [];
  // The newest numbers of all charts at once: those that are made later begin with them.
  private whole: PlotSource | null = null;
  // The charts of the answer whose numbers did not come with it.
  private behind = new Set<number>();
  private readonly seen = new Set<Element>();
  private readonly watch: IntersectionObserver;
  private rest = 0;
  private isWhole = false;
  // The object whose charts are shown; null: those of all.
  private object: string | null = null;
  private readonly paper = matchMedia("print");
  // Says that it has none.
  private readonly without = Object.assign(document.createElement("p"), { className: "soft" });

  constructor(
    private readonly place: Element,
    scroller: Element,
    private readonly told: (sight: number[]) => void,
  ) {
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
    this.paper.addEventListener("change", () => this.build());
  }

  // Objects that have charts.
  get objects(): string[] {
    return this.sections.flatMap(({ id }) => id ?? []);
  }
  private get made(): PlotChart[] {
    return this.sections.flatMap(({ made }) => made ?? []);
  }

  private look(): void {
    this.told(this.made.filter((chart) => this.seen.has(chart.svg)).map(placeOf));
  }

  // Shows the charts of one object, or of all, and what belongs to none.
  only(object: string | null): void {
    this.object = object;
    this.build();
  }

  // Makes what is shown, and takes away what is not.
  private build(): void {
    const { object, sections } = this,
      isAll = object === null || this.paper.matches,
      shown = sections.filter(({ id }) => isAll || id === null || id === object),
      nodes = shown.map(({ node }) => node);
    if (sections.length && !isAll && !this.objects.includes(object)) nodes.push(this.without);
    this.without.textContent = `No charts of ${object} are drawn here. The report has those of all objects.`;
    const { children } = this.place;
    if (nodes.length !== children.length || nodes.some((node, k) => node !== children[k]))
      this.place.replaceChildren(...nodes);
    for (const section of shown) section.made ??= this.make(section);
  }
  private make({ node, id }: Section): PlotChart[] {
    const made = live.make(node, this.whole!);
    offer(made);
    for (const { svg, data } of made) {
      if (id !== null)
        svg.parentElement!.style.order = String(
          -1 - FIRST.findIndex((symbol) => data.title.split(" ").includes(symbol)),
        );
      this.seen.add(svg);
      this.watch.observe(svg);
    }
    this.mark(made);
    return made;
  }

  // Charts whose numbers did not come, since nobody sees them, are printed: at rest they come.
  private mark(made: PlotChart[]): void {
    for (const chart of made) chart.svg.parentElement?.classList.toggle("behind", this.behind.has(placeOf(chart)));
  }
  private follow({ plots }: Told): void {
    clearTimeout(this.rest);
    this.behind = new Set(plots.flatMap((plot, place) => (plot ? [] : place)));
    this.mark(this.made);
    if (this.behind.size)
      this.rest = setTimeout(() => {
        this.isWhole = true;
        this.told(plots.map((_, place) => place));
      }, REST);
    else if (this.isWhole) {
      this.isWhole = false;
      this.look();
    }
  }

  // What an answer is drawn from.
  source(columns: PlotSource["columns"]): PlotSource {
    return { columns, plots: this.plots };
  }

  // Shows an answer, with the charts of the object that is chosen of those that have any.
  show(head: Told, columns: PlotSource["columns"], choose: (objects: string[]) => string | null): string | null {
    if (head.charts !== undefined) this.plots = [];
    head.plots.forEach((plot, place) => {
      if (plot) this.plots[place] = plot;
    });
    if (!head.plots.includes(null)) this.whole = { columns, plots: [...this.plots] };
    if (head.charts !== undefined) {
      this.drop();
      const drawn = document.createElement("template");
      drawn.innerHTML = head.charts;
      this.sections = [...drawn.content.children].map((node) => ({
        node,
        id: node.id.startsWith("object-") ? node.id.slice("object-".length) : null,
        made: null,
      }));
    } else {
      const { made } = this,
        fresh = made.filter((chart) => head.plots[placeOf(chart)]);
      for (const chart of made) chart.stale = true;
      live.update(fresh, this.source(columns), (chart) => this.seen.has(chart.svg));
    }
    this.follow(head);
    this.only(choose(this.objects));
    return this.object;
  }

  private drop(): void {
    live.drop(this.made);
    this.watch.disconnect();
    this.seen.clear();
    this.sections = [];
  }
  // Nothing of a document before stays.
  clear(): void {
    clearTimeout(this.rest);
    this.drop();
    this.plots = [];
    this.whole = null;
    this.place.replaceChildren();
  }
}
