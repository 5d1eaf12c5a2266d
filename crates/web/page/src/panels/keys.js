// The keys of the page. Keys that an input, an open dialog or a pane of the stage takes are left to them.

import { TOOLS } from "./tools.js";

/** @typedef {import("./tools.js").ToolBar} ToolBar */

/**
 * @param {object} parts
 * @param {import("../../types").Model} parts.model
 * @param {import("../../types").Player} parts.player
 * @param {import("../../types").Stage} parts.stage
 * @param {ToolBar} parts.tools
 * @param {import("./setups.js").Setups} parts.setups
 * @param {import("./scenario.js").ScenarioBar} parts.scenario
 * @param {() => void} parts.help
 */
export function startKeys({ model, player, stage, tools, setups, scenario, help }) {
  /** @type {Record<string, () => void>} */
  const actions = {
    "[": () => setups.stepK(-1),
    "]": () => setups.stepK(1),
    p: () => player.toggle(),
    " ": () => player.toggle(),
    ",": () => player.step(-1),
    ".": () => player.step(1),
    0: () => stage.fit(),
    "+": () => stage.zoom(1.25),
    "=": () => stage.zoom(1.25),
    "-": () => stage.zoom(0.8),
    n: () => scenario.step(1),
    b: () => scenario.step(-1),
    l: () => tools.nextBrush(),
    "?": help,
  };
  for (const { tool, key } of TOOLS) actions[key] = () => tools.choose(tool);
  addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.isComposing || document.querySelector("dialog[open]")) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (isTyping(event.target)) return;
    if ((event.ctrlKey || event.metaKey) && !event.altKey) return historyKey(event, key, model);
    if (event.ctrlKey || event.metaKey || event.altKey || isTaken(event.target, key)) return;
    const action = actions[key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

/** @param {KeyboardEvent} event @param {string} key @param {import("../../types").Model} model */
function historyKey(event, key, model) {
  const redo = key === "y" || (key === "z" && event.shiftKey);
  if (key !== "z" && !redo) return;
  event.preventDefault();
  if (redo) model.redo();
  else model.undo();
}

/** @param {EventTarget | null} target */
function isTyping(target) {
  if (!(target instanceof HTMLElement)) return false;
  const texts = "textarea, select, input:not([type=range], [type=radio], [type=checkbox])";
  return target.isContentEditable || target.matches(texts);
}

/** Whether the element at the focus does something with the key.
 *  @param {EventTarget | null} target @param {string} key */
function isTaken(target, key) {
  if (!(target instanceof HTMLElement) || key !== " ") return false;
  return target.matches("button, summary, a, input, [role=tab]") || target.closest(".stage") !== null;
}
