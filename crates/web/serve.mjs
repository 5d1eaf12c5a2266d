// Serves the page on this machine: `node crates/web/serve.mjs [FOLDER] [--port 8080]`.
//
// The page needs nothing but a server of files; this one is for machines that have Node.js and no other.
// Texts are sent compressed to those who take them so.

import { createReadStream } from "node:fs";
import { readFile, stat } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize, resolve, sep } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { parseArgs, promisify } from "node:util";
import { brotliCompress, constants, gzip } from "node:zlib";

/** The folder into which `cargo xtask web` writes the page. */
export const PAGE = fileURLToPath(new URL("../../target/web/page", import.meta.url));

/** @type {Record<string, string>} */
const TYPES = {
  ".css": "text/css; charset=utf-8",
  ".gz": "application/gzip",
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".json": "application/json",
  ".map": "text/plain; charset=utf-8",
  ".md": "text/markdown; charset=utf-8",
  ".mjs": "text/javascript; charset=utf-8",
  ".png": "image/png",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".webmanifest": "application/manifest+json",
};

/**
 * The file of the folder that an address means, or the status to answer with.
 * @param {string} folder
 * @param {string} address
 * @returns {Promise<{ path: string, size: number } | number | string>} a string is the address to go to
 */
async function find(folder, address) {
  let name;
  try {
    name = decodeURIComponent(address.split(/[?#]/, 1)[0]);
  } catch {
    return 400;
  }
  const path = join(folder, normalize(`/${name}`));
  // No address leads outside of the folder.
  if (name.includes("\0") || (path !== folder && !path.startsWith(folder + sep))) {
    return 404;
  }
  try {
    const found = await stat(path);
    if (!found.isDirectory()) {
      return found.isFile() ? { path, size: found.size } : 404;
    }
    if (!name.endsWith("/")) {
      // Without the slash, the addresses in the page would mean other files.
      return `./${encodeURIComponent(name.split("/").at(-1) ?? "")}/`;
    }
    const index = join(path, "index.html");
    return { path: index, size: (await stat(index)).size };
  } catch {
    return 404;
  }
}

/** Whether a file is worth compressing: a text that is not small. */
const isText = (/** @type {string} */ type, /** @type {number} */ size) =>
  size > 1000 && /^text\/|json$|\+xml$/.test(type);

/**
 * Ways to compress, the smaller one first. Brotli's best would take seconds.
 * @type {[string, (bytes: Buffer) => Promise<Buffer>][]}
 */
const WAYS = [
  ["br", (bytes) => promisify(brotliCompress)(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: 5 } })],
  ["gzip", (bytes) => promisify(gzip)(bytes)],
];

/**
 * The first way that a browser takes.
 * @param {import("node:http").IncomingMessage} request
 */
function wayFor(request) {
  const taken = String(request.headers["accept-encoding"] ?? "").split(",");
  return WAYS.find(([name]) => taken.some((way) => way.trim() === name));
}

/**
 * Answers one request.
 * @param {string} folder
 * @param {import("node:http").IncomingMessage} request
 * @param {import("node:http").ServerResponse} response
 */
async function answer(folder, request, response) {
  /** @type {Record<string, string | number>} */
  const headers = { "cache-control": "no-cache", "x-content-type-options": "nosniff" };
  const fail = (/** @type {number} */ status, /** @type {string} */ text) => {
    response.writeHead(status, { ...headers, "content-type": "text/plain; charset=utf-8" }).end(text);
  };
  if (request.method !== "GET" && request.method !== "HEAD") {
    return fail(405, "This server only gives files.");
  }
  const found = await find(folder, request.url ?? "/");
  if (typeof found === "string") {
    response.writeHead(301, { ...headers, location: found }).end();
  } else if (typeof found === "number") {
    fail(found, found === 404 ? "There is no such file." : "The address is malformed.");
  } else {
    headers["content-type"] = TYPES[extname(found.path)] ?? "application/octet-stream";
    await send(found, request, response, headers);
  }
}

/**
 * Sends a file, compressed if it is a text.
 * @param {{ path: string, size: number }} file
 * @param {import("node:http").IncomingMessage} request
 * @param {import("node:http").ServerResponse} response
 * @param {Record<string, string | number>} headers
 */
async function send({ path, size }, request, response, headers) {
  const way = wayFor(request);
  if (isText(String(headers["content-type"]), size)) {
    headers.vary = "accept-encoding";
    const bytes =
      way &&
      (await readFile(path)
        .then(way[1])
        .catch(() => null));
    if (bytes) {
      response.writeHead(200, { ...headers, "content-encoding": way[0], "content-length": bytes.length });
      return response.end(request.method === "HEAD" ? undefined : bytes);
    }
  }
  response.writeHead(200, { ...headers, "content-length": size });
  if (request.method === "HEAD") {
    return response.end();
  }
  createReadStream(path)
    .on("error", () => response.destroy())
    .pipe(response);
}

/**
 * Starts a server; port 0 takes any that is free.
 * @param {{ folder?: string, port?: number, host?: string }} [how]
 * @returns {Promise<{ address: string, close: () => Promise<void> }>}
 */
export function serve({ folder = PAGE, port = 0, host = "127.0.0.1" } = {}) {
  const root = resolve(folder);
  const server = createServer((request, response) => void answer(root, request, response));
  return new Promise((started, failed) => {
    server.once("error", failed);
    server.listen(port, host, () => {
      const at = server.address();
      const used = typeof at === "object" && at ? at.port : port;
      const close = () =>
        new Promise((/** @type {(value: void) => void} */ closed) => {
          server.close(() => closed());
          server.closeAllConnections();
        });
      started({ address: `http://${host === "127.0.0.1" ? "localhost" : host}:${used}/`, close });
    });
  });
}

async function main() {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { port: { type: "string", default: "8080" }, host: { type: "string", default: "127.0.0.1" } },
  });
  const folder = resolve(positionals[0] ?? PAGE);
  if (!(await stat(join(folder, "index.html")).catch(() => null))) {
    throw new Error(`${folder} has no page: \`cargo xtask web\` makes one`);
  }
  const port = Number(values.port);
  if (!Number.isInteger(port) || port < 0 || port > 65535) {
    throw new Error(`--port ${values.port}: ports are numbers from 0 to 65535`);
  }
  const { address } = await serve({ folder, port, host: values.host });
  console.log(`${folder} is at ${address} (end with Ctrl+C)`);
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  main().catch((error) => {
    const taken =
      error.code === "EADDRINUSE" ? "another program has this port; --port 0 takes any" : error.message;
    console.error(`error: ${taken}`);
    process.exitCode = 1;
  });
}
