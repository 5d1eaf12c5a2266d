// Links and files of scenes: what goes in comes out, and what is damaged is refused with a sentence.
// `SEED=… node --test` repeats a run.

import assert from "node:assert/strict";
import { test } from "node:test";
import { digest, fromRuns, toRuns } from "../page/src/model/bytes.js";
import { Random } from "../page/src/model/generate/random.js";
import { generate } from "../page/src/model/generate.js";
import { generators } from "../page/src/model/generators.js";
import { apply, decode, encode, fromFile, TOO_LARGE, toFile } from "../page/src/model/link.js";
import { bundled, loadMap } from "../page/src/model/maps.js";
import { Model } from "../page/src/model/model.js";
import { CHOICES, OVERLAYS } from "../page/src/model/setups.js";

const SEED = Number(process.env.SEED ?? 1);

/** Maps without the network: a bundled one is made up. */
async function load(source) {
  if (source.kind !== "bundled") return loadMap(source);
  const made = generate("cave", 40, 7);
  return { source, ...made };
}

function generated(name, side, seed) {
  return { kind: "generated", name, side, seed };
}

function randomSource(random) {
  switch (random.below(4)) {
    case 0:
      return { kind: "bundled", name: random.pick(bundled).name };
    case 1:
      return generated(random.pick(generators).name, random.between(32, 60), random.next());
    case 2:
      return { kind: "empty", width: random.between(1, 50), height: random.between(1, 50) };
    default:
      return { kind: "file", name: random.pick(["a.map", "größer ~.map", "地図#%25.png", ""]) };
  }
}

function randomLane(random) {
  const motion = Object.entries(CHOICES).map(([key, words]) => [key, random.pick(words)]);
  const [engine, k] = [random.pick(["astar", "lazy-theta"]), random.pick([2, 3, 12, "any"])];
  return { engine, k, ...Object.fromEntries(motion) };
}

async function randomModel(random) {
  const model = new Model();
  const source = randomSource(random);
  if (source.kind === "file") {
    const [width, height] = [random.between(1, 40), random.between(1, 40)];
    const cells = Uint8Array.from({ length: width * height }, () => (random.chance(30) ? 1 : 0));
    model.load({ source, width, height, cells, edited: random.chance(50) });
  } else {
    model.load(await load(source));
  }
  const cells = Array.from({ length: random.pick([0, 1, 30, 400]) }, () => random.below(model.cells.length));
  model.paint(cells, random.chance(50));
  if (random.chance(50)) model.paintLand(cells.slice(0, 200), random.pick([1, 2, 4, 8]));
  if (random.chance(50)) model.setCosts(cells.slice(0, 9), random.pick([1, 2, 4, 8]));
  model.moveEnd("start", [random.below(model.width), random.below(model.height)]);
  model.setLanes(Array.from({ length: random.between(1, 4) }, () => randomLane(random)));
  model.set({
    active: random.below(4),
    overlay: random.pick(OVERLAYS),
    nearest: random.chance(50),
    radius: random.pick([0, 0.5, 1.125, 1000]),
    agents: random.pick([0, 3, 400]),
  });
  return model;
}

function stateOf(model) {
  const { width, height, cells, costs, source, edited, start, goal, lanes } = model;
  const { active, overlay, nearest, radius, agents } = model;
  const shown = lanes.map((lane) => ["engine", "k", ...Object.keys(CHOICES)].map((key) => lane[key]));
  const map = { width, height, cells: [...cells], costs: costs && [...costs], source, edited, start, goal };
  return JSON.stringify({ ...map, shown, active, overlay, nearest, radius, agents });
}

/** The model must not have changed, and the error must be a sentence. */
async function refuses(work, what) {
  await assert.rejects(
    work,
    (error) => {
      assert.match(error.message, /^[A-Z].*\.$/s, what);
      return error instanceof Error;
    },
    what,
  );
}

test(`scenes come back from links and files (SEED=${SEED})`, async () => {
  for (let round = 0; round < 150; round++) {
    const random = new Random(SEED + round);
    const model = await randomModel(random);
    const state = stateOf(model);
    const link = await encode(model);
    assert.match(link, /^[\w.~-]+$/, "letters that every program leaves as they are");
    for (const text of [link, `#${link}`, link.replaceAll("~", "%7E")]) {
      const other = new Model();
      await apply(decode(text), other, load);
      assert.equal(stateOf(other), state, `SEED=${SEED} round ${round}: ${link}`);
      assert.equal(await encode(other), link);
    }
    const other = new Model();
    await apply(fromFile(await (await toFile(model)).text()), other, load);
    assert.equal(stateOf(other), state, `SEED=${SEED} round ${round}`);
  }
});

test("applying a scene is one event, and undo takes back its edits", async () => {
  const model = new Model();
  const other = new Model();
  model.load(await loadMap(generated("rooms", 64, 1)));
  model.paint([70, 71, 72], false);
  model.addLane();
  const told = [];
  other.addEventListener("change", ({ detail }) => told.push(detail));
  await apply(decode(await encode(model)), other);
  assert.equal(told.length, 1);
  assert.equal(told[0].map, true);
  assert.equal(told[0].lanes, true);
  other.undo();
  assert.equal(other.edited, false);
  assert.equal(other.canUndo, false);
});

test("links of maps that the page has are short", async () => {
  const model = new Model();
  model.load(await loadMap(generated("city", 1024, 7)));
  const link = await encode(model);
  assert.ok(link.length < 90, link);
});

