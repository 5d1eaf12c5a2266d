// The stage: one pane for each lane, with one view of the map for all. It follows the scene, the answers and
// the player, and draws at most once a frame.

import { Calls } from "./calls.js";
import { element } from "./caption.js";
import { readTheme, watchTheme } from "./colors.js";
import { Keyboard } from "./keyboard.js";
import { LandPainter } from "./paint-land.js";
import { Walls } from "./paint-map.js";
import { Pane } from "./pane.js";
import { DragRecord } from "./record.js";
import { PointerTools } from "./tools.js";
import { View } from "./view.js";

/** @typedef {import("../../types.d.ts").Model} Model */
/** @typedef {import("../../types.d.ts").Lanes} Lanes */
/** @typedef {import("../../types.d.ts").Player} Player */
/** @typedef {import("../../types.d.ts").Stage} Contract */
/** @typedef {import("../../types.d.ts").Walkers} Walkers */
/** @typedef {import("../../types.d.ts").Change} Change */
/** @typedef {import("../../types.d.ts").Rect} Rect */
/** @typedef {import("../../types.d.ts").Tool} Tool */

const HELP = `Arrow keys move the cell cursor, with Shift by eight cells. Space or Enter draws or erases a
  wall; hold it to go on. L takes another brush: road, grass, forest or swamp. S puts the start here, G the
  goal. Plus and minus zoom, 0 shows all. 1 to 5 choose the tool. Escape leaves what is under way.`;

/** Dispatches `tool` when the tool changes, and `say` with a sentence for those who do not see the cell
 *  cursor. @implements {Contract} */
export class Stage extends EventTarget {
  /** @type {Pane[]} */
  panes = [];
  view = new View();
  walls = new Walls();
  /** Darker, for panes that show a field: loaded only while one is shown. */
  wallsInField = new Walls();
  land = new LandPainter();
  record = new DragRecord();
  /** The cell of the keyboard. */
  cursor = { x: 0, y: 0, isShown: false };
  /** The end that is dragged, and the one under the pointer. @type {"start" | "goal" | ""} */
  held = "";
  /** @type {"start" | "goal" | ""} */
  near = "";
  /** Cells under the brush, or of a rectangle to come; all panes show what is shared.
   *  @type {{ rect: Rect, pane: Pane, isErasing: boolean, isShared: boolean } | null} */
  preview = null;
  /** Whether a path turns slowly into another one. */
  glides = false;
  helpId = "stage-help";
  /** @type {Tool} */
  #tool = "move";
  #brush = 0;
  #frame = 0;
  #size = [0, 0];
  /** @type {Calls | undefined} */
  #calls;

