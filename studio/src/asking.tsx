// The questions besides the motion: a tab each, with the options of the command that answers it,
// and what it finds, told as its page tells it.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { offer, save } from "./export";
import { Host } from "./host";
import type { Link } from "./link";
import type { AnswerFound } from "./messages";
import { OptionField, type Option } from "./option";
import { BENCH, RESULTS } from "./store/views";
import { Tabs } from "./tabs";
import { choice, reshow } from "./units";

export interface Question {
  command: string;
  tab: string;
  about: string;
  fields: Option[];
  why: string | null;
  choices: Record<string, string[]> | null;
}
type Values = Record<string, string[]>;

const FIRST = [BENCH, RESULTS];

// What came of a version: told while the tab is closed too, at little cost.
export interface Hearing {
  checked: (version: number) => void;
  // Asks a question with options, in its tab.
  ask: (command: string, options: Values) => void;
}

interface Props {
  link: Link;
  scene: string;
  tab: string;
  choose: (tab: string) => void;
  // Hears of every version that was checked while the tab is closed too.
  hearing: Hearing;
  // Counts how often a scene was opened: the server knows no question by then.
  opened: number;
  faulty: boolean;
}

// The first of what the scene offers stands where something is needed, or where there are several;
// of conditions all of them. What is to be greatest is none where something is to be least.
function filled(question: Question, values: Values): Values {
  const all = { ...values },
    has = (name: string) => all[name]?.some((value) => value !== "") ?? false;
  for (const { name, required } of question.fields) {
    const offered = question.choices?.[name] ?? [];
    if (has(name) || !offered.length || name === "methods" || (name === "maximize" && has("minimize"))) continue;
    if (name === "subject") all[name] = offered;
    else if (required || offered.length > 1) all[name] = [offered[0]!];
  }
  return all;
}

const lacks = (question: Question, values: Values): string[] =>
  question.fields
    .filter(({ name, required }) => required && !values[name]?.some((value) => value !== ""))
    .map(({ name }) => name);

