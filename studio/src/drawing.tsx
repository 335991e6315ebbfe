// A linkage drawn to scale, whose joints are dragged: mobility, groups, branches, range and faults
// are told while they move.

import { useEffect, useRef, useState } from "preact/hooks";
import { dragged, joints, placed, sizeOf, stepOf, type Joint, type Point, type Sketch } from "./linkage";
import type { Link } from "./link";
import type { Fault } from "./objects";
import type { Change, Edits } from "./tree";

interface Props { link: Link; scene: string; version: number; faults: Fault[]; edit: (make: (edits: Edits) => Change[], drag?: number) => boolean; drag: () => number }
// A joint that is held, and the step of undo that its moves belong to.
interface Grip { joint: string; drag: number }
interface Move extends Grip { to: Point }
interface Frame { left: number; bottom: number; scale: number; width: number; height: number }

const WIDTH = 500, HEIGHT = 330, EDGE = 44;

// Everything that is reached, in the picture.
function framed(sketch: Sketch): Frame {
  const all: Point[] = sketch.ground.map((point) => point.at);
  for (const pose of sketch.poses) if (pose) {
    sketch.links.forEach((link, k) => { all.push(placed(pose, k, [0, 0]), ...link.points.map((point) => placed(pose, k, point.at))); });
  }
  const xs = all.map((one) => one[0]), ys = all.map((one) => one[1]), size = sizeOf(sketch);
  const [x0, x1, y0, y1] = all.length ? [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)] : [-size, size, -size, size];
  const scale = Math.min((WIDTH - 2 * EDGE) / Math.max(x1 - x0, 0.1 * size), (HEIGHT - 2 * EDGE) / Math.max(y1 - y0, 0.1 * size));
  return { scale, left: (x0 + x1) / 2 - WIDTH / 2 / scale, bottom: (y0 + y1) / 2 - HEIGHT / 2 / scale, width: WIDTH, height: HEIGHT };
}

export function Drawing({ link, scene, version, faults, edit, drag }: Props) {
  const [all, setAll] = useState<Sketch[]>([]);
  const [chosen, setChosen] = useState("");
  const [at, setAt] = useState<number | null>(null);
  const [stale, setStale] = useState(false);
  const [told, setTold] = useState("");
  const frame = useRef<Frame | null>(null), svg = useRef<SVGSVGElement>(null);
  const held = useRef<Grip | null>(null), waiting = useRef<Move | null>(null);
  const asking = useRef(false), wanted = useRef(version), shown = useRef(-1);
  // The version that the drawing shows, and the one that the last move was made on: until another
  // is drawn, further moves wait.
  const [drawn, setDrawn] = useState(-1), behind = useRef<number | null>(null);
  const [busy, setBusy] = useState(false);
  wanted.current = version;
  useEffect(() => {
    let gone = false;
    const ask = async () => {
      if (asking.current || shown.current === wanted.current) return;
      asking.current = true;
      const asked = wanted.current;
      try {
        const found = await link.get(`/api/linkages?scene=${encodeURIComponent(scene)}`);
        if (gone) return;
        if (found) setAll(found.linkages);
        setStale(!found);
      } catch { if (!gone) setStale(true); }
      shown.current = asked;
      asking.current = false;
      if (!gone) setDrawn(asked);
      if (!gone && shown.current !== wanted.current) void ask();
    };
    void ask();
    return () => { gone = true; asking.current = false; };
  }, [version, scene]);

  const sketch = all.find((one) => one.id === chosen) ?? all[0];
  const k = sketch ? Math.min(at ?? sketch.start, sketch.poses.length - 1) : 0, pose = sketch?.poses[k] ?? null;
  // While a joint is held the scale stays.
  if (sketch && (!frame.current || !held.current)) frame.current = framed(sketch);
  const view = frame.current;
  const pixel = ([x, y]: Point): Point => [(x - view!.left) * view!.scale, view!.height - (y - view!.bottom) * view!.scale];

  const pull = ({ to, joint: name, drag: step }: Move) => {
    const joint = sketch && pose && joints(sketch, pose).find((one) => one.names.includes(name));
    if (!joint) return;
    const changed = edit((edits) => {
      const done = dragged(edits, sketch, pose, joint, to, stepOf(1.5 / view!.scale));
      if (typeof done === "string") { setTold(done); return []; }
      setTold("");
      return done;
    }, step);
    if (changed) { behind.current = shown.current; setBusy(true); }
  };
  const free = () => !asking.current && shown.current === wanted.current && behind.current === null;
  const later = (next: Move) => { if (free()) pull(next); else { waiting.current = next; setBusy(true); } };
  // The next move is made on what the last one came to.
  useEffect(() => {
    if (behind.current !== drawn) behind.current = null;
    const next = waiting.current;
    if (next && free()) { waiting.current = null; pull(next); }
    setBusy(behind.current !== null || waiting.current !== null);
  }, [drawn]);
  const place = (event: PointerEvent): Point => {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.current!.getScreenCTM()!.inverse());
    return [view!.left + point.x / view!.scale, view!.bottom + (view!.height - point.y) / view!.scale];
  };
  const move = (event: PointerEvent) => { if (held.current) later({ ...held.current, to: place(event) }); };
  const step = (joint: Joint, event: KeyboardEvent) => {
    const by = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] } as Record<string, Point>)[event.key];
    if (!by || !view) return;
    event.preventDefault();
    const size = stepOf(1.5 / view.scale) * (event.shiftKey ? 10 : 1);
    later({ joint: joint.names[0]!, drag: drag(), to: [joint.at[0] + by[0] * size, joint.at[1] + by[1] * size] });
  };

  if (!sketch) return <p class="soft drawing">{stale ? "The scene has faults: they are told below." : "There is no linkage in this scene: add one from the list of objects."}</p>;
  const own = faults.filter((fault) => fault.path === sketch.id || fault.path.startsWith(`${sketch.id}.`));
  const value = sketch.inputs[k] ?? 0;
  return (
    <div class="drawing">
      <div class="tools">
        {all.length > 1 && <label>linkage <select value={sketch.id} onChange={(event) => { setChosen(event.currentTarget.value); setAt(null); frame.current = null; }}>{all.map((one) => <option value={one.id}>{one.id}</option>)}</select></label>}
        <label class="wide">input <input type="range" aria-label="input of the linkage" min={0} max={sketch.inputs.length - 1} value={k} onInput={(event) => setAt(Number(event.currentTarget.value))} /></label>
        <output>{sketch.unit === "rad" ? `${numbers.withUnit(value * 180 / Math.PI, "°", 4)}` : numbers.withUnit(value, sketch.unit, 4)}</output>
      </div>
      <svg class="sketch" ref={svg} viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="group" aria-label={`linkage ${sketch.id}`} aria-busy={busy} onPointerMove={move}
        onPointerUp={(event) => { move(event); held.current = null; frame.current = null; setTold((before) => before); }} onPointerCancel={() => { held.current = null; }}>
        {pose && <Links sketch={sketch} pose={pose} pixel={pixel}/>}
        {pose && joints(sketch, pose).map((joint) => {
          const [x, y] = pixel(joint.at), name = [...new Set(joint.points.map((point) => point.name))].join(", ");
          return (
            <g key={joint.names[0]} class="joint" tabindex={0} role="button" aria-label={`joint ${joint.names.join(", ")}`} data-joint={joint.names.join(" ")} onKeyDown={(event) => step(joint, event)}
              onPointerDown={(event) => { if (event.button !== 0) return; event.preventDefault(); (event.currentTarget as SVGElement).focus(); svg.current!.setPointerCapture(event.pointerId); held.current = { joint: joint.names[0]!, drag: drag() }; }}>
              <title>{joint.names.join(", ")}</title>
              <circle class="hit" cx={x} cy={y} r={13} /><circle cx={x} cy={y} r={5} />
              <text x={x + 8} y={y - 8}>{name}</text>
            </g>
          );
        })}
        {!pose && <text class="soft" x={WIDTH / 2} y={HEIGHT / 2} text-anchor="middle">It cannot be put together at this input.</text>}
      </svg>
      {(told || stale) && <p class="told" role="status">{told || "Stale: the scene has faults; this is the last good drawing."}</p>}
      {own.map((fault) => <p class={`told ${fault.severity}`} role="alert">{fault.path}: {fault.message}</p>)}
      <p class="soft">Drag a joint, or move it with the arrow keys: the other joints and the angles of the links stay as they are at this input.</p>
      <ul class="structure" aria-label="structure">{[...sketch.told, `input ${sketch.range}`].map((line) => <li>{line}</li>)}</ul>
    </div>
  );
}

