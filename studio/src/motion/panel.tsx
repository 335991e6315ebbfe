// The drawn editor of a motion made of segments, above the form of its object. Whatever is done
// in it is an edit of the text; the curves come from the program.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Desk } from "../form/desk";
import type { Link } from "../link";
import { Steps, type Change, type Edits } from "../tree";
import { useMotion } from "./asked";
import { Curves, type Grip } from "./curves";
import { given, lifted, moved, removed, split } from "./edits";
import { open, pathOf, placed, segmentsOf, stepAlong, stepUp } from "./motion";
import { frameOf, placeOf, valueAt, xOf, type Frame } from "./scale";
import { Segments } from "./segments";
import { Begin } from "./begin";
import { Greatest, Jumps } from "./words";
import type { Place } from "./written";

interface Props {
  link: Link;
  scene: string;
  id: string;
  kind: string;
  desk: Desk;
  isAt: (version: number) => boolean;
  edit: (make: (edits: Edits) => Change[], drag?: number) => boolean;
  drag: () => number;
  coordinates: Map<string, string | null>;
}
type Act = (steps: Steps, place: Place) => string | null;

// Narrowest drawing, and the way of an arrow key with Shift, as a share of a step.
const NARROW = 240,
  FINE = 0.1;
// From so many pixels on what is pressed is dragged.
const MOVED = 3;
// Arrow keys, and Page keys by ten steps.
const KEYS: Record<string, number> = {
  ArrowLeft: -1,
  ArrowDown: -1,
  ArrowRight: 1,
  ArrowUp: 1,
  PageDown: -10,
  PageUp: 10,
};

