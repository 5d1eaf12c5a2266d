// All lanes of the race, and what else the engines are asked for. Follows the model; each lane has a
// worker of its own, so that a slow engine does not keep the others waiting.

/** @import { Order } from "./protocol.js" */
/** @import { Change, EngineInfo, Lanes as Contract, LaneSetup, LaneState, Model } from "../../types.js" */
/** @import { Queries } from "../../types.js" */
import { decided } from "../workers.js";
import { Helper } from "./assistant.js";
import { Ladder } from "./ladder.js";
import { Lane } from "./lane.js";
import { Overlay } from "./overlay.js";
import { changeOf, sentence, setupKey, textOf } from "./protocol.js";

/** The largest file that is read, in bytes. */
const LARGEST_FILE = 2 ** 28;

/** @implements {Contract} */
export class Lanes extends EventTarget {
  /** @type {LaneState[]} */
  list = [];
  /** @type {EngineInfo[]} */
  engines = [];
  /** @type {Promise<void>} */
  ready;
  #model;
  /** @type {Lane[]} */
  #lanes = [];
  #overlay;
  #ladder;
  #helper = new Helper();
  /** Answers of the helper that stay true. @type {Map<string, Promise<any>>} */
  #known = new Map();
  /** @type {() => void} */
  #readied = () => {};
  /** Fulfilled when the first lane has something to show: nothing takes its time before.
   *  @type {Promise<void>} */
  #first;
  /** @type {() => void} */
  #shown = () => {};

