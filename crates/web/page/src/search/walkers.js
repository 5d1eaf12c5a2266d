// Agents that walk to the goal with the active lane's engine. When cells change, only the agents whose way
// comes near the change are looked at, and only those whose way no longer holds get another one.

/** @import { Change, Model, Rect, Walkers as Contract } from "../../types.js" */
/** @import { ErrandDone, FromLane } from "./protocol.js" */
/** @import { Agent } from "./agent.js" */
/** @import { Lanes } from "./lanes.js" */
import { MOST_AGENTS } from "../model/setups.js";
import { errandOf, mayWalk, need, newAgent, take } from "./agent.js";
import { changeOf, motionKey, setupKey } from "./protocol.js";
import { advance, meets, offsetOf } from "./walk.js";

/** The time for which another way is marked, and the stay of an agent at the goal, in ms. */
const [FRESH, REST] = [700, 1000];
/** The wait for another worker, in ms. */
const AGAIN = 200;
/** Walking is no faster than this after a pause of the page, in ms. */
const LONGEST_FRAME = 100;

/**
 * @typedef {object} Batch
 * @property {number} id
 * @property {Lanes["activeLane"]} lane
 * @property {string} motion - Of the paths.
 * @property {number} offset
 * @property {Map<number, number>} wishes - The `wish` of each agent that is asked.
 * @property {boolean} isEdit - Whether cells have changed.
 * @property {number} successes
 */

/** @implements {Contract} */
export class Walkers extends EventTarget {
  walking = false;
  /** @type {Agent[]} */
  list = [];
  #model;
  #lanes;
  #wanted = 0;
  #ids = 0;
  #frame = 0;
  #then = 0;
  /** The batch of errands under way. @type {Batch | null} */
  #batch = null;
  #batches = 0;
  /** Agents that are not on the map yet. @type {Map<number, Agent>} */
  #coming = new Map();
  /** Whether the lane could do nothing for us, so that we wait until it has an answer. */
  #isIdle = false;
  #setup = "";
  #goal = "";
  /** The agents whose way was lost since the last edit, and what finding others took, in ms. */
  #edit = { replanned: new Set(), ms: 0, isOpen: false };

