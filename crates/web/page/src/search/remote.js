// A worker with the package in it. The package is compiled once; each worker makes an instance of its own.

/** @import { ToLane, Request } from "./protocol.js" */

/** @type {Promise<WebAssembly.Module> | undefined} */
let module;

/**
 * The package, compiled.
 * @returns {Promise<WebAssembly.Module>}
 */
export function compiled() {
  if (!module) {
    module = compile();
    // Who asks again, tries again.
    module.catch(() => (module = undefined));
  }
  return module;
}

async function compile() {
  const response = await fetch(new URL("../../mediant/mediant_bg.wasm", import.meta.url));
  if (!response.ok) {
    throw new Error(`the server answered ${response.status} for mediant_bg.wasm`);
  }
  // A browser compiles while it loads only what the server calls by its type.
  return response.headers.get("Content-Type")?.startsWith("application/wasm")
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}

/**
 * @template {object} Heard - The messages of the worker.
 */
export class Remote {
  /** @type {Worker} */
  #worker;
  #over = false;
  #hasSpoken = false;
  /** What came before anybody listened. @type {(() => void)[]} */
  #early = [];
  /** @type {{ heard: (message: Heard) => void, died: (why: string) => void } | null} */
  #listener = null;

  /** @param {Worker} worker */
  constructor(worker) {
    this.#worker = worker;
    worker.onmessage = ({ data }) => {
      this.#hasSpoken = true;
      this.#tell(() => this.#over || this.#listener?.heard(data));
    };
    worker.onmessageerror = () => this.#die("a message of a worker could not be read");
    worker.onerror = (event) => {
      event.preventDefault();
      // A worker that is newer than the compiled package does not start with it.
      module = this.#hasSpoken ? module : undefined;
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
