// The messages of the page: sentences over the stage that can be dismissed.

import { h, part } from "./dom.js";
import { iconButton } from "./icons.js";

/** The time for which a notice stays. Errors stay until they are dismissed. */
const NOTICE_MS = 9000;

/** @type {Map<string, HTMLElement>} */
const shown = new Map();

/**
 * Says a sentence. A later message of the same `key` takes its place.
 * @param {string} text
 * @param {{ kind?: "notice" | "error", key?: string }} [how]
 */
export function say(text, { kind = "notice", key = text } = {}) {
  dismiss(key);
  const close = iconButton("close", "Dismiss", () => dismiss(key));
  const message = h(
    "div",
    { class: `message ${kind}`, role: kind === "error" ? "alert" : "status" },
    h("p", {}, text),
    close,
  );
  part("messages", HTMLElement).append(message);
  // There is less room for the page now: what is in use stays in sight.
  document.activeElement?.scrollIntoView({ block: "nearest" });
  shown.set(key, message);
  if (kind === "notice") expire(key, message);
}

/** Takes a message away. @param {string} key */
export function dismiss(key) {
  shown.get(key)?.remove();
  shown.delete(key);
}

/** @param {string} key @param {HTMLElement} message */
function expire(key, message) {
  setTimeout(() => {
    if (shown.get(key) !== message) return;
    if (message.matches(":hover, :focus-within")) expire(key, message);
    else dismiss(key);
  }, NOTICE_MS);
}

/** Whether the page moves by itself, and says nothing of it. */
let isHushed = false;
/** The sentence before the next one that is said. */
let preface = "";

/** Nothing more is said to those who do not see the page. */
export function hush() {
  isHushed = true;
  for (const output of document.querySelectorAll("output")) output.setAttribute("aria-live", "off");
}

/** Sentences are said again, the next one after this one. @param {string} first */
export function unhush(first) {
  isHushed = false;
  preface = first;
  for (const output of document.querySelectorAll("output")) output.removeAttribute("aria-live");
}

/** Says a sentence to those who do not see the page. Returns whether it was said. @param {string} text */
export function announce(text) {
  if (isHushed) return false;
  part("summary", HTMLElement).textContent = `${preface}${text}`;
  preface = "";
  return true;
}

/** Says at the head of the page why nothing can run. @param {string} text */
export function banner(text) {
  document.body.classList.add("cannot-run");
  const element = part("banner", HTMLElement);
  element.textContent = text;
  element.hidden = false;
}

/** The sentence of an error. @param {unknown} error */
export const sentence = (error) => (error instanceof Error ? error.message : String(error));
