// Generates one map aside, so that the page stays alive meanwhile.

import { generate } from "./generate.js";

export function work() {
  addEventListener("message", ({ data: { name, side, seed } }) => {
    const map = generate(name, side, seed);
    const arrays = map.costs ? [map.cells, map.costs] : [map.cells];
    postMessage(map, { transfer: arrays.map(({ buffer }) => buffer) });
  });
}
