// Keys that are pressed in a field belong to the field: no handler of keys around it acts on them.

const CONTROL = "input, textarea, select, [contenteditable]:not([contenteditable=false])";
const NO_TEXT = "select, [type=range], [type=checkbox], [type=radio]";

const controlOf = (target: EventTarget | null): Element | null =>
  target instanceof Element ? target.closest(CONTROL) : null;

// Whether it is in a field.
export const isInField = (target: EventTarget | null): boolean => controlOf(target) !== null;

// Whether it is in a field that text is typed into.
export function isInText(target: EventTarget | null): boolean {
  const control = controlOf(target);
  return control !== null && !control.matches(NO_TEXT);
}

// The field in which something was typed that it has not given away yet.
let unfinished: EventTarget | null = null;
const ended = ({ target }: Event): void => {
  if (target === unfinished) unfinished = null;
};
addEventListener(
  "input",
  ({ target }) => {
    if (isInText(target)) unfinished = target;
  },
  true,
);
for (const type of ["change", "focusout"]) addEventListener(type, ended, true);
addEventListener("keydown", (event) => {
  if (event.key === "Enter" || event.key === "Escape") ended(event);
});

export const isUnfinished = (target: EventTarget | null): boolean => target !== null && target === unfinished;

// What was typed in a field is taken, as when it is left.
export function take(target: EventTarget | null): void {
  if (!isUnfinished(target) || !(target instanceof HTMLElement)) return;
  target.blur();
  target.focus();
}
