// Files that a lane is asked for, until its worker can write them.

/** @import { Order } from "./protocol.js" */

/** @typedef {{ order: Order, resolve: (file: Blob) => void, reject: (why: Error) => void }} Open */

export class Orders {
  /** @type {Open[]} */
  #open = [];

  /**
   * @param {Order} order
   * @returns {Promise<Blob>}
   */
  add(order) {
    return new Promise((resolve, reject) => this.#open.push({ order, resolve, reject }));
  }

  /** @param {{ ask: (order: Order) => Promise<Blob> }} remote */
  send(remote) {
    for (const { order, resolve, reject } of this.#open.splice(0)) remote.ask(order).then(resolve, reject);
  }

  /** @param {string} why - The message to those who wait. */
  refuse(why) {
    for (const { reject } of this.#open.splice(0)) reject(new Error(why));
  }
}