export function MotionPanel({ link, scene, id, kind, desk, isAt, edit, drag, coordinates }: Props) {
  const { motion, isFree, busy, faulty, round } = useMotion({ link, scene, id, text: desk.text, isAt });
  const place = useRef<HTMLDivElement>(null),
    svg = useRef<SVGSVGElement>(null),
    [width, setWidth] = useState(NARROW);
  const held = useRef<{ grip: Grip; step: number; frame: Frame; from: [number, number]; moves: boolean } | null>(null),
    waiting = useRef<(() => void) | null>(null),
    acts = useRef<(() => void)[]>([]);
  const [told, setTold] = useState("");
  const path = motion && pathOf(id, motion, kind === "drive");
  const now = useRef<Place | null>(null);
  now.current = motion && path ? { motion, path } : null;

  useLayoutEffect(() => {
    const watch = new ResizeObserver(([entry]) => setWidth(Math.max(NARROW, Math.floor(entry!.contentRect.width))));
    if (place.current) watch.observe(place.current);
    return () => watch.disconnect();
  }, [motion === null]);

  // An act is done on the text that the curves are of: later ones wait, and of a drag the last.
  const act = (make: Act, step?: number) => {
    const own = now.current;
    if (own)
      edit((edits) => {
        const steps = new Steps(edits),
          wrong = make(steps, own);
        setTold(wrong ?? "");
        return wrong === null ? steps.changes : [];
      }, step);
  };
  const soon = (make: Act) => {
    const run = () => act(make);
    if (isFree() && !acts.current.length) run();
    else acts.current.push(run);
  };
  useEffect(() => {
    while (acts.current.length && isFree()) acts.current.shift()!();
    const next = waiting.current;
    if (next && isFree()) {
      waiting.current = null;
      next();
    }
  }, [round]);

  if (!motion || !path) return <Begin {...{ id, kind, desk, edit, drag, coordinates }} />;
  const frame = held.current?.frame ?? frameOf(motion, width),
    segments = segmentsOf(motion, desk.root, path, desk.text);

  // Moves what is held to a place of the picture.
  const pull = (x: number, y: number, isFine: boolean) => {
    const own = held.current;
    if (!own) return;
    // What is only pressed stays.
    own.moves ||= Math.hypot(x - own.from[0], y - own.from[1]) > MOVED;
    if (!own.moves) return;
    const run = () => act((steps, place) => to(steps, place, own.grip, own.frame, x, y, isFine), own.step);
    if (isFree()) run();
    else waiting.current = run;
  };
  const at = (event: PointerEvent): [number, number] => {
    const { left, top } = svg.current!.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  // Of boundaries that lie close together the one that is nearest to the pointer.
  const nearest = (x: number): Grip => {
    const off = open(motion).map((one) => Math.abs(xOf(frame, placed(motion, one.at)) - x));
    return { sort: "boundary", station: off.indexOf(Math.min(...off)) };
  };
  const hold = (pressed: Grip, event: PointerEvent) => {
    if (event.button !== 0) return;
    event.preventDefault();
    const grip = pressed.sort === "level" ? pressed : nearest(at(event)[0]);
    svg
      .current!.querySelector<SVGElement>(
        `.${grip.sort}[data-station="${grip.sort === "level" ? grip.group[0] : grip.station}"]`,
      )
      ?.focus();
    svg.current!.setPointerCapture(event.pointerId);
    held.current = { grip, step: drag(), frame, from: at(event), moves: false };
  };
  const press = (grip: Grip, event: KeyboardEvent) => {
    const by = KEYS[event.key];
    if (by === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    soon((steps, place) => stepped(steps, place, grip, by, event.shiftKey));
  };
  return (
    <section class="motion" aria-label={`motion of ${id}`} aria-busy={busy}>
      <h3>
        Motion of {id}{" "}
        <small>{motion.axis === "rad" ? "over the angle of the drive, one cycle" : "over one cycle"}</small>
      </h3>
      <div ref={place}>
        <svg
          ref={svg}
          class="motion-curves"
          width={width}
          height={frame.height}
          viewBox={`0 0 ${width} ${frame.height}`}
          role="group"
          aria-label="displacement, velocity, acceleration and jerk"
          onPointerMove={(event) => {
            if (held.current) pull(...at(event), event.shiftKey);
          }}
          onPointerUp={(event) => {
            pull(...at(event), event.shiftKey);
            held.current = null;
          }}
          onPointerCancel={() => {
            held.current = null;
          }}
        >
          <Curves {...{ motion, segments, frame, hold, press }} />
        </svg>
      </div>
      {(told || faulty) && (
        <p class="field-note" role="status">
          {told || "Stale: the scene has faults. These are the last good curves."}
        </p>
      )}
      <Greatest motion={motion} />
      <Jumps motion={motion} />
      <Segments
        {...{ motion, segments }}
        laws={lawsOf(desk)}
        give={(index, law) => soon((steps, own) => given(steps, own, index, law))}
        split={(index) => soon((steps, own) => split(steps, own, index))}
        remove={(index) => soon((steps, own) => removed(steps, own, index))}
      />
    </section>
  );
}

// The laws that the program knows between two stations, by name.
function lawsOf(desk: Desk): string[] {
  const alternatives: { enum?: string[] }[] = desk.guide.root.$defs?.planned_motion?.anyOf ?? [];
  return (alternatives.find((one) => one.enum)?.enum ?? []).filter(
    (one) => !["dwell", "uniform", "smooth"].includes(one),
  );
}

const snapped = (value: number, step: number): number => Math.round(value / step) * step;

// What is held goes to a place of the picture, in whole steps of the machine's angle or of the level.
function to(
  steps: Steps,
  place: Place,
  grip: Grip,
  frame: Frame,
  x: number,
  y: number,
  isFine: boolean,
): string | null {
  const { motion } = place,
    along = stepAlong(motion) * (isFine ? FINE : 1),
    up = stepUp(motion) * (isFine ? FINE : 1);
  if (grip.sort === "level") return lifted(steps, place, grip.group, snapped(valueAt(frame.lanes[0]!, y), up));
  const { at } = open(motion)[grip.station]!,
    before = placed(motion, at),
    by = snapped(placeOf(frame, x), along) - before;
  // The shorter way, where it goes over the end of the cycle.
  const { period } = motion,
    way = period === null ? by : by - period * Math.round(by / period);
  return moved(steps, place, grip.station, at + way, along);
}

// What an arrow key does: to the next whole step.
function stepped(steps: Steps, place: Place, grip: Grip, by: number, isFine: boolean): string | null {
  const { motion } = place,
    size = (grip.sort === "level" ? stepUp(motion) : stepAlong(motion)) * (isFine ? FINE : 1);
  if (grip.sort === "level")
    return lifted(steps, place, grip.group, snapped(open(motion)[grip.group[0]!]!.displacement, size) + by * size);
  const { at } = open(motion)[grip.station]!,
    before = placed(motion, at);
  return moved(steps, place, grip.station, at + snapped(before, size) + by * size - before, size);
}
