// Files dropped on the page, and opened: maps of all formats, scenes, and broken ones.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { drop, isSentence, lanes, loadRows, message, messages, rows, scene } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";
import { movingai, pgm, pngOf, ros } from "../pictures.mjs";
import { ROOT } from "../places.mjs";

const site = new Site();
const MAP = [
  "..........",
  ".####.....",
  "....#..##.",
  "....#..#..",
  "..........",
  ".#######..",
  "..........",
];

/** @type {[string, { name: string, bytes: Uint8Array | string }[]][]} */
const WHOLE_MAPS = [
  ["a MovingAI map", [{ name: "a.map", bytes: movingai(MAP) }]],
  ["a PNG", [{ name: "a.png", bytes: pngOf(MAP) }]],
  ["a PGM", [{ name: "a.pgm", bytes: pgm(MAP) }]],
  [
    "a ROS map",
    [
      { name: "a.yaml", bytes: ros("a.pgm") },
      { name: "a.pgm", bytes: pgm(MAP) },
    ],
  ],
  [
    "a ROS map, its picture first",
    [
      { name: "a.pgm", bytes: pgm(MAP) },
      { name: "a.yaml", bytes: ros("a.pgm") },
    ],
  ],
];

test("maps are dropped", async () => {
  const page = await site.open();
  for (const [what, files] of WHOLE_MAPS) {
    await loadRows(page, ["..", ".#"], [0, 0], [1, 0]);
    await drop(page, ...files);
    await message(page, /10 × 7/);
    await settled(page);
    assert.deepEqual(await rows(page), MAP, what);
    assert.equal((await lanes(page))[0].answer.status, "found", what);
    assert.ok(await page.locator("#drop").isHidden());
    await page.locator("#messages").getByRole("button", { name: "Dismiss" }).click();
  }
});

test("a file is chosen by the button", async () => {
  const page = await site.open();
  const [chooser] = await Promise.all([
    page.waitForEvent("filechooser"),
    page.getByRole("button", { name: /^Open/ }).click(),
  ]);
  await chooser.setFiles({ name: "b.map", mimeType: "text/plain", buffer: Buffer.from(movingai(MAP)) });
  await message(page, /b\.map/);
  assert.deepEqual(await rows(page), MAP);
});

test("what is dropped is announced while it is dragged", async () => {
  const page = await site.open();
  const dataTransfer = await page.evaluateHandle(() => {
    const transfer = new DataTransfer();
    transfer.items.add(new File(["x"], "x.map"));
    return transfer;
  });
  await page.dispatchEvent("main", "dragenter", { dataTransfer });
  await page.locator("#drop").waitFor();
  await picture(page, "drop");
  await page.dispatchEvent("main", "dragleave", { dataTransfer });
  await page.locator("#drop").waitFor({ state: "hidden" });
});

const WHOLE = pngOf(MAP);
/** @type {[string, { name: string, bytes: Uint8Array | string }[]][]} */
const BROKEN = [
  ["an empty map", [{ name: "a.map", bytes: "" }]],
  [
    "a map with another number of rows",
    [{ name: "a.map", bytes: movingai(MAP).replace("height 7", "height 9") }],
  ],
  [
    "a map of huge size by its header",
    [{ name: "a.map", bytes: movingai(MAP).replace("height 7", "height 999999999") }],
  ],
  ["a PNG that was cut off", [{ name: "a.png", bytes: WHOLE.subarray(0, WHOLE.length / 2) }]],
  ["a PNG that is none", [{ name: "a.png", bytes: "<svg/>" }]],
  ["a PGM of huge size by its header", [{ name: "a.pgm", bytes: "P5\n4000000000 4000000000\n255\n" }]],
  ["a ROS map without its picture", [{ name: "a.yaml", bytes: ros("a.pgm") }]],
  [
    "a YAML file of something else",
    [
      { name: "a.yaml", bytes: "name: value\n" },
      { name: "a.pgm", bytes: pgm(MAP) },
    ],
  ],
  ["a scene that is no scene", [{ name: "a.json", bytes: "{}" }]],
  ["a scene that is no JSON", [{ name: "a.json", bytes: "{" }]],
  [
    "a scene of a wrong kind",
    [{ name: "a.json", bytes: '{"format":"mediant scene","version":1,"map":7,"rows":[]}' }],
  ],
  ["a file of another kind", [{ name: "a.exe", bytes: "MZ" }]],
];

test("broken files are refused in a sentence, and the scene stays", async () => {
  const page = await site.open();
  const before = await rows(page);
  for (const [what, files] of BROKEN) {
    await drop(page, ...files);
    const alert = page.locator("#messages").getByRole("alert");
    await alert.waitFor();
    const [text] = await messages(page);
    assert.ok(isSentence(text), `${what}: ${text}`);
    assert.deepEqual(await rows(page), before, what);
    assert.equal((await lanes(page))[0].phase, "done", what);
    if (what === "a PNG that was cut off") await picture(page, "broken-file");
    await page.locator("#messages").getByRole("button", { name: "Dismiss" }).click();
    await alert.waitFor({ state: "hidden" });
  }
});

test("a map of 8192 × 8192 cells is refused in a sentence", async (t) => {
  const page = await site.open();
  const dataTransfer = await page.evaluateHandle(() => {
    const row = `${".".repeat(8192)}\n`;
    const transfer = new DataTransfer();
    const text = ["type octile\nheight 8192\nwidth 8192\nmap\n", row.repeat(8192)];
    transfer.items.add(new File(text, "huge.map"));
    return transfer;
  });
  await page.dispatchEvent("main", "drop", { dataTransfer });
  const text = await message(page, /8192|8,192|huge\.map/);
  assert.ok(isSentence(text), text);
  t.diagnostic(text);
  await settled(page, 60_000);
  assert.equal((await scene(page)).width, 72, "the scene stays");
  await picture(page, "huge-map");
});

test("the bundled maps are whole", async () => {
  const page = await site.open();
  await drop(page, { name: "maze.map", bytes: readFileSync(join(ROOT, "crates/cli/maps/maze.map")) });
  await message(page, /maze\.map/);
  await settled(page);
  assert.equal((await lanes(page))[0].answer.status, "found");
});
