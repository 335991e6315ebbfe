// The studio: text, numbers and answers of one scene, side by side.

import { render } from "preact";
import { useEffect, useMemo, useReducer, useRef, useState } from "preact/hooks";
import { Board, type Answer } from "./answer";
import { Asking, BENCH, RESULTS, type Hearing } from "./asking";
import { Besides, connection } from "./connection";
import { ALL, Dock } from "./dock";
import { Drawing } from "./drawing";
import { Editor } from "./editor";
import { Expectations } from "./expect";
import { Exports } from "./exports";
import { First, type From } from "./first";
import { ObjectForm, SceneForm, type Desk } from "./form";
import type { Outline } from "./graph";
import { Host } from "./host";
import type { Parts } from "./kinds";
import { isUnfinished, take } from "./keys";
import { shownScene, type Message } from "./link";
import { Models } from "./models";
import { MotionPanel } from "./motion/panel";
import { fields as fieldsOf, type Field, type Span } from "./numbers";
import { Objects } from "./objects";
import { printing } from "./print";
import type { Guide } from "./schema";
import { Sliders } from "./sliders";
import { Splitter, useLayout } from "./splitter";
import { StatusLine } from "./status";
import { seen, Tour, type Show } from "./tour";
import { Edits, member, find, parse, type Change, type Value } from "./tree";
import { offered, Units } from "./units";
import "./style.css";
import "./bench.css";
import "./first.css";
import "./tour.css";
import "./expect.css";
import "./units.css";
import "./print.css";
import "./motion/motion.css";
import "./gallery/gallery.css";

const link = connection();

const VIEWS = [
  ["objects", "Objects"],
  ["drawing", "Drawing"],
  ["text", "Text"],
  ["model", "Dynamic model"],
  ["equations", "Equations"],
] as const;
type View = (typeof VIEWS)[number][0];

interface Status {
  saved: boolean;
  undo: boolean;
  redo: boolean;
  disk: string;
  base: string;
}
// What a notice is about: it goes when that is another. What the user did is about the text and the
// file, a run about its answer.
type About = "deed" | "run" | "file";

// Faults that are listed.
const MOST = 100;

// What is to be known of an answer that is not that of the text.
function stalenessOf(faults: number, isThere: boolean): string {
  const has = faults ? `the text has ${faults} ${faults === 1 ? "fault" : "faults"}` : "this text has no answer";
  return isThere ? `Stale: ${has}. This is the last good answer.` : `No answer yet: ${has}.`;
}

// Requests in words of the reader.
const DEEDS: Record<string, string> = {
  save: "saving",
  save_as: "saving",
  new: "new scene",
  open: "other scene",
  undo: "undoing",
  redo: "redoing",
};
const NO_STATUS: Status = { saved: true, undo: false, redo: false, disk: "same", base: "" };

// Addresses of the figures of a run: numbers, however deep they stand.
function figuresOf(objects: Record<string, any>): string[] {
  const found: string[] = [];
  const walk = (value: any, address: string) => {
    if (typeof value === "number") found.push(address);
    else if (value && typeof value === "object" && !Array.isArray(value))
      for (const [name, inner] of Object.entries(value)) walk(inner, address ? `${address}.${name}` : name);
  };
  walk(objects, "");
  return found;
}

// The object whose charts are looked at first: the one that is separated longest, else the last elastic one.
function mostLoaded(objects: Record<string, any>): string | null {
  const apart = (one: any): number => one?.pair?.separated_time ?? 0,
    ids = Object.keys(objects);
  const longest = ids.reduce<string | null>(
    (best, id) => (apart(objects[id]) > (best === null ? 0 : apart(objects[best])) ? id : best),
    null,
  );
  return longest ?? ids.filter((id) => objects[id]?.delta_abs > 0).at(-1) ?? ids.at(-1) ?? null;
}

