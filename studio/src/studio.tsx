// The page: the bar, notices, the workbench, and the first page and the tour above them.

import { useEffect } from "preact/hooks";
import { First } from "./first";
import { Header } from "./header";
import { Notices } from "./notices";
import { folder, isSaved, request, scene } from "./store/file";
import { link } from "./store/line";
import { placed } from "./store/places";
import { start } from "./store/start";
import { bring, enterScene, isHome, isTouring, seen } from "./store/views";
import { Tour } from "./tour";
import { Workbench } from "./workbench";

function FirstPage() {
  // Once the tour ends it has been seen.
  void isTouring.value;
  return (
    <First
      link={link}
      folder={folder.value}
      scene={scene.value}
      saved={isSaved.value}
      toured={seen.get() !== null}
      back={enterScene}
      tour={() => {
        isTouring.value = true;
      }}
      open={(wanted) => request({ type: "open", scene: wanted })}
      make={(name, from) => request({ type: "new", scene: name, from })}
    />
  );
}

const TourOfPage = () => (
  <Tour
    link={link}
    scene={scene.value}
    home={isHome.value}
    show={bring}
    end={() => {
      isTouring.value = false;
    }}
  />
);

const Stage = () => (
  <main class={isHome.value ? "stage home" : "stage"} tabIndex={-1} ref={placed("stage")}>
    <Workbench />
    {isHome.value && <FirstPage />}
  </main>
);

export function Studio() {
  useEffect(start, []);
  return (
    <div class="studio">
      <Header />
      <Notices />
      <Stage />
      {isTouring.value && <TourOfPage />}
    </div>
  );
}
