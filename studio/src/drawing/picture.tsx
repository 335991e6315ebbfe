// The picture or plan below the drawing, and what is done with it.

import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { toPixel, type Frame } from "../figure";
import type { Point } from "../linkage";
import { unitOf } from "../units";
import { typedMeasure } from "./lengths";
import type { Under } from "./under";
import { scaledTo } from "./underlay";

export function PictureBelow({ under: { url, path, own }, view }: { under: Under; view: Frame }) {
  if (!own) return null;
  const [x, y] = toPixel(view, [own.left, own.bottom + own.pixel * own.height]),
    size = own.pixel * view.scale;
  if (path)
    return (
      <path
        class="underlay"
        d={path}
        transform={`translate(${x} ${y}) scale(${size})`}
        vector-effect="non-scaling-stroke"
        fill="none"
        stroke="currentColor"
        opacity={own.opacity}
      >
        <title>the plan below the drawing</title>
      </path>
    );
  if (!url) return null;
  return (
    <image
      class="underlay"
      href={url}
      {...{ x, y }}
      width={size * own.width}
      height={size * own.height}
      opacity={own.opacity}
      preserveAspectRatio="none"
    >
      <title>the picture below the drawing</title>
    </image>
  );
}

// Where it is marked, and where it would be.
export const Marks = ({ marks, aim, view }: { marks: Point[]; aim: Point | null; view: Frame }) => (
  <>
    {[...marks, ...(aim ? [aim] : [])].map((place, k) => {
      const [x, y] = toPixel(view, place);
      return <path key={k} class="spot held" d={`M${x - 9} ${y}h18M${x} ${y - 9}v18`} />;
    })}
  </>
);

// The distance of the two places that are marked.
function Distance({ under }: { under: Under }) {
  const [wrong, setWrong] = useState(""),
    field = useRef<HTMLInputElement>(null),
    [a, b] = under.marks;
  useLayoutEffect(() => {
    if (b) field.current?.focus();
  }, [b]);
  if (!a || !b) return <span>Mark two places of the picture whose distance you know.</span>;
  const enter = (typed: string) => {
    const value = typedMeasure(typed, "length", unitOf("m") || "mm"),
      next = typeof value === "number" && under.own ? scaledTo(under.own, a, b, value) : null;
    setWrong(typeof value === "string" ? value : next ? "" : "Both places are one: mark two.");
    if (!next) return;
    under.set(next);
    under.begin("rest");
  };
  return (
    <label>
      their distance{" "}
      <input
        type="text"
        ref={field}
        size={10}
        aria-invalid={wrong !== ""}
        placeholder={unitOf("m") || "mm"}
        onKeyDown={(event) => {
          if (event.key === "Enter") enter(event.currentTarget.value);
          if (event.key === "Escape") under.begin("rest");
        }}
      />{" "}
      {wrong && <span role="alert">{wrong}</span>}
    </label>
  );
}

const Adjust = ({ under }: { under: Under }) => (
  <>
    {(
      [
        ["move", "Move picture"],
        ["scale", "Scale picture"],
      ] as const
    ).map(([mode, words]) => (
      <button
        type="button"
        key={mode}
        aria-pressed={under.mode === mode}
        onClick={() => {
          under.begin(under.mode === mode ? "rest" : mode);
          document.querySelector<SVGElement>("svg.sketch")?.focus();
        }}
      >
        {words}
      </button>
    ))}
    <label>
      opacity{" "}
      <input
        type="range"
        aria-label="opacity of the picture"
        min={0}
        max={1}
        step={0.05}
        value={under.own!.opacity}
        onInput={(event) => under.set({ ...under.own!, opacity: Number(event.currentTarget.value) })}
      />
    </label>
    <button type="button" onClick={under.remove}>
      Remove picture
    </button>
    {under.mode === "scale" && <Distance under={under} />}
    {under.mode === "move" && <span>Drag the picture, or move it with the arrow keys; Escape ends.</span>}
  </>
);

export function PictureTools({ under }: { under: Under }) {
  const chosen = useRef<HTMLInputElement>(null);
  return (
    <div class="tools picture-tools" role="group" aria-label="picture below the drawing">
      <input
        ref={chosen}
        type="file"
        accept="image/png,image/jpeg,.dxf"
        aria-label="picture from a file"
        hidden
        onChange={(event) => {
          const [file] = event.currentTarget.files ?? [];
          if (file) void under.take(file, file.name);
          event.currentTarget.value = "";
        }}
      />
      <button
        type="button"
        title="PNG, JPEG or DXF; a picture can be pasted too. It stays in this browser: no scene has it, and it is not sent."
        onClick={() => chosen.current!.click()}
      >
        {under.own ? "Other picture or DXF…" : "Picture or DXF below…"}
      </button>
      {under.own && <Adjust under={under} />}
      {under.told && <span role="status">{under.told}</span>}
    </div>
  );
}
