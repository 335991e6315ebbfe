// The charts under the canvas: of one object or of all, pinned runs, a signal over another, and a map
// beside them.

import { Beside, Choice } from "./beside";
import { Host } from "./host";
import { MapView } from "./map";
import { scene } from "./store/file";
import { link } from "./store/line";
import { hearing } from "./store/opening";
import { placed } from "./store/places";
import { ALL, answer, charted, chosenCharts, figures, isStale, openings, shownCharts } from "./store/run";
import { editor, fields, spans } from "./store/text";
import { RESULTS, tab } from "./store/views";

function ChartsOf() {
  const shown = shownCharts.value ?? ALL,
    own = charted.value,
    all = shown === ALL || own.includes(shown) ? own : [...own, shown];
  return (
    <Choice
      label="Charts of"
      value={shown}
      all={all.length > 1 ? [...all, ALL] : all}
      none="all objects"
      set={(id) => {
        chosenCharts.value = id;
      }}
    />
  );
}

export function Dock() {
  return (
    <section class="dock" aria-label="dock">
      {answer.value && (
        <Beside
          link={link}
          answer={answer.value}
          opened={openings.value}
          stale={isStale.value}
          compare={() => {
            tab.value = RESULTS;
          }}
          before={<ChartsOf />}
        />
      )}
      <div class="docked">
        {editor.value && (
          <MapView
            editor={editor.value}
            link={link}
            fields={fields.value}
            figures={figures.value}
            spans={spans}
            scene={scene.value}
            opened={openings.value}
            edge={(address, range) => hearing.ask("find", { vary: [`${address}=${range}`], maximize: [address] })}
          />
        )}
        <div class="chart-scroll" tabindex={0} role="region" aria-label="charts of the objects" ref={placed("dock")}>
          <Host kind="section" class="charts" label="charts" of={placed("charts")} />
        </div>
      </div>
    </section>
  );
}
