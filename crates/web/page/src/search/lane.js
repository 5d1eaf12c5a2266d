// One lane, on the page's side: it asks its worker what the scene asks for. The latest query wins: at most
// one is under way, and the one that waits is always that of the scene as it is.

/** @import { Change, LaneSetup, Model } from "../../types.js" */
/** @import { EngineInfo } from "../../mediant/mediant.js" */
/** @import { OfQuery, Walked } from "./engine.js" */
/** @import { Walk } from "./protocol.js" */
/** @import { Sent } from "./when.js" */
import { Engine } from "./engine.js";
import { BROKEN, sentence, setupKey } from "./protocol.js";
import { Shown } from "./shown.js";
import { PAUSE, whatNow } from "./when.js";

/** What is over before this (ms) is not shown as under way. */
const SHOWN = 60;
/** Searches up to this size are recorded while a gesture is under way. */
const MOST_RECORDED = 100_000;
/** A worker whose memory has grown beyond this is replaced with the map, as memory never shrinks. */
const MOST_MEMORY = 2 ** 28;

export class Lane {
  /** @type {LaneSetup} */
  setup;
  #model;
  #shown;
  #engine;
  /** Whether the scene has changed since the last query. */
  #isWanted = true;
  /** Whether more than the ends has changed since then. */
  #isOther = false;
  /** The query under way. @type {Sent | null} */
  #sent = null;
  #number = 0;
  /** Whether the last query was that of a gesture, so that something is left for its end. */
  #hurry = false;
  /** What an edit costs, in ms: the mean of the last ones, the later the more. */
  #took = 0;
  #pauseEnds = 0;
  #memory = 0;
  #timers = { show: 0, pause: 0 };

