// A field of directions as arrows, as dense as they can be read. An arrow is drawn once for each direction
// and then copied.

/** @typedef {NonNullable<import("../../types.d.ts").Lanes["field"]>} Field */
/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {import("./colors.js").Theme} Theme */

/** The least distance between arrows, in pixels of the page. */
const SPACING = 22;
/** A turn has so many directions: no eye tells more. */
const DIRECTIONS = 144;

export class Arrows {
  /** @type {Map<number, HTMLCanvasElement>} */
  #pictures = new Map();
  #key = "";

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {Field} field
   *  @param {number} shift Of a vertex, in cells. @param {Theme} theme */
  draw(context, frame, { flow, width, height }, shift, theme) {
    if (!flow) return;
    const { scale, dpr } = frame;
    const stride = Math.max(1, Math.ceil((SPACING * dpr) / scale));
    const half = Math.round(Math.min(13 * dpr, 0.36 * stride * scale));
    this.#forget(`${half} ${dpr} ${theme.css.text} ${theme.css.page}`);
    // Arrows stay at their vertices while the map moves.
    const first = (/** @type {number} */ edge) =>
      Math.max(0, Math.floor(-edge / scale / stride)) * stride + (stride >> 1);
    for (let y = first(frame.top); y < height; y += stride) {
      const py = frame.top + (y + shift) * scale;
      if (py > frame.height + half) break;
      for (let x = first(frame.left); x < width; x += stride) {
        const px = frame.left + (x + shift) * scale;
        if (px > frame.width + half) break;
        const at = 2 * (y * width + x);
        if (flow[at] === 0 && flow[at + 1] === 0) continue;
        const picture = this.#picture(Math.atan2(flow[at + 1], flow[at]), half, dpr, theme);
        const middle = picture.width / 2;
        context.drawImage(picture, Math.round(px - middle), Math.round(py - middle));
      }
    }
  }

  /** @param {string} key */
  #forget(key) {
    if (key === this.#key) return;
    this.#key = key;
    this.#pictures.clear();
  }

  /** @param {number} angle @param {number} half The length from the middle to the tip. @param {number} dpr
   *  @param {Theme} theme */
  #picture(angle, half, dpr, theme) {
    const index = Math.round((angle / (2 * Math.PI)) * DIRECTIONS);
    const known = this.#pictures.get(index);
    if (known) return known;
    const canvas = document.createElement("canvas");
    const middle = half + Math.ceil(3 * dpr);
    [canvas.width, canvas.height] = [2 * middle, 2 * middle];
    this.#pictures.set(index, canvas);
    const context = canvas.getContext("2d");
    if (!context) return canvas;
    context.translate(middle, middle);
    context.rotate((index / DIRECTIONS) * 2 * Math.PI);
    context.lineJoin = "round";
    context.lineCap = "round";
    context.beginPath();
    context.moveTo(-half, 0);
    context.lineTo(half, 0);
    context.moveTo(0.25 * half, 0.5 * half);
    context.lineTo(half, 0);
    context.lineTo(0.25 * half, -0.5 * half);
    context.strokeStyle = theme.css.page;
    context.globalAlpha = 0.6;
    context.lineWidth = 3.5 * dpr;
    context.stroke();
    context.strokeStyle = theme.css.text;
    context.globalAlpha = 1;
    context.lineWidth = 1.4 * dpr;
    context.stroke();
    return canvas;
  }
}
