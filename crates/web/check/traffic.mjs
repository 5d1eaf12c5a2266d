// A relay between a browser and a server that counts the requests and the bytes.

import { connect, createServer } from "node:net";

/**
 * Starts a relay to a server on this machine. `requests` are the paths that were asked for, `bytes` all that
 * the server sent, its headers included.
 * @param {number} port of the server
 */
export async function relay(port) {
  const counted = { requests: /** @type {string[]} */ ([]), bytes: 0 };
  const server = createServer((browser) => {
    const origin = connect(port, "localhost");
    browser.on("data", (part) => {
      const asked = part.toString("latin1").matchAll(/^GET (\S+) HTTP/gm);
      counted.requests.push(...[...asked].map((match) => match[1]));
    });
    origin.on("data", (part) => (counted.bytes += part.length));
    browser.on("error", () => origin.destroy()).pipe(origin);
    origin.on("error", () => browser.destroy()).pipe(browser);
  });
  await new Promise((/** @type {(value?: unknown) => void} */ started) =>
    server.listen(0, "127.0.0.1", () => started()),
  );
  const at = server.address();
  const address = `http://localhost:${typeof at === "object" && at ? at.port : 0}/`;
  return { counted, address, close: () => server.close() };
}
