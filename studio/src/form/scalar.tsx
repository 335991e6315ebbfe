// A number or a word, typed into a field.

import { useLayoutEffect, useState } from "preact/hooks";
import { literal, type Shape } from "../shape";
import { address, find } from "../tree";
import { faultsAt, type FieldProps } from "./desk";
import { Row } from "./row";

export function Scalar({ shape, ...props }: FieldProps & { shape: Shape & { sort: "scalar" } }) {
  const { desk, path, write, required, schema } = props,
    value = find(desk.root, path),
    id = `field ${address(path)}`;
  const text = value && value.sort !== "wrong" ? value.text : "";
  const [typed, setTyped] = useState(text),
    [why, setWhy] = useState("");
  // (At once, here and below: an effect after the picture is drawn would undo what is typed before.)
  useLayoutEffect(() => {
    setTyped(text);
    setWhy("");
  }, [text]);
  const unit = shape.units[0] ?? "",
    bare = value?.sort === "number" || typed === "";
  const enter = () => {
    setWhy("");
    if (typed === text) return;
    if (typed.trim() === "") {
      if (value && !required) desk.edit((edits) => edits.remove(path));
      else setTyped(text);
      return;
    }
    const made = literal(shape, typed);
    if ("why" in made) {
      setWhy(made.why);
      return;
    }
    write(path, made.json);
    // What was worked out to what stands there already.
    if (find(desk.root, path) === value && made.json === (value && desk.text.slice(value.from, value.to)))
      setTyped(text);
  };
  const preset = schema.default !== undefined && typeof schema.default !== "object" ? String(schema.default) : "";
  return (
    <Row {...props} why={why}>
      <input
        type="text"
        id={id}
        value={typed}
        placeholder={preset}
        spellcheck={false}
        list={shape.words.length ? `${id} words` : undefined}
        aria-invalid={why !== "" || faultsAt(desk, path).some((fault) => fault.severity === "error")}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={enter}
        onKeyDown={(event) => {
          if (event.key === "Enter") enter();
          if (event.key === "Escape") {
            setTyped(text);
            setWhy("");
          }
        }}
      />
      {unit && bare ? (
        <span class="field-unit" title={`also as text with a unit: ${shape.units.join(", ")}`}>
          {unit}
        </span>
      ) : null}
      {shape.words.length ? (
        <datalist id={`${id} words`}>
          {shape.words.map((word) => (
            <option value={word} />
          ))}
        </datalist>
      ) : null}
    </Row>
  );
}
