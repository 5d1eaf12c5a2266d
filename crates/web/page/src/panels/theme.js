// Switches between the system's theme, light and dark.

import { part } from "./dom.js";
import { setIcon } from "./icons.js";

const THEMES = /** @type {const} */ (["system", "light", "dark"]);

export function startTheme() {
  const button = part("theme", HTMLButtonElement);
  button.addEventListener("click", () => {
    const next = (THEMES.indexOf(chosen()) + 1) % THEMES.length;
    choose(THEMES[next] ?? "system");
  });
  describe();
}

function chosen() {
  const theme = document.documentElement.dataset.theme;
  return theme === "light" || theme === "dark" ? theme : "system";
}

/** @param {"system" | "light" | "dark"} theme */
function choose(theme) {
  const root = document.documentElement;
  if (theme === "system") delete root.dataset.theme;
  else root.dataset.theme = theme;
  try {
    localStorage.setItem("theme", theme);
  } catch {
    // Without storage the theme lasts as long as the page.
  }
  describe();
}

function describe() {
  const button = part("theme", HTMLButtonElement);
  const theme = chosen();
  setIcon(button, `theme-${theme}`);
  const text = { system: "Theme: as the system", light: "Theme: light", dark: "Theme: dark" }[theme];
  button.title = text;
  const label = button.querySelector(".sr-only");
  if (label) label.textContent = text;
}
