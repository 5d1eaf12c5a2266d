// Without a network; and when the server has a new version of the page.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { appendFileSync, cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { lanes, setLanes } from "../act.mjs";
import { Site, settled } from "../browser.mjs";
import { PAGE } from "../places.mjs";

/** @typedef {import("playwright-core").Page} Page */

const folder = mkdtempSync(join(tmpdir(), "mediant-page-"));
cpSync(PAGE, folder, { recursive: true });
after(() => rmSync(folder, { recursive: true }));
const site = new Site(folder);

/** Waits until the page is kept for use without a network. @param {Page} page */
const kept = (page) => page.waitForFunction(() => navigator.serviceWorker.controller?.state === "activated");

/** Gives the server another version of the page, as the build does. @param {string} title */
function publish(title) {
  const read = (/** @type {string} */ name) => readFileSync(join(folder, name), "utf8");
  const list = JSON.parse(read("files.json"));
  const html = read("index.html").replace(/<title>.*<\/title>/, `<title>${title}</title>`);
  const digest = createHash("sha256").update(html).digest();
  writeFileSync(join(folder, "index.html"), html);
  const version = digest.toString("hex").slice(0, 16);
  list.files["index.html"] = `sha256-${digest.toString("base64")}`;
  writeFileSync(join(folder, "offline.js"), read("offline.js").replace(list.version, version));
  writeFileSync(join(folder, "files.json"), JSON.stringify({ ...list, version }));
}

test("after the first visit the page works without a network", async () => {
  const page = await site.open({ serviceWorkers: "allow" });
  await kept(page);
  await page.context().setOffline(true);
  await page.reload();
  await settled(page);
  // Engines and maps that were not used before are there, too.
  await setLanes(page, { engine: "jps" }, { engine: "anya", k: "any", placement: "corner" });
  await settled(page);
  for (const { answer } of await lanes(page)) assert.equal(answer.status, "found");
  await page.locator("#maps > summary").click();
  await page.locator("#maps").getByRole("button", { name: "Maze", exact: true }).first().click();
  await settled(page);
  for (const { answer } of await lanes(page)) assert.equal(answer.status, "found");
  // The list of files holds all that the page can ask for.
  const all = await page.evaluate(async () => {
    const name = (await caches.keys()).find((name) => name.startsWith("mediant"));
    const cache = await caches.open(name ?? "");
    const top = location.href.split("#")[0].length;
    return (await cache.keys()).map(({ url }) => url.slice(top));
  });
  const files = JSON.parse(readFileSync(join(folder, "files.json"), "utf8")).files;
  assert.deepEqual(all.sort(), Object.keys(files).sort());
});

test("a new version takes over at a reload, whole, and keeps the scene's link", async () => {
  const context = await site.context({ serviceWorkers: "allow" });
  const page = await site.open({ context });
  await kept(page);
  publish("The second");
  await page.evaluate(async () => {
    const registration = await navigator.serviceWorker.getRegistration();
    await registration?.update();
    while (!registration?.waiting) await new Promise((done) => setTimeout(done, 50));
  });
  // Two windows: a reload of one would leave the other with half of each version.
  const other = await site.open({ context });
  await page.reload();
  await settled(page);
  assert.notEqual(await page.title(), "The second");
  await other.close();
  await page.evaluate(() => history.replaceState(null, "", "#x=1"));
  // The browser may count a window for a while after it was closed.
  for (let load = 0; load < 10 && (await page.title()) !== "The second"; load += 1) {
    await page.waitForTimeout(300);
    await page.reload();
    const isSecond = () => document.title === "The second";
    await page.waitForFunction(isSecond, undefined, { timeout: 3000 }).catch(() => {});
  }
  assert.equal(await page.title(), "The second");
  assert.match(page.url(), /#x=1$/);
  const names = await page.evaluate(() => caches.keys());
  assert.equal(names.length, 1, "the old version is gone");
});

test("a version whose files are not as listed is not taken", async () => {
  const page = await site.open({ serviceWorkers: "allow" });
  await kept(page);
  const title = await page.title();
  publish("Half of a version");
  appendFileSync(join(folder, "maps/cave.map"), "\n");
  const state = await page.evaluate(async () => {
    const registration = await navigator.serviceWorker.getRegistration();
    await registration?.update().catch(() => {});
    const installing = registration?.installing;
    while (installing && installing.state === "installing") await new Promise((done) => setTimeout(done, 50));
    return { waiting: registration?.waiting !== null, caches: (await caches.keys()).length };
  });
  assert.equal(state.waiting, false);
  await page.reload();
  await settled(page);
  assert.equal(await page.title(), title);
  site.taken();
});
