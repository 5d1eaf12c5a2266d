// The pointer on the panes: mouse, pen and fingers. It decides which gesture begins, and zooms.

import { boxing, brushAt, cellAt, dragging, fill, inMap, panning, stroking } from "./gestures.js";

/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("./pane.js").Pane} Pane */
/** @typedef {import("./gestures.js").Gesture} Gesture */
/** @typedef {import("./gestures.js").Spot} Spot */

/** The distance from the center of an end within which a press takes it, in pixels of the page. */
const REACH = { mouse: 14, pen: 16, touch: 24 };
/** A finger that has not moved so far may still become one of two that zoom. */
const SLACK = 6;
const HOLD = 140;

export class PointerTools {
  /** @type {Gesture | null} */
  #gesture = null;
  /** The gesture of a finger if no other finger follows. @type {(() => Gesture) | null} */
  #waiting = null;
  #timer = 0;
  /** The fingers, or the mouse button. @type {Map<number, Spot>} */
  #down = new Map();
  /** @type {Pane | null} */
  #pane = null;
  /** Whether the space bar makes every drag move the map. */
  isSpaceDown = false;

  /** @param {Stage} stage */
  constructor(stage) {
    this.stage = stage;
    // Before the panes, which draw with the space bar if it does not move the map.
    addEventListener("keydown", (event) => this.#space(event, true), true);
    addEventListener("keyup", (event) => this.#space(event, false));
    addEventListener("blur", () => this.#hold(false));
  }

  /** Whether a drag is under way. */
  get isBusy() {
    return this.#gesture !== null || this.#waiting !== null;
  }

  /** @param {Pane} pane */
  listen(pane) {
    const { surface } = pane;
    surface.addEventListener("pointerdown", (event) => this.#press(pane, event));
    surface.addEventListener("pointermove", (event) => {
      const from = performance.now();
      this.#move(pane, event);
      this.stage.record.worked(from);
    });
    surface.addEventListener("pointerup", (event) => this.#release(event, false));
    surface.addEventListener("pointercancel", (event) => this.#release(event, true));
    surface.addEventListener("pointerleave", () => this.#hover(pane, null));
    surface.addEventListener("contextmenu", (event) => event.preventDefault());
    surface.addEventListener("dblclick", (event) => this.#doubleClick(pane, event));
    surface.addEventListener("wheel", (event) => this.#wheel(pane, event), { passive: false });
  }

  /** Leaves the gesture that is under way. Returns whether there was one. */
  cancel() {
    const wasBusy = this.isBusy;
    clearTimeout(this.#timer);
    this.#waiting = null;
    const gesture = this.#gesture;
    this.#gesture = null;
    gesture?.cancel();
    return wasBusy;
  }

  /** @param {Pane} pane @param {PointerEvent} event */
  #press(pane, event) {
    if (event.pointerType !== "touch" && this.#down.size > 0) return;
    if (event.button > 2) return;
    this.stage.cursor.isShown = false;
    if (this.#pane !== pane && this.#down.size > 0) return;
    this.#pane = pane;
    pane.surface.setPointerCapture(event.pointerId);
    const spot = spotOf(pane, event);
    this.#down.set(event.pointerId, spot);
    if (this.#down.size === 2) {
      this.#finish();
      this.#gesture = panning(this.stage, spot);
      return;
    }
    if (this.#down.size > 2) return;
    const begin = this.#choose(pane, event, spot);
    if (event.pointerType !== "touch") {
      this.#gesture = begin();
      return;
    }
    this.#waiting = begin;
    this.#timer = window.setTimeout(() => this.#start(), HOLD);
  }

  /** The gesture that a press here begins. @param {Pane} pane @param {PointerEvent} event @param {Spot} spot
   *  @returns {() => Gesture} */
  #choose(pane, event, spot) {
    const { stage } = this;
    const { tool } = stage;
    if (event.button === 1 || this.isSpaceDown) return () => panning(stage, spot);
    const end = event.button === 0 ? this.#endAt(pane, spot, event.pointerType) : "";
    if (end) return () => dragging(pane, end, spot);
    if (tool === "move") return () => panning(stage, spot);
    const isErasing = (tool === "erase") !== (event.shiftKey || event.button === 2);
    if (tool === "rectangle") return () => boxing(pane, isErasing, spot);
    if (tool !== "fill") return () => stroking(pane, isErasing, spot);
    return () => {
      fill(stage.model, cellAt(pane, spot), stage.brush);
      const nothing = () => {};
      return { move: nothing, end: nothing, cancel: nothing };
    };
  }

  #start() {
    clearTimeout(this.#timer);
    const begin = this.#waiting;
    this.#waiting = null;
    if (begin) this.#gesture = begin();
  }

  #finish() {
    clearTimeout(this.#timer);
    this.#waiting = null;
    const gesture = this.#gesture;
    this.#gesture = null;
    gesture?.end();
  }

  /** @param {Pane} pane @param {PointerEvent} event */
  #move(pane, event) {
    const spot = spotOf(pane, event);
    const old = this.#down.get(event.pointerId);
    if (!old) return this.#hover(pane, event);
    if (this.#waiting) {
      if (Math.hypot(spot.x - old.x, spot.y - old.y) < SLACK) return undefined;
      this.#start();
    }
    if (this.#down.size >= 2) return this.#pinch(event.pointerId, old, spot);
    this.#down.set(event.pointerId, spot);
    const all = event.getCoalescedEvents?.() ?? [];
    const spots = all.length > 0 ? all.map((one) => spotOf(pane, one)) : [spot];
    this.#gesture?.move(spots);
    if (this.stage.tool === "draw" || this.stage.tool === "erase") this.#hover(pane, event);
    return undefined;
  }

  /** Two fingers: what is under them stays under them. @param {number} id @param {Spot} old @param {Spot}
   *  spot */
  #pinch(id, old, spot) {
    const pane = this.#pane;
    const other = [...this.#down].find(([key]) => key !== id)?.[1];
    this.#down.set(id, spot);
    if (!pane || !other) return;
    const { view } = this.stage;
    const away = (/** @type {Spot} */ a) => Math.max(20, Math.hypot(a.x - other.x, a.y - other.y));
    view.pan((spot.x - old.x) / 2, (spot.y - old.y) / 2);
    const [x, y] = [(spot.x + other.x - pane.width) / 2, (spot.y + other.y - pane.height) / 2];
    view.zoom(away(spot) / away(old), x, y);
    this.stage.moved();
  }

  /** @param {PointerEvent} event @param {boolean} isCancelled */
  #release(event, isCancelled) {
    if (!this.#down.delete(event.pointerId)) return;
    if (isCancelled) this.cancel();
    if (this.#waiting) this.#start();
    if (this.#down.size === 0) this.#finish();
    // The finger that is left moves nothing: it would be by chance.
    else this.#gesture = null;
    if (this.#down.size === 0) this.stage.root.classList.remove("is-panning");
    if (event.pointerType === "touch" && this.#pane) this.#hover(this.#pane, null);
  }

  /** Shows what a press here would take or draw. @param {Pane} pane @param {PointerEvent | null} event */
  #hover(pane, event) {
    const { stage } = this;
    if (this.#gesture && event && this.#down.size === 0) return;
    const spot = event && spotOf(pane, event);
    const near = spot && this.#down.size === 0 ? this.#endAt(pane, spot, event.pointerType) : "";
    const isDrawing = stage.tool !== "move" && stage.tool !== "rectangle";
    const before = JSON.stringify([stage.near, stage.preview?.rect]);
    stage.near = near;
    pane.surface.classList.toggle("is-near", near !== "");
    if (stage.preview?.isShared) return;
    stage.preview = null;
    if (spot && isDrawing && !near && !stage.held && !this.isSpaceDown && event.pointerType !== "touch") {
      const [x, y] = cellAt(pane, spot);
      const brush = stage.tool === "fill" ? { x, y, width: 1, height: 1 } : brushAt(pane, spot);
      const rect = inMap(stage.model, brush);
      const isErasing = (stage.tool === "erase") !== event.shiftKey;
      if (rect.width > 0 && rect.height > 0) stage.preview = { rect, pane, isErasing, isShared: false };
    }
    if (JSON.stringify([near, stage.preview?.rect]) !== before) stage.soil("top");
  }

  /** @param {Pane} pane @param {Spot} spot @param {string} pointer @returns {"start" | "goal" | ""} */
  #endAt(pane, spot, pointer) {
    const { start, goal } = this.stage.model;
    const away = (/** @type {readonly [number, number]} */ [x, y]) => {
      const at = pane.spotOf(x + pane.shift, y + pane.shift);
      return Math.hypot(at.x - spot.x, at.y - spot.y);
    };
    const [toStart, toGoal] = [away(start), away(goal)];
    const reach = REACH[/** @type {keyof typeof REACH} */ (pointer)] ?? REACH.mouse;
    if (Math.min(toStart, toGoal) > reach) return "";
    // The goal lies on top.
    return toGoal <= toStart ? "goal" : "start";
  }

  /** @param {Pane} pane @param {MouseEvent} event */
  #doubleClick(pane, event) {
    const { stage } = this;
    if (stage.tool === "move" && !this.#endAt(pane, spotOf(pane, event), "mouse")) stage.fit();
  }

  /** @param {Pane} pane @param {WheelEvent} event */
  #wheel(pane, event) {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 24 : event.deltaMode === 2 ? 400 : 1;
    const spot = spotOf(pane, event);
    // A pinch on a touchpad comes as a wheel with Ctrl, in small steps.
    const delta = Math.max(-300, Math.min(300, event.deltaY * lines)) * (event.ctrlKey ? 5 : 1);
    this.stage.view.zoom(Math.exp(-delta * 0.0016), spot.x - pane.width / 2, spot.y - pane.height / 2);
    this.stage.moved();
  }

  /** @param {KeyboardEvent} event @param {boolean} isDown */
  #space(event, isDown) {
    if (event.key !== " ") return;
    const isOver = this.stage.panes.some(({ surface }) => surface.matches(":hover"));
    const target = event.target instanceof Element ? event.target : null;
    const isFree = !target || target === document.body || target.classList.contains("stage-surface");
    this.#hold(isDown && isOver && isFree && !this.stage.cursor.isShown);
  }

  /** @param {boolean} isDown */
  #hold(isDown) {
    if (isDown === this.isSpaceDown) return;
    this.isSpaceDown = isDown;
    this.stage.root.classList.toggle("is-pan-ready", isDown);
  }
}

/** @param {Pane} pane @param {MouseEvent} event @returns {Spot} */
function spotOf(pane, event) {
  const box = pane.surface.getBoundingClientRect();
  const { clientLeft, clientTop } = pane.surface;
  const [x, y] = [event.clientX - box.left - clientLeft, event.clientY - box.top - clientTop];
  return { x, y, time: event.timeStamp };
}