  /** @param {HTMLElement} root @param {Model} model @param {Lanes} lanes @param {Player} player
   *  @param {Walkers} walkers */
  constructor(root, model, lanes, player, walkers) {
    super();
    this.root = root;
    this.model = model;
    this.lanes = lanes;
    this.player = player;
    this.walkers = walkers;
    root.classList.add("stage");
    root.dataset.tool = this.#tool;
    const help = element("p", "stage-help", root);
    help.id = this.helpId;
    help.textContent = HELP;
    this.theme = readTheme(root);
    this.pointer = new PointerTools(this);
    this.keyboard = new Keyboard(this);
    this.#loadMap();
    this.#makePanes();
    this.#listen();
    new ResizeObserver(() => this.#arrange()).observe(root);
    // Zooming the page changes the device's pixels, but not always the size.
    addEventListener("resize", () => this.#arrange());
  }

  get tool() {
    return this.#tool;
  }

  set tool(tool) {
    if (tool === this.#tool) return;
    this.#tool = tool;
    this.root.dataset.tool = tool;
    this.preview = null;
    this.soil("top");
    this.dispatchEvent(new Event("tool"));
  }

  get brush() {
    return this.#brush;
  }

  set brush(brush) {
    if (brush === this.#brush) return;
    this.#brush = brush;
    this.dispatchEvent(new Event("tool"));
  }

  /** Whether the ends are called to be dragged. @param {boolean} shown */
  set calls(shown) {
    this.#calls = shown ? new Calls(this.panes[0].surface) : this.#calls?.remove();
    this.soil("top");
  }

  /** @param {Pane} pane */
  placeCalls(pane) {
    if (pane === this.panes[0]) this.#calls?.place(pane, this.model);
  }

  get frames() {
    return this.record.frames;
  }
  get latencies() {
    return this.record.latencies;
  }

  fit() {
    this.view.fit();
    this.moved();
  }

  /** @param {number} factor */
  zoom(factor) {
    this.view.zoom(factor);
    this.moved();
  }

  /** The pixels in the window of a place of the map, in cells: for tests and hints. @param {number} lane
   *  @param {number} x @param {number} y */
  place(lane, x, y) {
    const pane = this.panes[lane];
    const { left, top } = pane.surface.getBoundingClientRect();
    const spot = pane.spotOf(x, y);
    return { x: left + pane.surface.clientLeft + spot.x, y: top + pane.surface.clientTop + spot.y };
  }

  /** The view changed. */
  moved() {
    this.soil("ground", "walls", "top");
  }

  /** @param {("ground" | "walls" | "top" | "text")[]} parts */
  soil(...parts) {
    for (const pane of this.panes) pane.soil(...parts);
  }

  requestFrame() {
    if (this.#frame === 0) this.#frame = requestAnimationFrame((now) => this.#draw(now));
  }

  /** The pane that shows this lane's answer to a drag. @type {Pane | null} */
  watched = null;

  /** @param {number} now */
  #draw(now) {
    const from = performance.now();
    this.#frame = 0;
    for (const pane of this.panes) {
      if (pane.draw(now)) this.requestFrame();
    }
    const lane = this.watched?.lane ?? this.model.active;
    this.record.framed(from, this.lanes.list[lane], this.model);
  }

  #listen() {
    this.model.addEventListener("change", (event) => {
      this.#follow(/** @type {CustomEvent<Change>} */ (event).detail);
    });
    this.lanes.addEventListener("change", (event) => {
      const { detail } = /** @type {CustomEvent<{ lane?: number, overlay?: boolean }>} */ (event);
      const { lane, overlay } = detail;
      if (overlay) this.soil("ground", "walls", "text");
      if (lane !== undefined) this.panes[lane]?.soil("top", "text");
    });
    this.player.addEventListener("change", () => this.soil("top", "text"));
    this.walkers.addEventListener("change", () => this.panes[this.model.active]?.soil("top"));
    watchTheme(() => {
      this.theme = readTheme(this.root);
      this.#loadWalls();
      this.soil("ground", "walls", "top");
    });
  }

  /** @param {Change} change */
  #follow(change) {
    if (change.map) this.#loadMap();
    if (change.lanes) this.#makePanes();
    if (change.map || change.lanes || change.active || change.overlay) {
      if (change.overlay && this.#hasField) this.#loadWalls();
      this.soil("ground", "walls", "top", "text");
    }
    if (change.cells && !change.map) {
      this.walls.patch(this.model, change.cells);
      if (this.land.patch(this.model, change.cells, this.theme)) this.soil("ground", "text");
      if (this.#hasField) this.wallsInField.patch(this.model, change.cells);
      for (const pane of this.panes) {
        // Lines and glyphs of an overlay reach further than the cells.
        if (this.model.overlay === "search" || this.model.overlay === "none") pane.soilCells(change.cells);
        else pane.soil("walls");
      }
    }
    if (change.ends) this.soil("top");
    if (change.wishes) this.soil("walls", "top", "text");
    if (change.agents) this.soil("top");
  }

  #loadMap() {
    const { model } = this;
    this.pointer.cancel();
    this.#loadWalls();
    this.view.setMap(model.width, model.height);
    [this.cursor.x, this.cursor.y] = model.start;
    this.preview = null;
    this.#size = [0, 0];
    this.#arrange();
  }

  get #hasField() {
    return this.model.overlay === "distances" || this.model.overlay === "clearance";
  }

  #loadWalls() {
    this.walls.load(this.model, this.theme.wall);
    this.land.load(this.model, this.theme);
    if (this.#hasField) this.wallsInField.load(this.model, this.theme.wallInField);
  }

  #makePanes() {
    const count = this.model.lanes.length;
    if (this.panes.length === count) return;
    while (this.panes.length > count) this.panes.pop()?.root.remove();
    while (this.panes.length < count) {
      const pane = new Pane(this, this.panes.length);
      this.panes.push(pane);
      this.pointer.listen(pane);
      this.keyboard.listen(pane);
      this.root.append(pane.root);
    }
    this.#size = [0, 0];
    this.#arrange();
  }

  /** Gives the panes their places: so many columns that the map is largest. */
  #arrange() {
    const [width, height] = [this.root.clientWidth, this.root.clientHeight];
    const dpr = globalThis.devicePixelRatio || 1;
    const size = [width, height, dpr];
    if (this.panes.length === 0 || size.every((side, i) => side === this.#size[i])) return;
    this.#size = size;
    const count = this.panes.length;
    const caption = this.panes[0].caption.button.offsetHeight || 36;
    let [best, columns] = [-1, 1];
    for (let n = count; n >= 1; n--) {
      if (count % n) continue; // An empty place would stay.
      const rows = count / n;
      const scale = this.view.scaleFor(width / n, Math.max(1, height / rows - caption));
      // Few columns only if the map gains: eyes compare more easily side by side.
      if (scale > best * 1.25) [best, columns] = [scale, n];
    }
    this.root.style.setProperty("--columns", String(columns));
    this.root.dataset.count = String(count);
    for (const pane of this.panes) pane.measure();
    const smallest = this.panes.reduce((a, b) => (b.width * b.height < a.width * a.height ? b : a));
    this.view.setPane(smallest.width, smallest.height, dpr);
    for (const pane of this.panes) pane.resize();
  }
}
