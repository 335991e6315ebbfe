// Every number of the scene as a field with its unit and a slider.

import type { VNode } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import type { Editor } from "./editor";
import { choice, fieldIn } from "./units";
import { fieldOf, shareOf, spanOf, typed, valueAt, written, type Field, type Span } from "./numbers";

const STEPS = 1000;
// Of more objects than these the numbers are shown one object at a time.
const MANY = 40;
// Width of the knob that the browser draws (pixels).
const KNOB = 16;
// A key that rests this long begins a new step of undo.
const PAUSE = 600;

interface Props { editor: Editor; fields: Field[]; spans: Map<string, Span> }

export function Sliders({ editor, fields, spans }: Props) {
  // What looks as before is not drawn anew.
  const drawn = useRef(new Map<string, { look: string; of: VNode }>());
  const slider = (field: Field): VNode => {
    const { address, value, unit, units, si, bounds } = field, text = editor.state.sliceDoc(...field.number_at);
    const look = JSON.stringify([text, value, unit, units, si, bounds, spans.get(address), choice.number]), before = drawn.current.get(address);
    if (before?.look === look) return before.of;
    const of = <Slider key={address} editor={editor} field={field} text={text} spans={spans} />;
    drawn.current.set(address, { look, of });
    return of;
  };
  const groups = new Map<string, Field[]>();
  for (const field of fields) {
    const id = field.address.split(/[.[]/)[0]!;
    const own = groups.get(id) ?? [];
    own.push(field);
    groups.set(id, own);
  }
  return (
    <div class="sliders" role="group" aria-label="numbers of the scene">
      {[...groups].map(([id, own]) => (
        <Group key={id} id={id} count={own.length} open={id !== "run" && own.length <= 60 && groups.size <= MANY}>{() => own.map(slider)}</Group>
      ))}
      {fields.length === 0 && <p class="soft">No numbers can be read from the text yet.</p>}
    </div>
  );
}

// The numbers of an object, made where they are looked at.
function Group({ id, count, open, children }: { id: string; count: number; open: boolean; children: () => VNode[] }) {
  const [isOpen, setOpen] = useState(open);
  return (
    <details open={isOpen} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>{id} <span class="soft">{count}</span></summary>
      {isOpen && children()}
    </details>
  );
}

function Slider({ editor, field, text, spans }: { editor: Editor; field: Field; text: string; spans: Map<string, Span> }) {
  const drag = useRef(0), last = useRef(0), held = useRef(false), raw = useRef(false);
  const bar = useRef<HTMLInputElement>(null);
  // Where it is held: asked of the page once, which would be laid out anew at every move.
  const place = useRef({ left: 0, width: 1 });
  const [wrong, setWrong] = useState("");
  // What is being typed stays, whatever comes of edits before.
  const [typing, setTyping] = useState<string | null>(null);
  const { address, value, unit, units, si } = field;
  let span = spans.get(address);
  // A number that was set elsewhere may lie beyond.
  if (!span || (!held.current && (value < span.low * (1 - 1e-9) - 1e-300 || value > span.high * (1 + 1e-9) || (span.log && value <= 0)))) {
    span = spanOf(field);
    spans.set(address, span);
  }
  const name = address.replace(/^[^.[]+\.?/, "") || address;
  const shownUnit = unit || si, other = fieldIn(field), words = other ? `${other.text} ${other.unit}` : `${text}${shownUnit ? ` ${shownUnit}` : ""}`;

  const move = (share: number) => {
    const now = performance.now();
    if (!held.current && now - last.current > PAUSE) drag.current = editor.drag();
    last.current = now;
    const state = editor.state, own = fieldOf(state, address);
    if (!own) return;
    const [from, to] = own.number_at, before = state.sliceDoc(from, to);
    const insert = written(valueAt(span!, share), before, field.whole, span!);
    if (insert !== before) editor.change({ from, to, insert }, drag.current);
  };
  // The browser tells of a slider once a frame, of the pointer at once: this saves half a frame.
  const newest = useRef(move);
  newest.current = move;
  useEffect(() => {
    const own = bar.current!, follow = (event: Event) => {
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
    if (share < 0.02 || share > 0.98) spans.set(address, spanOf(field));
  };
  const enter = (text: string) => {
    const own = fieldOf(editor.state, address), change = own && typed(own, other ? other.back(text) : unit ? text : text.replace(` ${shownUnit}`, ""));
    const isFine = change !== undefined && typeof change !== "string";
    setWrong(isFine ? "" : change ?? "This number is not in the text any more.");
    setTyping(isFine ? null : text);
    if (isFine) { spans.delete(address); editor.change(change, editor.drag()); }
  };
  const forget = () => { setWrong(""); setTyping(null); };
  return (
    <div class="slider" data-address={address}>
      <label for={`number ${address}`} title={`${address}${field.quantity ? `: ${field.quantity}` : ""}`}>{name}</label>
      <input type="range" ref={bar} min={0} max={STEPS} step={1} value={Math.round(STEPS * shareOf(span, value))} aria-label={`${address}, slider`}
        aria-valuetext={words}
        onPointerDown={(event) => { held.current = true; place.current = event.currentTarget.getBoundingClientRect(); raw.current = false; drag.current = editor.drag(); }}
        onInput={(event) => move(Number(event.currentTarget.value) / STEPS)} onChange={settle} />
      <input type="text" id={`number ${address}`} value={typing ?? words} aria-invalid={wrong !== ""} aria-describedby={wrong ? `wrong ${address}` : undefined} spellcheck={false} size={12}
        title={units.length ? `in ${units.join(", ")}` : field.whole ? "a whole number" : "a number"}
        onFocus={(event) => event.currentTarget.select()}
        onInput={(event) => setTyping(event.currentTarget.value)}
        onKeyDown={(event) => { if (event.key === "Enter") enter(event.currentTarget.value); if (event.key === "Escape") forget(); }}
        onBlur={(event) => { const given = event.currentTarget.value; if (given !== words) enter(given); else forget(); }} />
      {wrong && <p class="number-note" role="alert" id={`wrong ${address}`}>{wrong}</p>}
    </div>
  );
}
