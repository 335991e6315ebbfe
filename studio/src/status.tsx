// The line at the foot of the workbench: the verdict, what is remarked, what is expected.

import { answer, staleness } from "./store/run";
import { RESULTS, tab } from "./store/views";
import { said } from "./units";
import "./status.css";

export function StatusLine() {
  const stale = staleness.value,
    known = answer.value;
  const { verdict, warnings = [], expect = [] } = known ?? {},
    met = expect.filter((one) => one.holds).length;
  return (
    <section class="status-line" aria-label="verdict">
      {stale && (
        <p class="stale-mark" role="status">
          {stale}
        </p>
      )}
      {known && verdict && (
        <p class={`verdict ${verdict.sort}`} title={said(verdict.text)}>
          {known.coarse && <span class="sort">First look, the model is still being judged</span>}{" "}
          <b>{said(verdict.headline)}</b> <span class="sentence">{said(verdict.text)}</span>
        </p>
      )}
      {warnings.length > 0 && (
        <details class="remarks">
          <summary>{warnings.length === 1 ? "1 remark" : `${warnings.length} remarks`}</summary>
          <ul class="warnings">
            {warnings.map((one) => (
              <li>{said(one)}</li>
            ))}
          </ul>
        </details>
      )}
      {expect.length > 0 && (
        <button
          type="button"
          class={met < expect.length ? "failed" : "met"}
          onClick={() => {
            tab.value = RESULTS;
          }}
          title="what the scene expects of this run: see Results"
        >
          {met < expect.length ? "✗" : "✓"} {met} of {expect.length} met
        </button>
      )}
    </section>
  );
}
