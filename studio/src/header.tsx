// The bar at the top: the scene that is open, what is done with its file, and what is chosen for all.

import { Besides } from "./connection";
import { Exports } from "./exports";
import { History } from "./history";
import { createScene, folder, isSaved, request, saveAs, scene, scenes, status } from "./store/file";
import { isConnected, link } from "./store/line";
import { tell } from "./store/notices";
import { places } from "./store/places";
import { isStale } from "./store/run";
import { goHome, isHome, isTouring } from "./store/views";
import { UnitsMenu } from "./units-menu";

function SceneChoice() {
  const own = scene.value,
    all = scenes.value;
  return (
    <label>
      <span class="soft">{folder}/</span>{" "}
      <select
        aria-label="scene"
        value={own}
        onChange={(event) => {
          const select = event.currentTarget;
          if (!request({ type: "open", scene: select.value })) select.value = own;
        }}
      >
        {all.concat(own && !all.includes(own) ? [own] : []).map((one) => (
          <option key={one} value={one}>
            {one}
          </option>
        ))}
      </select>
    </label>
  );
}

// Saves, undoes and passes on the scene that is open.
function SceneTools() {
  const { undo, redo } = status.value;
  return (
    <>
      <SceneChoice />
      <span class={isSaved.value ? "soft" : "unsaved"} role="status">
        {isSaved.value ? "saved" : "not saved"}
      </span>
      <button
        type="button"
        class="save"
        onClick={() => request({ type: "save" })}
        disabled={isSaved.value}
        title="Ctrl-S"
      >
        Save
      </button>
      <button type="button" onClick={saveAs}>
        Save as…
      </button>
      <button type="button" class="undo" onClick={() => request({ type: "undo" })} disabled={!undo} title="Ctrl-Z">
        Undo
      </button>
      <button type="button" onClick={() => request({ type: "redo" })} disabled={!redo} title="Ctrl-Y">
        Redo
      </button>
      <History />
      <Exports link={link} scene={scene.value} stale={isStale.value} tell={tell} />
    </>
  );
}

// Nothing answers this window.
const Lost = () => (
  <span class="lost" role="alert">
    {link.known
      ? `The server is gone. This window keeps its edits and sends them when the studio runs on port ${location.port} again.`
      : "This window was not opened by dam studio: start the studio, which opens a window of its own."}
  </span>
);

// For the keyboard: past the bar.
const Skip = () => (
  <button type="button" class="skip" onClick={() => places.stage.focus()}>
    Skip the bar
  </button>
);

export function Header() {
  return (
    <header class="top">
      <Skip />
      <strong>dam studio</strong>
      <button type="button" aria-pressed={isHome.value} onClick={goHome}>
        Home
      </button>
      {!isHome.value && <SceneTools />}
      <Besides scene={isHome.value ? "" : scene.value} link={link} tell={tell} />
      <button type="button" onClick={createScene}>
        New…
      </button>
      <button
        type="button"
        onClick={() => {
          isTouring.value = true;
        }}
      >
        Tour
      </button>
      <UnitsMenu />
      {!isConnected.value && <Lost />}
    </header>
  );
}
