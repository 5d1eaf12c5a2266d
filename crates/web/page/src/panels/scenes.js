// Opens scenes from links and files, one after the other.

import { apply } from "../model/link.js";

/** @typedef {import("../model/model.js").Model} Model */
/** @typedef {import("../model/scene.js").Scene} Scene */

/** @type {Promise<void>} */
let last = Promise.resolve();

/**
 * Makes the scene the model's, after those that were asked for before.
 * @param {Promise<Scene>} scene
 * @param {Model} model
 */
export function openScene(scene, model) {
  const opened = last.then(() => apply(scene, model));
  last = opened.catch(() => {});
  return opened;
}
