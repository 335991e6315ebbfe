// A word, or something larger in its place.

import { useLayoutEffect, useState } from "preact/hooks";
import type { Shape } from "../shape";
import { address, find } from "../tree";
import type { FieldProps, Nesting } from "./desk";
import { Row } from "./row";
import { Scalar } from "./scalar";

export function Either({ shape, Nested, ...props }: FieldProps & Nesting & { shape: Shape & { sort: "either" } }) {
  const { desk, path, write, schema } = props,
    value = find(desk.root, path);
  const now = !value
    ? ""
    : value.sort === "object" || value.sort === "array"
      ? "…"
      : shape.words.includes(value.text)
        ? value.text
        : "…value";
  const [open, setOpen] = useState(now);
  useLayoutEffect(() => setOpen(now), [now]);
  const choose = (chosen: string) => {
    setOpen(chosen);
    if (chosen === "") {
      if (value) desk.edit((edits) => edits.remove(path));
    } else if (!chosen.startsWith("…")) write(path, JSON.stringify(chosen));
  };
  const compound = desk.guide.resolved(shape.compound),
    { description: _, ...rest } = schema;
  if (shape.scalar?.sort === "scalar" && !shape.words.length && open !== "…")
    return <Scalar {...props} shape={shape.scalar} />;
  return (
    <>
      <Row {...props}>
        <select id={`field ${address(path)}`} value={open} onChange={(event) => choose(event.currentTarget.value)}>
          <option value="">not given</option>
          {shape.words.map((word) => (
            <option value={word}>{word.replaceAll("_", " ")}</option>
          ))}
          {shape.scalar && <option value="…value">a number or text</option>}
          <option value="…">in detail</option>
        </select>
      </Row>
      {open === "…value" && shape.scalar?.sort === "scalar" && <Scalar {...props} name="value" shape={shape.scalar} />}
      {open === "…" && <Nested {...props} schema={rest.$ref ? compound : { ...compound }} remove={false} />}
    </>
  );
}
