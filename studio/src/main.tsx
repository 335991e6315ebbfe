// The studio: text, numbers and answers of one scene, side by side.

import { render } from "preact";
import { Studio } from "./studio";
import "./style.css";
import "./bench.css";
import "./first.css";
import "./tour.css";
import "./expect.css";
import "./popup.css";
import "./print.css";
import "./motion/motion.css";
import "./gallery/gallery.css";

render(<Studio />, document.getElementById("studio")!);
