// A picture of one pixel a cell (or vertex), with smaller copies for maps that are larger than the screen.

/** @typedef {import("./view.js").Frame} Frame */

/** @param {number} width @param {number} height */
function newContext(width, height) {
  const canvas = document.createElement("canvas");
  canvas.width = Math.max(1, width);
  canvas.height = Math.max(1, height);
  // Pixels come from the processor: a copy on the graphics card would only be in the way.
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) throw new Error("This browser gives no canvas to draw on.");
  return context;
}

/** @typedef {{ x0: number, y0: number, x1: number, y1: number }} Box */

/** @param {Box | null} box @param {Box} other @returns {Box} */
function joined(box, other) {
  if (!box) return { ...other };
  return {
    x0: Math.min(box.x0, other.x0),
    y0: Math.min(box.y0, other.y0),
    x1: Math.max(box.x1, other.x1),
    y1: Math.max(box.y1, other.y1),
  };
}

export class Raster {
  /** @type {{ context: CanvasRenderingContext2D, dirty: Box | null }[]} */
  #levels = [];
  #data;
  #spare = newContext(1, 1);

  /** `weight`: how much of its color a pixel of a smaller copy has beyond the mean, so that thin lines stay.
   *  With a weight, lines are also drawn equally thick. @param {number} width @param {number} height @param
   *  {number} [weight] */
  constructor(width, height, weight = 0) {
    this.width = width;
    this.height = height;
    this.weight = weight;
    this.#data = new ImageData(width, height);
    /** The pixels; say `touch` after a change. */
    this.pixels = new Uint32Array(this.#data.data.buffer);
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height */
  touch(x = 0, y = 0, width = this.width, height = this.height) {
    this.#level(0).dirty = joined(this.#level(0).dirty, { x0: x, y0: y, x1: x + width, y1: y + height });
  }

  /** Draws what is seen of it. Pixel (x, y) begins at `shift` cells beside (x, y).
   *  @param {CanvasRenderingContext2D} context @param {Frame} frame @param {number} shift
   *  @param {Box} [part] Only these pixels of the raster. */
  draw(context, frame, shift, part) {
    let level = 0;
    while (frame.scale * 2 ** level < 0.55 && Math.min(this.width, this.height) >> level > 2) level++;
    const size = 2 ** level;
    const source = this.#fresh(level).canvas;
    const [left, top] = [frame.left + shift * frame.scale, frame.top + shift * frame.scale];
    const x0 = Math.max(0, Math.floor(-left / frame.scale / size), part ? Math.floor(part.x0 / size) : 0);
    const y0 = Math.max(0, Math.floor(-top / frame.scale / size), part ? Math.floor(part.y0 / size) : 0);
    const x1 = Math.min(
      source.width,
      Math.ceil((frame.width - left) / frame.scale / size),
      part ? Math.ceil(part.x1 / size) : Infinity,
    );
    const y1 = Math.min(
      source.height,
      Math.ceil((frame.height - top) / frame.scale / size),
      part ? Math.ceil(part.y1 / size) : Infinity,
    );
    if (x1 <= x0 || y1 <= y0) return;
    const scale = frame.scale * size;
    const times = Math.ceil(frame.scale);
    if (this.weight > 0 && frame.scale > 1 && times <= 4 && frame.scale !== times) {
      this.#drawEven(context, { x0, y0, x1, y1 }, times, [left, top, scale]);
      return;
    }
    context.imageSmoothingEnabled = frame.scale < 1;
    context.imageSmoothingQuality = "low";
    context.drawImage(
      source,
      x0,
      y0,
      x1 - x0,
      y1 - y0,
      left + x0 * scale,
      top + y0 * scale,
      (x1 - x0) * scale,
      (y1 - y0) * scale,
    );
  }

  /** Draws thin lines equally thick, although a cell is no whole number of pixels: enlarged by whole
   *  numbers, then smoothly made smaller. @param {CanvasRenderingContext2D} context @param {Box} box @param
   *  {number} times @param {[number, number, number]} place Left, top and the size of a pixel. */
  #drawEven(context, { x0, y0, x1, y1 }, times, [left, top, scale]) {
    const [columns, rows] = [x1 - x0, y1 - y0];
    const { canvas } = this.#spare;
    const [width, height] = [columns * times, rows * times];
    if (canvas.width < width) canvas.width = width;
    if (canvas.height < height) canvas.height = height;
    this.#spare.imageSmoothingEnabled = false;
    this.#spare.clearRect(0, 0, width, height);
    this.#spare.drawImage(this.#fresh(0).canvas, x0, y0, columns, rows, 0, 0, width, height);
    context.imageSmoothingEnabled = true;
    context.imageSmoothingQuality = "low";
    const at = [left + x0 * scale, top + y0 * scale];
    context.drawImage(canvas, 0, 0, width, height, at[0], at[1], columns * scale, rows * scale);
  }

  /** @param {number} index */
  #level(index) {
    while (this.#levels.length <= index) {
      const size = 2 ** this.#levels.length;
      const [width, height] = [Math.ceil(this.width / size), Math.ceil(this.height / size)];
      const context = newContext(width, height);
      this.#levels.push({ context, dirty: { x0: 0, y0: 0, x1: width, y1: height } });
    }
    return this.#levels[index];
  }

  /** The copy of this level, with all changes. @param {number} index @returns {CanvasRenderingContext2D} */
  #fresh(index) {
    const level = this.#level(index);
    if (index === 0) {
      const { dirty } = level;
      if (!dirty) return level.context;
      level.dirty = null;
      const [width, height] = [dirty.x1 - dirty.x0, dirty.y1 - dirty.y0];
      level.context.putImageData(this.#data, 0, 0, dirty.x0, dirty.y0, width, height);
      this.#spread(1, dirty);
      return level.context;
    }
    const larger = this.#fresh(index - 1);
    const { dirty } = level;
    if (!dirty) return level.context;
    level.dirty = null;
    this.#halve(larger.canvas, level.context, dirty, 2 ** index);
    this.#spread(index + 1, dirty);
    return level.context;
  }

  /** Marks the next smaller copy, if there is one. @param {number} index @param {Box} dirty */
  #spread(index, dirty) {
    const level = this.#levels[index];
    if (!level) return;
    const { canvas } = level.context;
    level.dirty = joined(level.dirty, {
      x0: dirty.x0 >> 1,
      y0: dirty.y0 >> 1,
      x1: Math.min(canvas.width, (dirty.x1 + 1) >> 1),
      y1: Math.min(canvas.height, (dirty.y1 + 1) >> 1),
    });
  }

  /** Each pixel becomes the mean of four. @param {HTMLCanvasElement} source @param
   *  {CanvasRenderingContext2D} context @param {Box} box @param {number} size Of a pixel, in cells. */
  #halve(source, context, box, size) {
    const [width, height] = [box.x1 - box.x0, box.y1 - box.y0];
    context.clearRect(box.x0, box.y0, width, height);
    context.imageSmoothingEnabled = true;
    context.imageSmoothingQuality = "low";
    const [left, top] = [2 * box.x0, 2 * box.y0];
    const [w, h] = [Math.min(2 * width, source.width - left), Math.min(2 * height, source.height - top)];
    if (w <= 0 || h <= 0) return;
    const draw = () => context.drawImage(source, left, top, w, h, box.x0, box.y0, w / 2, h / 2);
    draw();
    // Not below: the copies of copies would grow fat.
    if (this.weight > 0 && size <= 4) {
      context.globalAlpha = this.weight;
      draw();
      context.globalAlpha = 1;
    }
  }
}
