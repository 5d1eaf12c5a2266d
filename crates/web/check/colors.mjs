// A picture in few colors: the most frequent ones as they are, the others by median cut (Heckbert 1982).

/** The number of pixels of each color, by red · 65536 + green · 256 + blue. @param {Uint8Array} data */
function counted(data) {
  /** @type {Map<number, number>} */
  const counts = new Map();
  for (let at = 0; at < data.length; at += 4) {
    const color = (data[at] << 16) | (data[at + 1] << 8) | data[at + 2];
    counts.set(color, (counts.get(color) ?? 0) + 1);
  }
  return counts;
}

/** @param {number} color @param {number} channel 0 is red */
const part = (color, channel) => (color >> (16 - 8 * channel)) & 255;

/** A box of colors: the channel in which it is widest, and how wide. @param {[number, number][]} box */
function widest(box) {
  let [best, width] = [0, -1];
  for (let channel = 0; channel < 3; channel += 1) {
    let [least, most] = [255, 0];
    for (const [color] of box) {
      least = Math.min(least, part(color, channel));
      most = Math.max(most, part(color, channel));
    }
    if (most - least > width) [best, width] = [channel, most - least];
  }
  return { channel: best, width };
}

/** Cuts boxes until there are enough. @param {[number, number][]} colors @param {number} count */
function cut(colors, count) {
  const boxes = [colors];
  while (boxes.length < count) {
    const weights = boxes.map((box) => {
      const pixels = box.reduce((sum, [, times]) => sum + times, 0);
      return box.length < 2 ? 0 : widest(box).width * Math.sqrt(pixels);
    });
    const at = weights.indexOf(Math.max(...weights));
    if (weights[at] === 0) break;
    const box = boxes[at];
    const { channel } = widest(box);
    box.sort(([a], [b]) => part(a, channel) - part(b, channel) || a - b);
    const half = box.reduce((sum, [, times]) => sum + times, 0) / 2;
    let [sum, middle] = [0, 0];
    while (sum < half && middle < box.length - 1) sum += box[middle++][1];
    boxes.splice(at, 1, box.slice(0, Math.max(1, middle)), box.slice(Math.max(1, middle)));
  }
  return boxes.filter((box) => box.length > 0);
}

/** The mean color of a box. @param {[number, number][]} box */
function mean(box) {
  const pixels = box.reduce((sum, [, times]) => sum + times, 0);
  return [0, 1, 2].map((channel) =>
    Math.round(box.reduce((sum, [color, times]) => sum + part(color, channel) * times, 0) / pixels),
  );
}

/**
 * @param {Uint8Array} data red, green, blue, alpha of each pixel
 * @param {number} count the most colors, at most 256
 */
export function quantized(data, count) {
  const colors = [...counted(data)].sort(([a, some], [b, others]) => others - some || a - b);
  const exact = colors.slice(0, Math.floor(count / 2));
  const boxes = cut(colors.slice(exact.length), count - exact.length);
  /** @type {Map<number, number>} */
  const places = new Map();
  exact.forEach(([color], place) => places.set(color, place));
  boxes.forEach((box, at) => box.forEach(([color]) => places.set(color, exact.length + at)));
  const parts = exact.map(([color]) => [0, 1, 2].map((channel) => part(color, channel)));
  const palette = [...parts, ...boxes.map(mean)];
  const indices = new Uint8Array(data.length / 4);
  for (let at = 0; at < indices.length; at += 1) {
    const color = (data[4 * at] << 16) | (data[4 * at + 1] << 8) | data[4 * at + 2];
    indices[at] = places.get(color) ?? 0;
  }
  return { places: indices, palette: Uint8Array.from(palette.flat()) };
}