  /** @param {Model} model */
  constructor(model) {
    super();
    this.#model = model;
    this.ready = new Promise((resolve) => (this.#readied = resolve));
    this.#first = new Promise((resolve) => (this.#shown = resolve));
    const isCut = () => {
      const status = this.list[model.active]?.answer?.status;
      return status === "unreachable" || status === "nearest";
    };
    this.#overlay = new Overlay(model, isCut, () => this.#tell({ overlay: true }));
    this.#ladder = new Ladder(model, () => this.#tell({ ladder: true }));
    this.#follow();
    this.#overlay.update();
    this.#first.then(() => this.#ladder.update());
    model.addEventListener("change", (event) => this.#note(changeOf(event)));
    decided.then(() => this.#lanes.forEach((lane) => lane.takeWhole()));
  }

  get field() {
    return this.#overlay.field;
  }

  get ladder() {
    return this.#ladder.rungs;
  }

  get isLadderWhole() {
    return this.#ladder.isWhole;
  }

  get parts() {
    return this.#overlay.parts;
  }

  get tooNarrow() {
    return this.#overlay.tooNarrow;
  }

  /** @param {{ lane: number } | { overlay: true } | { ladder: true }} detail */
  #tell(detail) {
    this.dispatchEvent(new CustomEvent("change", { detail }));
  }

  /** @param {Change} change */
  #note(change) {
    if (change.lanes) {
      this.#follow();
    }
    for (const lane of this.#lanes) {
      lane.note(change);
    }
    this.#overlay.note(change);
    this.#ladder.note(change);
    // The model tells of a gesture's end, too.
    if (!this.#model.gesture) {
      this.#lanes.forEach((lane) => lane.settle());
    }
  }

  /** Gives each setup of the model a lane: one that has the setup already, if there is one. */
  #follow() {
    const setups = this.#model.lanes;
    const free = new Set(this.#lanes);
    /** @param {Lane | undefined} lane */
    const taken = (lane) => (lane && free.delete(lane) ? lane : undefined);
    const before = this.#lanes;
    const same = setups.map((setup, index) => {
      const fits = (/** @type {Lane | undefined} */ lane) => lane && setupKey(lane.setup) === setupKey(setup);
      return taken([before[index], ...free].find((lane) => lane && free.has(lane) && fits(lane)));
    });
    this.#lanes = setups.map((setup, index) => same[index] ?? taken(before[index]) ?? this.#newLane(setup));
    for (const lane of free) {
      lane.close();
    }
    this.list = this.#lanes.map((lane) => lane.state);
    setups.forEach((setup, index) => this.#lanes[index].change(setup));
  }

  /** @param {LaneSetup} setup */
  #newLane(setup) {
    const changed = (/** @type {Lane} */ lane) => {
      const index = this.#lanes.indexOf(lane);
      this.#shown();
      if (index >= 0) {
        this.#tell({ lane: index });
        this.#overlay.update();
      }
    };
    return new Lane(this.#model, setup, changed, (engines, kind) => {
      const isWhole = kind === "whole";
      if (isWhole || this.engines.length === 0) this.engines = engines;
      if (isWhole) this.#readied();
    });
  }

  /**
   * Asks the helper once for each key, when the first lane has something to show; keeps the answer.
   * @param {string} key
   * @param {() => Promise<any>} ask
   */
  #once(key, ask) {
    const known = this.#known.get(key) ?? this.#first.then(ask);
    this.#known.set(key, known);
    known.catch(() => this.#known.delete(key));
    return known;
  }

  /**
   * @param {number} k
   * @returns {Promise<Int32Array>}
   */
  moves(k) {
    return this.#once(`moves ${k}`, () => this.#helper.ask({ type: "moves", k }));
  }

  /**
   * @param {LaneSetup} setup
   * @returns {Promise<string>}
   */
  check(setup) {
    const onLand = this.#model.costs !== null;
    const request = /** @type {const} */ ({ type: "check", setup: { ...setup }, onLand });
    return this.#once(`${onLand} ${setupKey(setup)}`, () => this.#helper.ask(request));
  }

  /**
   * @param {LaneSetup} setup
   * @param {number[]} ks
   * @returns {Promise<(number | null)[]>}
   */
  bounds(setup, ks) {
    return this.#first.then(() => this.#helper.ask({ type: "bounds", setup: { ...setup }, ks }));
  }

  /** @param {number} index */
  cancel(index) {
    this.#lanes[index]?.cancel();
  }

  /** @param {number} index */
  retry(index) {
    this.#lanes[index]?.retry();
  }

  /**
   * @param {File[]} files
   * @returns {Promise<{ name: string, width: number, height: number, cells: Uint8Array }>}
   */
  async readMap(files) {
    const read = await Promise.all(files.map(bytesOf));
    const reader = new Helper();
    try {
      return await reader.ask(
        { type: "read", files: read },
        read.map(({ bytes }) => bytes.buffer),
      );
    } finally {
      // A large map leaves much memory behind.
      reader.stop("");
    }
  }

  /**
   * @param {File} file
   * @returns {Promise<Queries>}
   */
  async readScenario(file) {
    const { width, height } = this.#model;
    return this.#helper.ask({ type: "scenario", width, height, ...(await bytesOf(file)) });
  }

  /**
   * @param {number} index
   * @returns {Promise<Blob>}
   */
  trace(index) {
    return this.#order(index, { type: "trace" });
  }

  /**
   * @param {number} index
   * @param {"png" | "svg"} format
   * @returns {Promise<Blob>}
   */
  picture(index, format) {
    return this.#order(index, { type: "picture", format, overlay: this.#model.overlay });
  }

  /**
   * @param {number} index
   * @param {Order} order
   */
  #order(index, order) {
    return this.#lanes[index]?.order(order) ?? Promise.reject(new Error("There is no such lane."));
  }

  /** The lane of the active setup, for the agents. Not for others. */
  get activeLane() {
    return this.#lanes[this.#model.active];
  }
}

/**
 * @param {File} file
 * @returns {Promise<{ name: string, bytes: Uint8Array<ArrayBuffer> }>}
 */
async function bytesOf(file) {
  if (file.size > LARGEST_FILE) {
    throw new Error(`${file.name} is larger than any map that this page takes.`);
  }
  try {
    return { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
  } catch (error) {
    throw new Error(`${file.name} could not be read: ${sentence(textOf(error))}`);
  }
}
