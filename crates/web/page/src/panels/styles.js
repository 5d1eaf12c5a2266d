/// <reference path="../../css.d.ts" />
// The styles of what the scripts build. They travel with the scripts, compressed; the others are in the head.

import help from "../../style/help.css" with { type: "text" };
import land from "../../style/land.css" with { type: "text" };
import menus from "../../style/menus.css" with { type: "text" };
import notes from "../../style/notes.css" with { type: "text" };
import race from "../../style/race.css" with { type: "text" };
import rules from "../../style/rules.css" with { type: "text" };

export function addStyles() {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync([menus, rules, help, race, land, notes].join("\n"));
  document.adoptedStyleSheets = [sheet];
}
