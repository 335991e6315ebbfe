// The first page: scenes that were opened last, those of the folder, the gallery of what a new one
// may begin with; one search over all of it.

import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { fitting, Gallery, type Scenario, type Template } from "./gallery/gallery";
import type { From } from "./gallery/picture";
import type { Link } from "./link";

export type { From };
interface Scene {
  name: string;
  title: string | null;
}
interface Told {
  recent: string[];
  scenes: Scene[];
  templates: Template[];
  scenarios: Scenario[];
}

interface Props {
  link: Link;
  folder: string;
  // The scene that is open behind the page; empty: none.
  scene: string;
  saved: boolean;
  open: (scene: string) => void;
  make: (name: string, from: From | null) => void;
  back: () => void;
  tour: () => void;
  toured: boolean;
}

// A name for a new scene that none has yet.
export function freeFile(stem: string, known: string[]): string {
  for (let k = 1; ; k++) {
    const name = k === 1 ? `${stem}.json` : `${stem}-${k}.json`;
    if (!known.includes(name)) return name;
  }
}

export function First({ link, folder, scene, saved, open, make, back, tour, toured }: Props) {
  const [told, setTold] = useState<Told | null>(null),
    [failed, setFailed] = useState(false);
  const [words, setWords] = useState("");
  const search = useRef<HTMLInputElement>(null);
  useEffect(() => {
    void link.get<Told>("/api/first").then(setTold, () => setFailed(true));
  }, []);
  useEffect(() => search.current?.focus(), [told]);
  if (!told)
    return (
      <section class="first-page" aria-label="first page" aria-busy={!failed}>
        <p class="soft">{failed ? "The list of scenes did not come: load the page anew." : "…"}</p>
      </section>
    );
  const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
  const fits = (...texts: (string | null)[]) => {
    const all = texts.join(" ").toLowerCase();
    return wanted.every((word) => all.includes(word));
  };
  const titleOf = (name: string) => told.scenes.find((one) => one.name === name)?.title ?? null;
  const recent = told.recent.filter((name) => fits(name, titleOf(name)));
  const scenes = told.scenes.filter((one) => fits(one.name, one.title));
  const { templates, scenarios } = fitting({ ...told, fits });
  const none = !recent.length && !scenes.length && !templates.length && !scenarios.length;
  const begin = (stem: string, from: From | null) => {
    const name = prompt(
      `Name of the new scene in ${folder}/`,
      freeFile(
        stem,
        told.scenes.map((one) => one.name),
      ),
    );
    if (name) make(name.endsWith(".json") ? name : `${name}.json`, from);
  };
  const existing = (name: string) => <Entry key={name} name={name} words={titleOf(name)} act={() => open(name)} />;
  return (
    <section class="first-page" aria-label="first page">
      <header>
        <h1>Scenes of mechanisms</h1>
        <input
          type="search"
          ref={search}
          value={words}
          placeholder="Search scenes, templates, scenarios"
          aria-label="search scenes, templates and scenarios"
          onInput={(event) => setWords(event.currentTarget.value)}
          onKeyDown={(event) => {
            if (event.key === "Escape" && words) {
              event.preventDefault();
              setWords("");
            }
          }}
        />
        {scene && (
          <button type="button" onClick={back}>
            Back to {scene}
            {saved ? "" : ", which is not saved"}
          </button>
        )}
        <button type="button" class={toured ? "" : "urged"} onClick={tour}>
          {toured ? "Tour" : "New here? A tour of two minutes"}
        </button>
      </header>
      {none && <p role="status">Nothing here has all of these words.</p>}
      <div class="first-lists">
        <div>
          <List title="Opened last" of={recent} one={existing} />
          <List title={`Scenes of ${folder}/`} of={scenes} one={({ name }) => existing(name)}>
            {told.scenes.length === 0 && <p class="soft">There is no scene in this folder yet.</p>}
          </List>
        </div>
        <div>
          {fits("empty scene template") && (
            <Entry name="An empty scene" words="drawn or built of objects" act={() => begin("scene", null)} />
          )}
          {templates.length + scenarios.length > 0 && (
            <Gallery link={link} templates={told.templates} scenarios={told.scenarios} fits={fits} begin={begin} />
          )}
        </div>
      </div>
    </section>
  );
}

function List<T>({
  title,
  of,
  one,
  children,
}: {
  title: string;
  of: T[];
  one: (item: T) => ComponentChildren;
  children?: ComponentChildren;
}) {
  const own = [children].flat().filter(Boolean);
  if (!of.length && !own.length) return null;
  return (
    <section aria-label={title}>
      <h2>{title}</h2>
      {of.map(one)}
      {children}
    </section>
  );
}

function Entry({ name, words, act }: { name: string; words: string | null; act: () => void }) {
  return (
    <button type="button" class="entry" onClick={act}>
      <b>{name}</b> {words && <span class="soft">{words}</span>}
    </button>
  );
}
