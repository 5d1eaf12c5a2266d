// Asks the helper worker. It is started when it is first needed, and again if it breaks.

/** @import { Request } from "./protocol.js" */
import { sentence } from "./protocol.js";
import { Remote } from "./remote.js";

/** @typedef {{ id: number, value?: unknown, refused?: string, broken?: boolean }} Heard */

export class Helper {
  /** @type {Remote<Heard> | null} */
  #remote = null;
  /** @type {{ id: number, message: Request & { id: number }, transfer: Transferable[] }[]} */
  #early = [];
  #isReady = false;
  #count = 0;
  /** @type {Map<number, { resolve: (value: any) => void, reject: (why: Error) => void }>} */
  #open = new Map();

  /**
   * @param {Request} request
   * @param {Transferable[]} [transfer]
   * @returns {Promise<any>}
   */
  ask(request, transfer = []) {
    this.#remote ??= this.#start();
    const id = ++this.#count;
    return new Promise((resolve, reject) => {
      this.#open.set(id, { resolve, reject });
      const message = { ...request, id };
      if (this.#isReady) {
        this.#remote?.post(message, transfer);
      } else {
        this.#early.push({ id, message, transfer });
      }
    });
  }

  #start() {
    /** @type {Remote<Heard>} */
    const remote = new Remote("helper");
    const text = (/** @type {string} */ why) => `The engines could not be loaded: ${sentence(why)}`;
    remote.listen(
      (message) => this.#hear(message),
      (why) => this.stop(text(why)),
    );
    return remote;
  }

  /** @param {Heard} message */
  #hear({ id, value, refused, broken }) {
    if (id === 0) {
      this.#isReady = true;
      for (const { message, transfer } of this.#early.splice(0)) {
        this.#remote?.post(message, transfer);
      }
      return;
    }
    const open = this.#open.get(id);
    this.#open.delete(id);
    if (refused === undefined) {
      open?.resolve(value);
    } else {
      open?.reject(new Error(refused));
    }
    if (broken) {
      this.stop(refused ?? "");
    }
  }

  /**
   * Ends the worker, and gives its memory back.
   * @param {string} why - What is said to those who wait for something.
   */
  stop(why) {
    this.#remote?.close();
    this.#remote = null;
    this.#isReady = false;
    this.#early = [];
    for (const { reject } of this.#open.values()) {
      reject(new Error(why));
    }
    this.#open.clear();
  }
}
