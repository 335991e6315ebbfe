// The counted journeys in the single file.

import { expect, test } from "@playwright/test";
import { begun, eachWatched } from "./drawn.mjs";
import { journeys } from "./journeys.mjs";
import { address, file, requested, WHY } from "./single.mjs";

test.skip(!file, WHY);
eachWatched();
let requests;
test.beforeEach(({ page }) => {
  requests = requested(page);
});
test.afterEach(() => expect(requests).toEqual([]));
journeys((page) => begun(page, {}, () => {}, address));
