// Starts the studio once its page stands: text, answers, keys, and the line to the server.

import { Board } from "../answer";
import { Editor } from "../editor";
import { printing } from "../print";
import { Frames } from "./frames";
import { hearKeys } from "./keyboard";
import { link, self } from "./line";
import { clear, tell } from "./notices";
import { listen } from "./opening";
import { places } from "./places";
import { board, show } from "./run";
import { editor, redraw } from "./text";
import { lookAtObject } from "./views";

export function start(): void {
  const own = new Editor(places.text, link, () => self.peek());
  const frames = new Frames(own, { text: redraw, answer: show }, () => link.send({ type: "shown" }));
  own.edited = () => clear("deed");
  own.refused = (words) => {
    tell(words);
    redraw();
  };
  own.changed = () => frames.changed();
  editor.value = own;
  const { tables, compared, charts, machine, dock } = places;
  board.value = new Board(
    { tables, compared, charts, machine },
    dock,
    (sight) => link.send({ type: "sight", charts: sight }),
    lookAtObject,
  );
  link.answer = (frame) => frames.answered(frame);
  printing(places.answers);
  // What only this window has.
  addEventListener("beforeunload", (event) => {
    if (!own.isSettled) event.preventDefault();
  });
  hearKeys();
  listen();
  link.connect();
}
