// The server of files: only files of its folder, with the types that browsers ask for.

import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { connect } from "node:net";
import { networkInterfaces, tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { brotliDecompressSync, gunzipSync } from "node:zlib";
import { serve } from "../serve.mjs";

const parent = mkdtempSync(join(tmpdir(), "mediant-serve-"));
const folder = join(parent, "page");
const LONG = "let a = 1;\n".repeat(999);
let port = 0;
/** @type {() => Promise<void>} */
let close;

before(async () => {
  mkdirSync(join(folder, "src"), { recursive: true });
  writeFileSync(join(parent, "secret.txt"), "secret");
  mkdirSync(join(parent, "page2"));
  writeFileSync(join(parent, "page2/secret.txt"), "secret");
  writeFileSync(join(folder, "index.html"), "<title>page</title>");
  for (const name of ["a.js", "a.wasm", "a.css", "a.json", "ä b.map"])
    writeFileSync(join(folder, name), name);
  writeFileSync(join(folder, "src/index.html"), "inner");
  writeFileSync(join(folder, "long.js"), LONG);
  writeFileSync(join(folder, "long.js.gz"), LONG);
  const server = await serve({ folder });
  [port, close] = [Number(new URL(server.address).port), server.close];
});
after(async () => {
  await close();
  rmSync(parent, { recursive: true });
});

/**
 * Asks for this path as it stands: `fetch` would mend it.
 * @param {string} path @param {string} [method] @param {Record<string, string>} [headers]
 */
const ask = (path, method = "GET", headers = {}) =>
  new Promise((/** @type {(value: any) => void} */ done, failed) => {
    const asked = request({ host: "127.0.0.1", port, path, method, headers }, (response) => {
      /** @type {Buffer[]} */
      const parts = [];
      response.on("data", (part) => parts.push(part));
      response.on("end", () => {
        const bytes = Buffer.concat(parts);
        done({ status: response.statusCode, headers: response.headers, bytes, text: bytes.toString() });
      });
    });
    asked.on("error", failed).end();
  });

test("files of the folder come with their type, and are asked for anew each time", async () => {
  for (const [path, type] of [
    ["/", "text/html"],
    ["/index.html?x#y", "text/html"],
    ["/a.js", "text/javascript"],
    ["/a.wasm", "application/wasm"],
    ["/long.js.gz", "application/gzip"],
    ["/a.css", "text/css"],
    ["/a.json", "application/json"],
    ["/%C3%A4%20b.map", "text/plain"],
  ]) {
    const { status, headers, text } = await ask(path);
    assert.equal(status, 200, path);
    assert.ok(headers["content-type"]?.startsWith(type), `${path}: ${headers["content-type"]}`);
    assert.equal(headers["cache-control"], "no-cache", path);
    assert.equal(Number(headers["content-length"]), Buffer.byteLength(text), path);
  }
});

test("texts come compressed to who takes them so; what is packed or small comes as it is", async () => {
  const taking = (/** @type {string} */ ways) => ({ "accept-encoding": ways });
  for (const [ways, used, unpack] of /** @type {const} */ ([
    ["gzip, deflate, br, zstd", "br", brotliDecompressSync],
    ["gzip", "gzip", gunzipSync],
    ["identity", undefined, (/** @type {Buffer} */ bytes) => bytes],
  ])) {
    const { headers, bytes } = await ask("/long.js", "GET", taking(ways));
    assert.equal(headers["content-encoding"], used);
    assert.equal(headers.vary, "accept-encoding");
    assert.equal(Number(headers["content-length"]), bytes.length);
    assert.equal(unpack(bytes).toString(), LONG);
    const head = await ask("/long.js", "HEAD", taking(ways));
    assert.deepEqual([head.headers["content-length"], head.text], [headers["content-length"], ""]);
  }
  for (const path of ["/long.js.gz", "/a.js"]) {
    const { headers } = await ask(path, "GET", taking("gzip, br"));
    assert.equal(headers["content-encoding"], undefined, path);
  }
});

test("what lies outside of the folder is not there, however it is asked for", async () => {
  for (const path of [
    "/../secret.txt",
    "/src/../../secret.txt",
    "/%2e%2e/secret.txt",
    "/..%2fsecret.txt",
    "/src/%2e%2e/%2e%2e/secret.txt",
    "/../page2/secret.txt",
    "/..\\secret.txt",
    `/${join(parent, "secret.txt")}`,
    "/index.html%00",
  ]) {
    const { status, text } = await ask(path);
    assert.equal(status, 404, path);
    assert.ok(!text.includes("secret"), path);
  }
});

test("folders, other methods, and addresses that are none", async () => {
  const inner = await ask("/src");
  assert.equal(inner.status, 301);
  assert.equal(new URL(inner.headers.location, "http://x/src").pathname, "/src/");
  assert.equal((await ask("/src/")).text, "inner");
  assert.equal((await ask("/none.js")).status, 404);
  assert.equal((await ask("/%zz")).status, 400);
  assert.equal((await ask("/a.js", "POST")).status, 405);
  const head = await ask("/a.js", "HEAD");
  assert.deepEqual([head.status, head.text, head.headers["content-length"]], [200, "", "4"]);
});

test("by itself it is there for this machine only", async () => {
  const { address, close } = await serve({ folder });
  try {
    const { hostname, port } = new URL(address);
    assert.equal(hostname, "localhost");
    const others = Object.values(networkInterfaces()).flatMap((list) => list ?? []);
    for (const { address: host } of others.filter(({ family, internal }) => family === "IPv4" && !internal)) {
      const socket = connect({ host, port: Number(port) });
      const heard = await new Promise((done) => {
        for (const event of ["connect", "error"]) socket.once(event, () => done(event));
      });
      socket.destroy();
      assert.equal(heard, "error", `${host} is served, too`);
    }
  } finally {
    await close();
  }
});
