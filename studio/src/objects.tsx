// The mechanism as a graph: objects with their ports, joined by dragging from port to port or
// with the keyboard.

import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { clip, copied, pasted } from "./copy";
import { BOX, boxes, freeName, ownerOf, portAt, within, type Box, type Outline } from "./graph";
import { isInField } from "./keys";
import { Palette, Picture, type Part, type Parts } from "./kinds";
import { put } from "./starter";
import { Steps, written, type Change, type Edits } from "./tree";

export interface Fault {
  path: string;
  severity: string;
  message: string;
  hints: string[];
}
interface Props {
  objects: Outline[];
  faults: Fault[];
  parts: Parts;
  selected: string[];
  select: (ids: string[]) => void;
  edit: (make: (edits: Edits) => Change[]) => boolean;
}
interface View {
  x: number;
  y: number;
  k: number;
}
interface Pull {
  output: string | null;
  input: string | null;
  x: number;
  y: number;
  ends: { x: number; y: number };
}

function byObject(faults: Fault[]): Map<string, Fault[]> {
  const all = new Map<string, Fault[]>();
  for (const fault of faults) {
    const id = fault.path.split(".")[0]!,
      own = all.get(id) ?? [];
    own.push(fault);
    all.set(id, own);
  }
  return all;
}
// A graph of more objects is built where it is in sight.
const MANY = 60;

// Where an input is written, and with what, when it is connected to an output; without an address to
// the only input, or one that is free. Text: why it cannot be.
function connection(edits: Edits, object: Outline, address: string | null, output: string): Change[] | string {
  const { id, inputs, open, kind } = object,
    free = inputs.find((one) => one.output === "") ?? (open || inputs.length > 1 ? undefined : inputs[0]);
  const known = address === null ? free : inputs.find((one) => one.address === address);
  if (known) return edits.set(["objects", ...known.address.split(".")], JSON.stringify(output));
  if (inputs.length && !open) return `All inputs of ${id} are connected: drop on the one that is to change.`;
  if (!open)
    return kind
      ? `${id} has no input: nothing drives an object of kind ${kind.replaceAll("_", " ")}.`
      : `The kind of ${id} is not known, and so are its inputs.`;
  const name = freeName(
    "input",
    inputs.map((one) => one.name),
  );
  return edits.set(["objects", object.id, "inputs", name], written({ object: output, ratio: 1 }));
}

// What an object loses when it hangs on nothing.
function released(edits: Edits, address: string): Change[] {
  const [id, ...rest] = address.split(".");
  return edits.remove(rest[0] === "inputs" ? ["objects", id!, "inputs", rest[1]!] : ["objects", id!, "input"]);
}

// Objects taken out, and all connections to them.
export function removed(edits: Edits, ids: string[], objects: Outline[]): Change[] {
  const gone = new Set(ids),
    loose = objects
      .filter((one) => !gone.has(one.id))
      .flatMap((one) => one.inputs.filter((input) => gone.has(ownerOf(input.output))).map((input) => input.address));
  const steps = new Steps(edits);
  for (const address of loose) steps.do((now) => released(now, address));
  for (const id of ids) steps.remove(["objects", id]);
  return steps.changes;
}

