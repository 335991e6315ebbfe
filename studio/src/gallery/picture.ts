// Moving pictures of scenes that nobody has opened yet: worked out one after the other while their
// cards are in sight, and kept as long as the page is.
//
// The program runs the scene shortly; the player of the pages makes a picture of it that runs by
// itself. On a card it stands still until somebody looks at it.

import type { Link } from "../link";

export type From = { template: string } | { scenario: string };
interface Wanted {
  from: From;
  link: Link;
  isSeen: () => boolean;
  done: (svg: string | null) => void;
}

// Pictures by their scenes; null: there is none.
const known = new Map<string, string | null>();
const waiting: Wanted[] = [];
let working = false;

// Calls back with the picture: at once, or when it was worked out. Who is out of sight by then is
// passed over, and may ask again.
export function wanted(one: Wanted): void {
  const found = known.get(JSON.stringify(one.from));
  if (found !== undefined) {
    one.done(found);
    return;
  }
  waiting.push(one);
  if (!working) void work();
}

async function work(): Promise<void> {
  working = true;
  for (let one = waiting.shift(); one; one = waiting.shift()) {
    if (!one.isSeen()) continue;
    const key = JSON.stringify(one.from);
    try {
      if (!known.has(key))
        known.set(
          key,
          await drawn(await one.link.get<Preview | null>(`/api/preview?${new URLSearchParams({ from: key })}`)),
        );
    } catch {
      known.set(key, null);
    }
    one.done(known.get(key) ?? null);
    // Whatever the user does comes between.
    await new Promise((done) => setTimeout(done));
  }
  working = false;
}

interface Preview {
  moving: Moving;
  pictures: string;
  columns: (number | null)[][];
}

let count = 0;
async function drawn(preview: Preview | null): Promise<string | null> {
  if (!preview) return null;
  const { moving, pictures, columns } = preview;
  const figure = document.createElement("figure");
  figure.className = "moving in-the-making";
  figure.innerHTML = `${pictures}<div class="bar controls"></div>`;
  // It is measured where it stands.
  document.querySelector(".first-page")?.append(figure);
  try {
    const playing = machine.player(figure, moving, { columns, plots: [] }),
      svg = playing?.running() ?? null;
    playing?.stop();
    if (!svg) return null;
    figure.innerHTML = svg;
    return apart(await near(figure.querySelector("svg")!), `card-${++count}-`);
  } finally {
    figure.remove();
  }
}

// Holds a picture at its beginning. Before it was drawn once, its clock does not go and nothing of it
// moves to an instant that is set.
export async function begun(svg: SVGSVGElement): Promise<void> {
  for (let frames = 0; frames < 2; frames++) await new Promise((done) => requestAnimationFrame(done));
  svg.pauseAnimations();
  svg.setCurrentTime(0);
  // To measure it brings it to that instant.
  svg.getBBox();
}

// Instants at which it is measured how far a machine reaches, and the room around it (pixels).
const INSTANTS = 24,
  ROOM = 8;

// The machine alone, without words that nobody could read on a card, as near as it fits.
async function near(svg: SVGSVGElement): Promise<string> {
  for (const one of svg.querySelectorAll("text, .scale, svg > rect:first-child")) one.remove();
  const seconds = parseFloat(svg.querySelector("[dur]")?.getAttribute("dur") ?? "0");
  let [left, top, right, foot] = [Infinity, Infinity, -Infinity, -Infinity];
  await begun(svg);
  for (let k = 0; k < INSTANTS; k++) {
    svg.setCurrentTime((seconds * k) / INSTANTS);
    const { x, y, width, height } = svg.getBBox();
    [left, top, right, foot] = [
      Math.min(left, x),
      Math.min(top, y),
      Math.max(right, x + width),
      Math.max(foot, y + height),
    ];
  }
  if (right > left && foot > top)
    svg.setAttribute(
      "viewBox",
      [left - ROOM, top - ROOM, right - left + 2 * ROOM, foot - top + 2 * ROOM].map((one) => one.toFixed(1)).join(" "),
    );
  return svg.outerHTML;
}

// Names within a picture are its own.
const apart = (svg: string, prefix: string): string =>
  svg
    .replace(/\bid="([^"]+)"/g, `id="${prefix}$1"`)
    .replace(/url\((&quot;|"|')?#([^)"'&]+)(&quot;|"|')?\)/g, `url(#${prefix}$2)`)
    .replace(/href="#([^"]+)"/g, `href="#${prefix}$1"`);
