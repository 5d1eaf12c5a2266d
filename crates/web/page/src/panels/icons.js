// The icons of the page: lines on a grid of 20 × 20.

import { h, s } from "./dom.js";

/** @type {Record<string, string>} */
const PATHS = {
  move:
    "M10 2.5v15M2.5 10h15M7.8 4.7 10 2.5l2.2 2.2M7.8 15.3l2.2 2.2 2.2-2.2M4.7 7.8 2.5 10l2.2 2.2" +
    "M15.3 7.8l2.2 2.2-2.2 2.2",
  draw: "M3.5 16.5l.8-3.6 9-9a1.9 1.9 0 0 1 2.8 2.8l-9 9zM11.8 5.4l2.8 2.8",
  erase:
    "M8 16.5 3.6 12.1a1.5 1.5 0 0 1 0-2.1l6.4-6.4a1.5 1.5 0 0 1 2.1 0l4.3 4.3a1.5 1.5 0 0 1 0" +
    " 2.1l-6.5 6.5zM6.6 7l6.4 6.4M8 16.5h8.5",
  fill:
    "M8.5 2.8l7 7-5.6 5.6a1.6 1.6 0 0 1-2.3 0L3 10.8a1.6 1.6 0 0 1 0-2.3l5.5-5.7zM2.8 9.8h12.7M16.8" +
    " 13.2c1 1.5 1.3 2.1 1.3 2.7a1.3 1.3 0 0 1-2.6 0c0-.6.3-1.2 1.3-2.7z",
  rectangle: "M3 5h14v10H3zM3 5h.01M17 15h.01",
  undo: "M7 4 3.5 7.5 7 11M3.5 7.5h8a4.5 4.5 0 0 1 0 9H8",
  redo: "M13 4l3.5 3.5L13 11M16.5 7.5h-8a4.5 4.5 0 0 0 0 9H12",
  plus: "M10 4v12M4 10h12",
  minus: "M4 10h12",
  fit: "M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4M7.5 7.5h5v5h-5z",
  map: "M2.5 5l5-2 5 2 5-2v12l-5 2-5-2-5 2zM7.5 3v12M12.5 5v12",
  open: "M2.5 15.5v-11h5l1.5 2h7v2.5M2.5 15.5 5 9h13l-2.5 6.5z",
  save: "M10 2.5v10M6 8.8l4 4 4-4M3 13v4h14v-4",
  share:
    "M8.3 11.7a3.2 3.2 0 0 0 4.5 0l3-3a3.2 3.2 0 0 0-4.5-4.5L10 5.5M11.7 8.3a3.2 3.2 0 0 0-4.5 0l-3" +
    " 3a3.2 3.2 0 0 0 4.5 4.5L10 14.5",
  "theme-system": "M2.5 3.5h15v10h-15zM7 17h6M10 13.5V17",
  "theme-light":
    "M10 6.5a3.5 3.5 0 1 1 0 7 3.5 3.5 0 0 1 0-7zM10 1.5v2M10 16.5v2M1.5 10h2M16.5 10h2M4 4l1.4" +
    " 1.400M14.6 14.6 16 16M4 16l1.4-1.400M14.6 5.4 16 4",
  "theme-dark": "M16.5 12A7 7 0 0 1 8 3.5a7 7 0 1 0 8.5 8.5z",
  help: "M7.3 7.5a2.7 2.7 0 1 1 4.2 2.2c-1 .7-1.5 1.2-1.5 2.3M10 15v.1M10 2a8 8 0 1 1 0 16 8 8 0 0 1 0-16z",
  play: "M6 3.5v13l10.5-6.5z",
  pause: "M6.5 4v12M13.5 4v12",
  back: "M14.5 4.5v11L7 10zM5 4.5v11",
  forward: "M5.5 4.5v11L13 10zM15 4.5v11",
  first: "M16 4.5v11L9.5 10zM9.5 4.5v11L3 10z",
  last: "M4 4.5v11l6.5-5.5zM10.5 4.5v11L17 10z",
  previous: "M12.5 4.5 7 10l5.5 5.500",
  next: "M7.5 4.5 13 10l-5.5 5.500",
  close: "M5 5l10 10M15 5 5 15",
  retry: "M16 10a6 6 0 1 1-1.8-4.3L16 7.5M16 3.5v4h-4",
  stop: "M5.5 5.5h9v9h-9z",
  walk:
    "M10.5 3a1.3 1.3 0 1 1 0 2.6 1.3 1.3 0 0 1 0-2.600zM10.3 7.5 8.5 12l3 2 .5 4M9 11l-2.5 6.5M10.3" +
    " 7.5 7 9v2.5M10.3 7.5l2 2.5 2.7.5",
  dice: "M4 4h12v12H4zM7 7h.01M13 13h.01M10 10h.01M7 13h.01M13 7h.01",
};

/** @param {string} name */
export function icon(name) {
  const path = s("path", { d: PATHS[name] ?? "" });
  return s("svg", { class: "icon", viewBox: "0 0 20 20", "aria-hidden": "true" }, path);
}

/**
 * A button with an icon. Its text is for those who do not see the icon; the title adds the key.
 * @param {string} name of the icon
 * @param {string} text
 * @param {() => void} run
 * @param {string} [key]
 */
export function iconButton(name, text, run, key) {
  const title = key ? `${text} (${key})` : text;
  return h(
    "button",
    { type: "button", class: "quiet", title, click: run },
    icon(name),
    h("span", { class: "sr-only" }, text),
  );
}

/** Sets the icon of a button. @param {Element} button @param {string} name */
export function setIcon(button, name) {
  button.querySelector(".icon")?.remove();
  button.prepend(icon(name));
}

/** Draws the icons of all elements with `data-icon`. @param {ParentNode} root */
export function drawIcons(root) {
  for (const element of root.querySelectorAll("[data-icon]")) {
    setIcon(element, element.getAttribute("data-icon") ?? "");
  }
}
