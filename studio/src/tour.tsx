// A tour of two minutes: steps that point at a part of the page, say what it does and what to try.
// The page stays in use meanwhile.

import { useEffect, useReducer, useRef, useState } from "preact/hooks";
import { isInText } from "./keys";
import type { Link } from "./link";
import { seen } from "./store/views";

// Brings a part of the page into sight.
export type Show = (part: "home" | "scene" | "results" | "numbers" | "objects" | "equations" | "text") => void;

interface Step {
  part: Parameters<Show>[0];
  at: string;
  title: string;
  does: string;
  try: string;
}

const STEPS: Step[] = [
  {
    part: "home",
    at: ".first-page",
    title: "Open a scene",
    does: "A scene is a machine with what is asked of it: objects, numbers, a run. Here are those of the folder, templates to begin with, and scenarios whose answers are known.",
    try: "Open one: the tour goes on by itself.",
  },
  {
    part: "numbers",
    at: ".pane-middle",
    title: "Move a number",
    does: "Every number of the scene has its unit and a slider. What you change is the text of the scene, nothing else.",
    try: "Drag a slider, or type a value with another unit.",
  },
  {
    part: "scene",
    at: ".answers .verdict",
    title: "Read the verdict",
    does: "The answer in a sentence, worked out anew with every change: whether pairs stay closed, how exact the positions are, why a run stopped.",
    try: "Move the number further and see when the sentence changes.",
  },
  {
    part: "scene",
    at: ".machine",
    title: "See it move",
    does: "The machine as it moves in this run, deviations magnified.",
    try: "Press play.",
  },
  {
    part: "scene",
    at: ".dock",
    title: "Charts of an object",
    does: "The charts of the object that is loaded most, below the machine; those of another once it is clicked in the machine.",
    try: "Drag in a chart to zoom; move the bar between machine and charts.",
  },
  {
    part: "scene",
    at: ".map-view",
    title: "Map two numbers",
    does: "A figure over two numbers of the scene at once: where does it work, where does it fail?",
    try: "Switch the map on and click in it: both numbers are set.",
  },
  {
    part: "objects",
    at: ".canvas",
    title: "The mechanism as a graph",
    does: "Objects and what drives what. Ports are joined by dragging; what is chosen shows its properties beside.",
    try: "Click an object, then add another one.",
  },
  {
    part: "equations",
    at: ".pane-left",
    title: "Its equations",
    does: "The equations of motion that are solved, with the meaning of every letter.",
    try: "Look for the letter of the number that you moved.",
  },
  {
    part: "text",
    at: ".text-pane",
    title: "The text behind it all",
    does: "Graph, drawing, forms and sliders change this text, and it keeps the form in which it was written.",
    try: "Type here: names are completed, faults are told at their places.",
  },
  {
    part: "results",
    at: ".figures",
    title: "Figures",
    does: "What the run found, of every object, in tables.",
    try: "Point at a number: all of its digits show.",
  },
  {
    part: "scene",
    at: ".top .undo",
    title: "Take it back",
    does: "Every change is one step, whatever made it: typing, a slider, the graph, the map.",
    try: "Undo until the scene is as it was.",
  },
  {
    part: "scene",
    at: ".top .save",
    title: "Save",
    does: "The file is written when you say so. What is not saved is kept as a draft, from crashes too.",
    try: "Save, or save under another name.",
  },
];

interface Props {
  link: Link;
  // The scene that is open; empty: none.
  scene: string;
  // It stands before everything.
  home: boolean;
  show: Show;
  end: () => void;
}

type Box = { left: number; top: number; width: number; height: number };
const CORNERS = ["south-east", "south-west", "north-east", "north-west"] as const;
const CARD = { width: 380, height: 250 };

function boxOf(at: string): Box | null {
  const element = document.querySelector(at),
    box = element?.getBoundingClientRect();
  if (!box || box.width < 4 || box.height < 4) return null;
  const [left, top] = [Math.max(0, box.left), Math.max(0, box.top)];
  return {
    left,
    top,
    width: Math.max(0, Math.min(innerWidth, box.right) - left),
    height: Math.max(0, Math.min(innerHeight, box.bottom) - top),
  };
}

