// The pane at the left: the numbers of the scene, or the properties of what is selected.

import { Properties } from "./properties";
import { Sliders } from "./sliders";
import { scene } from "./store/file";
import { link } from "./store/line";
import { editor, fields, spans } from "./store/text";
import { selection, side } from "./store/views";
import { Tabs } from "./tabs";

function Numbers() {
  return (
    editor.value && (
      <Sliders
        key={scene.value}
        editor={editor.value}
        link={link}
        scene={scene.value}
        fields={fields.value}
        spans={spans}
      />
    )
  );
}

export function Side() {
  const isNumbers = side.value === "numbers",
    ids = selection.value;
  return (
    <section class="pane-middle" aria-label="numbers and properties">
      <Tabs
        label="numbers and properties"
        chosen={side.value}
        choose={(name) => {
          side.value = name as typeof side.value;
        }}
        tabs={[
          { name: "numbers", words: "Numbers" },
          { name: "properties", words: `Properties${ids.length === 1 ? ` of ${ids[0]}` : ""}` },
        ]}
      />
      <div class="side" role="tabpanel" aria-label={side.value}>
        {isNumbers ? <Numbers /> : <Properties />}
      </div>
    </section>
  );
}
