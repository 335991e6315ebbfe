// Lists, and maps of parts with names of their own.

import { useLayoutEffect, useState } from "preact/hooks";
import { freeName } from "../graph";
import type { Schema } from "../schema";
import { shapeOf } from "../shape";
import { address, find, member, type Step } from "../tree";
import { shown, type Desk, type FieldProps, type Nesting } from "./desk";
import { Row, Section } from "./row";

// A list of numbers or of points, as it is written.
export function Raw(props: FieldProps) {
  const { desk, path, write, required } = props,
    value = find(desk.root, path),
    text = value ? desk.text.slice(value.from, value.to) : "";
  const [typed, setTyped] = useState(text);
  const [wrong, setWrong] = useState("");
  useLayoutEffect(() => {
    setTyped(text);
    setWrong("");
  }, [text]);
  const enter = () => {
    if (typed === text) return;
    if (typed.trim() === "") {
      if (value && !required) desk.edit((edits) => edits.remove(path));
      return;
    }
    const list = typed.trim().startsWith("[") ? typed.trim() : `[${typed.trim()}]`;
    try {
      JSON.parse(list);
    } catch (error) {
      setWrong(`This is no list: ${(error as Error).message}`);
      return;
    }
    write(path, list);
  };
  return (
    <Row {...props} wide why={wrong}>
      <textarea
        id={`field ${address(path)}`}
        rows={Math.min(8, Math.max(1, typed.split("\n").length))}
        value={typed}
        placeholder="[…, …]"
        spellcheck={false}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={enter}
      />
    </Row>
  );
}

export function MapOf({ inner, Nested, ...props }: FieldProps & Nesting & { inner: Schema }) {
  const { desk, path, name, write } = props,
    value = find(desk.root, path),
    stem = name.replace(/ies$/, "y").replace(/s$/, "");
  const names = value?.members.map((one) => one.name) ?? [],
    simple = shapeOf(desk.guide, inner);
  const fresh = simple.sort === "scalar" ? "0" : simple.sort === "list" ? "[]" : "{}";
  return (
    <Section props={props} empty={null}>
      {names.map((one) => (
        <div class="named" key={one}>
          <Rename desk={desk} path={[...path, one]} />
          <Nested desk={desk} path={[...path, one]} write={write} schema={inner} name={one} required={false} remove />
        </div>
      ))}
      <button
        type="button"
        class="add"
        aria-label={`Add ${shown(stem)} to ${address(path)}`}
        onClick={() => write([...path, freeName(stem, names)], fresh)}
      >
        Add {shown(stem)}
      </button>
    </Section>
  );
}

// The name of a part of a map.
function Rename({ desk, path }: { desk: Desk; path: Step[] }) {
  const last = String(path.at(-1)),
    [typed, setTyped] = useState(last),
    own = member(find(desk.root, path.slice(0, -1)), last);
  useLayoutEffect(() => setTyped(last), [last]);
  const enter = () => {
    if (typed === last || !own) return;
    if (typed.trim() === "" || member(find(desk.root, path.slice(0, -1)), typed.trim())) {
      setTyped(last);
      return;
    }
    desk.edit(() => [{ from: own.nameAt[0], to: own.nameAt[1], insert: JSON.stringify(typed.trim()) }]);
  };
  return (
    <label class="rename">
      name{" "}
      <input
        type="text"
        aria-label={`name of ${address(path)}`}
        value={typed}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={enter}
        onKeyDown={(event) => {
          if (event.key === "Enter") enter();
        }}
      />
    </label>
  );
}

export function ListOf({ inner, Nested, ...props }: FieldProps & Nesting & { inner: Schema }) {
  const { desk, path, name, write } = props,
    items = find(desk.root, path)?.items ?? [],
    stem = shown(name).replace(/s$/, "");
  return (
    <Section props={props} empty={null}>
      {items.map((_, k) => (
        <Nested
          key={k}
          desk={desk}
          path={[...path, k]}
          write={write}
          schema={inner}
          name={`${stem} ${k + 1}`}
          required={false}
          remove
        />
      ))}
      <button
        type="button"
        class="add"
        aria-label={`Add ${stem} to ${address(path)}`}
        onClick={() => write([...path, items.length], "{}")}
      >
        Add {stem}
      </button>
    </Section>
  );
}
