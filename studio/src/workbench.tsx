// The workbench: numbers at the side, the canvas (scene and machine) above the charts, the verdict
// below. Questions and results stand in the place of machine and charts.

import { Asking } from "./asking";
import { Dock } from "./dock";
import { Host } from "./host";
import { Results } from "./results";
import { SceneViews } from "./scene-views";
import { Side } from "./side";
import { Splitter } from "./splitter";
import { StatusLine } from "./status";
import { folder, isSaved, scene } from "./store/file";
import { isFaulty } from "./store/findings";
import { layout } from "./store/layout";
import { link, program } from "./store/line";
import { hearing } from "./store/opening";
import { placed } from "./store/places";
import { answer, isStale, openings } from "./store/run";
import { BENCH, tab } from "./store/views";

// On paper, and for those who hear the page.
const PrintHead = () => (
  <header class="print-head">
    <h1>{answer.value?.title || scene.value || "dam studio"}</h1>
    <p>
      {folder}/{scene}, dam {program}
      {isSaved.value ? "" : ", changes not saved"}
    </p>
  </header>
);

const Questions = () => (
  <Asking
    link={link}
    scene={scene.value}
    tab={tab.value}
    choose={(name) => {
      tab.value = name;
    }}
    hearing={hearing}
    opened={openings.value}
    faulty={isFaulty.value}
  />
);

function Answers() {
  const { graph, canvas } = layout.value;
  return (
    <section
      class={`answers${isStale.value ? " stale" : ""}${tab.value === BENCH ? "" : " asks"}`}
      ref={placed("answers")}
      aria-label="answers"
      style={{
        gridTemplateColumns: `minmax(0, ${graph}fr) 5px minmax(0, ${1 - graph}fr)`,
        gridTemplateRows: `auto minmax(0, ${canvas}fr) 5px minmax(0, ${1 - canvas}fr) auto`,
      }}
    >
      <PrintHead />
      <StatusLine />
      <SceneViews />
      <Splitter name="graph" label="width of the graph" upright />
      <Questions />
      <Host kind="section" class="machine" label="machine moving" of={placed("machine")} />
      <Splitter name="canvas" label="height of the canvas" upright={false} />
      <Dock />
      <Results />
    </section>
  );
}

export const Workbench = () => (
  <div class="panes" style={{ gridTemplateColumns: `${layout.value.side}px 5px minmax(0, 1fr)` }}>
    <Side />
    <Splitter name="side" label="width of the numbers" upright />
    <Answers />
  </div>
);
