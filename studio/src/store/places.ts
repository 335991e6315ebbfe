// Elements of the page whose content is made by others than the components: text, charts, tables.

type Place = "stage" | "answers" | "text" | "machine" | "dock" | "charts" | "tables" | "compared";

export const places = {} as Record<Place, HTMLElement>;

// For `ref` of an element, or for `of` of a `Host`.
export const placed =
  (name: Place) =>
  (element: HTMLElement | null): void => {
    if (element) places[name] = element;
  };
