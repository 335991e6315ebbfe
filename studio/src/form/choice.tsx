// One of several words.

import { address, find } from "../tree";
import type { FieldProps } from "./desk";
import { Row } from "./row";

export function Choice({ options, ...props }: FieldProps & { options: string[] }) {
  const { desk, path, write, required, schema } = props,
    value = find(desk.root, path)?.text ?? "";
  const preset = schema.default === undefined ? "" : ` (${schema.default})`;
  const all = value && !options.includes(value) ? [value, ...options] : options;
  return (
    <Row {...props}>
      <select
        id={`field ${address(path)}`}
        value={value}
        onChange={(event) => {
          const chosen = event.currentTarget.value;
          if (chosen === "") desk.edit((edits) => edits.remove(path));
          else write(path, JSON.stringify(chosen));
        }}
      >
        {(value === "" || !required) && (
          <option value="">{value === "" && required ? "choose…" : `not given${preset}`}</option>
        )}
        {all.map((one) => (
          <option value={one}>{one.replaceAll("_", " ")}</option>
        ))}
      </select>
    </Row>
  );
}
