// The page of the run, and the scene, as files.

import { useState } from "preact/hooks";
import { save } from "./export";
import type { Link } from "./link";

export function Exports({
  link,
  scene,
  stale,
  tell,
}: {
  link: Link;
  scene: string;
  stale: boolean;
  tell: (words: string) => void;
}) {
  const [busy, setBusy] = useState(false);
  const named = scene.split("/").pop() ?? "scene.json";
  const fetched = async (name: string, query: Record<string, string>, path: string) => {
    setBusy(true);
    try {
      save(name, await link.text(`${path}?${new URLSearchParams({ scene, ...query })}`));
    } catch (error) {
      tell(`${name}: ${(error as Error).message}`);
    }
    setBusy(false);
  };
  const run = { question: JSON.stringify({ command: "run" }) };
  return (
    <span class="exports" role="group" aria-label="export" aria-busy={busy}>
      <button
        type="button"
        aria-label="Export report"
        disabled={!scene || busy || stale}
        title="the report of this run with all charts, as a file"
        onClick={() => void fetched(named.replace(/\.json$/, ".html"), { ...run, name: "report.html" }, "/api/file")}
      >
        ⤓ report
      </button>
      <button
        type="button"
        aria-label="Export record"
        disabled={!scene || busy || stale}
        title="the record of this run, as CSV"
        onClick={() => void fetched(named.replace(/\.json$/, ".csv"), { ...run, name: "record.csv" }, "/api/file")}
      >
        ⤓ record
      </button>
      <button
        type="button"
        aria-label="Export scene"
        disabled={!scene || busy}
        title="the scene as it is edited, as a file"
        onClick={() => void fetched(named, {}, "/api/text")}
      >
        ⤓ scene
      </button>
    </span>
  );
}
