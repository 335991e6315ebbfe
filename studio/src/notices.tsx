// What is to be known before one goes on: drafts, changes of the file, what was refused.

import type { Draft } from "./messages";
import { discardDraft, draft, request, restoreDraft, saveAs, status } from "./store/file";
import { notice, tell } from "./store/notices";

const DraftNotice = ({ time, other_base }: Draft) => (
  <p role="alert">
    <b>A draft of {new Date(1000 * time).toLocaleString()} holds changes that were not saved.</b>
    {other_base && " The file has been changed since."}
    <button type="button" onClick={restoreDraft}>
      Restore the draft
    </button>
    <button type="button" onClick={discardDraft}>
      Discard it
    </button>
  </p>
);

const ChangedNotice = () => (
  <p role="alert">
    <b>The file was changed by another program.</b>
    <button type="button" onClick={() => request({ type: "reload" })}>
      Reload it
    </button>
    <button type="button" onClick={() => request({ type: "keep_mine" })}>
      Keep mine
    </button>
    <button type="button" onClick={saveAs}>
      Save as…
    </button>
  </p>
);

export function Notices() {
  const own = draft.value,
    { disk } = status.value,
    said = notice.value;
  if (!own && disk === "same" && said === null) return null;
  return (
    <div class="notices">
      {own && <DraftNotice {...own} />}
      {disk === "changed" && <ChangedNotice />}
      {disk === "gone" && (
        <p role="alert">
          <b>The file is gone.</b> Save writes it anew.
        </p>
      )}
      {said && (
        <p role="alert">
          {said.words}{" "}
          <button type="button" onClick={() => tell("")}>
            Close
          </button>
        </p>
      )}
    </div>
  );
}
