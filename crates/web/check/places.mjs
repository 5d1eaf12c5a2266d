// The paths of the project's folders, and of the browser.

import { accessSync, constants } from "node:fs";
import { delimiter, join } from "node:path";
import { fileURLToPath } from "node:url";

export { PAGE } from "../serve.mjs";

/** @param {string} path from this folder */
const here = (path) => fileURLToPath(new URL(path, import.meta.url));

export const HERE = here(".");
export const ROOT = here("../../../");
export const SOURCES = here("../page");
export const WEB = here("../../../target/web");
export const PACKAGE = here("../../../target/web/package");
export const SCREENSHOTS = here("../../../target/web/screenshots");

/** @param {string} path */
function isProgram(path) {
  try {
    accessSync(path, constants.X_OK);
    return true;
  } catch {
    return false;
  }
}

/** The browser: that of the variable CHROMIUM, or the first on the path. */
export function chromium() {
  const { CHROMIUM, PATH = "" } = process.env;
  const names = ["chromium", "chromium-browser", "google-chrome-stable", "google-chrome"];
  const found = PATH.split(delimiter).flatMap((folder) => names.map((name) => join(folder, name)));
  return (CHROMIUM ? [CHROMIUM] : found).find(isProgram);
}
