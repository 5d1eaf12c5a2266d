// The times of a drag: the page's work in each frame, and the way of a path from the pointer to the screen.

/** @typedef {import("../../types.d.ts").Model} Model */
/** @typedef {import("../../types.d.ts").LaneState} LaneState */

export class DragRecord {
  /** @type {number[]} */
  frames = [];
  /** @type {number[]} */
  latencies = [];
  #isOpen = false;
  /** Work of this frame before it is painted: handlers of events. */
  #work = 0;
  /** Moves whose path has not been painted. @type {{ key: string, time: number }[]} */
  #moves = [];

  begin() {
    this.frames = [];
    this.latencies = [];
    this.#moves = [];
    this.#work = 0;
    this.#isOpen = true;
  }

  end() {
    this.#isOpen = false;
  }

  /** Work outside a frame that began at this time. @param {number} from */
  worked(from) {
    this.#work += performance.now() - from;
  }

  /** The pointer changed the scene to these ends. @param {Pick<Model, "start" | "goal">} model @param
   *  {number} time Of the event. */
  moved(model, time) {
    this.#moves.push({ key: keyOf(model), time });
  }

  /** A frame was drawn that began at this time. @param {number} from @param {LaneState | undefined} state
   *  @param {Model} model */
  framed(from, state, model) {
    const now = performance.now();
    const work = this.#work + now - from;
    this.#work = 0;
    if (this.#isOpen) {
      this.frames.push(work);
      performance.measure("drag-frame", { start: now - work, end: now });
    }
    this.#arrive(state, model, now);
  }

  /** Finds the last move whose answer is on the screen now. @param {LaneState | undefined} state
   *  @param {Model} model @param {number} now */
  #arrive(state, model, now) {
    const answer = state?.answer;
    if (this.#moves.length === 0 || !answer) return;
    // Of cells an answer does not say which it saw; one that is not stale saw all.
    const last = state.stale
      ? this.#moves.findLastIndex((move) => move.key === keyOf(answer))
      : this.#moves.length - 1;
    if (last < 0 || (state.stale && model.gesture === "cells")) return;
    this.latencies.push(now - this.#moves[last].time);
    this.#moves.splice(0, last + 1);
  }
}

/** @param {{ start: readonly number[], goal: readonly number[] }} ends */
function keyOf({ start, goal }) {
  return `${start},${goal}`;
}
