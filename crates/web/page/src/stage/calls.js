// Short calls at the ends, for those who do not know yet that these can be dragged.

import { element } from "./caption.js";
import { BADGE } from "./paint-path.js";

/** @import { Model } from "../../types.js" */
/** @typedef {import("./pane.js").Pane} Pane */

/** The free space between a call and its badge, and at the least at the edges of the pane, in pixels. */
const [AWAY, EDGE] = [7, 2];

export class Calls {
  #list;

  /** @param {Element} surface */
  constructor(surface) {
    this.#list = [0, 1].map(() => {
      const call = element("span", "call", surface);
      call.setAttribute("aria-hidden", "true");
      call.textContent = "drag me";
      return call;
    });
  }

  /** Puts each above or below its end, away from the middle of the pane.
   *  @param {Pane} pane @param {Model} model */
  place(pane, { start, goal }) {
    [start, goal].forEach(([x, y], at) => {
      const call = this.#list[at];
      const spot = pane.spotOf(x + pane.shift, y + pane.shift);
      const [width, height] = [call.offsetWidth, call.offsetHeight];
      const away = BADGE + AWAY;
      const top = spot.y < pane.height / 2 ? spot.y - away - height : spot.y + away;
      const left = within(spot.x - width / 2, pane.width - width);
      call.style.translate = `${left}px ${within(top, pane.height - height)}px`;
    });
  }

  remove() {
    for (const call of this.#list) call.remove();
    return undefined;
  }
}

/** @param {number} at @param {number} room */
const within = (at, room) => Math.round(Math.max(EDGE, Math.min(room - EDGE, at)));
