// Asks the helper worker. It is started when it is first needed, and again if it breaks.

/** @import { Kind } from "../workers.js" */
/** @import { Request } from "./protocol.js" */
import { Remote } from "./remote.js";

export class Helper {
  /** @type {Remote<never, never> | null} */
  #remote = null;

  /** @param {Kind} [kind] - The package of its worker. */
  constructor(kind = "whole") {
    this.kind = kind;
  }

  /**
   * @param {Request} request
   * @param {Transferable[]} [transfer]
   * @returns {Promise<any>}
   */
  ask(request, transfer = []) {
    this.#remote ??= this.#start();
    return this.#remote.ask(request, transfer);
  }

  #start() {
    /** @type {Remote<never, never>} */
    const remote = new Remote("helper", this.kind);
    remote.listen(
      () => {},
      (why) => this.stop(why),
    );
    return remote;
  }

  /**
   * Ends the worker, and gives its memory back.
   * @param {string} why - The message to those who wait for something.
   */
  stop(why) {
    this.#remote?.close(why);
    this.#remote = null;
  }
}
