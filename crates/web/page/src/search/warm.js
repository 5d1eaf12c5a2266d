// Loads the engines and starts the first worker ahead of all else of the page, so that the first path is
// there as soon as the map is. To be loaded as a module of its own, `async`, before main.js.

import { warm } from "./engine.js";

warm();
