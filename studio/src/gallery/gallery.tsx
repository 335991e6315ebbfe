// The templates and scenarios as cards, by what they ask, of one topic or of all.

import { useState } from "preact/hooks";
import type { Link } from "../link";
import { Card } from "./card";
import type { From } from "./picture";

export interface Template {
  name: string;
  meaning: string;
}
export interface Scenario {
  name: string;
  title: string;
  question: string;
  group: string;
}
interface Props {
  link: Link;
  templates: Template[];
  scenarios: Scenario[];
  // Whether texts have all the words that are searched for.
  fits: (...texts: string[]) => boolean;
  begin: (stem: string, from: From) => void;
}

export const topicOf = ({ name }: { name: string }): string => name.split("/")[0]!;
const shown = (topic: string): string => topic[0]!.toUpperCase() + topic.slice(1).replaceAll("_", " ");
const TEMPLATES = "templates";

export const fitting = ({ templates, scenarios, fits }: Pick<Props, "templates" | "scenarios" | "fits">) => ({
  templates: templates.filter((one) => fits(one.name, one.meaning, "template")),
  scenarios: scenarios.filter((one) => fits(one.name, one.title, one.question, one.group)),
});

export function Gallery(props: Props) {
  const { link, begin } = props,
    [topic, setTopic] = useState("");
  const topics = [TEMPLATES, ...[...new Set(props.scenarios.map(topicOf))].sort()],
    found = fitting(props);
  const templates = found.templates.filter(() => topic === "" || topic === TEMPLATES),
    scenarios = found.scenarios.filter((one) => topic === "" || topicOf(one) === topic);
  const groups = [...new Set(scenarios.map((one) => one.group))],
    count = templates.length + scenarios.length;
  return (
    <section class="gallery" aria-label="gallery">
      <h2>
        Gallery <small>machines with a question and its answer; a copy of what you choose comes into the folder</small>
      </h2>
      <p class="gallery-tools">
        <label>
          topic{" "}
          <select aria-label="topic" value={topic} onChange={(event) => setTopic(event.currentTarget.value)}>
            <option value="">all</option>
            {topics.map((one) => (
              <option key={one} value={one}>
                {shown(one)}
              </option>
            ))}
          </select>
        </label>
        <span class="soft" role="status">
          {count} {count === 1 ? "scene" : "scenes"}
        </span>
      </p>
      {templates.length > 0 && (
        <section aria-label="Begin with a template">
          <h3>Begin with a template</h3>
          <div class="cards">
            {templates.map(({ name, meaning }) => (
              <Card
                key={name}
                link={link}
                from={{ template: name }}
                title={meaning}
                words=""
                name={name}
                act={() => begin(name, { template: name })}
              />
            ))}
          </div>
        </section>
      )}
      {groups.map((group) => (
        <section key={group} aria-label={group}>
          <h3>{group}</h3>
          <div class="cards">
            {scenarios
              .filter((one) => one.group === group)
              .map(({ name, title, question }) => (
                <Card
                  key={name}
                  link={link}
                  from={{ scenario: name }}
                  title={title}
                  words={question}
                  name={name}
                  act={() => begin(name.split("/").at(-1)!, { scenario: name })}
                />
              ))}
          </div>
        </section>
      ))}
    </section>
  );
}
