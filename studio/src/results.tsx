// The results of the run: expectations, figures, and figures beside those of pinned runs.

import { Expectations } from "./expect";
import { Host } from "./host";
import { scene } from "./store/file";
import { link, program } from "./store/line";
import { placed } from "./store/places";
import { edit, isAt } from "./store/text";
import { RESULTS, tab } from "./store/views";

export function Results() {
  const own = scene.value;
  return (
    <div class="results" hidden={tab.value !== RESULTS}>
      {own && (
        <Expectations
          key={`expectations ${own}`}
          link={link}
          scene={own}
          isAt={isAt}
          edit={edit}
          program={program.value}
        />
      )}
      <Host key="figures" kind="section" class="figures" label="figures" of={placed("tables")} />
      <Host key="compared" kind="section" class="compared" label="figures beside pinned runs" of={placed("compared")} />
    </div>
  );
}
