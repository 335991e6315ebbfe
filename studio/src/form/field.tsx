// A property as its schema declares it, and the properties of a group.

import type { VNode } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { shapeOf, type Group } from "../shape";
import { address, find, member, type Step } from "../tree";
import { Choice } from "./choice";
import { faultsIn, helpOf, shown, type FieldProps, type Place } from "./desk";
import { Either } from "./either";
import { ListOf, MapOf, Raw } from "./lists";
import { More, Section } from "./row";
import { Scalar } from "./scalar";

// What is not worth a place of its own: it stands in the head of the form, or belongs to files.
const ASIDE = ["kind", "$schema", "dam"];

export function Field(props: FieldProps): VNode {
  const { desk, path, schema, name } = props,
    shape = shapeOf(desk.guide, schema);
  const told = { ...props, schema: desk.guide.resolved(schema) };
  if (
    (name === "input" || name === "object") &&
    shape.sort === "scalar" &&
    /drives this one/.test(helpOf(told.schema))
  ) {
    const own = path[0] === "objects" ? String(path[1]) : "";
    return <Choice {...told} options={desk.outputs.filter((one) => one.split(".")[0] !== own)} />;
  }
  switch (shape.sort) {
    case "choice":
      return <Choice {...told} options={shape.options} />;
    case "flag":
      return <Choice {...told} write={(at, json) => props.write(at, JSON.parse(json))} options={["true", "false"]} />;
    case "scalar":
      return <Scalar {...told} shape={shape} />;
    case "map":
      return <MapOf {...told} inner={shape.inner} Nested={Field} />;
    case "list":
      return shape.compound ? <ListOf {...told} inner={shape.inner} Nested={Field} /> : <Raw {...told} />;
    case "either":
      return <Either {...told} shape={shape} Nested={Field} />;
    case "group": {
      const inner = () => <Properties {...props} group={shape} />;
      if (!props.required && find(desk.root, path) === undefined && !faultsIn(desk, path).length)
        return (
          <More label={`add ${address(path)}`} title={shown(name)} help={helpOf(told.schema)}>
            {inner}
          </More>
        );
      return (
        <Section props={told} empty={null}>
          {inner()}
        </Section>
      );
    }
  }
}

// The properties of a group: those that are there or must be, the others on demand.
export function Properties({ desk, path, write, group, aside = [] }: Place & { group: Group; aside?: string[] }) {
  const value = find(desk.root, path),
    has = (name: string) => member(value, name) !== undefined;
  const present = group.variants.find(has),
    [chosen, setChosen] = useState(present ?? group.variants[0] ?? "");
  useLayoutEffect(() => {
    if (present) setChosen(present);
  }, [present]);
  const own = address(path);
  // What is filled in stands in place of what it excludes.
  const instead = (at: Step[], json: string) => {
    const old =
      present && present !== chosen && at.length > path.length && at[path.length] === chosen
        ? member(value, present)
        : undefined;
    if (!old) {
      write(at, json);
      return;
    }
    const inner = at
      .slice(path.length + 1)
      .reduceRight(
        (made, step) => (typeof step === "number" ? `[${made}]` : `{ ${JSON.stringify(step)}: ${made} }`),
        json,
      );
    desk.edit(() => [{ from: old.from, to: old.to, insert: `${JSON.stringify(chosen)}: ${inner}` }]);
  };
  const field = (name: string, required: boolean) => (
    <Field
      key={name}
      desk={desk}
      path={[...path, name]}
      write={name === chosen ? instead : write}
      schema={group.properties[name]!}
      name={name}
      required={required}
      remove
    />
  );
  const names = Object.keys(group.properties).filter(
    (name) => ![...ASIDE, ...aside].includes(name) && !group.variants.includes(name),
  );
  const order = (name: string) => value?.members.findIndex((one) => one.name === name) ?? -1;
  // While the others are shown nothing changes its place: what is filled in stays where it is.
  const [open, setOpen] = useState(() => !group.variants.length && !group.required.length && !names.some(has)),
    early = useRef<string[]>([]);
  const faulty = (name: string) => faultsIn(desk, [...path, name]).length > 0;
  if (!open) early.current = names.filter((name) => has(name) || faulty(name));
  const there = names
    .filter((name) => early.current.includes(name) || group.required.includes(name))
    .sort((a, b) => (has(a) ? order(a) : 1e3) - (has(b) ? order(b) : 1e3));
  const others = names.filter((name) => !there.includes(name));
  return (
    <>
      {group.variants.length > 1 && (
        <div class="field variant">
          <label for={`variant ${own}`}>by</label>
          <div class="entry">
            <select
              id={`variant ${own}`}
              aria-label={`${own}, by`}
              value={chosen}
              onChange={(event) => setChosen(event.currentTarget.value)}
            >
              {group.variants.map((name) => (
                <option value={name}>{shown(name)}</option>
              ))}
            </select>
          </div>
        </div>
      )}
      {group.variants.length > 0 && chosen && field(chosen, true)}
      {there.map((name) => field(name, group.required.includes(name)))}
      {others.length > 0 && (
        <More
          label={`more properties${own ? ` of ${own}` : ""}`}
          title="more properties"
          help={String(others.length)}
          open={open}
          toggle={setOpen}
        >
          {() => others.map((name) => field(name, false))}
        </More>
      )}
    </>
  );
}