export function Objects({ objects, faults, parts, selected, select, edit }: Props) {
  const svg = useRef<SVGSVGElement>(null);
  const [view, setView] = useState<View | null>(null);
  const [pull, setPull] = useState<Pull | null>(null);
  const [edge, setEdge] = useState<string | null>(null);
  const [adding, setAdding] = useState(false);
  const [joining, setJoining] = useState<string | null>(null);
  // Why what was dragged could not be connected.
  const [refused, setRefused] = useState("");
  const [, redraw] = useState(0);
  const pan = useRef<{ x: number; y: number; view: View } | null>(null);
  const { drawn, at, faultsBy } = useMemo(() => {
    const drawn = boxes(objects);
    return { drawn, at: new Map(drawn.map((box) => [box.object.id, box])), faultsBy: byObject(faults) };
  }, [objects, faults]);

  const fitted = (): View => {
    const room = svg.current?.getBoundingClientRect() ?? { width: 500, height: 400 };
    const right = drawn.reduce((most, box) => Math.max(most, box.x + BOX.width), BOX.width),
      bottom = drawn.reduce((most, box) => Math.max(most, box.y + box.height), BOX.head);
    const k = Math.max(0.3, Math.min(1.25, (room.width - 48) / right, (room.height - 40) / bottom));
    return { k, x: (room.width - k * right) / 2, y: (room.height - k * bottom) / 2 };
  };
  // What is drawn stays in sight as objects come and go.
  const shape = drawn.map((box) => `${box.object.id} ${box.x} ${box.y} ${box.height}`).join();
  useLayoutEffect(() => {
    setView(fitted());
  }, [shape]);
  useEffect(() => {
    const own = svg.current!,
      room = new ResizeObserver(() => setView(fitted()));
    room.observe(own);
    const wheel = (event: WheelEvent) => {
      event.preventDefault();
      zoom(Math.exp(-Math.sign(event.deltaY) * 0.18), event.clientX, event.clientY);
    };
    own.addEventListener("wheel", wheel, { passive: false });
    return () => {
      room.disconnect();
      own.removeEventListener("wheel", wheel);
    };
  }, [shape]);
  const now = view ?? { x: 24, y: 20, k: 1 };
  const zoom = (factor: number, clientX?: number, clientY?: number) =>
    setView((before) => {
      const own = svg.current!.getBoundingClientRect(),
        old = before ?? now;
      const k = Math.min(3, Math.max(0.2, old.k * factor)),
        x = (clientX ?? own.left + own.width / 2) - own.left,
        y = (clientY ?? own.top + own.height / 2) - own.top;
      return { k, x: x - ((x - old.x) * k) / old.k, y: y - ((y - old.y) * k) / old.k };
    });
  const placeOf = (event: PointerEvent) => {
    const own = svg.current!.getBoundingClientRect();
    return { x: (event.clientX - own.left - now.x) / now.k, y: (event.clientY - own.top - now.y) / now.k };
  };

  const add = (part: Part) => {
    const driver = (selected.length === 1 && objects.find((one) => one.id === selected[0])) || objects.at(-1);
    let id = "";
    const done = edit((edits) => {
      const steps = new Steps(edits);
      id = put(steps, part, parts, driver ?? null);
      return steps.changes;
    });
    if (done) select([id]);
    setAdding(false);
  };
  const remove = () => {
    if (edge) {
      const address = edge;
      setEdge(null);
      edit((edits) => released(edits, address));
      return;
    }
    if (selected.length && edit((edits) => removed(edits, selected, objects))) select([]);
  };
  const duplicate = () => {
    const taken = objects.map((one) => one.id),
      copies: string[] = [];
    const done = edit((edits) => {
      const steps = new Steps(edits);
      for (const id of selected) {
        const copy = freeName(id, [...taken, ...copies]);
        copies.push(copy);
        steps.do((now) => now.duplicate(["objects", id], copy));
      }
      return steps.changes;
    });
    if (done) select(copies);
  };
  const copy = (): string | null => {
    let text: string | null = null;
    edit((edits) => {
      text = copied(edits, selected);
      return [];
    });
    if (text !== null) {
      clip.text = text;
      redraw((count) => count + 1);
    }
    return text;
  };
  const paste = (text: string): boolean => {
    let names: string[] = [];
    const done = edit((edits) => {
      const steps = new Steps(edits);
      names = pasted(steps, text);
      return steps.changes;
    });
    if (done) select(names);
    return done;
  };
  // By the keyboard, from and to the clipboard that all windows and programs have.
  const clipboard = useRef({ copy, paste, remove });
  clipboard.current = { copy, paste, remove };
  useEffect(() => {
    const act = (event: ClipboardEvent) => {
      const at = document.activeElement;
      if ((at && at !== document.body && !at.closest(".objects")) || isInField(at)) return;
      const taken =
        event.type === "paste"
          ? clipboard.current.paste(event.clipboardData?.getData("text/plain") ?? "")
          : clipboard.current.copy();
      if (!taken) return;
      event.preventDefault();
      if (typeof taken === "string") event.clipboardData?.setData("text/plain", taken);
      if (event.type === "cut") clipboard.current.remove();
    };
    for (const type of ["copy", "cut", "paste"] as const) document.addEventListener(type, act);
    return () => {
      for (const type of ["copy", "cut", "paste"] as const) document.removeEventListener(type, act);
    };
  }, []);
  const connect = (output: string, object: Outline, address: string | null) => {
    let why = ownerOf(output) === object.id ? `${object.id} cannot drive itself.` : "";
    if (!why)
      edit((edits) => {
        const made = connection(edits, object, address, output);
        if (typeof made !== "string") return made;
        why = made;
        return [];
      });
    setRefused(why);
    setJoining(null);
  };

  const begin = (event: PointerEvent, output: string | null, input: string | null, ends: { x: number; y: number }) => {
    event.stopPropagation();
    event.preventDefault();
    setRefused("");
    svg.current!.setPointerCapture(event.pointerId);
    setPull({ output, input, ends, ...placeOf(event) });
  };
  const move = (event: PointerEvent) => {
    if (pull) setPull({ ...pull, ...placeOf(event) });
    else if (pan.current) {
      const { x, y, view: old } = pan.current;
      setView({ ...old, x: old.x + event.clientX - x, y: old.y + event.clientY - y });
    }
  };
  const drop = (event: PointerEvent) => {
    pan.current = null;
    if (!pull) return;
    setPull(null);
    const there = placeOf(event),
      isFar = Math.hypot(there.x - pull.ends.x, there.y - pull.ends.y) * now.k > 12;
    const under = document.elementFromPoint(event.clientX, event.clientY),
      id = under?.closest<SVGElement>("[data-id]")?.dataset.id;
    const object = objects.find((one) => one.id === id);
    if (pull.output !== null) {
      if (object) connect(pull.output, object, under?.closest<SVGElement>("[data-input]")?.dataset.input ?? null);
      else if (isFar) setRefused(`Nothing is connected: drop ${pull.output} on an input.`);
      return;
    }
    const [owner] = pull.input!.split(".");
    const output = under?.closest<SVGElement>("[data-output]")?.dataset.output ?? object?.id;
    const target = objects.find((one) => one.id === owner);
    if (output && target) connect(output, target, pull.input);
    else if (!object && target?.inputs.some((one) => one.address === pull.input && one.output !== ""))
      edit((edits) => released(edits, pull.input!));
    else if (isFar) setRefused(`Nothing is connected: drop this input of ${owner} on an output.`);
  };
  const keys = (event: KeyboardEvent) => {
    const { key } = event,
      target = event.target as Element,
      box = target.closest<SVGElement>("[data-id]"),
      id = box?.dataset.id;
    // What is added has keys of its own, and buttons have theirs.
    if (
      isInField(target) ||
      target.closest("[role=dialog]") ||
      (target.closest("button") && (key === "Enter" || key === " "))
    )
      return;
    if (key === "Escape") {
      setRefused("");
      setJoining(null);
      setEdge(null);
      setAdding(false);
      return;
    }
    if (key === "Delete" || key === "Backspace") {
      event.preventDefault();
      remove();
      return;
    }
    if ((event.ctrlKey || event.metaKey) && key.toLowerCase() === "d") {
      event.preventDefault();
      duplicate();
      return;
    }
    if ((event.ctrlKey || event.metaKey) && key.toLowerCase() === "a") {
      event.preventDefault();
      select(objects.map((one) => one.id));
      return;
    }
    if (key === "Enter" || key === " ") {
      event.preventDefault();
      const address = (event.target as SVGElement).dataset.edge,
        object = objects.find((one) => one.id === id);
      if (address) setEdge(address);
      else if (object && joining) connect(joining, object, null);
      else if (id) select([id]);
      return;
    }
    if (key.toLowerCase() === "c" && id && !event.ctrlKey && !event.metaKey) {
      event.preventDefault();
      setJoining(id);
      return;
    }
    if (key === "F2" && id) {
      event.preventDefault();
      select([id]);
      requestAnimationFrame(() => document.getElementById("object-name")?.focus());
    }
  };

  // The whole view is as large as the window at most.
  const room = { width: svg.current?.clientWidth || innerWidth, height: svg.current?.clientHeight || innerHeight };
  const inSight =
    drawn.length > MANY
      ? within(drawn, {
          left: -now.x / now.k,
          top: -now.y / now.k,
          right: (room.width - now.x) / now.k,
          bottom: (room.height - now.y) / now.k,
        })
      : null;
  const isSeen = ({ object: { id } }: Box): boolean =>
    inSight === null || inSight.has(id) || pull?.output?.split(".")[0] === id;
  const curve = (a: { x: number; y: number }, b: { x: number; y: number }) => {
    const d = Math.max(36, Math.abs(b.x - a.x) / 2);
    return `M${a.x} ${a.y}C${a.x + d} ${a.y} ${b.x - d} ${b.y} ${b.x} ${b.y}`;
  };
  const edges = drawn.flatMap((box) =>
    box.object.inputs.map((input, index) => {
      const from = at.get(ownerOf(input.output));
      // Of many that begin at an object in sight those whose end is.
      if (!from || !(isSeen(box) || (isSeen(from) && at.size <= MANY))) return null;
      const port = Math.max(
        0,
        from.object.outputs.findIndex((one) => one.address === input.output),
      );
      const d = curve(portAt(from, "out", port), portAt(box, "in", index));
      return (
        <g
          key={input.address}
          class={`connection${edge === input.address ? " chosen" : ""}`}
          tabindex={0}
          role="button"
          data-edge={input.address}
          aria-label={`connection from ${input.output} to ${box.object.id}`}
          onPointerDown={(event) => {
            event.stopPropagation();
            setEdge(input.address);
            select([]);
          }}
        >
          <title>
            {input.output} drives {box.object.id}
            {box.object.open ? ` (${input.name})` : ""}; Delete takes it away
          </title>
          <path class="hit" d={d} />
          <path d={d} />
        </g>
      );
    }),
  );
  return (
    <div class="objects" onKeyDown={keys}>
      <div class="tools" role="toolbar" aria-label="graph">
        <button type="button" aria-expanded={adding} onClick={() => setAdding(!adding)}>
          Add object
        </button>
        <button type="button" disabled={!selected.length} onClick={duplicate} title="Ctrl-D">
          Duplicate
        </button>
        <button type="button" disabled={!selected.length} onClick={copy} title="Ctrl-C">
          Copy
        </button>
        <button
          type="button"
          disabled={clip.text === null}
          onClick={() => paste(clip.text!)}
          title="Ctrl-V, from other windows too"
        >
          Paste
        </button>
        <button type="button" disabled={!selected.length && !edge} onClick={remove} title="Delete">
          Delete
        </button>
        <button
          type="button"
          aria-pressed={!selected.length && !edge}
          onClick={() => {
            setEdge(null);
            select([]);
          }}
        >
          Scene and run
        </button>
      </div>
      <div class="canvas">
        <svg
          class="objects-graph"
          ref={svg}
          role="group"
          aria-label="objects of the mechanism"
          onPointerDownCapture={() => setRefused("")}
          onPointerDown={(event) => {
            if (event.button === 0) {
              svg.current!.setPointerCapture(event.pointerId);
              pan.current = { x: event.clientX, y: event.clientY, view: now };
            }
          }}
          onPointerMove={move}
          onPointerUp={drop}
          onPointerCancel={() => {
            setPull(null);
            pan.current = null;
          }}
          onDblClick={() => setView(fitted())}
        >
          <g transform={`translate(${now.x.toFixed(2)} ${now.y.toFixed(2)}) scale(${now.k.toFixed(4)})`}>
            {edges}
            {drawn.filter(isSeen).map((box) => (
              <ObjectBox
                key={box.object.id}
                box={box}
                faults={faultsBy.get(box.object.id) ?? NONE}
                chosen={selected.includes(box.object.id)}
                target={joining !== null && joining !== box.object.id}
                begin={begin}
                choose={(event) => {
                  setEdge(null);
                  if (joining) {
                    connect(joining, box.object, null);
                    return;
                  }
                  select(
                    event.shiftKey
                      ? selected.includes(box.object.id)
                        ? selected.filter((id) => id !== box.object.id)
                        : [...selected, box.object.id]
                      : [box.object.id],
                  );
                }}
              />
            ))}
            {pull && <path class="pull" d={pull.output !== null ? curve(pull.ends, pull) : curve(pull, pull.ends)} />}
          </g>
        </svg>
        <div class="zoom">
          <button type="button" onClick={() => zoom(1.25)} aria-label="zoom in">
            +
          </button>
          <button type="button" onClick={() => zoom(0.8)} aria-label="zoom out">
            −
          </button>
          <button type="button" onClick={() => setView(fitted())}>
            Fit
          </button>
        </div>
        {joining && (
          <p class="hint-line" role="status">
            Connect {joining} to …: choose an object, Escape ends.
          </p>
        )}
        {refused && !joining && (
          <p class="hint-line refused" role="status">
            {refused}
          </p>
        )}
        {!joining && !refused && objects.length > 0 && !selected.length && !edge && (
          <p class="hint-line soft">
            Drag from port to port to connect; C connects with the keyboard, Shift selects several.
          </p>
        )}
        {(adding || objects.length === 0) && (
          <Palette parts={parts} add={add} close={objects.length ? () => setAdding(false) : null} />
        )}
      </div>
    </div>
  );
}

