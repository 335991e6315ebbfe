// The dynamic model and the equations of the scene, as the program writes them.
//
// They are requested when they are in view (`src/studio/questions.rs`): levels and errors of a
// judged run, the tables of `dam show`, a picture (`report/svg/masses.rs`), and the formulas
// as MathML.

import { useEffect, useRef, useState } from "preact/hooks";
import { Host } from "./host";
import type { Link } from "./link";

interface Props {
  link: Link;
  scene: string;
  version: number;
  kind: "model" | "equations";
  choose: (id: string) => void;
}

// Wide equations scroll by the keyboard, and a mass is called by what stands on it.
function reachable(place: HTMLElement): void {
  for (const one of place.querySelectorAll<HTMLElement>(".equation")) {
    one.tabIndex = 0;
    one.setAttribute("role", "group");
    one.setAttribute("aria-label", "equation");
  }
  for (const one of place.querySelectorAll<SVGElement>("[data-mass]")) {
    const shown = [...one.querySelectorAll("text")].map((text) => text.textContent).join(" ");
    one.setAttribute("aria-label", `${shown}: ${one.getAttribute("aria-label")}`);
  }
}

export function Models({ link, scene, version, kind, choose }: Props) {
  const place = useRef<HTMLElement>(null!),
    asking = useRef(false),
    wanted = useRef(version),
    shown = useRef(-1);
  const [told, setTold] = useState("");
  wanted.current = version;
  useEffect(() => {
    let gone = false;
    // One question at a time; what is newer by then is asked next.
    const ask = async () => {
      if (!scene || asking.current || shown.current === wanted.current) return;
      asking.current = true;
      const asked = wanted.current;
      try {
        const found = await link.get<Record<Props["kind"], string> | null>(
          `/api/model?scene=${encodeURIComponent(scene)}`,
        );
        if (gone) return;
        if (found) {
          place.current.innerHTML = found[kind];
          reachable(place.current);
        }
        setTold(
          found
            ? ""
            : place.current.childElementCount
              ? "Stale: the scene has faults; this is the last good one."
              : "The scene has faults: they are told below and at the objects.",
        );
      } catch {
        if (!gone) setTold("The program does not answer.");
      }
      shown.current = asked;
      asking.current = false;
      if (!gone && shown.current !== wanted.current) void ask();
    };
    void ask();
    return () => {
      gone = true;
      asking.current = false;
    };
  }, [version, scene, kind]);

  // What belongs to an object lights up together.
  const lit = (event: Event) => {
    const at = event.target as Element,
      id = at.closest<HTMLElement>("[data-of]")?.dataset.of ?? at.closest<HTMLElement>("[data-object]")?.dataset.object;
    for (const node of place.current.querySelectorAll<HTMLElement>("[data-of], [data-object]")) {
      const own = node.dataset.of ?? node.dataset.object;
      node.classList.toggle("lit", id !== undefined && own === id);
    }
  };
  const go = (event: Event) => {
    const id = (event.target as Element).closest<HTMLElement>("[data-mass]")?.dataset.object;
    if (id) choose(id);
  };
  return (
    <div
      class={`models ${kind}`}
      tabindex={0}
      role="region"
      aria-label={kind === "model" ? "dynamic model" : "equations"}
      onPointerOver={lit}
      onPointerLeave={() => {
        for (const node of place.current.querySelectorAll(".lit")) node.classList.remove("lit");
      }}
      onClick={go}
      onKeyDown={(event) => {
        if (event.key === "Enter" || event.key === " ") go(event);
      }}
    >
      {told && (
        <p key="told" class="soft" role="status">
          {told}
        </p>
      )}
      <Host
        key="place"
        class="models-place"
        of={(element) => {
          place.current = element;
        }}
      />
    </div>
  );
}
