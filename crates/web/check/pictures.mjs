// Map files for the tests, made here: the format is what is tested, not a picture of somebody.

import { deflateSync } from "node:zlib";

/** @param {string[]} rows `#` is a wall */
export const movingai = (rows) => {
  const head = `type octile\nheight ${rows.length}\nwidth ${rows[0].length}\nmap`;
  return `${head}\n${rows.join("\n").replaceAll("#", "@")}\n`;
};

/** A gray picture: walls black. @param {string[]} rows */
export const pgm = (rows) => {
  const gray = Uint8Array.from([...rows.join("")], (cell) => (cell === "#" ? 0 : 254));
  return Buffer.concat([Buffer.from(`P5\n${rows[0].length} ${rows.length}\n255\n`), gray]);
};

/** A map of ROS that names its picture. @param {string} picture */
export const ros = (picture) =>
  `image: ${picture}\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n` +
  "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

const CRC = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; bit += 1) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  return crc >>> 0;
});

/** @param {string} name @param {Uint8Array} data */
function chunk(name, data) {
  const body = Buffer.concat([Buffer.from(name, "latin1"), data]);
  let crc = 0xffffffff;
  for (const byte of body) crc = CRC[(crc ^ byte) & 255] ^ (crc >>> 8);
  const [length, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
  length.writeUInt32BE(data.length);
  sum.writeUInt32BE((crc ^ 0xffffffff) >>> 0);
  return Buffer.concat([length, body, sum]);
}

/**
 * A PNG of one byte a pixel: gray, or places in a palette of red, green, blue.
 * @param {number} width @param {number} height @param {Uint8Array} pixels @param {Uint8Array} [palette]
 */
export function png(width, height, pixels, palette) {
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, palette ? 3 : 0, 0, 0, 0], 8);
  const lines = Buffer.alloc((width + 1) * height);
  for (let y = 0; y < height; y += 1)
    lines.set(pixels.subarray(y * width, (y + 1) * width), y * (width + 1) + 1);
  const parts = [
    chunk("IHDR", head),
    chunk("IDAT", deflateSync(lines, { level: 9 })),
    chunk("IEND", Buffer.alloc(0)),
  ];
  if (palette) parts.splice(1, 0, chunk("PLTE", palette));
  return Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), ...parts]);
}

/** A map as a picture: walls black. @param {string[]} rows */
export const pngOf = (rows) =>
  png(
    rows[0].length,
    rows.length,
    Uint8Array.from([...rows.join("")], (cell) => (cell === "#" ? 0 : 255)),
  );
