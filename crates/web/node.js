// The package in node, where files are read, not fetched: `init()` needs no argument there.
import { readFileSync } from "node:fs";
import init from "./mediant.js";

export * from "./mediant.js";

const neighbor = new URL("./mediant_bg.wasm", import.meta.url);
export default (input) => init(input ?? { module_or_path: readFileSync(neighbor) });
