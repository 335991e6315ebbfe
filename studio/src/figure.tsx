// The picture of a linkage: its scale, its links, pairs and joints.

import { far, placed, shows, type Joint, type Pair, type Point, type Sketch } from "./linkage";

export interface Frame {
  left: number;
  bottom: number;
  scale: number;
}

export const WIDTH = 500,
  HEIGHT = 330;
const EDGE = 44;
// What is seen where there is nothing yet: half a metre.
export const START: Frame = { scale: WIDTH / 0.5, left: -0.125, bottom: -0.125 };

export const toPixel = ({ left, bottom, scale }: Frame, [x, y]: Point): Point => [
  (x - left) * scale,
  HEIGHT - (y - bottom) * scale,
];
export const toPlace = ({ left, bottom, scale }: Frame, [x, y]: Point): Point => [
  left + x / scale,
  bottom + (HEIGHT - y) / scale,
];

// Everything that is reached, in the picture.
export function framed(sketch: Sketch): Frame {
  const all: Point[] = sketch.ground.map((point) => point.at);
  for (const pose of sketch.courses.flatMap((course) => course.poses))
    if (pose) {
      sketch.links.forEach((link, k) => {
        all.push(placed(pose, k, [0, 0]), ...link.points.map((point) => placed(pose, k, point.at)));
      });
    }
  const ends = [0, 1].map((c) => [Math.min(...all.map((one) => one[c]!)), Math.max(...all.map((one) => one[c]!))]) as [
    Point,
    Point,
  ];
  const size = Math.max(...ends.map(([from, to]) => to - from)),
    [[x0, x1], [y0, y1]] = ends;
  if (!(size > 0))
    return { ...START, left: START.left + (all[0]?.[0] ?? 0), bottom: START.bottom + (all[0]?.[1] ?? 0) };
  const scale = Math.min(
    (WIDTH - 2 * EDGE) / Math.max(x1 - x0, 0.1 * size),
    (HEIGHT - 2 * EDGE) / Math.max(y1 - y0, 0.1 * size),
  );
  return { scale, left: (x0 + x1) / 2 - WIDTH / 2 / scale, bottom: (y0 + y1) / 2 - HEIGHT / 2 / scale };
}

// Nearer or farther, a place of the picture staying where it is.
export function zoomed(frame: Frame, factor: number, about: Point = [WIDTH / 2, HEIGHT / 2]): Frame {
  const [x, y] = toPlace(frame, about),
    scale = frame.scale * factor;
  return { scale, left: x - about[0] / scale, bottom: y - (HEIGHT - about[1]) / scale };
}

// The places that the tools set points at.
export function Grid({ frame, step }: { frame: Frame; step: number }) {
  const lines: string[] = [],
    count = (pixels: number) => Math.ceil(pixels / frame.scale / step) + 1;
  const [k0, l0] = [Math.ceil(frame.left / step), Math.ceil(frame.bottom / step)];
  for (let k = 0; k < count(WIDTH); k++)
    lines.push(`M${toPixel(frame, [(k0 + k) * step, 0])[0].toFixed(1)} 0V${HEIGHT}`);
  for (let l = 0; l < count(HEIGHT); l++)
    lines.push(`M0 ${toPixel(frame, [0, (l0 + l) * step])[1].toFixed(1)}H${WIDTH}`);
  return <path class="grid" d={lines.join("")} />;
}

interface Props {
  sketch: Sketch;
  pose: number[];
  pixel: (at: Point) => Point;
  // The link that is chosen, and what keys do at links; undefined: none can be chosen.
  chosen: string | null;
  keys: ((name: string, event: KeyboardEvent) => void) | undefined;
}

