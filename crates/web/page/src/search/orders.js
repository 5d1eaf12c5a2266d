// What was ordered of a worker, and will come as files.

/** @import { FromLane } from "./protocol.js" */

export class Orders {
  /** @type {Map<number, { resolve: (file: Blob) => void, reject: (why: Error) => void }>} */
  #open = new Map();
  #count = 0;

  /**
   * @param {(id: number) => void} send
   * @returns {Promise<Blob>}
   */
  place(send) {
    return new Promise((resolve, reject) => {
      const id = ++this.#count;
      this.#open.set(id, { resolve, reject });
      send(id);
    });
  }

  /** @param {Extract<FromLane, { type: "result" | "refused" }>} message */
  hear(message) {
    const order = this.#open.get(message.id);
    this.#open.delete(message.id);
    if (message.type === "result") {
      order?.resolve(new Blob(message.value, { type: message.kind }));
    } else {
      order?.reject(new Error(message.message));
    }
  }

  /**
   * Nothing of it will come.
   * @param {string} why
   */
  refuse(why) {
    for (const { reject } of this.#open.values()) {
      reject(new Error(why));
    }
    this.#open.clear();
  }
}
