// What is done to the page before it is printed, and taken back after.

export function printing(answers: Element): void {
  let opened: HTMLDetailsElement[] = [];
  addEventListener("beforeprint", () => {
    // What is folded is printed too.
    opened = [...answers.querySelectorAll<HTMLDetailsElement>("details:not([open])")];
    for (const one of opened) one.open = true;
  });
  addEventListener("afterprint", () => {
    for (const one of opened) one.open = false;
  });
}
