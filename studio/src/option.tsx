// An option of a command as a field, as the command declares it.

import { useId } from "preact/hooks";
import { useTyping } from "./typing";

export interface Option {
  name: string;
  sort: "flag" | "choice" | "text" | "optional" | "lines";
  value: string;
  help: string;
  default: string;
  choices: [string, string][];
  required: boolean;
}

// Of these the scene offers some, and others may be written.
const OPEN = ["methods", "law", "vary", "maximize", "minimize"];

interface Props {
  option: Option;
  offered: string[];
  values: string[];
  set: (values: string[]) => void;
}

export function OptionField({ option, offered, values, set }: Props) {
  const id = useId(),
    { name, sort, required } = option,
    first = values[0] ?? "";
  const lines = useTyping(values.join("\n"), (text) =>
    set(
      text
        .split("\n")
        .map((line) => line.trim())
        .filter(Boolean),
    ),
  );
  const line = useTyping(first, (text) => set(text.trim() === "" && sort !== "optional" ? [] : [text.trim()]));
  const hint = option.default || option.value;
  const entry = () => {
    if (sort === "flag")
      return (
        <input
          id={id}
          type="checkbox"
          checked={values.length > 0}
          onChange={(event) => set(event.currentTarget.checked ? [""] : [])}
        />
      );
    if (sort === "choice" || (offered.length > 0 && !OPEN.includes(name) && sort === "text")) {
      const all = sort === "choice" ? option.choices : offered.map((one): [string, string] => [one, ""]);
      return (
        <select
          id={id}
          value={first}
          onChange={(event) => set(event.currentTarget.value ? [event.currentTarget.value] : [])}
        >
          {!(required && all.length) && (
            <option value="">{option.default ? `${option.default} (default)` : "–"}</option>
          )}
          {all
            .filter(([one]) => one !== option.default)
            .map(([one, help]) => (
              <option value={one} title={help}>
                {one}
              </option>
            ))}
        </select>
      );
    }
    if (sort === "lines")
      return (
        <textarea id={id} rows={Math.max(1, values.length)} placeholder={`${option.value}, one a line`} {...lines} />
      );
    if (sort === "optional")
      return (
        <>
          <input
            type="checkbox"
            aria-label={`${name}, on`}
            checked={values.length > 0}
            onChange={(event) => set(event.currentTarget.checked ? [""] : [])}
          />
          <input id={id} type="text" placeholder={option.value} {...line} />
        </>
      );
    return (
      <>
        <input id={id} type="text" placeholder={hint} list={offered.length ? `${id}-list` : undefined} {...line} />
        {offered.length > 0 && (
          <datalist id={`${id}-list`}>
            {offered.map((one) => (
              <option value={one} />
            ))}
          </datalist>
        )}
      </>
    );
  };
  return (
    <div class="option">
      <label for={id}>{name.replaceAll("-", " ")}</label>
      <span class="entry">{entry()}</span>
      <span class="help soft">{option.help}</span>
    </div>
  );
}
