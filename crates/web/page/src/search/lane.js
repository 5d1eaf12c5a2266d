// One lane, on the page's side: it asks its worker what the scene asks for, and keeps what the page shows of
// it. The latest query wins: at most one is under way, and the one that waits is always that of the scene as
// it is.

/** @import { Change, LaneAnswer, LaneSetup, LaneState, Model } from "../../types.js" */
/** @import { EngineInfo } from "../../mediant/mediant.js" */
/** @import { Ask, FromLane, Order, Reply, ToLane, Walk } from "./protocol.js" */
/** @import { Sent } from "./when.js" */
/** @import { Kind } from "../workers.js" */
import { loadWhole, standsIn } from "../workers.js";
import { buffersOf, Feed } from "./feed.js";
import { Orders } from "./orders.js";
import { BROKEN, bestKey, setupKey } from "./protocol.js";
import { Remote } from "./remote.js";
import { kindFor } from "./stand-in.js";
import { PAUSE, whatNow } from "./when.js";

/** The time (ms) after which a query is shown as under way. */
const SHOWN = 60;
/** Searches up to this size are recorded while a gesture is under way. */
const MOST_RECORDED = 100_000;
/** A worker whose memory has grown beyond this is replaced with the map, as memory never shrinks. */
const MOST_MEMORY = 2 ** 28;

/** @typedef {Exclude<FromLane, Reply>} Heard */
/** @typedef {Extract<FromLane, { type: "walked" }>} Walked */
/** @typedef {Remote<ToLane, Heard>} LaneWorker */

/** A worker that was started ahead. @type {LaneWorker | null} */
let spare = null;

/** Starts the worker of the first lane while the page is still put together. */
export function warm() {
  spare ??= new Remote("lane", standsIn() ? "light" : "whole");
}

export class Lane {
  /** @type {LaneSetup} */
  setup;
  /** @type {LaneState} */
  state = {
    phase: "starting",
    progress: null,
    expanded: 0,
    message: "",
    answer: null,
    stale: true,
    index: null,
  };
  #model;
  #changed;
  #readied;
  /** The changes of the map that the worker does not know yet. */
  #feed;
  /** @type {LaneWorker} */
  #remote;
  #isReady = false;
  /** Whether the worker could not be loaded. */
  #isDead = false;
  /** Whether the scene has changed since the last query. */
  #isWanted = true;
  /** Whether more than the ends has changed since then. */
  #isOther = false;
  /** The query under way. @type {Sent | null} */
  #sent = null;
  #number = 0;
  /** The number of the answer. */
  #answered = 0;
  /** The last shortest path at any angle, and its scene: it is the same for all k.
   *  @type {{ scene: string, reference: LaneAnswer["reference"] }} */
  #best = { scene: "", reference: null };
  /** Whether the last query was that of a gesture, so that something is left for its end. */
  #hurry = false;
  /** The time of an edit, in ms: a mean of the last ones, in which later ones weigh more. */
  #took = 0;
  #pauseEnds = 0;
  #memory = 0;
  #timers = { show: 0, pause: 0 };
  /** Files that wait until the worker can write them. */
  #orders = new Orders();
  /** The agents' errands, and who hears what became of them. */
  /** @type {{ walk: Walk, heard: (message: Walked | null) => void, isSent: boolean } | null} */
  #walk = null;

  /**
   * @param {Model} model
   * @param {Readonly<LaneSetup>} setup
   * @param {(lane: Lane) => void} changed
   * @param {(engines: EngineInfo[], kind: Kind) => void} readied
   */
  constructor(model, setup, changed, readied) {
    this.#model = model;
    this.setup = { ...setup };
    this.#changed = changed;
    this.#readied = readied;
    this.#feed = new Feed(model);
    this.#remote = this.#start();
  }

