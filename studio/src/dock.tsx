// The charts under the canvas: of one object or of all, pinned runs, a signal over another, and a map
// beside them.

import type { Answer } from "./answer";
import { Beside, Choice } from "./beside";
import type { Editor } from "./editor";
import { Host } from "./host";
import type { Link } from "./link";
import { MapView } from "./map";
import type { Field, Span } from "./numbers";

// Charts of all objects are shown.
export const ALL = "";

interface Props {
  link: Link;
  editor: Editor | null;
  answer: Answer | null;
  opened: number;
  stale: boolean;
  scene: string;
  fields: Field[];
  figures: string[];
  spans: Map<string, Span>;
  // The object whose charts are shown, and all that have some.
  object: string | null;
  all: string[];
  choose: (id: string) => void;
  // Shows the figures of pinned runs.
  compare: () => void;
  edge: (address: string, range: string) => void;
  hosts: { dock: { current: HTMLDivElement | null }; charts: { current: HTMLElement } };
}

export function Dock({
  link,
  editor,
  answer,
  opened,
  stale,
  scene,
  fields,
  figures,
  spans,
  object,
  all,
  choose,
  compare,
  edge,
  hosts,
}: Props) {
  return (
    <section class="dock" aria-label="dock">
      {answer && (
        <Beside
          link={link}
          answer={answer}
          opened={opened}
          stale={stale}
          compare={compare}
          before={
            <Choice
              label="Charts of"
              value={object ?? ALL}
              all={all.length > 1 ? [...all, ALL] : all}
              none="all objects"
              set={choose}
            />
          }
        />
      )}
      <div class="docked">
        {editor && (
          <MapView
            editor={editor}
            link={link}
            fields={fields}
            figures={figures}
            spans={spans}
            scene={scene}
            opened={opened}
            edge={edge}
          />
        )}
        <div class="chart-scroll" tabindex={0} role="region" aria-label="charts of the objects" ref={hosts.dock}>
          <Host
            kind="section"
            class="charts"
            label="charts"
            of={(element) => {
              hosts.charts.current = element;
            }}
          />
        </div>
      </div>
    </section>
  );
}
