// A worker with the package in it, as the page holds it.

/** @import { Kind, Role } from "../workers.js" */
/** @import { Reply, Start } from "./protocol.js" */
import { compiled, newWorker } from "../workers.js";
import { BROKEN, sentence, textOf } from "./protocol.js";

/**
 * @template {object} Told - The messages to the worker, but for requests.
 * @template {{ type: string }} Heard - The messages of the worker, but for replies.
 */
export class Remote {
  #worker;
  #over = false;
  #hasSpoken = false;
  /** The messages posted before the package was there; null once it is.
   *  @type {{ message: object, transfer: Transferable[] }[] | null} */
  #unsent = [];
  /** Calls to the listener from before there was one. @type {(() => void)[]} */
  #early = [];
  /** @type {{ heard: (message: Heard) => void, died: (why: string) => void } | null} */
  #listener = null;
  /** Requests without a reply, by their ids. */
  /** @type {Map<number, { resolve: (value: any) => void, reject: (why: Error) => void }>} */
  #open = new Map();
  #count = 0;

  /** @param {Role} role @param {Kind} kind */
  constructor(role, kind) {
    this.kind = kind;
    this.#worker = newWorker(role);
    this.#worker.onmessage = ({ data }) => this.#hear(data);
    this.#worker.onmessageerror = () => this.#fail("a message of a worker could not be read");
    this.#worker.onerror = (event) => {
      event.preventDefault();
      this.#fail(event.message || "a worker could not be loaded");
    };
    compiled(kind).then(
      (module) => this.#begin({ type: "start", kind, module }),
      (error) => this.#fail(textOf(error)),
    );
  }

  /** @param {Start} start */
  #begin(start) {
    const unsent = this.#unsent ?? [];
    this.#unsent = null;
    this.#send(start, []);
    for (const { message, transfer } of unsent) {
      this.#send(message, transfer);
    }
  }

  /**
   * @param {(message: Heard) => void} heard
   * @param {(why: string) => void} died - Told why, as a sentence; at most once, and not after `close`.
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

  /** @param {Heard | Reply} message */
  #hear(message) {
    this.#hasSpoken = true;
    if (message.type === "result" || message.type === "refused") {
      this.#settle(/** @type {Reply} */ (message));
    } else {
      this.#tell(() => this.#over || this.#listener?.heard(/** @type {Heard} */ (message)));
    }
  }

  /** @param {Reply} reply */
  #settle(reply) {
    const open = this.#open.get(reply.id);
    this.#open.delete(reply.id);
    if (reply.type === "result") {
      open?.resolve(reply.value);
      return;
    }
    open?.reject(new Error(reply.message));
    if (reply.broken) {
      this.#die(reply.message);
    }
  }

  /** @param {string} why */
  #fail(why) {
    this.#die(this.#hasSpoken ? BROKEN : `The engines could not be loaded: ${sentence(why)}`);
  }

  /** @param {string} why */
  #die(why) {
    if (!this.#over) {
      this.close(why);
      this.#tell(() => this.#listener?.died(why));
    }
  }

  /**
   * @param {Told} message
   * @param {Transferable[]} [transfer]
   */
  post(message, transfer = []) {
    this.#send(message, transfer);
  }

  /**
   * @param {object} message
   * @param {Transferable[]} transfer
   */
  #send(message, transfer) {
    if (this.#unsent) {
      this.#unsent.push({ message, transfer });
    } else if (!this.#over) {
      this.#worker.postMessage(message, transfer);
    }
  }

  /**
   * Posts a request, with an id for its reply.
   * @param {object} request
   * @param {Transferable[]} [transfer]
   * @returns {Promise<any>}
   */
  ask(request, transfer = []) {
    const id = ++this.#count;
    return new Promise((resolve, reject) => {
      this.#open.set(id, { resolve, reject });
      this.#send({ ...request, id }, transfer);
    });
  }

  /**
   * Ends the worker, whatever it does.
   * @param {string} why - The message to those who wait for a reply.
   */
  close(why) {
    this.#over = true;
    this.#worker.terminate();
    for (const { reject } of this.#open.values()) {
      reject(new Error(why));
    }
    this.#open.clear();
  }
}
