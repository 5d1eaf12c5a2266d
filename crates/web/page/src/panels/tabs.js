// On narrow screens the panels are tabs. On wide ones all panels are shown, and the tabs are not.

import { h, part } from "./dom.js";

const TABS = /** @type {const} */ ([
  ["engine", "Engine"],
  ["race", "Race"],
  ["show", "Show"],
]);
const NARROW = matchMedia("(max-width: 699px)");

export function startTabs() {
  const list = part("tabs", HTMLElement);
  const tabs = TABS.map(([id, name]) => {
    const about = { role: "tab", id: `tab-${id}`, "aria-controls": id };
    return h("button", { type: "button", ...about, click: () => choose(id) }, name);
  });
  list.append(...tabs);
  list.addEventListener("keydown", (event) => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    const at = tabs.indexOf(/** @type {HTMLButtonElement} */ (document.activeElement));
    if (by === undefined || at < 0) return;
    event.preventDefault();
    const next = (at + by + TABS.length) % TABS.length;
    choose(TABS[next]?.[0] ?? "engine");
    tabs[next]?.focus();
  });
  NARROW.addEventListener("change", () => choose(chosen));
  choose("engine");
}

let chosen = "engine";

/** @param {string} id */
function choose(id) {
  chosen = id;
  for (const [key] of TABS) {
    const panel = part(key, HTMLElement);
    const tab = part(`tab-${key}`, HTMLElement);
    tab.setAttribute("aria-selected", String(key === id));
    tab.tabIndex = key === id ? 0 : -1;
    panel.classList.toggle("off", key !== id);
    if (NARROW.matches) panel.setAttribute("role", "tabpanel");
    else panel.removeAttribute("role");
  }
}
