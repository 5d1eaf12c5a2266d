// The playback of the searches: all lanes expand at the same pace, or as fast as they were. It dispatches
// `use` when somebody plays.

/** @typedef {import("../../types.d.ts").Player} Contract */
/** @typedef {import("../../types.d.ts").Lanes} Lanes */
/** @typedef {import("../../types.d.ts").LaneAnswer} LaneAnswer */

/** @type {WeakMap<Uint32Array, Uint32Array>} */
const known = new WeakMap();

/** The number of steps up to the end of the n-th expansion, for n = 1, 2, …: with the vertices that it
 *  generated. @param {Uint32Array} steps @returns {Uint32Array} */
export function expansionEnds(steps) {
  const found = known.get(steps);
  if (found) return found;
  let count = 0;
  for (let i = 0; i < steps.length; i++) count += steps[i] & 1;
  const ends = new Uint32Array(count);
  let n = 0;
  for (let i = 0; i < steps.length; i++) {
    if (steps[i] & 1) {
      if (n > 0) ends[n - 1] = i;
      n++;
    }
  }
  if (count > 0) ends[count - 1] = steps.length;
  known.set(steps, ends);
  return ends;
}

/** A speed at which the whole takes about five seconds, with one digit. @param {number} length */
function easy(length) {
  const speed = Math.max(1, length / 5);
  const unit = 10 ** Math.floor(Math.log10(speed));
  return Math.max(1, Math.round(speed / unit) * unit);
}

/** @implements {Contract} */
export class Player extends EventTarget {
  #lanes;
  /** @type {"pace" | "time"} */
  #mode = "pace";
  #speed = 0;
  #position = 0;
  #isPlaying = false;
  /** Whether it plays as soon as all lanes have ended. */
  #isAwaited = false;
  /** The time of the last tick. */
  #last = 0;
  /** The paths and steps that were seen last. @type {unknown[]} */
  #seen = [];

  /** @param {Lanes} lanes */
  constructor(lanes) {
    super();
    this.#lanes = lanes;
    lanes.addEventListener("change", () => this.#follow());
    this.#follow();
  }

  get mode() {
    return this.#mode;
  }

  set mode(mode) {
    if (mode === this.#mode) return;
    // The same share of the whole is shown in both.
    const share = this.length > 0 ? this.#position / this.length : 1;
    this.#mode = mode;
    this.#speed = 0;
    this.#position = share * this.length;
    this.#changed();
  }

  /** Until it is set, such that all takes about five seconds. */
  get speed() {
    if (this.#speed > 0) return this.#speed;
    return this.#mode === "pace" ? easy(this.length) : 200;
  }

  set speed(speed) {
    if (!(speed > 0)) return;
    this.#speed = speed;
    this.#changed();
  }

  get playing() {
    return this.#isPlaying;
  }
  get position() {
    return this.#position;
  }

  get length() {
    let length = 0;
    for (const { answer } of this.#lanes.list) {
      if (answer) length = Math.max(length, this.#mode === "pace" ? expansions(answer) : answer.ms);
    }
    return length;
  }

  /** Plays from the beginning, when all lanes have ended: a race. */
  start() {
    this.#isPlaying = false;
    this.#isAwaited = true;
    this.#position = 0;
    this.#begin();
    this.#changed();
  }

  play() {
    this.#use();
    if (this.#isPlaying || this.length === 0) return;
    if (this.#position >= this.length) this.#position = 0;
    this.#isPlaying = true;
    this.#last = performance.now();
    requestAnimationFrame(() => this.#tick());
    this.#changed();
  }

  pause() {
    if (!this.#isPlaying) return;
    this.#isPlaying = false;
    this.#changed();
  }

  toggle() {
    if (this.#isPlaying) this.pause();
    else this.play();
  }

  /** @param {number} by */
  step(by) {
    this.#use();
    this.#isPlaying = false;
    if (this.#mode === "pace") return this.seek(Math.round(this.#position) + by);
    // One expansion of the lane that made most of them.
    const most = Math.max(1, ...this.#lanes.list.map(({ answer }) => (answer ? expansions(answer) : 0)));
    return this.seek(this.#position + (by * this.length) / most);
  }

  /** @param {number} position */
  seek(position) {
    this.#use();
    this.#position = Math.min(this.length, Math.max(0, position));
    this.#changed();
  }

  /** @param {number} lane */
  shown(lane) {
    const steps = this.#lanes.list[lane]?.answer?.steps;
    if (!steps) return 0;
    const n = this.#done(lane);
    const ends = expansionEnds(steps);
    if (n >= ends.length) return steps.length;
    return n > 0 ? ends[n - 1] : 0;
  }

  /** @param {number} lane */
  arrived(lane) {
    const answer = this.#lanes.list[lane]?.answer;
    if (!answer) return false;
    const done = this.#done(lane);
    // A lane without expansions arrives when its time is over, too.
    return done === Infinity || (this.#mode === "pace" && done >= expansions(answer));
  }

  /** The number of the lane's expansions that are shown; Infinity for all. @param {number} lane */
  #done(lane) {
    const answer = this.#lanes.list[lane]?.answer;
    if (!answer) return 0;
    if (this.#position >= this.length) return Infinity;
    if (this.#mode === "pace") return Math.floor(this.#position);
    const share = answer.ms > 0 ? this.#position / answer.ms : 1;
    return share >= 1 ? Infinity : Math.floor(share * expansions(answer));
  }

  #tick() {
    if (!this.#isPlaying) return;
    const now = performance.now();
    const seconds = Math.min(0.1, (now - this.#last) / 1000);
    this.#last = now;
    const rate = this.#mode === "pace" ? this.speed : (this.speed / 1000) * this.length;
    this.#position = Math.min(this.length, this.#position + seconds * rate);
    if (this.#position >= this.length) this.#isPlaying = false;
    else requestAnimationFrame(() => this.#tick());
    this.#changed();
  }

  #use() {
    this.#isAwaited = false;
    this.dispatchEvent(new Event("use"));
  }

  /** Starts the race that was awaited, if no lane is under way any more. */
  #begin() {
    const { list } = this.#lanes;
    if (!this.#isAwaited || !list.every(hasEnded)) return;
    this.#position = 0;
    this.play();
  }

  /** Shows a new answer whole, unless somebody plays. A reference that comes later is no new answer. */
  #follow() {
    this.#begin();
    const seen = this.#lanes.list.flatMap(({ answer }) => [answer?.path, answer?.steps]);
    if (seen.length === this.#seen.length && seen.every((part, i) => part === this.#seen[i])) return;
    this.#seen = seen;
    if (this.#isPlaying) this.#position = Math.min(this.#position, this.length);
    else this.#position = this.#isAwaited ? 0 : this.length;
    this.#changed();
  }

  #changed() {
    this.dispatchEvent(new Event("change"));
  }
}

/** @param {LaneAnswer} answer */
function expansions(answer) {
  return answer.steps ? expansionEnds(answer.steps).length : answer.expanded;
}

/** @param {import("../../types.d.ts").LaneState} lane */
const hasEnded = ({ phase, stale }) => !stale && ["done", "failed", "cancelled"].includes(phase);
