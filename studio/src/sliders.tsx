// Every number of the scene as a row with its name, value, unit and a slider; those with a star come
// first, and a search leaves those that it names.

import type { VNode } from "preact";
import { useEffect, useReducer, useRef, useState } from "preact/hooks";
import type { Editor } from "./editor";
import { InSight } from "./in-sight";
import { Kept, type Link } from "./link";
import { choice, fieldIn } from "./units";
import { fieldOf, shareOf, spanOf, typed, valueAt, written, type Field, type Span } from "./numbers";
import "./sliders.css";

const STEPS = 1000;
// Of more objects than these the numbers are shown one object at a time.
const MANY = 40;
// Objects that are built at once then, where they are in sight, and how high one is (pixels).
const PART = 20,
  HEAD = 27;
// Characters of all stars.
const MOST_KEPT = 1900;
// Rows that a search shows.
const FOUND = 100;
// Width of the knob that the browser draws (pixels).
const KNOB = 16;
// A key that rests this long begins a new step of undo.
const PAUSE = 600;

// Addresses with a star, of every scene.
const kept = new Kept("stars");
type Stars = Record<string, string[]>;
function storedStars(): Stars {
  try {
    return JSON.parse(kept.get() ?? "{}") ?? {};
  } catch {
    return {};
  }
}

interface Props {
  editor: Editor;
  link: Link;
  scene: string;
  fields: Field[];
  spans: Map<string, Span>;
}

