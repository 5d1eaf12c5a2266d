// A choice of one of a few, side by side, each with a small drawing if it has one.

import { h } from "./dom.js";
import { noteOf } from "./notes.js";

/**
 * @typedef {object} Option
 * @property {string} value
 * @property {string} label
 * @property {SVGElement} [figure]
 */

let groups = 0;

export class Choice {
  /** @type {HTMLFieldSetElement} */
  element;
  /** @type {Map<string, HTMLInputElement>} */
  #inputs = new Map();
  /** The line that says why some options cannot be chosen. The panel places it. */
  reason = h("p", { class: "reason muted", hidden: true });

  /**
   * @param {string} legend
   * @param {Option[]} options
   * @param {(value: string) => void} chosen
   * @param {string} note
   */
  constructor(legend, options, chosen, note) {
    const name = `choice-${++groups}`;
    const labels = options.map(({ value, label, figure }) => {
      const input = h("input", { type: "radio", name, value, class: "sr-only", change: () => chosen(value) });
      this.#inputs.set(value, input);
      return h("label", { class: "choice" }, input, ...(figure ? [figure] : []), h("span", {}, label));
    });
    this.element = h(
      "fieldset",
      { class: "choices" },
      h("legend", {}, legend),
      ...noteOf(note),
      h("div", { class: "choice-row" }, ...labels),
    );
  }

  /** @param {string} value */
  set value(value) {
    for (const [key, input] of this.#inputs) input.checked = key === value;
  }

  /** Disables the options that have a reason, and says the reasons. @param {Map<string, string>} reasons */
  refuse(reasons) {
    for (const [key, input] of this.#inputs) {
      const reason = reasons.get(key) ?? "";
      input.disabled = reason !== "";
      if (input.parentElement) input.parentElement.title = reason;
    }
    // One reason is enough: the others say the same of another option. Each option has its own as a title.
    const text = [...reasons.values()].find(Boolean) ?? "";
    this.reason.textContent = text;
    this.reason.hidden = text === "";
  }
}