// The corner in which the card hides least of what it speaks of.
function cornerFor(box: Box | null): (typeof CORNERS)[number] {
  if (!box) return CORNERS[0];
  const hidden = (corner: string) => {
    const [x, y] = [
      corner.endsWith("east") ? innerWidth - CARD.width : 0,
      corner.startsWith("south") ? innerHeight - CARD.height : 0,
    ];
    const across = (a: number, b: number, from: number, size: number) =>
      Math.max(0, Math.min(a + b, from + size) - Math.max(a, from));
    return across(box.left, box.width, x, CARD.width) * across(box.top, box.height, y, CARD.height);
  };
  return CORNERS.reduce((best, one) => (hidden(one) < hidden(best) ? one : best));
}

export function Tour({ link, scene, home, show, end }: Props) {
  const [index, setIndex] = useState(scene && !home ? 1 : 0);
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  const next = useRef<HTMLButtonElement>(null),
    back = useRef<HTMLButtonElement>(null),
    box = useRef<Box | null>(null);
  const step = STEPS[index]!,
    last = index === STEPS.length - 1;
  const finish = () => {
    seen.set("seen", link);
    end();
  };
  const go = (to: number) => {
    // What this scene does not have is passed over.
    while (STEPS[to]?.part === "scene" && index > 0 && !boxOf(STEPS[to]!.at)) to += to > index ? 1 : -1;
    if (to >= STEPS.length) finish();
    else if (to === 0 || scene) setIndex(to);
  };
  // The focus goes back where it was.
  useEffect(() => {
    const before = document.activeElement;
    return () => {
      if (before instanceof HTMLElement && before.isConnected) before.focus({ preventScroll: true });
    };
  }, []);
  useEffect(() => {
    show(step.part);
    requestAnimationFrame(() => {
      document.querySelector(step.at)?.scrollIntoView({ block: "nearest" });
    });
    (next.current?.disabled ? back : next).current?.focus({ preventScroll: true });
  }, [index]);
  // A scene was opened: on it goes.
  const before = useRef(scene && !home);
  useEffect(() => {
    const now = scene && !home;
    if (now && !before.current && index === 0) setIndex(1);
    before.current = now;
  }, [scene, home]);
  useEffect(() => {
    const keys = (event: KeyboardEvent) => {
      if (event.key === "Escape" && !event.defaultPrevented && !isInText(event.target)) {
        event.preventDefault();
        finish();
      }
    };
    addEventListener("keydown", keys);
    // What is pointed at may move.
    let frame = 0;
    const follow = () => {
      frame = requestAnimationFrame(follow);
      const now = boxOf(step.at);
      if (JSON.stringify(now) !== JSON.stringify(box.current)) {
        box.current = now;
        redraw(0);
      }
    };
    follow();
    return () => {
      removeEventListener("keydown", keys);
      cancelAnimationFrame(frame);
    };
  }, [index]);
  const { current: around } = box,
    [w, h] = [innerWidth, innerHeight];
  return (
    <>
      {around && (
        <svg class="tour-light" aria-hidden="true" width={w} height={h}>
          <path
            class="shade"
            fill-rule="evenodd"
            d={`M0 0H${w}V${h}H0ZM${around.left} ${around.top}h${around.width}v${around.height}h${-around.width}Z`}
          />
          <rect
            class="tour-ring"
            x={around.left + 1.5}
            y={around.top + 1.5}
            width={Math.max(0, around.width - 3)}
            height={Math.max(0, around.height - 3)}
            rx={5}
          />
        </svg>
      )}
      <div class={`tour-card ${cornerFor(around)}`} role="dialog" aria-label="tour" aria-live="polite">
        <p class="soft">
          {index + 1} of {STEPS.length}
        </p>
        <h2>{step.title}</h2>
        <p>{step.does}</p>
        <p>
          <b>Try:</b> {step.try}
        </p>
        <div class="tools">
          <button type="button" onClick={() => go(index - 1)} disabled={index === 0}>
            Back
          </button>
          <button type="button" ref={next} onClick={() => go(index + 1)} disabled={!scene}>
            {last ? "Done" : "Next"}
          </button>
          <span class="space" />
          <button type="button" ref={back} onClick={finish} title="Escape">
            End the tour
          </button>
        </div>
      </div>
    </>
  );
}
