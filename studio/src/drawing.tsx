// A linkage drawn to scale, whose joints are dragged, and whose links and points are drawn:
// mobility, groups, branches, range and faults are told while it changes.

import { useEffect, useRef, useState } from "preact/hooks";
import { begun, driven, removed, spotAt, type Board, type Spot } from "./build";
import { drafted, stances, type Known } from "./draft";
import { framed, Grid, HEIGHT, JointMark, Links, START, toPixel, toPlace, WIDTH, zoomed, type Frame } from "./figure";
import { dragged } from "./drag";
import {
  baseOf,
  basePose,
  gridOf,
  joints,
  leads,
  poseAt,
  snapped,
  stepOf,
  type Joint,
  type Point,
  type Sketch,
} from "./linkage";
import { InputRows } from "./inputs";
import type { Parts } from "./kinds";
import type { Link } from "./link";
import { TOOLS, Tools, type Tool } from "./tools";
import { find, member, Steps, type Change, type Edits, type Value } from "./tree";

interface Props {
  link: Link;
  scene: string;
  version: number;
  parts: Parts;
  root: () => Value | null;
  isAt: (version: number) => boolean;
  edit: (make: (edits: Edits) => Change[], drag?: number) => boolean;
  drag: () => number;
}
// A joint that is held, and the step of undo that its moves belong to.
interface Grip {
  joint: string;
  drag: number;
}
interface Move extends Grip {
  to: Point;
}
// What a tool was pressed at: where on the screen (by the keyboard: nowhere), and where in the drawing.
interface Press {
  screen: Point;
  place: Point;
}

// How near to a joint is on it, how far a press moves to be a drag, how wide the grid is at least (pixels).
const REACH = 13,
  MOVED = 5,
  MESH = 8;
