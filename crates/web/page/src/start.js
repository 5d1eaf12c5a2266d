// The first script of the page, which the build writes into its head: it sets the theme, and loads what the
// page runs.
//
// The engines and both scripts are stored compressed and unpacked here. So any server of files sends them
// compressed. All three are asked for at once: the first path waits for the last of them, not for their sum.

import "./panels/theme-first.js";
import { addressOf, unpacked } from "./files.js";
import { banner, sentence } from "./panels/message.js";

/** @import { Kind } from "./workers.js" */

/** The file of each package. @type {Record<Kind, string>} */
const ENGINES = { whole: "mediant_bg.wasm.gz", light: "light_bg.wasm.gz" };

/** The feature that this browser lacks, as a sentence; empty if it has all that are needed. */
function missing() {
  const hint = "A current browser is needed.";
  if (typeof WebAssembly !== "object") {
    return `This browser has no WebAssembly: the engines are made of it. ${hint}`;
  }
  if (typeof Worker !== "function") return `This browser has no workers: the engines run in them. ${hint}`;
  if (typeof DecompressionStream !== "function") {
    return `This browser cannot unpack files, and the page travels packed. ${hint}`;
  }
  return "";
}

/** The address of a script, unpacked. @param {string} name */
async function script(name) {
  const response = await unpacked(`${name}.gz`, "text/javascript");
  // An address in memory is no place beside which a debugger could look.
  const map = `\n//# sourceMappingURL=${addressOf(`${name}.map`)}`;
  return URL.createObjectURL(new Blob([await response.blob(), map], { type: "text/javascript" }));
}

/** The engines of a package, compiled while they load. @param {Kind} kind */
const compiled = async (kind) =>
  WebAssembly.compileStreaming(await unpacked(ENGINES[kind], "application/wasm"));

const parsed = () =>
  new Promise((/** @type {(value?: unknown) => void} */ done) => {
    if (document.readyState !== "loading") done();
    else addEventListener("DOMContentLoaded", () => done(), { once: true });
  });

async function start() {
  const why = missing();
  if (why) {
    await parsed();
    return banner(why);
  }
  // The first sight needs few engines. A link may need any: it waits for all.
  const kind = location.hash.length > 1 ? "whole" : "light";
  const engines = compiled(kind);
  // Whoever needs the engines hears that they failed, and tries again.
  engines.catch(() => {});
  const [page, worker] = await Promise.all([script("page.js"), script("worker.js"), parsed()]);
  /** @type {typeof import("./main.js")} */
  const { start } = await import(page);
  await start({ worker, kind, engines, compile: compiled });
}

start().catch(async (error) => {
  await parsed();
  banner(`The page could not start: ${sentence(error)}`);
});
