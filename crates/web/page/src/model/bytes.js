// Bytes as text of a link: base64url, deflate, and cells as lengths of runs.

/** Bytes in the letters that a link may hold as they are.
 * @param {Uint8Array} bytes */
export function toText(bytes) {
  let binary = "";
  for (let i = 0; i < bytes.length; i += 4096) binary += String.fromCharCode(...bytes.subarray(i, i + 4096));
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The bytes of such a text. Throws if it is none.
 * @param {string} text */
export function fromText(text) {
  if (!/^[\w-]*$/.test(text)) throw new Error("These are no bytes.");
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
}

/** All that comes out of a stream; throws if it is more than `most` bytes.
 * @param {Uint8Array<ArrayBuffer>} bytes @param {CompressionStream | DecompressionStream} through
 * @param {number} most */
async function pass(bytes, through, most) {
  const reader = new Blob([bytes]).stream().pipeThrough(through).getReader();
  /** @type {Uint8Array[]} */ const parts = [];
  let length = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    length += part.value.length;
    if (length > most) {
      await reader.cancel();
      throw new Error("These are too many bytes.");
    }
    parts.push(part.value);
  }
  const all = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** @param {Uint8Array<ArrayBuffer>} bytes */
export function deflate(bytes) {
  return pass(bytes, new CompressionStream("deflate-raw"), Infinity);
}

/** @param {Uint8Array<ArrayBuffer>} bytes @param {number} most the bytes that may come out */
export function inflate(bytes, most) {
  return pass(bytes, new DecompressionStream("deflate-raw"), most);
}

/** Numbers in order as lengths: how many are left out, how many follow each other, and so on; seven bits a
 * byte, the last byte of a length without the eighth bit. Null if that would be more than `most` bytes.
 * @param {Uint32Array} numbers @param {number} most */
export function toRuns(numbers, most) {
  const bytes = new Uint8Array(most + 16);
  let at = 0;
  const put = (/** @type {number} */ length) => {
    for (; length > 127; length >>>= 7) bytes[at++] = (length & 127) | 128;
    bytes[at++] = length;
  };
  let next = 0;
  for (let i = 0; i < numbers.length; ) {
    let end = i + 1;
    while (end < numbers.length && numbers[end] === numbers[end - 1] + 1) end++;
    put(numbers[i] - next);
    put(end - i);
    if (at > most) return null;
    next = numbers[end - 1] + 1;
    i = end;
  }
  return bytes.slice(0, at);
}

/** The numbers of such lengths, below `size`. Throws if they are none.
 * @param {Uint8Array} bytes @param {number} size */
export function fromRuns(bytes, size) {
  /** @type {number[]} */ const lengths = [];
  for (let at = 0; at < bytes.length; ) {
    let length = 0;
    for (let unit = 1, isLast = false; !isLast; unit *= 128, at++) {
      if (unit > size * 128 || at >= bytes.length) throw new Error("A length has no end.");
      length += (bytes[at] & 127) * unit;
      isLast = bytes[at] < 128;
    }
    lengths.push(length);
  }
  const total = lengths.reduce((sum, length) => sum + length, 0);
  if (total > size || lengths.length % 2 !== 0) throw new Error("The lengths do not fit.");
  const count = lengths.reduce((sum, length, i) => sum + (i % 2) * length, 0);
  const numbers = new Uint32Array(count);
  let [next, n] = [0, 0];
  lengths.forEach((length, i) => {
    if (i % 2 === 1) for (let j = 0; j < length; j++) numbers[n++] = next + j;
    next += length;
  });
  return numbers;
}

/** Six letters that tell numbers of 32 bits from others: one changed number always gives other letters.
 * @param {number} count @param {(i: number) => number} at */
export function digest(count, at) {
  let sum = count;
  for (let i = 0; i < count; i++) {
    sum = Math.imul(sum ^ at(i), 0x5f356495);
    sum ^= sum >>> 15;
  }
  return toText(Uint8Array.of(sum >>> 24, sum >>> 16, sum >>> 8, sum));
}
