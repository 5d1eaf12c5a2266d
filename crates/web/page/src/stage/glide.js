// A path that turns into another one, as a rope is pulled: for a page that moves by itself.

/** The time of it, in ms. */
const TIME = 380;
/** The points of the path meanwhile. */
const POINTS = 240;

export class Glide {
  /** @type {ArrayLike<number>} */
  #to = [];
  /** @type {Float64Array | null} */
  #from = null;
  /** @type {Float64Array | null} */
  #shown = null;
  #since = 0;

  /** The path as it is drawn now. It turns into another one if it glides.
   *  @param {ArrayLike<number>} path @param {boolean} glides @param {number} now
   *  @returns {{ path: ArrayLike<number>, isMoving: boolean }} */
  at(path, glides, now) {
    if (path !== this.#to) {
      const before = this.#shown ?? (this.#to.length > 3 ? spread(this.#to) : null);
      this.#from = glides && path.length > 3 ? before : null;
      [this.#to, this.#since] = [path, now];
    }
    const age = (now - this.#since) / TIME;
    if (!this.#from || !glides || age >= 1) {
      this.#from = this.#shown = null;
      return { path, isMoving: false };
    }
    const t = age * age * (3 - 2 * age);
    const from = this.#from;
    this.#shown = spread(path).map((to, i) => from[i] + t * (to - from[i]));
    return { path: this.#shown, isMoving: true };
  }
}

/** Points on a path, all as far apart along it. @param {ArrayLike<number>} path */
function spread(path) {
  const ends = [0];
  for (let i = 2; i < path.length; i += 2) {
    ends.push(ends[ends.length - 1] + Math.hypot(path[i] - path[i - 2], path[i + 1] - path[i - 1]));
  }
  const points = new Float64Array(2 * POINTS);
  const gap = ends[ends.length - 1] / (POINTS - 1);
  for (let n = 0, leg = 1; n < POINTS; n++) {
    while (leg < ends.length - 1 && ends[leg] < n * gap) leg++;
    const t = Math.min(1, (n * gap - ends[leg - 1]) / (ends[leg] - ends[leg - 1] || 1));
    for (const c of [0, 1]) {
      const [a, b] = [path[2 * leg - 2 + c], path[2 * leg + c]];
      points[2 * n + c] = a + t * (b - a);
    }
  }
  return points;
}
