// The live map: a figure over two numbers of the scene. A click or a drag in it sets them.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Editor } from "./editor";
import { offer } from "./export";
import { Host } from "./host";
import type { Link } from "./link";
import type { Heard } from "./messages";
import { patch } from "./patch";
import { fieldOf, spanOf, written, type Field, type Span } from "./numbers";

interface Props {
  editor: Editor;
  link: Link;
  fields: Field[];
  figures: string[];
  spans: Map<string, Span>;
  scene: string;
  opened: number;
  // Looks for the edge along a number: its address and range.
  edge: (address: string, range: string) => void;
}

// What is most often asked: how fast, against how stiff, heavy or loose.
function first(fields: Field[], not: string | undefined, wanted: RegExp): string | undefined {
  const usable = fields.filter(
    (field) => field.address !== not && !field.address.startsWith("run.") && !field.address.includes("["),
  );
  return (usable.find((field) => wanted.test(`${field.quantity} ${field.address}`)) ?? usable[0])?.address;
}

export function MapView({ editor, link, fields, figures, spans, scene, opened, edge }: Props) {
  const [on, setOn] = useState(false);
  const [x, setX] = useState<string>();
  const [y, setY] = useState<string>();
  const [figure, setFigure] = useState("");
  const [progress, setProgress] = useState<[number, number] | null>(null);
  const [told, setTold] = useState("");
  const place = useRef<HTMLElement>(null!);
  const made = useRef<PlotChart[]>([]);
  const drag = useRef(0);
  const addresses = fields.map((field) => field.address);
  const alongX = x && addresses.includes(x) ? x : first(fields, undefined, /speed/);
  const alongY = y && addresses.includes(y) && y !== alongX ? y : first(fields, alongX, /stiffness|gap|inertia|mass/);
  const known = fields.length > 1 && alongX !== undefined && alongY !== undefined;
  const spanFor = (address: string): Span => {
    const field = fieldOf(editor.state, address)!;
    const span = spans.get(address) ?? spanOf(field);
    spans.set(address, span);
    return span;
  };
  const now = useRef({ x: alongX, y: alongY });
  now.current = { x: alongX, y: alongY };

  // The question goes out anew when it is another.
  const question =
    !on || !known
      ? null
      : JSON.stringify({
          ...Object.fromEntries(
            [
              ["x", alongX],
              ["y", alongY],
            ].map(([axis, address]) => {
              const field = fields.find((one) => one.address === address)!,
                span = spanFor(address!);
              return [
                axis,
                { address, unit: field.unit, ends: [span.low, span.high], log: span.log, whole: field.whole },
              ];
            }),
          ),
          figure: figure || null,
        });
  useEffect(() => {
    if (scene) link.send({ type: "map", question: question === null ? null : JSON.parse(question) });
    if (question === null && place.current) {
      live.drop(made.current);
      made.current = [];
      place.current.replaceChildren();
    }
  }, [question, scene, opened]);

  const mark = () => {
    const { x, y } = now.current,
      [a, b] = [x, y].map((address) =>
        address === undefined ? null : (fieldOf(editor.state, address)?.value ?? null),
      );
    for (const chart of made.current) chart.mark(a!, b!);
  };
  // In the frame of what it follows, not in one of its own.
  useLayoutEffect(mark);

  useEffect(() => {
    // Told of once a frame at most.
    let latest: [number, number] | null = null,
      isDue = false;
    link.on("map_progress", ({ done, of }) => {
      latest = [done, of];
      if (isDue) return;
      isDue = true;
      requestAnimationFrame(() => {
        isDue = false;
        setProgress(latest);
      });
    });
    // Over the same axes in the same frame the chart stays, and what differs in it is touched alone.
    const show = (html: string, source: PlotSource) => {
      const width = made.current[0]?.width,
        wanted = document.createElement("template");
      wanted.innerHTML = html;
      if (made.current.length && live.alike(made.current, source)) {
        patch(place.current!, wanted.content, ".over, .grid, .export");
        live.renew(made.current, source);
        return;
      }
      live.drop(made.current);
      place.current!.replaceChildren(wanted.content);
      made.current = live.make(place.current!, source, width);
      offer(made.current);
    };
    const take = (message: Heard["map"]) => {
      latest = null;
      setProgress(null);
      setTold(
        message.refused !== undefined
          ? `There is no map: ${message.refused}`
          : `${message.figure}, ${message.cells} points. Click or drag sets both numbers.`,
      );
      if (message.refused === undefined && place.current) {
        const source = { columns: message.columns, plots: message.plots };
        for (const plot of Object.values<PlotData>(message.plots)) if (plot.field) plot.field.notes = message.notes;
        show(message.html, source);
        mark();
      }
      performance.mark("map", {
        detail: { version: message.version, cells: "cells" in message ? message.cells : undefined },
      });
      requestAnimationFrame(() => link.send({ type: "map_shown" }));
    };
    link.on("map", take);
    const begin = () => {
      drag.current = editor.drag();
    };
    const steer = (event: Event) => {
      const { x: a, y: b } = (event as CustomEvent).detail,
        { x, y } = now.current,
        state = editor.state;
      const changes = [
        [x, a],
        [y, b],
      ].flatMap(([address, value]) => {
        const field = fieldOf(state, address as string);
        if (!field) return [];
        const [from, to] = field.number_at;
        return [{ from, to, insert: written(value as number, state.sliceDoc(from, to), field.whole) }];
      });
      editor.change(changes, drag.current);
    };
    place.current!.addEventListener("pointerdown", begin, true);
    document.addEventListener("steered", steer);
    return () => document.removeEventListener("steered", steer);
  }, []);

  const wordsOf = (address: string): string => {
    const found = fields.find((one) => one.address === address),
      owner = address.split(".")[0]!;
    return found ? `${owner}: ${found.label}` : address || "greatest |δ| of the last elastic object";
  };
  const choice = (label: string, value: string | undefined, all: string[], set: (value: string) => void) => (
    <label>
      {label}{" "}
      <select value={value} onChange={(event) => set(event.currentTarget.value)}>
        {all.map((one) => (
          <option value={one} title={one}>
            {wordsOf(one)}
          </option>
        ))}
      </select>
    </label>
  );
  return (
    <section class={on && known ? "map-view on" : "map-view"} aria-label="map">
      <div key="tools" class="tools">
        <button type="button" aria-pressed={on} disabled={!known} onClick={() => setOn(!on)}>
          Map over two numbers
        </button>
        {on && known && (
          <>
            {choice("along", alongX, addresses, setX)}
            {choice(
              "up",
              alongY,
              addresses.filter((one) => one !== alongX),
              setY,
            )}
            {choice("of", figure, ["", ...figures], setFigure)}
            <button
              type="button"
              onClick={() => {
                const { low, high } = spanFor(alongX!),
                  { unit } = fields.find((one) => one.address === alongX)!;
                edge(alongX!, `${low}:${high} ${unit}`.trim());
              }}
            >
              Find the edge
            </button>
          </>
        )}
        {on && progress && <progress max={progress[1]} value={progress[0]} aria-label="cells of the map" />}
      </div>
      <Host
        key="place"
        class="map-place"
        of={(element) => {
          place.current = element;
        }}
      />
      {on && told && (
        <p key="told" class="soft">
          {told}
        </p>
      )}
    </section>
  );
}
