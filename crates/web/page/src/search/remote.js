// A worker with the package in it.

/** @import { Role } from "../workers.js" */
/** @import { ToLane, Request } from "./protocol.js" */
import { compiled, newWorker } from "../workers.js";

/**
 * @template {object} Heard - The messages of the worker.
 */
export class Remote {
  /** @type {Worker} */
  #worker;
  #over = false;
  /** What came before anybody listened. @type {(() => void)[]} */
  #early = [];
  /** @type {{ heard: (message: Heard) => void, died: (why: string) => void } | null} */
  #listener = null;

  /** @param {Role} role */
  constructor(role) {
    const worker = newWorker(role);
    this.#worker = worker;
    worker.onmessage = ({ data }) => this.#tell(() => this.#over || this.#listener?.heard(data));
    worker.onmessageerror = () => this.#die("a message of a worker could not be read");
    worker.onerror = (event) => {
      event.preventDefault();
      this.#die(event.message || "a worker could not be loaded");
    };
    compiled().then(
      (module) => this.#over || worker.postMessage({ type: "start", module }),
      (error) => this.#die(error instanceof Error ? error.message : String(error)),
    );
  }

  /**
   * @param {(message: Heard) => void} heard
   * @param {(why: string) => void} died - Called at most once, and not after `close`.
   */
  listen(heard, died) {
    this.#listener = { heard, died };
    this.#early.splice(0).forEach((tell) => queueMicrotask(tell));
  }

  /** @param {() => void} tell */
  #tell(tell) {
    if (this.#listener) {
      tell();
    } else {
      this.#early.push(tell);
    }
  }

  /** @param {string} why */
  #die(why) {
    if (!this.#over) {
      this.close();
      this.#tell(() => this.#listener?.died(why));
    }
  }

  /**
   * @param {ToLane | (Request & { id: number })} message
   * @param {Transferable[]} [transfer]
   */
  post(message, transfer = []) {
    if (!this.#over) {
      this.#worker.postMessage(message, transfer);
    }
  }

  /** Ends the worker, whatever it does. */
  close() {
    this.#over = true;
    this.#worker.terminate();
  }
}