  /** Whether the worker has the light package. */
  get #isLight() {
    return this.#remote.kind === "light";
  }

  #start() {
    const kind = kindFor(this.setup.engine, this.#model);
    if (kind === "whole") loadWhole();
    const isFit = spare?.kind === kind;
    if (!isFit) spare?.close("");
    /** @type {LaneWorker} */
    const remote = isFit && spare ? spare : new Remote("lane", kind);
    spare = null;
    remote.listen(
      (message) => this.#hear(message),
      (why) => this.#died(why),
    );
    return remote;
  }

  /** Another worker takes the place of one that is broken, or that cannot be stopped otherwise. */
  #replace() {
    this.#end("The engine was stopped.");
    [this.#sent, this.#memory] = [null, 0];
    this.#isReady = this.#isDead = false;
    this.#feed.reset();
    this.#remote = this.#start();
  }

  /** A worker with the whole package takes over. It is asked again what the light one has answered. */
  takeWhole() {
    if (!this.#isLight) return;
    this.#isWanted ||= this.#sent !== null || this.state.phase === "done";
    this.#replace();
  }

  /** @param {string} why - The message to those who wait for something. */
  #end(why) {
    this.#remote.close(why);
    this.#endWalk()?.heard(null);
  }

  #endWalk() {
    const walk = this.#walk;
    this.#walk = null;
    return walk;
  }

  close() {
    clearTimeout(this.#timers.show);
    clearTimeout(this.#timers.pause);
    this.#end("The lane was removed.");
    this.#orders.refuse("The lane was removed.");
  }

  /**
   * The model has changed.
   * @param {Change} change
   */
  note(change) {
    this.#feed.note(change);
    if (change.map) {
      [this.state.index, this.state.answer] = [null, null];
      if (this.#memory > MOST_MEMORY || this.#sent?.isPreparing) {
        this.#replace();
      }
    }
    if (change.map || change.cells || change.wishes) {
      this.#want(true);
    } else if (change.ends) {
      // An engine that has failed is not asked again: other ends would not help.
      this.#want(false);
    }
    if (change.cells && this.#model.gesture === "cells") {
      this.#pauseEnds = performance.now() + PAUSE;
    }
    this.#pump();
  }

  /**
   * The lane gets another setup.
   * @param {Readonly<LaneSetup>} setup
   */
  change(setup) {
    if (setupKey(setup) === setupKey(this.setup)) {
      return;
    }
    if (setup.placement !== this.setup.placement) {
      this.state.answer = null;
    }
    this.setup = { ...setup };
    this.state.index = null;
    if (this.#sent?.isPreparing) {
      this.#replace();
    }
    this.#want(true);
    this.#pump();
  }

  /** @param {boolean} isOther */
  #want(isOther) {
    const { state } = this;
    state.stale = true;
    if (state.phase === "failed" && !isOther) {
      return;
    }
    this.#isWanted = true;
    this.#isOther ||= isOther;
    if (this.#isDead) {
      this.#replace();
    }
  }

  /** A gesture has ended: what was left for its end is done. */
  settle() {
    this.#pauseEnds = 0;
    const { answer } = this.state;
    if (!this.#isWanted && !this.#sent && this.#hurry && answer) {
      this.#hurry = false;
      if (answer.steps || answer.status === "invalid") {
        this.#remote.post({ type: "refine" });
      } else {
        this.#want(false);
      }
    }
    this.#pump();
  }

  cancel() {
    if (!this.#sent && this.#isReady) {
      return;
    }
    this.#isWanted = false;
    if (this.#sent?.isPreparing) {
      this.#replace();
    } else {
      this.#remote.post({ type: "cancel" });
    }
    this.#sent = null;
    this.#hurry = false;
    this.#show("cancelled");
  }

  retry() {
    this.#want(true);
    this.#show("starting");
    this.#pump();
  }

  /** Sends what is to be sent, if it is time. */
  #pump() {
    if (this.#isWanted && this.#isLight && kindFor(this.setup.engine, this.#model) === "whole") {
      this.#replace();
      this.#show("starting");
    }
    if (this.#isWanted && this.#isReady) {
      const now = performance.now();
      const { gesture } = this.#model;
      const [took, pauseEnds, sent, isOther] = [this.#took, this.#pauseEnds, this.#sent, this.#isOther];
      const what = whatNow({ now, gesture, took, pauseEnds, sent, isOther });
      if (what === "send") {
        this.#send();
      } else if (what === "replace") {
        this.#replace();
      } else if (what !== "await") {
        clearTimeout(this.#timers.pause);
        this.#timers.pause = setTimeout(() => this.#pump(), what.until - now + 1);
      }
    }
    // Errands come after all that the worker must know before.
    if (!this.#isWanted && this.#isReady && this.#walk && !this.#walk.isSent) {
      this.#walk.isSent = true;
      this.#remote.post(this.#walk.walk);
    }
    // The light package writes no files.
    if (!this.#isWanted && this.#isReady && !this.#isLight) {
      this.#orders.send(this.#remote);
    }
  }

  #send() {
    const { start, goal, nearest, radius, gesture } = this.#model;
    const number = ++this.#number;
    const hurry = gesture !== "";
    const record = !hurry || (this.state.answer?.expanded ?? 0) < MOST_RECORDED;
    [this.#isWanted, this.#isOther] = [false, false];
    const scene = bestKey(this.#model, this.setup);
    this.#sent = { number, at: performance.now(), isPreparing: false, tells: false, scene };
    this.#hurry = hurry;
    const news = this.#feed.take();
    /** @type {Ask} */
    const ask = {
      type: "ask",
      number,
      news,
      setup: this.setup,
      radius,
      start: [...start],
      goal: [...goal],
      nearest,
      hurry,
      record,
    };
    this.#remote.post(ask, buffersOf(news));
    clearTimeout(this.#timers.show);
    this.#timers.show = setTimeout(() => {
      if (this.#sent) {
        this.state.expanded = 0;
        this.#show(this.#sent.isPreparing ? "preparing" : "searching");
      }
    }, SHOWN);
  }

  /** @param {Heard} message */
  #hear(message) {
    switch (message.type) {
      case "ready":
        this.#isReady = true;
        this.#readied(message.engines, this.#remote.kind);
        this.#pump();
        break;
      case "walked":
        if (this.#walk?.walk.id === message.id) {
          (message.over ? this.#endWalk() : this.#walk)?.heard(message);
        }
        break;
      case "timing":
      case "reference":
        this.#complete(message);
        break;
      default:
        if (message.type === "failed" && message.broken) {
          this.#broke(message.message);
        } else if (message.number === this.#sent?.number) {
          this.#hearQuery(message, this.#sent);
        }
    }
  }

  /**
   * @param {Exclude<Heard, { type: "ready" | "walked" | "timing" | "reference" }>} message
   * @param {Sent} sent
   */
  #hearQuery(message, sent) {
    const { state } = this;
    switch (message.type) {
      case "preparing":
        sent.isPreparing = true;
        break;
      case "progress":
        sent.tells = true;
        state.progress = { stage: message.stage, done: message.done, total: message.total };
        this.#show("preparing");
        break;
      case "prepared":
        sent.isPreparing = false;
        // Without an edit it is not known whether one is quick: the first one tells.
        this.#took = message.wasEdit ? (this.#took + message.took) / 2 : sent.tells ? message.took : 0;
        // It says how long that took, which is for the whole package to tell.
        state.index = (!this.#isLight && message.index) || state.index;
        if (state.phase === "preparing") {
          this.#show("searching");
        }
        break;
      case "searching":
        state.expanded = message.expanded;
        this.#show("searching");
        break;
      case "answer":
        [this.#sent, this.#memory, this.#answered] = [null, message.memory, message.number];
        this.#take(message.answer, sent.scene);
        this.#show("done");
        this.#model.gesture ? this.#pump() : this.settle();
        break;
      case "failed":
        this.#sent = null;
        this.#fail(message.message);
        this.#pump();
    }
  }

  /** @param {LaneAnswer} answer @param {string} scene */
  #take(answer, scene) {
    const { state } = this;
    // The whole package tells how long a query takes.
    answer.settled &&= !this.#isLight;
    if (state.answer && !state.stale) {
      // Nothing has changed: it answers again what the light one has answered, and only times are others.
      [state.answer.ms, state.answer.settled] = [answer.ms, answer.settled];
      return;
    }
    [state.answer, state.expanded] = [answer, answer.expanded];
    this.#keep(scene, answer);
    state.stale = this.#isWanted;
  }

  /**
   * Completes the answer by its time or its reference, which come later. It stays the same object.
   * @param {Extract<Heard, { type: "timing" | "reference" }>} message
   */
  #complete(message) {
    const { answer } = this.state;
    if (!answer || message.number !== this.#answered) {
      return;
    }
    if (message.type === "timing") {
      if (this.#isLight) return;
      [answer.ms, answer.settled] = [message.ms, message.settled];
    } else {
      answer.reference = message.reference;
      this.#best.reference = message.reference;
    }
    this.#changed(this);
  }

  /**
   * An answer has the reference of the one before, if that is still the best: it must not flicker.
   * @param {string} scene
   * @param {LaneAnswer} answer
   */
  #keep(scene, answer) {
    const { reference } = this.#best;
    if (scene !== this.#best.scene) {
      this.#best = { scene, reference: null };
    } else if (answer.status === "found" && reference?.what === "any") {
      answer.reference = reference;
    }
  }

  /**
   * @param {LaneState["phase"]} phase
   * @param {string} [message]
   */
  #show(phase, message = "") {
    const { state } = this;
    [state.phase, state.message] = [phase, message];
    if (phase !== "preparing") {
      state.progress = null;
    }
    this.#changed(this);
  }

  /** @param {string} message */
  #fail(message) {
    this.state.answer = null;
    this.#orders.refuse(message);
    this.#show("failed", message);
  }

  /** @param {string} message */
  #broke(message) {
    this.state.index = null;
    this.#isWanted = false;
    this.#replace();
    this.#fail(message);
  }

  /** @param {string} why */
  #died(why) {
    const wasReady = this.#isReady;
    this.#isReady = false;
    this.#isDead = true;
    this.#end(why);
    if (wasReady) {
      this.#broke(BROKEN);
      return;
    }
    // Another one would not start either, until the user tries again.
    this.#isWanted = false;
    this.#fail(why);
  }

  /**
   * Has agents' errands done, when the worker knows the scene. `heard` is told what is done, and null if the
   * rest will not be.
   * @param {Walk} walk
   * @param {(message: Walked | null) => void} heard
   */
  walk(walk, heard) {
    this.#endWalk()?.heard(null);
    this.#walk = { walk, heard, isSent: false };
    this.#pump();
  }

  /**
   * @param {Order} order
   * @returns {Promise<Blob>}
   */
  order(order) {
    if (!this.state.answer) {
      return Promise.reject(new Error("This lane has no answer yet. Wait for it, or choose another lane."));
    }
    const file = this.#orders.add(order);
    this.#pump();
    return file;
  }
}
