// Random numbers for the generators: whole numbers only, thus the same on every platform.

/** Mixes the bits of a 32-bit number, so that near numbers give far ones: shifts and
 * products by turns, with the factors that Wellons found to mix best (hash-prospector, 2018).
 * @param {number} n */
export function mix(n) {
  let m = n | 0;
  m = Math.imul(m ^ (m >>> 16), 0x21f0aaad);
  m = Math.imul(m ^ (m >>> 15), 0x735a2d97);
  return (m ^ (m >>> 15)) >>> 0;
}

/** A sequence of random numbers: the mixed multiples of an odd number. */
export class Random {
  #state;

  /** @param {number} seed */
  constructor(seed) {
    this.#state = mix(seed);
  }

  /** From 0 to 2³² - 1. */
  next() {
    this.#state = (this.#state + 0x9e3779b9) | 0;
    return mix(this.#state);
  }

  /** From 0 to `n - 1`.
   * @param {number} n */
  below(n) {
    return Math.floor((this.next() * n) / 0x1_0000_0000);
  }

  /** From `least` to `most`, both included.
   * @param {number} least @param {number} most */
  between(least, most) {
    return least + this.below(most - least + 1);
  }

  /** Whether something that happens `percent` times in a hundred happens.
   * @param {number} percent */
  chance(percent) {
    return this.below(100) < percent;
  }

  /** One of the things.
   * @template T @param {readonly T[]} things @returns {T} */
  pick(things) {
    return things[this.below(things.length)];
  }
}

/** The whole part of the square root.
 * @param {number} n a whole number below 2⁵³ */
export function root(n) {
  let r = Math.floor(Math.sqrt(n));
  while (r * r > n) r--;
  while ((r + 1) * (r + 1) <= n) r++;
  return r;
}