test("a scene that is too large for a link is refused, and goes into a file", async () => {
  const model = new Model();
  const random = new Random(1);
  const cells = new Uint8Array(512 * 512).map(() => random.below(2));
  model.load({ source: { kind: "file", name: "x" }, width: 512, height: 512, cells });
  assert.equal(await encode(model), null);
  assert.match(TOO_LARGE, /\.$/);
  const other = new Model();
  await apply(fromFile(await (await toFile(model)).text()), other);
  assert.equal(stateOf(other), stateOf(model));
});

test(`damaged links are refused, whatever was changed (SEED=${SEED})`, async () => {
  const random = new Random(SEED);
  for (const kind of ["generated", "file"]) {
    let model = await randomModel(random);
    while (model.source.kind !== kind || !model.edited) model = await randomModel(random);
    const link = await encode(model);
    const letters = "0123456789abcXYZ-_.~ é%#";
    for (let i = 0; i < link.length; i++) {
      await refuses(decode(link.slice(0, i)), `cut at ${i}: ${link}`);
      const letter = [...letters].find((l) => l !== link[i] && random.chance(30)) ?? "!";
      await refuses(decode(link.slice(0, i) + letter + link.slice(i + 1)), `${letter} at ${i}: ${link}`);
      await refuses(decode(link.slice(0, i) + link.slice(i + 1)), `without ${i}: ${link}`);
    }
  }
  for (const foreign of ["", "#", "#section", "1", "1~", "~", "2~b.cave~x", "%", "%E0%A4%A"]) {
    await refuses(decode(foreign), foreign);
  }
});

/** A link whose check is right. */
function signed(text) {
  return `${text}~${digest(text.length, (i) => text.charCodeAt(i))}`;
}

test("links that were made by hand are checked field by field", async () => {
  const rest = "s1.1~g2.2~lastar.3.0000";
  assert.equal((await decode(signed(`1~e.5.5~${rest}~hAAAAAA`))).source.kind, "empty");
  const wrong = [
    ...[
      "e.5",
      "e.0.5",
      "e.99999.99999",
      "b.nowhere",
      "g.city.9999.1",
      "g.city.64.-1",
      "g.__proto__.64.1",
      "f.4096.4097.AAAA",
      "f.3.3.____",
      "constructor.3",
      "",
    ].map((map) => `1~${map}~${rest}`),
    ...[
      "s1.1~g2.2",
      "s1~g2.2~lastar.3.0000",
      "s1.1~g2.2~lastar.1.0000",
      "s1.1~g2.2~lastar.3.9000",
      "s1.1~g2.2~lastar.3.000",
      "s1.1~g2.2~l<b>.3.0000",
    ].map((fields) => `1~e.5.5~${fields}`),
    ...[`${"lastar.3.0000~".repeat(4)}a0`, "a1", "onowhere", "r1000001", "w10001", "z1", "s1.1", "~"].map(
      (field) => `1~e.5.5~${rest}~${field}`,
    ),
  ];
  for (const text of wrong) await refuses(decode(signed(text)), text);
  const model = new Model();
  const state = stateOf(model);
  const late = ["1~e.5.5~s1.1~g5.2~lastar.3.0000", `1~e.5.5~${rest}~hAAAAAA`, `1~e.5.5~${rest}~eAAAA`];
  for (const text of late) await refuses(apply(decode(signed(text)), model, load), text);
  assert.equal(stateOf(model), state, "nothing has changed");
});

test(`damaged files are refused (SEED=${SEED})`, async () => {
  const random = new Random(SEED + 1);
  const model = await randomModel(random);
  const text = await (await toFile(model)).text();
  for (let i = 0; i < 200; i++) await refuses(fromFile(text.slice(0, random.below(text.length - 3))), "cut");
  const whole = JSON.parse(text);
  const values = [null, 0, -1, 1.5, 1e9, "", "x", [], {}, [1], ["."], [[]], true];
  for (const key of Object.keys(whole)) {
    for (const value of values) {
      const scene = { ...whole, [key]: value };
      const other = new Model();
      const state = stateOf(other);
      // Some of these are scenes, too. The others change nothing.
      await apply(fromFile(JSON.stringify(scene)), other, load).catch((error) => {
        assert.match(error.message, /^[A-Z].*\.$/s, `${key}: ${JSON.stringify(value)}`);
        assert.equal(stateOf(other), state);
      });
      const { start, goal, width, height, cells } = other;
      assert.ok(
        [start, goal].every(([x, y]) => y * width + x in cells && x < width),
        `${key}: ${value}`,
      );
      assert.equal(cells.length, width * height);
    }
  }
});

test(`runs of numbers come back, and bytes by chance do no harm (SEED=${SEED})`, () => {
  const random = new Random(SEED + 2);
  for (let round = 0; round < 300; round++) {
    const size = random.pick([1, 100, 70_000]);
    const share = random.pick([0, 1, 50, 99, 100]);
    const numbers = Uint32Array.from({ length: size }, (_, i) => i).filter(() => random.chance(share));
    assert.deepEqual(fromRuns(toRuns(numbers, 1_000_000), size), numbers);
    const bytes = Uint8Array.from({ length: random.below(9) }, () => random.below(256));
    try {
      assert.ok(fromRuns(bytes, size).every((n) => n < size));
    } catch (error) {
      assert.match(error.message, /\.$/);
    }
  }
  assert.equal(toRuns(Uint32Array.of(1, 3, 5, 7, 9), 4), null);
});