const ownerOf = (field: Field): string => field.address.split(/[.[]/)[0]!;
// Every word of a search is in the name of a number, its address or what it measures.
export function isMeant(field: Field, search: string): boolean {
  const all = `${field.address} ${field.label} ${field.quantity}`.toLowerCase();
  return search
    .toLowerCase()
    .split(/\s+/)
    .every((word) => all.includes(word));
}

export function Sliders({ editor, link, scene, fields, spans }: Props) {
  const [search, setSearch] = useState(""),
    [stars, setStars] = useState(storedStars);
  const own = stars[scene] ?? [];
  const star = (address: string) => {
    const now = storedStars(),
      before = now[scene] ?? [];
    now[scene] = before.includes(address) ? before.filter((one) => one !== address) : [...before, address];
    if (!now[scene]!.length) delete now[scene];
    // What is kept is small: scenes of long ago lose theirs.
    while (JSON.stringify(now).length > MOST_KEPT && Object.keys(now).length > 1) delete now[Object.keys(now)[0]!];
    kept.set(JSON.stringify(now), link);
    setStars(now);
  };
  // What looks as before is not drawn anew.
  const drawn = useRef(new Map<string, { look: string; of: VNode }>());
  const slider = (field: Field, owned = true): VNode => {
    const { address, value, unit, units, si, bounds, label } = field,
      text = editor.state.sliceDoc(...field.number_at),
      isStarred = own.includes(address),
      key = `${address} ${owned}`;
    const name = owned ? label : `${label} of ${ownerOf(field)}`;
    const look = JSON.stringify([
        text,
        value,
        unit,
        units,
        si,
        bounds,
        spans.get(address),
        choice.value,
        isStarred,
        name,
      ]),
      before = drawn.current.get(key);
    if (before?.look === look) return before.of;
    const of = (
      <Slider
        key={address}
        editor={editor}
        field={field}
        text={text}
        spans={spans}
        name={name}
        starred={isStarred}
        star={() => star(address)}
      />
    );
    drawn.current.set(key, { look, of });
    return of;
  };
  const first = fields.filter((field) => own.includes(field.address)),
    groups = new Map<string, Field[]>();
  // A number stands in one place: with a star above, else with its object.
  for (const field of fields)
    if (!own.includes(field.address)) {
      const id = ownerOf(field),
        all = groups.get(id) ?? [];
      all.push(field);
      groups.set(id, all);
    }
  const opened = useRef(new Map<string, boolean>()),
    isMany = groups.size > MANY;
  const group = ([id, all]: [string, Field[]]) => (
    <Group
      key={id}
      id={id}
      count={all.length}
      open={id !== "run" && all.length <= 60 && !isMany}
      opened={opened.current}
    >
      {() => all.map((field) => slider(field))}
    </Group>
  );
  const meant = search.trim() ? fields.filter((field) => isMeant(field, search.trim())) : null;
  return (
    <div class="sliders" role="group" aria-label="numbers of the scene">
      {fields.length > 0 && (
        <input
          type="search"
          aria-label="search numbers"
          placeholder="Search numbers"
          value={search}
          onInput={(event) => setSearch(event.currentTarget.value)}
          onKeyDown={(event) => {
            if (event.key === "Escape" && search) {
              event.stopPropagation();
              setSearch("");
            }
          }}
        />
      )}
      {meant ? (
        <>
          {meant.length === 0 && (
            <p class="soft" role="status">
              No number is called “{search.trim()}”.
            </p>
          )}
          {meant.slice(0, FOUND).map((field) => slider(field, false))}
          {meant.length > FOUND && (
            <p class="soft" role="status">
              {meant.length - FOUND} more: search for more words.
            </p>
          )}
        </>
      ) : (
        <>
          {first.length > 0 && (
            <Group key="with a star" id="with a star" count={first.length} open>
              {() => first.map((field) => slider(field, false))}
            </Group>
          )}
          {isMany
            ? parted([...groups], PART).map((part) => (
                <InSight key={part[0]![0]} scroller=".side" height={HEAD * part.length}>
                  {() => part.map(group)}
                </InSight>
              ))
            : [...groups].map(group)}
        </>
      )}
      {fields.length === 0 && <p class="soft">No numbers can be read from the text yet.</p>}
    </div>
  );
}

function parted<T>(all: T[], size: number): T[][] {
  return Array.from({ length: Math.ceil(all.length / size) }, (_, k) => all.slice(k * size, (k + 1) * size));
}

interface GroupProps {
  id: string;
  count: number;
  open: boolean;
  // Those that were opened or closed, also while they are out of sight.
  opened?: Map<string, boolean>;
  children: () => VNode[];
}

// The numbers of an object, made where they are looked at.
function Group({ id, count, open, opened, children }: GroupProps) {
  const [isOpen, setOpen] = useState(opened?.get(id) ?? open);
  return (
    <details
      open={isOpen}
      onToggle={({ currentTarget }) => {
        opened?.set(id, currentTarget.open);
        setOpen(currentTarget.open);
      }}
    >
      <summary>
        {id} <span class="soft">{count}</span>
      </summary>
      {isOpen && children()}
    </details>
  );
}

interface Row {
  editor: Editor;
  field: Field;
  text: string;
  spans: Map<string, Span>;
  name: string;
  starred: boolean;
  star: () => void;
}

function Slider({ editor, field, text, spans, name, starred, star }: Row) {
  const drag = useRef(0),
    last = useRef(0),
    held = useRef(false),
    raw = useRef(false);
  const bar = useRef<HTMLInputElement>(null);
  // Where it is held: asked of the page once, which would be laid out anew at every move.
  const place = useRef({ left: 0, width: 1 });
  const [wrong, setWrong] = useState(""),
    [, redraw] = useReducer((count: number) => count + 1, 0);
  // What is being typed stays, whatever comes of edits before.
  const [typing, setTyping] = useState<string | null>(null);
  const { address, value, unit, units, si } = field;
  let span = spans.get(address);
  // A number that was set elsewhere may lie beyond.
  if (
    !span ||
    (!held.current &&
      (value < span.low * (1 - 1e-9) - 1e-300 || value > span.high * (1 + 1e-9) || (span.log && value <= 0)))
  ) {
    span = spanOf(field);
    spans.set(address, span);
  }
  const shownUnit = unit || si,
    other = fieldIn(field),
    words = other ? `${other.text} ${other.unit}` : `${text}${shownUnit ? ` ${shownUnit}` : ""}`;

  const move = (share: number) => {
    const now = performance.now();
    if (!held.current && now - last.current > PAUSE) drag.current = editor.drag();
    last.current = now;
    const state = editor.state,
      own = fieldOf(state, address);
    if (!own) return;
    const [from, to] = own.number_at,
      before = state.sliceDoc(from, to);
    const insert = written(valueAt(span!, share), before, field.whole, span!);
    if (insert !== before) editor.change({ from, to, insert }, drag.current);
  };
  // The browser tells of a slider once a frame, of the pointer at once: this saves half a frame.
  const newest = useRef(move);
  newest.current = move;
  useEffect(() => {
    const own = bar.current!,
      follow = (event: Event) => {
        if (!held.current || editor.isBusy) return;
        const { left, width } = place.current;
        const share = ((event as PointerEvent).clientX - left - KNOB / 2) / (width - KNOB);
        raw.current = true;
        newest.current(Math.round(STEPS * Math.min(1, Math.max(0, share))) / STEPS);
      };
    own.addEventListener("pointerrawupdate", follow);
    return () => own.removeEventListener("pointerrawupdate", follow);
  }, []);
  const settle = () => {
    held.current = false;
    const share = shareOf(span!, value);
    if (share >= 0.02 && share <= 0.98) return;
    spans.set(address, spanOf(field));
    redraw(0);
  };
  const enter = (text: string) => {
    const own = fieldOf(editor.state, address),
      change = own && typed(own, other ? other.back(text) : unit ? text : text.replace(` ${shownUnit}`, ""));
    const isFine = change !== undefined && typeof change !== "string";
    setWrong(isFine ? "" : (change ?? "This number is not in the text any more."));
    setTyping(isFine ? null : text);
    if (isFine) {
      spans.delete(address);
      editor.change(change, editor.drag());
    }
  };
  const forget = () => {
    setWrong("");
    setTyping(null);
  };
  return (
    <div class="slider" data-address={address}>
      <button
        type="button"
        class="star"
        aria-pressed={starred}
        aria-label={`star of ${address}`}
        title={starred ? "take the star off" : "keep this number on top"}
        onClick={star}
      >
        {starred ? "★" : "☆"}
      </button>
      <label for={`number ${address}`} title={`${address}${field.quantity ? `: ${field.quantity}` : ""}`}>
        {name}
      </label>
      <input
        type="range"
        ref={bar}
        min={0}
        max={STEPS}
        step={1}
        value={Math.round(STEPS * shareOf(span, value))}
        aria-label={`${address}, slider`}
        aria-valuetext={words}
        onPointerDown={(event) => {
          held.current = true;
          place.current = event.currentTarget.getBoundingClientRect();
          raw.current = false;
          drag.current = editor.drag();
        }}
        onInput={(event) => move(Number(event.currentTarget.value) / STEPS)}
        onChange={settle}
      />
      <input
        type="text"
        id={`number ${address}`}
        value={typing ?? words}
        aria-invalid={wrong !== ""}
        aria-describedby={wrong ? `wrong ${address}` : undefined}
        spellcheck={false}
        size={12}
        title={units.length ? `in ${units.join(", ")}` : field.whole ? "a whole number" : "a number"}
        onFocus={(event) => event.currentTarget.select()}
        onInput={(event) => setTyping(event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key === "Enter") enter(event.currentTarget.value);
          if (event.key === "Escape") forget();
        }}
        onBlur={(event) => {
          const given = event.currentTarget.value;
          if (given !== words) enter(given);
          else forget();
        }}
      />
      {wrong && (
        <p class="number-note" role="alert" id={`wrong ${address}`}>
          {wrong}
        </p>
      )}
    </div>
  );
}
