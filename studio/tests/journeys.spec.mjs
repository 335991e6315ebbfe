// The counted journeys with a server.

import { begun, eachWatched } from "./drawn.mjs";
import { journeys } from "./journeys.mjs";

eachWatched();
journeys(begun);