function Studio() {
  const { layout, set: setLayout, offered: layoutOffered } = useLayout(link);
  const place = useRef<HTMLElement>(null!),
    dock = useRef<HTMLDivElement>(null),
    answers = useRef<HTMLElement>(null);
  const [tables, charts, moving, compared] = [
    useRef<HTMLElement>(null!),
    useRef<HTMLElement>(null!),
    useRef<HTMLElement>(null!),
    useRef<HTMLElement>(null!),
  ];
  const editor = useRef<Editor | null>(null),
    board = useRef<Board | null>(null);
  const self = useRef("0"),
    spans = useRef(new Map<string, Span>());
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  const drawing = useRef(false);
  const [connected, setConnected] = useState(false);
  const [scenes, setScenes] = useState<string[]>([]);
  const [folder, setFolder] = useState("");
  const [scene, setScene] = useState("");
  const [status, setStatus] = useState<Status>(NO_STATUS);
  const stood = useRef(NO_STATUS),
    baseBefore = useRef<string | null>(null);
  const [draft, setDraft] = useState<{ time: number; other_base: boolean } | null>(null);
  const [faults, setFaults] = useState<any[]>([]);
  const [answer, setAnswer] = useState<Answer | null>(null);
  const [stale, setStale] = useState(false);
  const [told, setTold] = useState<{ words: string; about: About } | null>(null);
  const tell = (words: string, about: About = "deed") => setTold(words ? { words, about } : null);
  const cleared = (...about: About[]) => setTold((before) => (before && about.includes(before.about) ? null : before));
  const [home, setHome] = useState(false),
    [touring, setTouring] = useState(false);
  const atHome = useRef(false),
    again = useRef(false),
    judged = useRef<((head: Answer) => void) | null>(null),
    program = useRef("");
  atHome.current = home;
  const [view, setView] = useState<View>("objects");
  const [side, setSide] = useState<"numbers" | "properties">("numbers");
  const [objects, setObjects] = useState<Outline[]>([]);
  const [parts, setParts] = useState<Parts>({ kinds: [], objects: [] });
  const [guide, setGuide] = useState<Guide | null>(null);
  const [chosen, setChosen] = useState<string[]>([]);
  // The object whose charts are shown: as chosen, or the one that is loaded most.
  const [loaded, setLoaded] = useState<string | null>(null),
    lookAt = useRef<(id: string) => void>(() => {});
  const [version, setVersion] = useState(0);
  const [tab, setTab] = useState<string>(BENCH),
    [opened, setOpened] = useState(0);
  const hearing = useRef<Hearing>({ checked: () => {}, ask: () => {} });
  // What is told of versions matters where the model is looked at.
  const newest = useRef(0),
    models = useRef(false);
  models.current = view === "model" || view === "equations" || view === "drawing";
  const parsed = useRef<{ of: unknown; text: string; root: Value | null; good: Value | null; goodText: string }>({
    of: null,
    text: "",
    root: null,
    good: null,
    goodText: "",
  });
  const wrong = useRef(false),
    current = useRef(""),
    latest = useRef<Answer | null>(null);

  useEffect(() => {
    const own = (editor.current = new Editor(place.current!, link, () => self.current));
    const shown = (board.current = new Board(
      { tables: tables.current!, compared: compared.current!, charts: charts.current!, machine: moving.current! },
      dock.current!,
      (sight) => link.send({ type: "sight", charts: sight }),
      (id) => lookAt.current(id),
    ));
    printing(answers.current!);
    // Everything is drawn once a frame, however often the text and its answer change: the first
    // answer since a frame as it comes, so that the next frame has less to do.
    let changed = false,
      frame: ArrayBuffer | null = null,
      late = 0,
      ahead = false,
      owed = false;
    const taken = () => {
      owed = false;
      link.send({ type: "shown" });
    };
    const draw = () => {
      drawing.current = false;
      if (changed) {
        own.flush(false);
        redraw(0);
      }
      changed = false;
      if (own.isBehind) {
        clearTimeout(late);
        late = setTimeout(() => own.flush(), 150);
      }
      if (frame) {
        const newest = frame;
        frame = null;
        answered(newest);
      }
      if (owed) taken();
    };
    const soon = () => {
      if (drawing.current) return;
      drawing.current = true;
      requestAnimationFrame(draw);
    };
    own.edited = () => cleared("deed");
    own.refused = tell;
    own.changed = () => {
      changed = true;
      soon();
    };
    link.state = (on) => {
      setConnected(on);
      if (on) cleared("deed");
      else own.lost();
    };
    // What only this window has.
    addEventListener("beforeunload", (event) => {
      if (!own.isSettled) event.preventDefault();
    });
    link.on("welcome", (message) => {
      self.current = message.window;
      setFolder(message.folder);
      program.current = message.program;
      seen.offer(message.settings);
      layoutOffered(message.settings);
      if (offered(message.settings)) {
        shown.again();
        redraw(0);
      }
      void link.get("/api/scenes").then(({ scenes }) => {
        setScenes(scenes);
        // Of a connection that was lost the page stays where it is.
        again.current = current.current !== "";
        const wanted = current.current || (shownScene.get() ?? message.scene);
        if (wanted)
          link.send({ type: "open", scene: wanted, ...(again.current && own.since ? { since: own.since } : {}) });
        else setHome(true);
      });
    });
    link.on("resumed", (message) => {
      again.current = false;
      own.resume(message);
      setOpened((count) => count + 1);
    });
    link.on("opened", (message) => {
      // The server was started again: what it does not have is here.
      const left = again.current && message.scene === current.current ? own.left(stood.current.saved) : null;
      if (message.scene !== current.current) {
        setObjects([]);
        setChosen([]);
        setFaults([]);
        setLoaded(null);
        void link.get(`/api/parts?scene=${encodeURIComponent(message.scene)}`).then(setParts, () => {});
        setScenes((known) => (known.includes(message.scene) ? known : [...known, message.scene].sort()));
        spans.current.clear();
        shown.clear();
        latest.current = null;
        setAnswer(null);
      }
      current.current = message.scene;
      setScene(message.scene);
      if (!again.current) enter();
      again.current = false;
      tell("");
      wrong.current = false;
      own.open(message);
      // The draft is an older text of this window, unless the file has been changed since.
      const isOlder = left !== null && message.draft !== null && !message.draft.other_base;
      setDraft(isOlder ? null : message.draft);
      if (isOlder) link.send({ type: "draft", restore: true });
      baseBefore.current = left ? stood.current.base : null;
      if (left && !own.owe(left))
        tell("Another window changed the same lines while the server was away. Undo shows them.", "file");
      setOpened((count) => count + 1);
      void own.guide().then(setGuide, () => {});
    });
    link.on("status", (message) => {
      const now = message as unknown as Status;
      if (JSON.stringify(now) !== JSON.stringify(stood.current)) cleared("deed");
      if (now.saved) cleared("file");
      stood.current = now;
      setStatus(now);
      if (baseBefore.current !== null && baseBefore.current !== now.base)
        tell(
          "The file was changed while the server was away. Undo shows the file as it is now, Save writes over it.",
          "file",
        );
      baseBefore.current = null;
      if (!message.draft) {
        setDraft(null);
        own.lock(false);
      }
    });
    link.on("checked", (message: Message) => {
      if (!own.check(message)) return;
      wrong.current = message.faults.some((fault: any) => fault.severity === "error");
      setFaults((before) => (JSON.stringify(before) === JSON.stringify(message.faults) ? before : message.faults));
      setStale(wrong.current);
      // While a number moves nothing of it is another.
      if (message.objects)
        setObjects((before) => (JSON.stringify(before) === JSON.stringify(message.objects) ? before : message.objects));
      newest.current = message.version;
      hearing.current.checked(message.version);
      if (models.current) setVersion(message.version);
    });
    link.on("failed", (message) => {
      tell(message.message, "run");
      setStale(true);
    });
    link.on("error", (message) => {
      tell(message.message);
      again.current = false;
      if (!current.current) setHome(true);
    });
    link.answer = (given) => {
      // Of a window that nobody sees the server keeps the newest.
      if (document.hidden) {
        frame = given;
        owed = true;
        soon();
        return;
      }
      taken();
      if (ahead) {
        frame = given;
        soon();
        return;
      }
      ahead = true;
      requestAnimationFrame(() => {
        ahead = false;
      });
      answered(given);
    };
    const answered = (given: ArrayBuffer) => {
      const head = shown.show(given);
      performance.mark("answer", { detail: head.version });
      const before = latest.current;
      latest.current = head;
      judged.current?.(head);
      cleared("run");
      setStale(wrong.current);
      // The sentence is drawn anew where it says something else.
      const seen = (one: Answer) =>
        JSON.stringify([one.verdict, one.warnings, one.coarse, one.title, one.pins, one.signals]);
      if (!before || seen(before) !== seen(head)) setAnswer(head);
    };
    const keys = (event: KeyboardEvent) => {
      if (atHome.current || !(event.ctrlKey || event.metaKey) || place.current!.contains(event.target as Node)) return;
      const type = ({ z: event.shiftKey ? "redo" : "undo", y: "redo", s: "save" } as Record<string, string>)[
        event.key.toLowerCase()
      ];
      // A field takes back what is typed in it; what is saved has it.
      if (!type || (type !== "save" && isUnfinished(event.target))) return;
      event.preventDefault();
      if (type === "save") take(event.target);
      act(type);
    };
    addEventListener("keydown", keys);
    link.connect();
  }, []);

  // The first page, and the scene that is open.
  const leave = () => {
    setHome(true);
    shownScene.set("");
    document.title = "dam studio";
  };
  const enter = () => {
    setHome(false);
    shownScene.set(current.current);
    document.title = `${current.current} – dam studio`;
  };
  const show: Show = (part) => {
    if (part === "home") {
      leave();
      return;
    }
    enter();
    setTab(part === "results" ? RESULTS : BENCH);
    if (part === "numbers") setSide("numbers");
    else if (part === "objects" || part === "equations" || part === "text") look(part);
  };
  const act = (type: string, more = {}) => {
    cleared("deed");
    if (link.isOpen) editor.current!.when(() => link.send({ type, ...more }));
    else tell(`The server does not answer: there is no ${DEEDS[type] ?? "answer"} until it is back.`);
  };
  const saveAs = () => {
    const name = prompt("Name of the new file in this folder", scene.replace(/\.json$/, "-2.json"));
    if (name) act("save_as", { scene: name });
  };
  const fresh = () => {
    const name = prompt("Name of the new scene in this folder", "scene.json");
    if (name) act("new", { scene: name.endsWith(".json") ? name : `${name}.json` });
  };
  // The text as a tree, made where it is looked at; of what is no JSON the last one that was.
  const tree = () => {
    const own = editor.current!,
      known = parsed.current,
      doc = own.state.doc;
    if (known.of !== doc) {
      known.of = doc;
      known.text = doc.toString();
      known.root = parse(known.text);
      if (known.root) {
        known.good = known.root;
        known.goodText = known.text;
      }
    }
    return known;
  };
  const edit = (make: (edits: Edits) => Change[], drag?: number): boolean => {
    const own = editor.current!,
      { text, root } = tree();
    if (!root) {
      tell("The text is not whole at present: mend it in the text view first.");
      return false;
    }
    const changes = make(new Edits(text, root));
    return changes.length > 0 && own.change(changes, drag ?? own.drag());
  };
  const select = (ids: string[]) => {
    setChosen(ids);
    if (ids.length === 1) setLoaded(ids[0]!);
    if (ids.length || side !== "properties") setSide("properties");
  };
  // The object that was clicked in the machine or in a table: its charts, and the graph shows it.
  lookAt.current = (id) => {
    setTab(BENCH);
    setLoaded(id);
    if (objects.some((one) => one.id === id)) setChosen([id]);
  };
  const rename = (id: string, other: string) => {
    if (!/^[A-Za-z_][A-Za-z0-9_-]*$/.test(other)) {
      tell(`“${other}” is no name: letters, digits, _ and - are, and a letter comes first.`);
      redraw(0);
      return;
    }
    if (objects.some((one) => one.id === other)) {
      tell(`There is an object ${other} already.`);
      redraw(0);
      return;
    }
    if (edit((edits) => edits.rename(id, other)))
      setChosen((before) => before.map((one) => (one === id ? other : one)));
  };
  const look = (next: View) => {
    setView(next);
    setVersion(newest.current);
    if (next === "text") {
      editor.current!.flush();
      requestAnimationFrame(() => editor.current!.view.requestMeasure());
    }
  };
  const properties = () => {
    if (!guide || !editor.current) return null;
    const { good, goodText } = tree();
    if (!good) return <p class="soft">The text is no JSON yet: see the text view.</p>;
    const desk: Desk = {
      guide,
      root: good,
      text: goodText,
      faults,
      outputs: objects.flatMap((one) => one.outputs.map((output) => output.address)),
      edit,
    };
    const there = chosen.filter((id) => member(find(good, ["objects"]), id));
    if (there.length > 1)
      return (
        <p class="soft">
          {there.length} objects are selected: {there.join(", ")}. Duplicate and Delete take all of them.
        </p>
      );
    const id = there[0];
    if (id === undefined) return <SceneForm desk={desk} />;
    const kind =
      member(find(good, ["objects", id]), "kind")?.value.text ?? objects.find((one) => one.id === id)?.kind ?? "";
    const coordinates = new Map(
      objects.flatMap((one) => one.outputs.map((output) => [output.address, output.coordinate] as const)),
    );
    return (
      <>
        <MotionPanel
          key={`motion ${scene} ${id}`}
          {...{ link, scene, id, kind, desk, edit, coordinates }}
          isAt={(one) => editor.current!.isAt(one)}
          drag={() => editor.current!.drag()}
        />
        <ObjectForm key={id} desk={desk} id={id} kind={kind} rename={(other) => rename(id, other)} />
      </>
    );
  };
  // Drawn anew where something of it is another: not while numbers move.
  const graph = useMemo(
    () =>
      view === "objects" ? (
        <Objects
          key="objects"
          objects={objects}
          faults={faults}
          parts={parts}
          selected={chosen}
          select={select}
          edit={edit}
        />
      ) : null,
    [view, objects, faults, parts, chosen],
  );
  const fields: Field[] = editor.current?.state.field(fieldsOf) ?? [];
  const errors = faults.filter((fault) => fault.severity === "error");
  const found = latest.current?.figures,
    figures = useMemo(() => (found ? figuresOf(found) : []), [found]);
  const objectsOf = found ? Object.keys(found) : [],
    shown = loaded !== null && (loaded === ALL || objectsOf.includes(loaded)) ? loaded : mostLoaded(found ?? {});
  // Another scene begins with all of them.
  useEffect(() => {
    board.current?.only(shown === ALL ? null : shown);
  }, [shown, opened]);
  // It stays while numbers move, whichever is loaded most by then.
  useEffect(() => {
    if (loaded === null && shown !== null) setLoaded(shown);
  }, [loaded, shown]);
  const isSaved = status.saved && (editor.current?.isSettled ?? true);
  return (
    <div class="studio">
      <div key="top" class="top" role="toolbar" aria-label="scene">
        <strong>dam studio</strong>
        <button type="button" aria-pressed={home} onClick={leave}>
          Home
        </button>
        {!home && (
          <>
            <label>
              <span class="soft">{folder}/</span>{" "}
              <select
                aria-label="scene"
                value={scene}
                onChange={(event) => act("open", { scene: event.currentTarget.value })}
              >
                {scenes.concat(scene && !scenes.includes(scene) ? [scene] : []).map((one) => (
                  <option value={one}>{one}</option>
                ))}
              </select>
            </label>
            <span class={isSaved ? "soft" : "unsaved"} role="status">
              {isSaved ? "saved" : "not saved"}
            </span>
            <button type="button" class="save" onClick={() => act("save")} disabled={isSaved} title="Ctrl-S">
              Save
            </button>
            <button type="button" onClick={saveAs}>
              Save as…
            </button>
            <button type="button" class="undo" onClick={() => act("undo")} disabled={!status.undo} title="Ctrl-Z">
              Undo
            </button>
            <button type="button" onClick={() => act("redo")} disabled={!status.redo} title="Ctrl-Y">
              Redo
            </button>
            <Exports link={link} scene={scene} stale={stale} tell={tell} />
          </>
        )}
        <Besides scene={home ? "" : scene} link={link} tell={tell} />
        <button type="button" onClick={fresh}>
          New…
        </button>
        <button type="button" onClick={() => setTouring(true)}>
          Tour
        </button>
        <Units
          link={link}
          changed={() => {
            board.current?.again();
            redraw(0);
          }}
        />
        {!connected && (
          <span class="lost" role="alert">
            {link.known
              ? `The server is gone. This window keeps its edits and sends them when the studio runs on port ${location.port} again.`
              : "This window was not opened by dam studio: start the studio, which opens a window of its own."}
          </span>
        )}
      </div>
      {(draft || status.disk !== "same" || told !== null) && (
        <div key="notices" class="notices">
          {draft && (
            <p role="alert">
              <b>A draft of {new Date(1000 * draft.time).toLocaleString()} holds changes that were not saved.</b>
              {draft.other_base && " The file has been changed since."}
              <button type="button" onClick={() => act("draft", { restore: true })}>
                Restore the draft
              </button>
              <button
                type="button"
                onClick={() => {
                  editor.current!.forgive();
                  act("draft", { restore: false });
                }}
              >
                Discard it
              </button>
            </p>
          )}
          {status.disk === "changed" && (
            <p role="alert">
              <b>The file was changed by another program.</b>
              <button type="button" onClick={() => act("reload")}>
                Reload it
              </button>
              <button type="button" onClick={() => act("keep_mine")}>
                Keep mine
              </button>
              <button type="button" onClick={saveAs}>
                Save as…
              </button>
            </p>
          )}
          {status.disk === "gone" && (
            <p role="alert">
              <b>The file is gone.</b> Save writes it anew.
            </p>
          )}
          {told && (
            <p role="alert">
              {told.words}{" "}
              <button type="button" onClick={() => tell("")}>
                Close
              </button>
            </p>
          )}
        </div>
      )}
      <div key="stage" class={home ? "stage home" : "stage"}>
        <div key="panes" class="panes" style={{ gridTemplateColumns: `${layout.side}px 5px minmax(0, 1fr)` }}>
          <div class="pane-middle">
            <div class="tabs" role="tablist" aria-label="numbers and properties">
              <button type="button" role="tab" aria-selected={side === "numbers"} onClick={() => setSide("numbers")}>
                Numbers
              </button>
              <button
                type="button"
                role="tab"
                aria-selected={side === "properties"}
                onClick={() => setSide("properties")}
              >
                Properties{chosen.length === 1 ? ` of ${chosen[0]}` : ""}
              </button>
            </div>
            <div class="side">
              {editor.current &&
                (side === "numbers" ? (
                  <Sliders
                    key={scene}
                    editor={editor.current}
                    link={link}
                    scene={scene}
                    fields={fields}
                    spans={spans.current}
                  />
                ) : (
                  properties()
                ))}
            </div>
          </div>
          <Splitter name="side" label="width of the numbers" upright layout={layout} set={setLayout} />
          <main
            class={`answers${stale ? " stale" : ""}${tab === BENCH ? "" : " asks"}`}
            ref={answers}
            aria-label="answers"
            style={{
              gridTemplateColumns: `minmax(0, ${layout.graph}fr) 5px minmax(0, ${1 - layout.graph}fr)`,
              gridTemplateRows: `auto minmax(0, ${layout.canvas}fr) 5px minmax(0, ${1 - layout.canvas}fr) auto`,
            }}
          >
            <header key="print" class="print-head">
              <h1>{latest.current?.title || scene}</h1>
              <p>
                {folder}/{scene}, dam {program.current}
                {isSaved ? "" : ", changes not saved"}
              </p>
            </header>
            <StatusLine
              key="status"
              answer={answer}
              stale={stale ? stalenessOf(errors.length, answer !== null) : null}
              results={() => setTab(RESULTS)}
            />
            <div key="left" class={`pane-left shows-${view}${view === "drawing" ? " draws" : ""}`}>
              <div class="tabs" role="tablist" aria-label="views of the scene">
                {VIEWS.map(([name, words]) => (
                  <button type="button" role="tab" key={name} aria-selected={view === name} onClick={() => look(name)}>
                    {words}
                  </button>
                ))}
              </div>
              {graph}
              {view === "drawing" && (
                <Drawing
                  parts={parts}
                  key={`drawing ${scene}`}
                  link={link}
                  scene={scene}
                  version={version}
                  root={() => tree().root}
                  isAt={(one) => editor.current!.isAt(one)}
                  edit={edit}
                  drag={() => editor.current!.drag()}
                />
              )}
              {(view === "model" || view === "equations") && (
                <Models
                  key={view}
                  link={link}
                  scene={scene}
                  version={version}
                  kind={view}
                  choose={(id) => lookAt.current(id)}
                />
              )}
              <Host
                key="text"
                class="text-pane"
                of={(element) => {
                  place.current = element;
                }}
              />
              <div key="faults" class="faults" aria-label="faults" role="region">
                {faults.slice(0, MOST).map((fault) => (
                  <button
                    type="button"
                    class={fault.severity}
                    onClick={() => {
                      if (view === "text") {
                        editor.current!.show(fault.from, fault.to);
                        return;
                      }
                      const [id] = fault.path.split(/[.[]/);
                      if (view === "objects") select(objects.some((one) => one.id === id) ? [id] : []);
                      else {
                        look("text");
                        requestAnimationFrame(() => editor.current!.show(fault.from, fault.to));
                      }
                    }}
                  >
                    <b>{fault.severity}</b> {fault.path && <code>{fault.path}</code>} {fault.message}
                    {fault.hints.length ? ` (${fault.hints.join("; ")})` : ""}
                  </button>
                ))}
                {faults.length > MOST && <p class="soft">{faults.length - MOST} more.</p>}
              </div>
            </div>
            <Splitter key="graph" name="graph" label="width of the graph" upright layout={layout} set={setLayout} />
            <Asking
              key="asking"
              link={link}
              scene={scene}
              tab={tab}
              choose={setTab}
              hearing={hearing.current}
              opened={opened}
              faulty={wrong.current}
            />
            <Host
              key="machine"
              kind="section"
              class="machine"
              label="machine moving"
              of={(element) => {
                moving.current = element;
              }}
            />
            <Splitter
              key="canvas"
              name="canvas"
              label="height of the canvas"
              upright={false}
              layout={layout}
              set={setLayout}
            />
            <Dock
              key="dock"
              link={link}
              editor={editor.current}
              answer={answer}
              opened={opened}
              stale={stale}
              scene={scene}
              fields={fields}
              figures={figures}
              spans={spans.current}
              object={shown}
              all={objectsOf}
              choose={(id) => setLoaded(id)}
              compare={() => setTab(RESULTS)}
              edge={(address, range) =>
                hearing.current.ask("find", { vary: [`${address}=${range}`], maximize: [address] })
              }
              hosts={{ dock, charts }}
            />
            <div key="results" class="results" hidden={tab !== RESULTS}>
              {scene && (
                <Expectations
                  key={`expectations ${scene}`}
                  link={link}
                  scene={scene}
                  feed={judged}
                  latest={latest}
                  isAt={(one) => editor.current!.isAt(one)}
                  edit={edit}
                  program={program.current}
                />
              )}
              <Host
                key="figures"
                kind="section"
                class="figures"
                label="figures"
                of={(element) => {
                  tables.current = element;
                }}
              />
              <Host
                key="compared"
                kind="section"
                class="compared"
                label="figures beside pinned runs"
                of={(element) => {
                  compared.current = element;
                }}
              />
            </div>
          </main>
        </div>
        {home && (
          <First
            key="first"
            link={link}
            folder={folder}
            scene={scene}
            saved={isSaved}
            toured={seen.get() !== null}
            back={enter}
            tour={() => setTouring(true)}
            open={(wanted) => act("open", { scene: wanted })}
            make={(name, from: From | null) => act("new", { scene: name, from })}
          />
        )}
      </div>
      {touring && <Tour key="tour" link={link} scene={scene} home={home} show={show} end={() => setTouring(false)} />}
    </div>
  );
}

render(<Studio />, document.getElementById("studio")!);