interface BoxProps {
  box: Box;
  faults: Fault[];
  chosen: boolean;
  target: boolean;
  choose: (event: PointerEvent) => void;
  begin: (event: PointerEvent, output: string | null, input: string | null, ends: { x: number; y: number }) => void;
}

const NONE: Fault[] = [];
const cut = (text: string, length: number): string => (text.length > length ? `${text.slice(0, length - 1)}…` : text);

function ObjectBox({ box, faults, chosen, target, choose, begin }: BoxProps) {
  const { object, x, y, height } = box,
    { inputs, outputs, open } = object;
  const errors = faults.filter((one) => one.severity === "error").length;
  const kind = object.kind ? object.kind.replace("_", " ") : "unknown kind";
  const told = faults.map((one) => one.message).join("\n");
  const ports = inputs.map((input) => ({
    address: input.address as string | null,
    name: input.name,
    free: input.output === "",
  }));
  if (open) ports.push({ address: null, name: "new", free: true });
  // Names of ports take the place of the picture.
  const left = ports.length < 2 ? 44 : 56;
  const words = `${object.id}: ${kind}${object.detail ? `, ${object.detail}` : ""}${faults.length ? `; ${faults.length} ${faults.length === 1 ? "fault" : "faults"}: ${told}` : ""}`;
  return (
    <g
      class={`object-box${inputs.length || open ? "" : " drive"}${chosen ? " chosen" : ""}${target ? " target" : ""}${errors ? " wrong" : ""}`}
      data-id={object.id}
      tabindex={0}
      role="button"
      aria-pressed={chosen}
      aria-label={words}
      onPointerDown={(event) => {
        if (event.button === 0) {
          event.stopPropagation();
          (event.currentTarget as SVGElement).focus();
          choose(event);
        }
      }}
    >
      <title>{words}</title>
      <rect class="frame" x={x} y={y} width={BOX.width} height={height} rx={inputs.length || open ? 6 : 22} />
      {ports.length < 2 && <Picture kind={object.kind} x={x + 12} y={y + height / 2 - 12} size={24} />}
      <text class="id" x={x + left} y={y + height / 2 - 8}>
        {cut(object.id, ports.length < 2 ? 13 : 11)}
      </text>
      <text class="object-kind" x={x + left} y={y + height / 2 + 7}>
        {cut(kind, 16)}
      </text>
      <text class="object-kind" x={x + left} y={y + height / 2 + 21}>
        {cut(object.detail.replaceAll("_", " "), 18)}
      </text>
      {faults.length > 0 && (
        <g class={errors ? "badge error" : "badge warning"}>
          <circle cx={x + BOX.width - 4} cy={y + 4} r={10} />
          <text x={x + BOX.width - 4} y={y + 8} text-anchor="middle">
            {faults.length}
          </text>
        </g>
      )}
      {ports.map((port, index) => {
        const place = portAt(box, "in", index);
        return (
          <g
            key={port.address ?? "new"}
            class={`port in${port.address === null ? " further" : port.free ? " free" : ""}`}
            data-input={port.address ?? ""}
            onPointerDown={(event) => {
              if (port.address) begin(event, null, port.address, place);
            }}
          >
            <title>
              {port.address ? `input ${port.name}; drag it to an output, or away to let go` : "a further input"}
            </title>
            <circle class="hit" cx={place.x} cy={place.y} r={11} />
            <circle cx={place.x} cy={place.y} r={5.5} />
            {ports.length > 1 && (
              <text class="port-name" x={place.x + 9} y={place.y + 3.5}>
                {port.address ? cut(port.name, 8) : "+"}
              </text>
            )}
          </g>
        );
      })}
      {outputs.map((output, index) => {
        const place = portAt(box, "out", index),
          name = output.address.split(".")[1] ?? "";
        return (
          <g
            key={output.address}
            class="port out"
            data-output={output.address}
            onPointerDown={(event) => begin(event, output.address, null, place)}
          >
            <title>{`output ${output.address}${output.coordinate ? `, ${output.coordinate}` : ""}; drag it to an input`}</title>
            <circle class="hit" cx={place.x} cy={place.y} r={11} />
            {output.coordinate === "sliding" ? (
              <rect x={place.x - 5} y={place.y - 5} width={10} height={10} />
            ) : (
              <circle cx={place.x} cy={place.y} r={5.5} />
            )}
            {outputs.length > 1 && name && (
              <text class="port-name" x={place.x + 10} y={place.y + 3.5}>
                {name}
              </text>
            )}
          </g>
        );
      })}
    </g>
  );
}
