// The page in a browser, for tests: a server, Chromium, and pages whose every complaint is a failure.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { after, afterEach, before } from "node:test";
import { chromium } from "playwright-core";
import { serve } from "../serve.mjs";
import { PAGE, chromium as program, SCREENSHOTS } from "./places.mjs";

/** @typedef {import("playwright-core").Page} Page */
/** @typedef {import("playwright-core").BrowserContext} Context */

const FLAGS = [
  "--headless",
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** The options of a window. @typedef {import("playwright-core").BrowserContextOptions} Look */

/** Starts Chromium. */
export const launch = () => chromium.launch({ executablePath: program(), args: FLAGS });

/**
 * A server and a browser for the tests of a file. Each test opens windows of its own, which are closed after
 * it. A test fails if the console has an error or a warning, if a promise is rejected and nobody looks, if a
 * request fails, or if one goes to another server.
 */
export class Site {
  /** @type {import("playwright-core").Browser} */ browser;
  /** @type {string} */ address;
  /** @type {() => Promise<void>} */ #stop;
  /** @type {Context[]} */ #contexts = [];
  /** @type {string[]} */ #complaints = [];

  /** Registers itself with node's test runner. @param {string} [folder] of the page */
  constructor(folder = PAGE) {
    before(async () => {
      const { address, close } = await serve({ folder });
      this.address = address;
      this.#stop = close;
      this.browser = await launch();
    });
    afterEach(async () => {
      const complaints = this.#complaints.splice(0);
      await Promise.all(this.#contexts.splice(0).map((context) => context.close()));
      assert.deepEqual(complaints, [], "the page complained");
    });
    after(async () => {
      await this.browser?.close();
      await this.#stop?.();
    });
  }

  /** A window of its own, with nothing stored. @param {Look} [look] */
  async context(look = {}) {
    // Storing the page for later takes time, and a page that moves by itself is no scene to begin with: a
    // test that wants them says so.
    const context = await this.browser.newContext({
      viewport: { width: 1440, height: 900 },
      serviceWorkers: "block",
      reducedMotion: "reduce",
      ...look,
    });
    this.#contexts.push(context);
    context.on("page", (page) => this.#watch(page));
    return context;
  }

  /**
   * The page, when its first path and all engines are there.
   * @param {Look & { hash?: string, context?: Context, start?: boolean }} [look] `start` false does not wait
   */
  async open({ hash = "", context, start = true, ...look } = {}) {
    const page = await (context ?? (await this.context(look))).newPage();
    await page.goto(this.address + hash);
    if (start) {
      await settled(page);
      await whole(page);
    }
    return page;
  }

  /** @param {Page} page */
  #watch(page) {
    const note = (/** @type {string} */ text) => this.#complaints.push(text);
    page.on("console", (message) => {
      const kind = message.type();
      const isOwn = message.text().includes("registration blocked by Playwright");
      if ((kind === "error" || kind === "warning") && !isOwn)
        note(`${kind}: ${message.text()} ${message.location().url}`);
    });
    page.on("pageerror", (error) => note(`error: ${error.stack ?? error.message}`));
    page.on("request", (request) => {
      const { protocol, href } = new URL(request.url());
      const isOurs = href.startsWith(this.address) || protocol === "blob:" || protocol === "data:";
      if (!isOurs) note(`request to another server: ${href}`);
    });
    page.on("requestfailed", (request) => {
      const reason = request.failure()?.errorText ?? "";
      // A window that closes aborts its open requests.
      if (reason !== "net::ERR_ABORTED") note(`request failed: ${request.url()} ${reason}`);
    });
    page.on("response", (response) => {
      if (response.status() >= 400) note(`status ${response.status()}: ${response.url()}`);
    });
  }

  /** Complaints so far, which then count no more: a test that wants one takes it. */
  taken() {
    return this.#complaints.splice(0);
  }
}

/** Waits until every lane has answered for the scene. @param {Page} page @param {number} [timeout] */
export async function settled(page, timeout = 20_000) {
  await page.waitForFunction(
    () => {
      const { lanes, model } = /** @type {any} */ (globalThis).mediant ?? {};
      const ended = (/** @type {any} */ lane) =>
        ["done", "failed", "cancelled"].includes(lane.phase) && !lane.stale;
      return lanes && lanes.list.length === model.lanes.length && lanes.list.every(ended);
    },
    undefined,
    { timeout },
  );
}

/** Waits until all engines are there, and have answered what the first few have. @param {Page} page */
export async function whole(page) {
  await page.waitForFunction(() => {
    const { list, engines } = /** @type {any} */ (globalThis).mediant.lanes;
    const isOwn = (/** @type {any} */ { index, answer, phase }) => (index || !answer) && phase !== "starting";
    return engines.length > 6 && list.every(isOwn);
  });
  await settled(page);
}

/** Keeps a picture of the page. @param {Page} page @param {string} name */
export async function picture(page, name) {
  mkdirSync(SCREENSHOTS, { recursive: true });
  await page.screenshot({ path: join(SCREENSHOTS, `${name}.png`) });
}
