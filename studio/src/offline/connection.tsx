// Who answers this interface: the program in this tab.

import { render } from "preact";
import { useRef } from "preact/hooks";
import type { Link } from "../link";
import { lack, packedScene } from "./kernel";
import { Tab } from "./link";

let tab: Tab;

export function connection(): Link {
  const missing = lack();
  if (missing) {
    render(
      <p class="lost" role="alert">
        This browser has no {missing}: a newer one shows the studio.
      </p>,
      document.getElementById("studio")!,
    );
    throw new Error(`no ${missing}`);
  }
  return (tab = new Tab());
}

// Addresses longer than this are cut by some programs that pass them on.
const LONGEST = 30_000;

// Scenes from files and to others.
export function Besides({ scene, link, tell }: { scene: string; link: Link; tell: (words: string) => void }) {
  const chosen = useRef<HTMLInputElement>(null);
  const read = async (files: FileList | null) => {
    for (const file of files ?? []) {
      if (file.size > 1 << 20) {
        tell(`${file.name} is larger than 1 MB.`);
        return;
      }
      link.send({ type: "open", scene: tab.add(file.name, await file.text()) });
    }
    chosen.current!.value = "";
  };
  const share = async () => {
    const letters = await packedScene(await link.text(`/api/text?${new URLSearchParams({ scene })}`));
    const address = `${location.href.replace(/#.*/, "")}#scene=${letters}`;
    if (address.length > LONGEST) {
      tell("This scene is too large for an address: send it as a file.");
      return;
    }
    try {
      await navigator.clipboard.writeText(address);
      tell("The address with the scene in it is copied.");
    } catch {
      prompt("The address with the scene in it", address);
    }
  };
  return (
    <>
      <input
        ref={chosen}
        type="file"
        accept=".json,application/json"
        aria-label="scene from a file"
        hidden
        onChange={(event) => void read(event.currentTarget.files)}
      />
      <button type="button" onClick={() => chosen.current!.click()}>
        Open file…
      </button>
      {scene && (
        <button type="button" onClick={() => void share()} title="copies an address that holds this scene">
          Share
        </button>
      )}
    </>
  );
}