export function Asking({ link, scene, tab, choose, hearing, opened, faulty }: Props) {
  // The questions, and the scene that they were asked of.
  const [forms, setForms] = useState<{ of: string; questions: Question[] }>({ of: "", questions: [] });
  const [part, setPart] = useState<Record<string, string>>({});
  const [values, setValues] = useState<Record<string, Values>>({});
  const [told, setTold] = useState("");
  const [refused, setRefused] = useState("");
  const [progress, setProgress] = useState<{ done: number; of: number; now: string } | null>(null);
  const [subtitle, setSubtitle] = useState("");
  const [files, setFiles] = useState<string[]>([]);
  const [waiting, setWaiting] = useState(false);
  const place = useRef<HTMLElement>(null!),
    shown = useRef(""),
    drawn = useRef<{ message: AnswerFound; command: string } | null>(null);
  const made = useRef<PlotChart[]>([]),
    players = useRef<Playing[]>([]);
  const { questions } = forms;
  const names = [...new Set(questions.map((one) => one.tab))];
  const own = questions.filter((one) => one.tab === tab);
  const fitting = own.filter((one) => !one.why);
  const chosen = own.find((one) => one.command === part[tab]) ?? fitting[0] ?? own[0];
  const given = chosen ? filled(chosen, values[chosen.command] ?? {}) : {};
  const needs = chosen ? lacks(chosen, given) : [];
  const options = Object.fromEntries(Object.entries(given).filter(([, list]) => list.length));
  const open = !FIRST.includes(tab);
  const question =
    !open || forms.of !== scene || !chosen || chosen.why || needs.length
      ? null
      : JSON.stringify({ command: chosen.command, options });

  const clear = () => {
    live.drop(made.current);
    for (const one of players.current) one.stop();
    made.current = [];
    players.current = [];
    shown.current = "";
    drawn.current = null;
    place.current?.replaceChildren();
    setSubtitle("");
    setFiles([]);
  };

  const wanted = useRef(question),
    answered = useRef(-1),
    newest = useRef(-1);
  wanted.current = question;

  // What was chosen for one scene is nothing of another. (At once: later it would undo what is chosen.)
  useLayoutEffect(() => {
    setValues({});
    setPart({});
    answered.current = newest.current = -1;
  }, [scene]);

  // ---- which questions fit: asked anew some time after the text was another
  useEffect(() => {
    let late = 0,
      gone = false,
      asked = "";
    const ask = async () => {
      if (!scene || gone) return;
      try {
        const found = await link.get<{ questions: Question[]; fits: boolean }>(
          `/api/questions?scene=${encodeURIComponent(scene)}`,
        );
        // Of a scene with faults nothing is known: what was known of it stays.
        const text = JSON.stringify(found.questions);
        if (gone || text === asked || (asked && !found.fits)) return;
        asked = text;
        setForms({ of: scene, questions: found.questions });
      } catch {
        /* the top bar tells that the server is gone */
      }
    };
    hearing.checked = (version) => {
      newest.current = version;
      if (wanted.current !== null && version > answered.current) setWaiting(true);
      clearTimeout(late);
      late = setTimeout(ask, 300);
    };
    void ask();
    return () => {
      gone = true;
      clearTimeout(late);
      hearing.checked = () => {};
    };
  }, [scene, opened]);

  useEffect(() => {
    hearing.ask = (command, options) => {
      setValues((all) => ({ ...all, [command]: options }));
      const found = questions.find((one) => one.command === command);
      if (found) choose(found.tab);
    };
  }, [questions]);

  // ---- the question, and its answers
  useEffect(() => {
    setRefused("");
    setProgress(null);
    setTold("");
    if (shown.current && shown.current !== chosen?.command) clear();
    setWaiting(question !== null);
    if (scene) link.send({ type: "question", question: question === null ? null : JSON.parse(question) });
    if (question === null) clear();
  }, [question, opened]);

  useEffect(() => {
    link.on("question_progress", ({ done, of, now }) => setProgress({ done, of, now }));
    link.on("question", (message) => {
      const of = message.question,
        now = wanted.current === null ? null : JSON.parse(wanted.current);
      requestAnimationFrame(() => link.send({ type: "question_shown" }));
      // An answer to what was asked before.
      if (!now || (of && JSON.stringify(sorted(of)) !== JSON.stringify(sorted(now)))) return;
      setProgress(null);
      answered.current = message.version;
      if (message.version >= newest.current) setWaiting(false);
      setRefused(message.refused ?? "");
      if (message.refused === undefined) draw(message, now.command);
    });
    return () => clear();
  }, []);

  const draw = (message: AnswerFound, command: string) => {
    const width = made.current[0]?.width;
    live.drop(made.current);
    for (const one of players.current) one.stop();
    drawn.current = { message, command };
    place.current.innerHTML = (message.answer ?? "") + message.warnings + message.html;
    reshow(place.current);
    const plots: PlotData[] = [];
    for (const [index, plot] of Object.entries<PlotData>(message.plots)) plots[+index] = plot;
    made.current = live.make(place.current, { columns: message.columns, plots }, width);
    offer(made.current);
    players.current = [...place.current.querySelectorAll<HTMLElement>("figure.moving")].flatMap((figure) => {
      const given = place.current.querySelector(`[id="${figure.id}-data"]`);
      const playing =
        given &&
        machine.player(figure, JSON.parse(given.textContent!), {
          columns: message.columns,
          plots: Object.values(message.plots),
        });
      return playing ? [playing] : [];
    });
    shown.current = command;
    setSubtitle(message.subtitle);
    setFiles(message.files);
  };

  // In other units.
  useEffect(() => {
    if (drawn.current) draw(drawn.current.message, drawn.current.command);
  }, [choice.value]);

  const fetched = async (name: string) => {
    setTold(`${name} is being made …`);
    try {
      const text = await link.text(`/api/file?${new URLSearchParams({ scene, question: question!, name })}`);
      save(name, text);
      setTold("");
    } catch (error) {
      setTold(`${name}: ${(error as Error).message}`);
    }
  };
  const set = (name: string, list: string[]) =>
    setValues((all) => {
      const before = { ...all[chosen!.command] };
      if (list.length) before[name] = list;
      else delete before[name];
      return { ...all, [chosen!.command]: before };
    });

  // While the scene has faults all of the answers are marked.
  const stale = open && shown.current !== "" && refused !== "" && !faulty;
  return (
    <section class="asking" aria-label="questions" aria-busy={waiting && !faulty && question !== null}>
      <Tabs
        key="tabs"
        label="questions"
        chosen={tab}
        choose={choose}
        tabs={[...FIRST, ...names].map((name) => {
          const all = questions.filter((one) => one.tab === name);
          return { name, words: name, why: all.length && all.every((one) => one.why) ? all[0]!.why! : "" };
        })}
      />
      <div key="asked" class="asked" hidden={!open}>
        {open && own.length > 1 && (
          <div key="parts" class="parts" role="radiogroup" aria-label="which question">
            {own.map((one) => (
              <label key={one.command} title={one.why ?? ""}>
                <input
                  type="radio"
                  name="part"
                  checked={chosen === one}
                  disabled={!!one.why}
                  onChange={() => setPart((all) => ({ ...all, [tab]: one.command }))}
                />{" "}
                {one.command}
              </label>
            ))}
          </div>
        )}
        {open && chosen && (
          <p key="about" class="soft about">
            {chosen.about}
          </p>
        )}
        {open && chosen?.why && (
          <p key="why" class="why" role="status">
            This scene does not fit: {chosen.why}
          </p>
        )}
        {open && chosen && !chosen.why && chosen.fields.length > 0 && (
          <details
            key={`options ${chosen.command}`}
            class="options"
            open={needs.length > 0 || chosen.fields.some((one) => one.required)}
          >
            <summary>Options{said(values[chosen.command])}</summary>
            <form onSubmit={(event) => event.preventDefault()}>
              {chosen.fields.map((one) => (
                <OptionField
                  key={one.name}
                  option={one}
                  offered={chosen.choices?.[one.name] ?? []}
                  values={given[one.name] ?? []}
                  set={(list) => set(one.name, list)}
                />
              ))}
            </form>
          </details>
        )}
        {open && needs.length > 0 && (
          <p key="needs" class="soft" role="status">
            To be given: {needs.join(", ")}.
          </p>
        )}
        {open && waiting && question && !faulty && (
          <p key="progress" class="soft working" role="status">
            {progress && progress.of > 0 ? (
              <progress max={progress.of} value={progress.done} aria-label="progress" />
            ) : (
              <progress aria-label="progress" />
            )}{" "}
            {progress?.now ?? "being worked out"}
          </p>
        )}
        {open && refused && (
          <p key="refused" class="refused" role="alert">
            {refused}
          </p>
        )}
        {stale && (
          <p key="stale" class="stale-mark" role="status">
            Stale: this is the last good answer.
          </p>
        )}
        {open && subtitle && (
          <p key="subtitle" class="soft subtitle">
            {subtitle}
          </p>
        )}
        <Host
          key="place"
          class="found"
          of={(element) => {
            place.current = element;
          }}
        />
        {open && files.length > 0 && (
          <p key="files" class="files">
            <span class="soft">Files of the command:</span>{" "}
            {files.map((name) => (
              <button type="button" key={name} onClick={() => void fetched(name)}>
                {name}
              </button>
            ))}
          </p>
        )}
        {open && told && (
          <p key="told" class="soft" role="status">
            {told}
          </p>
        )}
      </div>
    </section>
  );
}

// How many options are said.
function said(values: Values | undefined): string {
  const count = Object.keys(values ?? {}).length;
  return count ? ` (${count} given)` : "";
}

// In an order of its own: the server has another.
function sorted({ command, options }: { command: string; options: Values }): unknown {
  return [command, Object.entries(options).sort(([a], [b]) => (a < b ? -1 : 1))];
}