const ARROWS: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export function Drawing({ link, scene, version, parts, root, isAt, edit, drag }: Props) {
  const [all, setAll] = useState<Sketch[]>([]);
  const [chosen, setChosen] = useState("");
  // Values of the inputs at which it is seen; null: where it is put together.
  const [at, setAt] = useState<number[] | null>(null);
  const [stale, setStale] = useState(false);
  const [told, setTold] = useState("");
  const [tool, setTool] = useState<Tool>("select");
  const [fixed, setFixed] = useState<Frame | null>(null);
  const [pressed, setPressed] = useState<Press | null>(null);
  const [cursor, setCursor] = useState<Point | null>(null);
  const frame = useRef<Frame | null>(null),
    svg = useRef<SVGSVGElement>(null);
  const held = useRef<Grip | null>(null),
    waiting = useRef<Move | null>(null),
    acts = useRef<(() => void)[]>([]);
  const pan = useRef<{ screen: Point; frame: Frame } | null>(null);
  // How links stood when their linkage was whole, and where they were drawn.
  const known = useRef(new Map<string, Known>());
  const asking = useRef(false),
    wanted = useRef(version),
    shown = useRef(-1);
  // Where linkages of several inputs are asked for, and where they were: in the server's words.
  const place = useRef(""),
    placeShown = useRef(""),
    base = useRef<number[] | null>(null);
  // The version that the drawing shows, and the one that the last move was made on: until another
  // is drawn, further moves wait.
  const [drawn, setDrawn] = useState(-1),
    behind = useRef<number | null>(null);
  const [busy, setBusy] = useState(false),
    [, setRound] = useState(0);
  wanted.current = version;

  const take = (found: { linkages: Sketch[] } | null) => {
    if (found) {
      for (const one of found.linkages) {
        const pose = basePose(one);
        if (pose) known.current.set(one.id, stances(one, pose));
      }
      setAll(found.linkages);
      setStale(false);
      return;
    }
    // Of a text that is not whole what it has; of copies the last good drawing.
    setAll((before) => {
      const texts = find(root() ?? undefined, ["objects"])?.members ?? [];
      const made = texts.flatMap(({ name, value }) => {
        if (member(value, "kind")?.value.text !== "linkage") return [];
        const stood = known.current.get(name) ?? new Map(),
          draft = drafted(name, value, stood) ?? before.find((one) => one.id === name);
        if (draft?.draft) known.current.set(name, stances(draft, basePose(draft)!));
        return draft ? [draft] : [];
      });
      return made.length ? made : before;
    });
    setStale(true);
  };
  useEffect(() => {
    let gone = false;
    const ask = async () => {
      const isShown = () => shown.current === wanted.current && placeShown.current === place.current;
      if (!scene || asking.current || isShown()) return;
      asking.current = true;
      const asked = wanted.current,
        there = place.current;
      try {
        const found = await link.get(
          `/api/linkages?scene=${encodeURIComponent(scene)}${there && `&at=${encodeURIComponent(there)}`}`,
        );
        if (gone) return;
        take(found);
      } catch {
        if (!gone) setStale(true);
      }
      shown.current = asked;
      placeShown.current = there;
      asking.current = false;
      if (!gone) {
        setDrawn(asked);
        setRound((round) => round + 1);
      }
      if (!gone && !isShown()) void ask();
    };
    void ask();
    return () => {
      gone = true;
      asking.current = false;
    };
  }, [version, scene, place.current]);

  const sketch = all.find((one) => one.id === chosen) ?? all[0];
  // What is drawn is drawn where the assembly holds.
  const own = tool === "select" && at?.length === sketch?.courses.length ? at : null,
    there = sketch ? poseAt(sketch, own ?? baseOf(sketch)) : null;
  // Where no course goes there yet, it is drawn as it stood.
  const stood = useRef<number[] | null>(null),
    settled = placeShown.current === place.current;
  const pose = there !== undefined ? there : settled && sketch ? basePose(sketch) : stood.current;
  stood.current = pose;
  // While a joint is held the scale stays.
  if (sketch && (!frame.current || !held.current)) frame.current = fixed ?? framed(sketch);
  const view = frame.current!,
    grid = view ? gridOf(MESH / view.scale) : 1;
  const pixel = (place: Point): Point => toPixel(view, place);
  const board: Board | null =
    sketch && pose
      ? { sketch, pose, joints: joints(sketch, pose), grid, known: known.current.get(sketch.id) ?? new Map(), parts }
      : null;
  if (board && !known.current.has(board.sketch.id)) known.current.set(board.sketch.id, board.known);
  const now = useRef(board);
  now.current = board;

  const free = () =>
    !asking.current &&
    placeShown.current === place.current &&
    shown.current === wanted.current &&
    behind.current === null &&
    isAt(shown.current);
  const changing = (make: (edits: Edits) => Change[] | string, step?: number) => {
    const changed = edit((edits) => {
      const done = make(edits);
      setTold(typeof done === "string" ? done : "");
      return typeof done === "string" ? [] : done;
    }, step);
    if (changed) {
      behind.current = shown.current;
      setBusy(true);
    }
  };
  // Shows it at values of the inputs; where the courses do not lead there, such are asked for that do.
  const see = (values: number[] | null) => {
    setAt(values);
    if (!values) base.current = null;
    else if (sketch && !leads(base.current ?? baseOf(sketch), values)) base.current = values;
    place.current = base.current && sketch ? JSON.stringify({ [sketch.id]: base.current }) : "";
  };
  const pull = ({ to, joint: name, drag: step }: Move) => {
    const { sketch: own, pose: stands, joints: there } = now.current ?? { joints: [] },
      joint = there.find((one) => one.names.includes(name));
    if (own && stands && joint)
      changing((edits) => dragged(edits, own, stands, there, joint, to, stepOf(1.5 / view.scale)), step);
  };
  const later = (next: Move) => {
    if (free()) pull(next);
    else {
      waiting.current = next;
      setBusy(true);
    }
  };
  // What a tool does, on the drawing as it is once everything before has come to it.
  const act = (make: (steps: Steps, board: Board) => string | null) => {
    const run = () => {
      const own = now.current;
      if (own)
        changing((edits) => {
          const steps = new Steps(edits);
          return make(steps, own) ?? steps.changes;
        });
    };
    if (free()) run();
    else {
      acts.current.push(run);
      setBusy(true);
    }
  };
  // The next move is made on what the last one came to.
  useEffect(() => {
    if (behind.current !== drawn) behind.current = null;
    while (acts.current.length && free()) acts.current.shift()!();
    const next = waiting.current;
    if (next && free()) {
      waiting.current = null;
      pull(next);
    }
    setBusy(behind.current !== null || waiting.current !== null || acts.current.length > 0);
  }, [drawn]);

  const screen = (event: PointerEvent | WheelEvent): Point => {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.current!.getScreenCTM()!.inverse());
    return [point.x, point.y];
  };
  const use = (from: Point, to: Point) => {
    const own = TOOLS[tool],
      reach = REACH / view.scale;
    act((steps, board) => own.act!(steps, board, spotAt(board, from, reach), spotAt(board, to, reach)));
    setPressed(null);
  };
  const press = (spot: Press) => {
    const { two, once } = TOOLS[tool];
    if (!two || (!pressed && board && once?.(spotAt(board, spot.place, REACH / view.scale))))
      use(spot.place, spot.place);
    else if (pressed) use(pressed.place, spot.place);
    else setPressed(spot);
  };
  const down = (event: PointerEvent) => {
    if (event.button !== 0) return;
    const point = screen(event);
    svg.current!.setPointerCapture(event.pointerId);
    if (tool !== "select") {
      event.preventDefault();
      svg.current!.focus();
      press({ screen: point, place: toPlace(view, point) });
      return;
    }
    pan.current = { screen: point, frame: view };
  };
  const move = (event: PointerEvent) => {
    const point = screen(event);
    if (held.current) later({ ...held.current, to: toPlace(view, point) });
    else if (pan.current) {
      const { screen: from, frame: old } = pan.current;
      if (fixed || Math.hypot(point[0] - from[0], point[1] - from[1]) > MOVED)
        setFixed({
          ...old,
          left: old.left - (point[0] - from[0]) / old.scale,
          bottom: old.bottom + (point[1] - from[1]) / old.scale,
        });
    } else if (tool !== "select") setCursor(toPlace(view, point));
  };
  const up = (event: PointerEvent) => {
    move(event);
    const point = screen(event);
    if (pressed && Math.hypot(point[0] - pressed.screen[0], point[1] - pressed.screen[1]) > MOVED)
      use(pressed.place, toPlace(view, point));
    held.current = null;
    pan.current = null;
  };
  const cancel = () => {
    held.current = null;
    pan.current = null;
    setPressed(null);
  };
  useEffect(() => {
    const own = svg.current;
    const wheel = (event: WheelEvent) => {
      event.preventDefault();
      const about = screen(event);
      setFixed(zoomed(frame.current!, Math.exp(-Math.sign(event.deltaY) * 0.18), about));
    };
    own?.addEventListener("wheel", wheel, { passive: false });
    return () => own?.removeEventListener("wheel", wheel);
  }, [sketch === undefined]);

  const step = (joint: Joint, event: KeyboardEvent) => {
    if (tool !== "select" || event.ctrlKey || event.metaKey) return;
    if (event.key === "Delete" || event.key === "Backspace") {
      event.preventDefault();
      const name = joint.names[0]!;
      act((steps, board) =>
        removed(steps, board, {
          at: joint.at,
          joint: board.joints.find((one) => one.names.includes(name)) ?? null,
          link: null,
        }),
      );
      return;
    }
    const by = ARROWS[event.key];
    if (!by) return;
    event.preventDefault();
    const size = stepOf(1.5 / view.scale) * (event.shiftKey ? 10 : 1);
    later({ joint: joint.names[0]!, drag: drag(), to: [joint.at[0] + by[0] * size, joint.at[1] + by[1] * size] });
  };
  // Tools go by the keyboard too: the arrow keys move what would be pressed, Enter presses.
  const keys = (event: KeyboardEvent) => {
    if (event.key === "Escape") {
      if (pressed) setPressed(null);
      else choose("select");
      return;
    }
    if (tool === "select") return;
    const by = ARROWS[event.key],
      from = cursor ?? toPlace(view, [WIDTH / 2, HEIGHT / 2]),
      size = grid * (event.shiftKey ? 10 : 1);
    if (by) {
      event.preventDefault();
      const [x, y] = snapped(from, grid);
      setCursor([x + by[0] * size, y + by[1] * size]);
    }
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      press({ screen: [NaN, NaN], place: from });
    }
  };
  const choose = (next: Tool) => {
    setTool(next);
    setPressed(null);
    setCursor(null);
    setTold("");
    if (next !== "select") see(null);
    if (next !== "select" && view) setFixed(view);
  };
  const fresh = () => {
    if (
      edit((edits) => {
        const steps = new Steps(edits);
        setChosen(begun(steps, parts));
        return steps.changes;
      })
    ) {
      behind.current = shown.current;
      setBusy(true);
      setFixed(START);
      setTool("ground");
    }
  };

  if (!sketch || !view) {
    return (
      <div class="drawing" aria-busy={busy}>
        <p class="soft">
          {stale ? "The scene has faults: they are told below." : "There is no linkage in this scene."}
        </p>
        <button type="button" onClick={fresh}>
          New linkage
        </button>
      </div>
    );
  }
  const several = find(root() ?? undefined, ["objects", sketch.id, "inputs"]) !== undefined;
  const target: Spot | null = board && cursor && tool !== "select" ? spotAt(board, cursor, REACH / view.scale) : null;
  const begin = board && pressed ? spotAt(board, pressed.place, REACH / view.scale) : null;
  return (
    <div class="drawing">
      <Tools tool={tool} choose={choose} />
      <div class="tools">
        {all.length > 1 && (
          <label>
            linkage{" "}
            <select
              value={sketch.id}
              onChange={(event) => {
                setChosen(event.currentTarget.value);
                see(null);
                setTool("select");
                setFixed(null);
              }}
            >
              {all.map((one) => (
                <option value={one.id}>{one.id}</option>
              ))}
            </select>
          </label>
        )}
        {!sketch.draft && (
          <InputRows sketch={sketch} at={own ?? baseOf(sketch)} disabled={tool !== "select"} set={see} />
        )}
        {!several && sketch.pairs.length > 0 && (
          <label>
            driven{" "}
            <select
              aria-label="driven pair"
              value={sketch.pairs.find((pair) => pair.driven)?.name ?? ""}
              onChange={(event) => {
                const name = event.currentTarget.value;
                if (name) act((steps, board) => driven(steps, board, name));
              }}
            >
              {!sketch.pairs.some((pair) => pair.driven) && <option value="">none yet</option>}
              {sketch.pairs.map((pair) => (
                <option value={pair.name}>{pair.name}</option>
              ))}
            </select>
          </label>
        )}
      </div>
      <div class="sheet">
        <svg
          class={tool === "select" ? "sketch" : "sketch drawn"}
          ref={svg}
          viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
          tabindex={tool === "select" ? -1 : 0}
          role="group"
          aria-label={`linkage ${sketch.id}`}
          aria-busy={busy || !settled}
          onKeyDown={keys}
          onPointerDown={down}
          onPointerMove={move}
          onPointerUp={up}
          onPointerCancel={cancel}
          onPointerLeave={() => {
            if (!pressed) setCursor(null);
          }}
        >
          {tool !== "select" && <Grid frame={view} step={grid} />}
          {pose && <Links sketch={sketch} pose={pose} pixel={pixel} />}
          {board?.joints.map((joint) => (
            <JointMark
              key={joint.names[0]}
              joint={joint}
              pixel={pixel}
              onKeyDown={(event) => step(joint, event)}
              onFocus={() => {
                if (tool !== "select") setCursor(joint.at);
              }}
              onPointerDown={(event) => {
                if (event.button !== 0 || tool !== "select") return;
                event.preventDefault();
                event.stopPropagation();
                (event.currentTarget as SVGElement).focus();
                svg.current!.setPointerCapture(event.pointerId);
                held.current = { joint: joint.names[0]!, drag: drag() };
              }}
            />
          ))}
          {begin && target && <path class="rubber" d={`M${pixel(begin.at).join(" ")}L${pixel(target.at).join(" ")}`} />}
          {[begin, target].map(
            (spot) =>
              spot && (
                <circle
                  class={spot.joint || spot.link !== null ? "spot held" : "spot"}
                  cx={pixel(spot.at)[0]}
                  cy={pixel(spot.at)[1]}
                  r={spot.joint ? 9 : 5}
                />
              ),
          )}
          {!pose && (
            <text class="soft" x={WIDTH / 2} y={HEIGHT / 2} text-anchor="middle">
              It cannot be put together at this input.
            </text>
          )}
        </svg>
        <div class="zoom">
          <button type="button" onClick={() => setFixed(zoomed(view, 1.25))} aria-label="zoom in">
            +
          </button>
          <button type="button" onClick={() => setFixed(zoomed(view, 0.8))} aria-label="zoom out">
            −
          </button>
          <button type="button" onClick={() => setFixed(tool === "select" ? null : framed(sketch))}>
            Fit
          </button>
        </div>
        <p class="mobility" aria-hidden="true">
          {sketch.told.join("; ")}
        </p>
      </div>
      {told ? (
        <p class="drawing-note" role="status">
          {told}
        </p>
      ) : (
        stale && (
          <p class="drawing-note" role="status">
            {sketch.draft
              ? "Not whole yet: drawn as its text has it."
              : "Stale: the scene has faults; this is the last good drawing."}
          </p>
        )
      )}
      <p class="soft">{TOOLS[tool].help}</p>
      <ul class="structure" aria-label="structure">
        {[
          ...sketch.told,
          ...sketch.courses.flatMap(({ name, range }) => (range ? [`input ${name && `${name} `}${range}`] : [])),
        ].map((line) => (
          <li>{line}</li>
        ))}
      </ul>
      <button type="button" onClick={fresh}>
        New linkage
      </button>
    </div>
  );
}
