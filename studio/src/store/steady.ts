// Values that stay the same object while they say the same: what shows them is not drawn anew.

import { computed, type ReadonlySignal, type Signal } from "@preact/signals";

export function steady<T>(make: () => T): ReadonlySignal<T> {
  let words = "",
    kept: T;
  return computed(() => {
    const next = make(),
      now = JSON.stringify(next);
    if (now !== words) {
      words = now;
      kept = next;
    }
    return kept;
  });
}

// Sets a value unless it says the same as the one before.
export function renew<T>(known: Signal<T>, next: T): void {
  if (JSON.stringify(known.peek()) !== JSON.stringify(next)) known.value = next;
}
