// Numbers that look random, and are the same for the same seed.

/** A prime number, and a factor whose powers run through all numbers below it (Park and Miller 1988). */
const [PRIME, FACTOR] = [2 ** 31 - 1, 48_271];

/**
 * Gives numbers from 0 up to 1, without 0 and 1.
 * @param {number} seed - From 0.
 * @returns {() => number}
 */
export function random(seed) {
  let number = 1 + ((seed * 40_503) % (PRIME - 1));
  const next = () => {
    number = (number * FACTOR) % PRIME;
    return number / PRIME;
  };
  // The first numbers of near seeds are near to each other.
  next();
  next();
  return next;
}
