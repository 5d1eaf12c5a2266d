// Starts the page: the scene, the engines, the stage and the panels.

import { decode } from "./model/link.js";
import { loadMap } from "./model/maps.js";
import { Model } from "./model/model.js";
import { Bounds } from "./panels/bounds.js";
import { changes, part } from "./panels/dom.js";
import { EnginePanel } from "./panels/engine.js";
import { Files } from "./panels/files.js";
import { startHelp } from "./panels/help.js";
import { drawIcons } from "./panels/icons.js";
import { startK } from "./panels/k.js";
import { startKeys } from "./panels/keys.js";
import { startLandLegend } from "./panels/land.js";
import { MapsMenu } from "./panels/maps-menu.js";
import { startMenus } from "./panels/menu.js";
import { say, sentence } from "./panels/message.js";
import { PlaybackBar } from "./panels/playback.js";
import { RacePanel } from "./panels/race.js";
import { ScenarioBar } from "./panels/scenario.js";
import { openScene } from "./panels/scenes.js";
import { Setups } from "./panels/setups.js";
import { AgentsPanel, ShowPanel, showSearch } from "./panels/show.js";
import { addStyles } from "./panels/styles.js";
import { startTabs } from "./panels/tabs.js";
import { startTheme } from "./panels/theme.js";
import { ToolBar } from "./panels/tools.js";
import { firstLane, isFirstVisit, mayMove, startTour } from "./panels/tour.js";
import { warm } from "./search/lane.js";
import { Lanes } from "./search/lanes.js";
import { Walkers } from "./search/walkers.js";
import { Player } from "./stage/player.js";
import { Stage } from "./stage/stage.js";
import { decided, loadWhole, provide } from "./workers.js";

/** @import { Loaded } from "./workers.js" */

/** Without a path, what comes after it is fetched so many ms after the start. */
const LATE = 10_000;

/** Loads the scene of the link. Returns whether there is one that could be loaded. @param {Model} model */
async function loadLink(model) {
  if (location.hash.length < 2) return false;
  try {
    await openScene(decode(location.hash), model);
    return true;
  } catch (error) {
    say(sentence(error), { kind: "error", key: "link" });
    return false;
  }
}

/** The scene of the link, or else the one of the first sight. @param {Model} model @param {boolean} moves */
async function firstScene(model, moves) {
  if (await loadLink(model)) return;
  model.setLanes([firstLane(moves)]);
  try {
    model.load(await loadMap({ kind: "bundled", name: "archipelago" }));
  } catch (error) {
    loadWhole();
    say(sentence(error), { kind: "error", key: "map" });
  }
}

/** Once the first path has been painted: marks when, for measurements. @param {Lanes} lanes */
function firstPath(lanes) {
  return new Promise((/** @type {(value?: unknown) => void} */ painted) => {
    let isMarked = false;
    changes(lanes, () => {
      const isThere = lanes.list.some(({ phase, answer }) => phase === "done" && answer?.path.length);
      if (isMarked || !isThere) return;
      isMarked = true;
      // The answer is drawn in the next frame, which is painted before the one after it.
      requestAnimationFrame(() =>
        requestAnimationFrame(() => {
          performance.mark("first-path");
          painted();
        }),
      );
    });
  });
}

/** Keeps the page for the time without a network. */
function keepOffline() {
  const isLocal = ["localhost", "127.0.0.1", "[::1]"].includes(location.hostname);
  if (!("serviceWorker" in navigator) || !(location.protocol === "https:" || isLocal)) return;
  navigator.serviceWorker.register("./offline.js", { updateViaCache: "none" }).catch(() => {});
}

/** @param {Model} model @param {() => void} help @param {{ isFirst: boolean, moves: boolean }} visit */
function startParts(model, help, { isFirst, moves }) {
  const lanes = new Lanes(model);
  // All engines, and then the files for use without a network, are fetched late: they do not delay the first
  // path.
  const late = new Promise((done) => setTimeout(done, LATE));
  const painted = firstPath(lanes);
  Promise.race([painted, late]).then(loadWhole);
  Promise.race([Promise.all([painted, decided]), late]).then(keepOffline);
  const player = new Player(lanes);
  const walkers = new Walkers(model, lanes);
  const stage = new Stage(part("stage", HTMLElement), model, lanes, player, walkers);
  const setups = new Setups(model, lanes);
  const failed = (/** @type {unknown} */ error) => say(sentence(error), { kind: "error", key: "engines" });
  const bounds = new Bounds(lanes, failed);
  // For tests, and for the console.
  Object.assign(globalThis, { mediant: { model, lanes, player, stage, walkers, loadMap } });

  startK(model, lanes, setups, bounds);
  new EnginePanel(model, lanes, setups);
  new RacePanel(model, lanes, player);
  player.addEventListener("use", () => showSearch(model));
  new PlaybackBar(player);
  new ShowPanel(model);
  startLandLegend(model);
  new AgentsPanel(model, walkers);
  new MapsMenu(model);
  const scenario = new ScenarioBar(model, lanes, setups);
  new Files(model, lanes, scenario);
  const tools = new ToolBar(model, stage);
  startKeys({ model, player, stage, tools, setups, scenario, help });
  addEventListener("hashchange", () => loadLink(model));
  if (isFirst) startTour({ model, lanes, setups, stage, moves, painted });
}

/** Starts the page, with what start.js has loaded. @param {Loaded} loaded */
export async function start(loaded) {
  provide(loaded);
  warm();
  addStyles();
  drawIcons(document);
  startTheme();
  startTabs();
  const help = startHelp();
  startMenus(document);
  const model = new Model();
  const isFirst = isFirstVisit();
  const moves = isFirst && mayMove();
  await firstScene(model, moves);
  return startParts(model, help, { isFirst, moves });
}