function Links({ sketch, pose, pixel }: { sketch: Sketch; pose: number[]; pixel: (at: Point) => Point }) {
  const ends = sketch.pairs.flatMap(({ on, link }) => [on, link]);
  const points = (index: number): Point[] => {
    const own = [...ends.filter((end) => end.link === index).map((end) => end.at), ...sketch.links[index]!.points.map((point) => point.at)];
    return own.filter((one, k) => own.findIndex((other) => Math.hypot(other[0] - one[0], other[1] - one[1]) < 1e-12) === k);
  };
  // About their middle, so that the outline does not cross itself.
  const around = (list: Point[]): Point[] => {
    const [x, y] = [0, 1].map((c) => list.reduce((sum, one) => sum + one[c]!, 0) / list.length) as Point;
    return [...list].sort((a, b) => Math.atan2(a[1] - y, a[0] - x) - Math.atan2(b[1] - y, b[0] - x));
  };
  return (
    <>
      {sketch.pairs.map((pair) => {
        if (pair.direction === null) {
          const end = [pair.on, pair.link].find((one) => one.link === null);
          if (!end) return null;
          const [x, y] = pixel(end.at);
          return <path key={pair.name} class="ground-mark" d={`M${x} ${y}l-9 15h18zM${x - 13} ${y + 15}h26`} />;
        }
        const frame = pair.on.link === null ? [0, 0, 1, 0] : pose.slice(4 * pair.on.link, 4 * pair.on.link + 4), angle = pair.direction + Math.atan2(frame[3]!, frame[2]!);
        const [x, y] = pixel(placed(pose, pair.on.link, pair.on.at)), [u, v] = pixel(placed(pose, pair.link.link, pair.link.at)), reach = Math.max(40, Math.hypot(u - x, v - y) + 24);
        const turn = -angle * 180 / Math.PI;
        return (
          <g key={pair.name}>
            <path class="guide-line" transform={`translate(${x} ${y}) rotate(${turn})`} d={`M${-reach} 0H${reach}`} />
            <rect class="block" transform={`translate(${u} ${v}) rotate(${turn})`} x={-12} y={-8} width={24} height={16} />
          </g>
        );
      })}
      {sketch.links.map((link, index) => {
        const list = around(points(index)).map((point) => pixel(placed(pose, index, point)).map((value) => value.toFixed(2)).join(" "));
        return <path key={link.name} class={`body l${index % 8}`} d={`M${list.join("L")}${list.length > 2 ? "z" : ""}`}><title>{link.name}</title></path>;
      })}
    </>
  );
}
