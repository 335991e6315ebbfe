// Charts as files: the picture as it stands on the page, as SVG or PNG, and its numbers as CSV.

export const save = (name: string, content: BlobPart): void => picture.save(name, content);

const quoted = (text: string): string => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const headed = (name: string, unit: string): string => quoted(unit ? `${name} [${unit}]` : name);

// Every column once: places that several curves share stand before them.
export function csvOf(charts: PlotChart[]): string {
  const heads: string[] = [],
    columns: (number | string | null)[][] = [];
  for (const { data, columns: all } of charts) {
    const known = new Map<number, number>();
    if (data.field) {
      const { x, y, notes, strip } = data.field,
        cells = notes.map((note, k) => [k % (x.length - 1), Math.floor(k / (x.length - 1)), note] as const);
      heads.push(
        ...[data.x, ...(strip ? [] : [data.y])].flatMap((axis) => [
          headed(`${axis.name} from`, axis.unit),
          headed(`${axis.name} to`, axis.unit),
        ]),
        "told",
      );
      columns.push(
        cells.map(([i]) => x[i]!),
        cells.map(([i]) => x[i + 1]!),
      );
      if (!strip)
        columns.push(
          cells.map(([, j]) => y[j]!),
          cells.map(([, j]) => y[j + 1]!),
        );
      columns.push(cells.map(([, , note]) => quoted(note)));
    }
    for (const series of data.series) {
      const xs = all[series.x],
        ys = all[series.y];
      if (!xs || !ys) continue;
      if (!known.has(series.x)) {
        known.set(series.x, columns.length);
        heads.push(headed(data.x.name || "x", data.x.unit));
        columns.push(xs);
      }
      const name = [data.title || data.y.name, series.label].filter(Boolean).join(": ");
      heads.push(headed(name, data.y.unit));
      columns.push(ys);
    }
  }
  const rows = Math.max(0, ...columns.map((column) => column.length));
  const lines = [heads.join(",")];
  for (let row = 0; row < rows; row++) lines.push(columns.map((column) => column[row] ?? "").join(","));
  return `${lines.join("\n")}\n`;
}

// The picture with all colours in it: what reads it need not know the page's style.
export const svgOf = (svg: SVGElement): string => picture.written(picture.alone(svg));

async function pngOf(svg: SVGElement): Promise<Blob> {
  const url = URL.createObjectURL(new Blob([svgOf(svg)], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    // Twice as fine: it may be printed.
    const canvas = Object.assign(document.createElement("canvas"), {
      width: 2 * image.naturalWidth,
      height: 2 * image.naturalHeight,
    });
    canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done, failed) =>
      canvas.toBlob((blob) => (blob ? done(blob) : failed(new Error("no picture"))), "image/png"),
    );
  } finally {
    URL.revokeObjectURL(url);
  }
}

const named = (charts: PlotChart[]): string => {
  const { id, title } = charts[0]!.data;
  return (id || title || "chart").replace(/[^\p{L}\p{N}._-]+/gu, "-").replace(/^-|-$/g, "");
};

// Puts the ways to save it at every chart.
export function offer(made: PlotChart[]): void {
  for (const svg of new Set(made.map((chart) => chart.svg))) {
    const charts = made.filter((chart) => chart.svg === svg),
      parent = svg.parentElement!;
    if (parent.querySelector(":scope > .export")) continue;
    const menu = document.createElement("details"),
      head = document.createElement("summary");
    menu.className = "export";
    head.textContent = "⤓";
    head.title = "export this chart";
    head.setAttribute("aria-label", `export ${charts[0]!.data.title || "chart"}`);
    menu.append(head);
    const ways: [string, () => BlobPart | Promise<BlobPart>][] = [
      ["svg", () => svgOf(svg)],
      ["png", () => pngOf(svg)],
      ["csv", () => csvOf(charts)],
    ];
    for (const [ending, make] of ways) {
      const button = Object.assign(document.createElement("button"), {
        type: "button",
        textContent: ending.toUpperCase(),
      });
      button.addEventListener("click", async () => {
        save(`${named(charts)}.${ending}`, await make());
        menu.open = false;
      });
      menu.append(button);
    }
    parent.append(menu);
  }
}
