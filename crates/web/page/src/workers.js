// Workers of the page. All run one script, which start.js has loaded; a name tells each what it is for.
//
// There are two packages of engines. Without a link the page begins with the light one, which finds the first
// path, and the whole one follows. With a link the page loads the whole one alone.

/**
 * A lane's queries; all other questions to the package; large generated maps.
 * @typedef {"lane" | "helper" | "maker"} Role
 */

/** A package. @typedef {"whole" | "light"} Kind */

/**
 * The scripts and engines that start.js has loaded.
 * @typedef {object} Loaded
 * @property {string} worker - The address of the workers' script.
 * @property {Kind} kind - The package of these engines.
 * @property {Promise<WebAssembly.Module>} engines
 * @property {(kind: Kind) => Promise<WebAssembly.Module>} compile - Loads a package anew.
 */

/** @type {Loaded} */
let loaded;
/** The packages, compiled once; each worker makes an instance of its own.
 *  @type {Map<Kind, Promise<WebAssembly.Module>>} */
const modules = new Map();
let isLight = false;
let [open, decide] = [() => {}, () => {}];
/** Fulfilled when the whole package may be loaded. @type {Promise<void>} */
const opened = new Promise((resolve) => (open = resolve));
/** Fulfilled when the whole package has come, or could not be had. @type {Promise<void>} */
export const decided = new Promise((resolve) => (decide = resolve));

/** Before anything else of this module. @param {Loaded} given */
export function provide(given) {
  loaded = given;
  isLight = given.kind === "light";
  keep(given.kind, given.engines);
}

/** @param {Role} role */
export function newWorker(role) {
  return new Worker(loaded.worker, { name: role });
}

/** Whether the light package stands in for the whole one. */
export const standsIn = () => isLight;

/** Loads the whole package, if it is not there. Before the first call nobody loads it: who asks waits. */
export function loadWhole() {
  open();
  compiled("whole").catch(() => {});
}

/** @param {Kind} kind */
export function compiled(kind) {
  const compile = () => loaded.compile(kind);
  return modules.get(kind) ?? keep(kind, kind === "light" ? compile() : opened.then(compile));
}

/** @param {Kind} kind @param {Promise<WebAssembly.Module>} engines */
function keep(kind, engines) {
  modules.set(kind, engines);
  // After a failure the next call tries again.
  engines.catch(() => modules.delete(kind));
  if (kind === "whole") engines.then(stepBack, stepBack);
  return engines;
}

/** The light package is of no more use; without the whole one the lanes say why. */
function stepBack() {
  isLight = false;
  open();
  decide();
}