export function Links({ sketch, pose, pixel, chosen, keys }: Props) {
  const ends = sketch.pairs.flatMap(({ on, link }) => [on, link]);
  const points = (index: number): Point[] => {
    const origin: Point[] = shows(sketch, index) ? [[0, 0]] : [];
    const own = [
      ...ends.filter((end) => end.link === index).map((end) => end.at),
      ...origin,
      ...sketch.links[index]!.points.map((point) => point.at),
    ];
    return own.filter((one, k) => own.findIndex((other) => far(one, other) < 1e-12) === k);
  };
  // About their middle, so that the outline does not cross itself.
  const around = (list: Point[]): Point[] => {
    const [x, y] = [0, 1].map((c) => list.reduce((sum, one) => sum + one[c]!, 0) / list.length) as Point;
    return [...list].sort((a, b) => Math.atan2(a[1] - y, a[0] - x) - Math.atan2(b[1] - y, b[0] - x));
  };
  return (
    <>
      {sketch.ground.map((point) => (
        <GroundMark key={point.name} at={point.at} sketch={sketch} pixel={pixel} />
      ))}
      {sketch.pairs.map((pair) =>
        pair.direction === null ? null : (
          <Guide key={pair.name} pair={pair} direction={pair.direction} pose={pose} pixel={pixel} />
        ),
      )}
      {sketch.links.map((link, index) => {
        const list = around(points(index)).map((point) =>
          pixel(placed(pose, index, point))
            .map((value) => value.toFixed(2))
            .join(" "),
        );
        return (
          <path
            key={link.name}
            class={`body l${index % 8}${chosen === link.name ? " chosen" : ""}`}
            data-link={link.name}
            {...(keys && {
              tabindex: 0,
              role: "button",
              "aria-label": `link ${link.name}`,
              "aria-pressed": chosen === link.name,
              onKeyDown: (event: KeyboardEvent) => keys(link.name, event),
            })}
            d={`M${list.join("L")}${list.length > 2 ? "z" : ""}`}
          >
            <title>{link.name}</title>
          </path>
        );
      })}
    </>
  );
}

// A point of the ground, where it is not one of a guide.
function GroundMark({ at, sketch, pixel }: { at: Point; sketch: Sketch; pixel: (at: Point) => Point }) {
  const here = sketch.pairs.filter((pair) =>
    [pair.on, pair.link].some((end) => end.link === null && far(end.at, at) === 0),
  );
  if (here.some((pair) => pair.direction !== null)) return null;
  const [x, y] = pixel(at);
  return (
    <path
      class={here.some((pair) => pair.driven) ? "ground-mark driven" : "ground-mark"}
      d={`M${x} ${y}l-9 15h18zM${x - 13} ${y + 15}h26`}
    />
  );
}

function Guide({
  pair,
  direction,
  pose,
  pixel,
}: {
  pair: Pair;
  direction: number;
  pose: number[];
  pixel: (at: Point) => Point;
}) {
  const frame = pair.on.link === null ? [0, 0, 1, 0] : pose.slice(4 * pair.on.link, 4 * pair.on.link + 4),
    angle = direction + Math.atan2(frame[3]!, frame[2]!);
  const [x, y] = pixel(placed(pose, pair.on.link, pair.on.at)),
    [u, v] = pixel(placed(pose, pair.link.link, pair.link.at)),
    reach = Math.max(40, Math.hypot(u - x, v - y) + 24);
  const turn = (-angle * 180) / Math.PI;
  return (
    <g>
      <path class="guide-line" transform={`translate(${x} ${y}) rotate(${turn})`} d={`M${-reach} 0H${reach}`} />
      <rect class="block" transform={`translate(${u} ${v}) rotate(${turn})`} x={-12} y={-8} width={24} height={16} />
    </g>
  );
}

interface JointProps {
  joint: Joint;
  pixel: (at: Point) => Point;
  onKeyDown: (event: KeyboardEvent) => void;
  onPointerDown: (event: PointerEvent) => void;
  onFocus: () => void;
}

export function JointMark({ joint, pixel, ...acts }: JointProps) {
  const [x, y] = pixel(joint.at),
    name = [...new Set(joint.points.map((point) => point.name))].join(", ");
  return (
    <g
      class="joint"
      tabindex={0}
      role="button"
      aria-label={`joint ${joint.names.join(", ")}`}
      data-joint={joint.names.join(" ")}
      data-at={joint.at.join(" ")}
      {...acts}
    >
      <title>{joint.names.join(", ")}</title>
      <circle class="hit" cx={x} cy={y} r={13} />
      <circle cx={x} cy={y} r={5} />
      <text x={x + 8} y={y - 8}>
        {name}
      </text>
    </g>
  );
}
