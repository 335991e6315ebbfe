// The pane at the left: the numbers of the scene, or the properties of what is selected.

import { Properties } from "./properties";
import { Sliders } from "./sliders";
import { scene } from "./store/file";
import { link } from "./store/line";
import { editor, fields, spans } from "./store/text";
import { selection, side } from "./store/views";

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
  const tab = (name: typeof side.value, words: string) => (
    <button
      type="button"
      role="tab"
      aria-selected={side.value === name}
      onClick={() => {
        side.value = name;
      }}
    >
      {words}
    </button>
  );
  return (
    <div class="pane-middle">
      <div class="tabs" role="tablist" aria-label="numbers and properties">
        {tab("numbers", "Numbers")}
        {tab("properties", `Properties${ids.length === 1 ? ` of ${ids[0]}` : ""}`)}
      </div>
      <div class="side">{isNumbers ? <Numbers /> : <Properties />}</div>
    </div>
  );
}