  /**
   * @param {Model} model
   * @param {Readonly<LaneSetup>} setup
   * @param {(lane: Lane) => void} changed
   * @param {(engines: EngineInfo[]) => void} readied
   */
  constructor(model, setup, changed, readied) {
    this.#model = model;
    this.setup = { ...setup };
    this.#shown = new Shown(() => changed(this));
    this.#engine = new Engine(model, {
      readied: (engines) => {
        readied(engines);
        this.#pump();
      },
      heard: (message) => this.#hear(message),
      died: (why, wasReady) => this.#died(why, wasReady),
    });
  }

  get state() {
    return this.#shown.state;
  }

  /** Another worker takes the place of the one. */
  #replace() {
    this.#sent = null;
    this.#memory = 0;
    this.#engine.replace();
  }

  close() {
    clearTimeout(this.#timers.show);
    clearTimeout(this.#timers.pause);
    this.#engine.close("The lane was removed.");
  }

  /**
   * The model has changed.
   * @param {Change} change
   */
  note(change) {
    this.#engine.note(change);
    if (change.map) {
      [this.state.index, this.state.answer] = [null, null];
      if (this.#memory > MOST_MEMORY || this.#sent?.isPreparing) {
        this.#replace();
      }
    }
    if (change.map || change.cells || change.wishes) {
      this.#want(true);
    } else if (change.ends) {
      // Where the engine has failed, it would fail again.
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
    if (this.#engine.isDead) {
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
        this.#engine.tell("refine");
      } else {
        this.#want(false);
      }
    }
    this.#pump();
  }

  cancel() {
    if (!this.#sent && this.#engine.isReady) {
      return;
    }
    this.#isWanted = false;
    if (this.#sent?.isPreparing) {
      this.#replace();
    } else {
      this.#engine.tell("cancel");
    }
    this.#sent = null;
    this.#hurry = false;
    this.#shown.phase("cancelled");
  }

  retry() {
    this.#want(true);
    this.#shown.phase("starting");
    this.#pump();
  }

  /** Sends what is to be sent, if it is time. */
  #pump() {
    if (this.#isWanted && this.#engine.isReady) {
      const now = performance.now();
      const what = whatNow({
        now,
        gesture: this.#model.gesture,
        took: this.#took,
        pauseEnds: this.#pauseEnds,
        sent: this.#sent,
        isOther: this.#isOther,
      });
      if (what === "send") {
        this.#send();
      } else if (what === "replace") {
        this.#replace();
      } else if (what !== "await") {
        clearTimeout(this.#timers.pause);
        this.#timers.pause = setTimeout(() => this.#pump(), what.until - now + 1);
      }
    }
    if (!this.#isWanted && this.#engine.isReady) {
      this.#engine.sendWalk();
    }
  }

  #send() {
    const { start, goal, nearest, radius, gesture } = this.#model;
    const number = ++this.#number;
    const hurry = gesture !== "";
    const record = !hurry || (this.state.answer?.expanded ?? 0) < MOST_RECORDED;
    [this.#isWanted, this.#isOther] = [false, false];
    this.#sent = { number, at: performance.now(), isPreparing: false, tells: false };
    this.#hurry = hurry;
    this.#engine.ask({
      number,
      setup: this.setup,
      radius,
      start: [...start],
      goal: [...goal],
      nearest,
      hurry,
      record,
    });
    clearTimeout(this.#timers.show);
    this.#timers.show = setTimeout(() => this.#sent && this.#shown.work(this.#sent.isPreparing), SHOWN);
  }

  /** @param {OfQuery} message */
  #hear(message) {
    if (message.type === "timing" || message.type === "reference") {
      this.#shown.complete(message);
    } else if (message.type === "failed" && message.broken) {
      this.#broke(message.message);
    } else if (message.number === this.#sent?.number) {
      this.#hearQuery(message, this.#sent);
    }
  }

  /**
   * @param {Exclude<OfQuery, { type: "timing" | "reference" }>} message
   * @param {Sent} sent
   */
  #hearQuery(message, sent) {
    switch (message.type) {
      case "preparing":
        sent.isPreparing = true;
        break;
      case "progress":
        sent.tells = true;
        this.#shown.progress(message);
        break;
      case "prepared":
        sent.isPreparing = false;
        // Without an edit it is not known whether one is quick: the first one tells.
        this.#took = message.wasEdit ? (this.#took + message.took) / 2 : sent.tells ? message.took : 0;
        this.#shown.prepared(message);
        break;
      case "searching":
        this.#shown.searching(message);
        break;
      case "answer":
        [this.#sent, this.#memory] = [null, message.memory];
        this.#shown.answer(message, this.#isWanted);
        this.#model.gesture ? this.#pump() : this.settle();
        break;
      case "failed":
        this.#sent = null;
        this.#shown.fail(message.message);
        this.#pump();
    }
  }

  /** @param {string} message */
  #broke(message) {
    this.state.index = null;
    this.#isWanted = false;
    this.#replace();
    this.#shown.fail(message);
  }

  /**
   * @param {string} why
   * @param {boolean} wasReady
   */
  #died(why, wasReady) {
    if (wasReady) {
      this.#broke(BROKEN);
      return;
    }
    // Another one would not start either, until the user tries again.
    this.#isWanted = false;
    this.#shown.fail(`The engines could not be loaded: ${sentence(why)}`);
  }

  /**
   * Has agents' errands done, when the worker knows the scene. `heard` is told what is done, and null if the
   * rest will not be.
   * @param {Walk} walk
   * @param {(message: Walked | null) => void} heard
   */
  walk(walk, heard) {
    this.#engine.takeWalk(walk, heard);
    this.#pump();
  }

  /**
   * @param {Parameters<Engine["order"]>[0]} order
   * @returns {Promise<Blob>}
   */
  order(order) {
    if (!this.#engine.isReady || !this.state.answer) {
      return Promise.reject(new Error("This lane has no answer yet. Wait for it, or choose another lane."));
    }
    return this.#engine.order(order);
  }
}
