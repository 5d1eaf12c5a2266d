// Workers of the page. All run one script, which start.js has loaded; a name tells each what it is for.

/**
 * A lane's queries; all other questions to the package; large generated maps.
 * @typedef {"lane" | "helper" | "maker"} Role
 */

/**
 * The scripts and engines that start.js has loaded.
 * @typedef {object} Loaded
 * @property {string} worker - The address of the workers' script.
 * @property {Promise<WebAssembly.Module>} engines
 * @property {() => Promise<WebAssembly.Module>} compile - Loads the engines anew.
 */

/** @type {Loaded} */
let loaded;
/** @type {Promise<WebAssembly.Module> | undefined} */
let module;

/** Before anything else of this module. @param {Loaded} given */
export function provide(given) {
  loaded = given;
  keep(given.engines);
}

/** @param {Role} role */
export function newWorker(role) {
  return new Worker(loaded.worker, { name: role });
}

/** The package, compiled once; each worker makes an instance of its own. */
export function compiled() {
  return module ?? keep(loaded.compile());
}

/** @param {Promise<WebAssembly.Module>} engines */
function keep(engines) {
  module = engines;
  // After a failure the next call tries again.
  engines.catch(() => (module = undefined));
  return engines;
}