  /**
   * @param {Model} model
   * @param {Lanes} lanes
   */
  constructor(model, lanes) {
    super();
    this.#model = model;
    this.#lanes = lanes;
    model.addEventListener("change", (event) => this.#note(changeOf(event)));
    lanes.addEventListener("change", () => {
      if (this.#isIdle && lanes.activeLane?.state.phase === "done") {
        this.#wake();
      }
    });
    if (model.agents) {
      this.start(model.agents);
    }
  }

  get counts() {
    const count = { walking: 0, arrived: 0, stuck: 0 };
    for (const { state } of this.list) {
      count[state]++;
    }
    const replanned = this.#edit.replanned.size;
    return { ...count, replanned, kept: Math.max(0, count.walking - replanned), ms: this.#edit.ms };
  }

  /** Cells a second. */
  get speed() {
    return Math.min(60, Math.max(4, (this.#model.width + this.#model.height) / 24));
  }

  /** @param {number} count */
  start(count) {
    this.#wanted = Math.max(0, Math.min(MOST_AGENTS, Math.floor(count)));
    if (!this.#wanted) {
      this.stop();
      return;
    }
    this.list = this.list.slice(0, this.#wanted);
    if (!this.walking) {
      this.walking = true;
      this.#then = performance.now();
      [this.#setup, this.#goal] = [this.#setupNow(), String(this.#model.goal)];
      this.#frame = requestAnimationFrame((now) => this.#step(now));
    }
    this.#wake();
    this.#tell();
  }

  stop() {
    cancelAnimationFrame(this.#frame);
    this.walking = false;
    this.list = [];
    this.#coming.clear();
    this.#wanted = 0;
    this.#batch = null;
    this.#tell();
  }

  #tell() {
    this.dispatchEvent(new CustomEvent("change"));
  }

  #setupNow() {
    const { lanes, active, radius, nearest } = this.#model;
    return lanes[active] ? `${setupKey(lanes[active])} ${radius} ${nearest}` : "";
  }

  /** @param {Change} change */
  #note(change) {
    const model = this.#model;
    if (change.agents) {
      this.start(model.agents);
    }
    if (!this.walking) {
      return;
    }
    if (change.map) {
      this.list = [];
      this.#coming.clear();
    }
    if (this.#batch && this.#batch.lane !== this.#lanes.activeLane) {
      this.#batch = null;
    }
    const [setup, goal] = [this.#setupNow(), String(model.goal)];
    if (setup !== this.#setup || goal !== this.#goal) {
      const isElsewhere = offsetOf(placementOf(setup)) !== offsetOf(placementOf(this.#setup));
      for (const agent of this.list) {
        agent.path = isElsewhere ? new Int32Array(0) : agent.path;
        need(agent, "way");
      }
    } else if (change.cells) {
      this.#noteCells(change.cells);
    }
    [this.#setup, this.#goal] = [setup, goal];
    this.#wake();
  }

  /** @param {Rect} rectangle */
  #noteCells(rectangle) {
    const { gesture, radius } = this.#model;
    // All strokes of a gesture are one edit.
    if (!this.#edit.isOpen || !gesture) {
      this.#edit = { replanned: new Set(), ms: 0, isOpen: gesture !== "" };
    }
    for (const agent of this.list) {
      if (agent.state === "stuck") {
        need(agent, "way");
      } else if (agent.state === "walking" && !agent.needs && meets(agent, rectangle, 1 + radius)) {
        need(agent, "check");
      } else if (agent.needs) {
        agent.wish++;
      }
    }
  }

  /** Asks for what agents need. One batch is under way at a time. */
  #wake() {
    const lane = this.#lanes.activeLane;
    if (!this.walking || this.#batch || !lane) {
      return;
    }
    this.#isIdle = false;
    for (let missing = this.#wanted - this.list.length - this.#coming.size; missing > 0; missing--) {
      const agent = newAgent(++this.#ids);
      this.#coming.set(agent.id, agent);
    }
    const agents = [...this.list, ...this.#coming.values()].filter(({ needs }) => needs);
    if (!agents.length) {
      return;
    }
    const [id, offset] = [++this.#batches, offsetOf(lane.setup.placement)];
    const wishes = new Map(agents.map((agent) => [agent.id, agent.wish]));
    const isEdit = agents.some(({ needs }) => needs === "check");
    this.#batch = { id, lane, motion: motionKey(lane.setup), offset, wishes, isEdit, successes: 0 };
    const { goal, nearest } = this.#model;
    const errands = agents.map((agent) => errandOf(agent, offset));
    lane.walk({ type: "walk", id, seed: id, errands, goal: [...goal], nearest }, (message) => {
      if (this.#batch?.id === id) {
        this.#hear(message, this.#batch);
      }
    });
  }

  /**
   * @param {Extract<FromLane, { type: "walked" }> | null} message
   * @param {Batch} batch
   */
  #hear(message, batch) {
    const setup = batch.lane?.setup;
    if (message && setup && motionKey(setup) === batch.motion) {
      const agents = new Map(this.list.map((agent) => [agent.id, agent]));
      for (const done of message.done) {
        const agent = agents.get(done.agent) ?? this.#coming.get(done.agent);
        if (agent) {
          this.#settle(agent, done, batch);
        }
      }
      this.#edit.ms += batch.isEdit ? message.ms : 0;
    }
    if (!message) {
      this.#batch = null;
      setTimeout(() => this.#wake(), AGAIN);
    } else if (message.over) {
      this.#batch = null;
      // Without success there is no engine or no way: we ask again when the lane has another answer.
      this.#isIdle = batch.successes === 0;
      this.#isIdle || this.#wake();
    }
    this.#tell();
  }

  /**
   * @param {Agent} agent
   * @param {ErrandDone} done
   * @param {Batch} batch
   */
  #settle(agent, done, batch) {
    const wasCheck = agent.needs === "check";
    const isLast = agent.wish === batch.wishes.get(agent.id);
    const hasWay = take(agent, done, isLast, batch.offset);
    batch.successes += Number(hasWay);
    if (wasCheck && hasWay && !done.kept) {
      this.#edit.replanned.add(agent.id);
    }
    if (this.#coming.delete(agent.id) && hasWay) {
      this.list.push(agent);
    }
  }

  /** @param {number} now */
  #step(now) {
    if (!this.walking) {
      return;
    }
    this.#frame = requestAnimationFrame((now) => this.#step(now));
    const cells = (Math.min(LONGEST_FRAME, Math.max(0, now - this.#then)) / 1000) * this.speed;
    this.#then = now;
    const { lanes, active } = this.#model;
    const offset = offsetOf(lanes[active]?.placement ?? "center");
    let isAsking = false;
    for (const agent of this.list) {
      agent.fresh &&= now - agent.since < FRESH;
      if (agent.state === "walking" && mayWalk(agent, this.#model) && advance(agent, cells, offset)) {
        [agent.state, agent.since] = ["arrived", now];
      } else if (agent.state === "arrived" && !agent.needs && now - agent.since > REST) {
        need(agent, "place");
        isAsking = true;
      }
    }
    if (isAsking) {
      this.#wake();
    }
    this.#tell();
  }
}

/** @param {string} setup - As `setupKey` writes it. */
const placementOf = (setup) => setup.split(" ")[2];
