// The page in all sizes and both themes, by touch, for screen readers and for eyes that see less contrast.

import assert from "node:assert/strict";
import { test } from "node:test";
import { badge, emptyRows, lanes, loadRows, place, scene, setLanes, token } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();
const SIZES = /** @type {const} */ ([
  [380, 760],
  [820, 1180],
  [1440, 900],
  [2560, 1440],
]);

for (const colorScheme of /** @type {const} */ (["light", "dark"])) {
  for (const [width, height] of SIZES) {
    test(`${width} × ${height}, ${colorScheme}: all is in the window, nothing is cut off`, async () => {
      const page = await site.open({ viewport: { width, height }, colorScheme });
      await page.waitForTimeout(200);
      await picture(page, `looks-${width}-${colorScheme}`);
      const { scroll, inner } = await page.evaluate(() => ({
        scroll: document.documentElement.scrollWidth,
        inner: innerWidth,
      }));
      assert.ok(scroll <= inner, `the page is ${scroll} wide in a window of ${inner}`);
      const cut = await page.evaluate(() => {
        const all = [...document.querySelectorAll("button, input, select, summary, output, h1, h2")];
        const isShown = (/** @type {Element} */ element) =>
          element.checkVisibility() &&
          !element.closest(".sr-only") &&
          !element.matches(".sr-only, [type=file]") &&
          element.getBoundingClientRect().width > 1;
        return all
          .filter(isShown)
          .filter((element) => {
            const { left, right } = element.getBoundingClientRect();
            return left < -1 || right > innerWidth + 1;
          })
          .map((element) => element.outerHTML.slice(0, 80));
      });
      assert.deepEqual(cut, []);
      const map = await page.locator(".stage-surface, .stage canvas").first().boundingBox();
      assert.ok(map && map.width >= Math.min(width, 700) * 0.85 && map.height > 200, JSON.stringify(map));
    });
  }
}

test("the theme is switched and kept", async () => {
  const page = await site.open({ colorScheme: "light" });
  const color = () => page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  const light = await color();
  const button = page.getByRole("button", { name: /^Theme/ });
  for (let press = 0; press < 2; press += 1) await button.click();
  const dark = await color();
  assert.notEqual(dark, light);
  await page.reload();
  await settled(page);
  assert.equal(await color(), dark);
});

test("by touch: an end is dragged, walls are drawn, two fingers zoom", async () => {
  const look = {
    viewport: { width: 390, height: 800 },
    hasTouch: true,
    isMobile: true,
    deviceScaleFactor: 2,
  };
  const page = await site.open(look);
  await setLanes(page, { engine: "astar" });
  await loadRows(page, emptyRows(20, 14), [2, 7], [15, 7]);
  const session = await page.context().newCDPSession(page);
  /** @param {"touchStart" | "touchMove" | "touchEnd"} type @param {{ x: number, y: number }[]} touchPoints */
  const touch = (type, ...touchPoints) => session.send("Input.dispatchTouchEvent", { type, touchPoints });

  const [from, to] = [await place(page, ...(await badge(page, "goal"))), await place(page, 10, 3)];
  await touch("touchStart", from);
  await touch("touchMove", { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 });
  await touch("touchMove", to);
  await touch("touchEnd");
  await settled(page);
  assert.deepEqual((await scene(page)).goal, [10, 3]);

  // The browser makes a click of a tap when it will, and none of some that follow a drag at once; before the
  // click, a finger would move the map.
  const draws = () => page.evaluate(() => /** @type {any} */ (globalThis).mediant.stage.tool === "draw");
  for (let taps = 0; taps < 5 && !(await draws()); taps += 1) {
    await page.getByRole("button", { name: /^Draw( walls|$)/ }).tap();
    for (let look = 0; look < 20 && !(await draws()); look += 1) await page.waitForTimeout(50);
  }
  assert.ok(await draws(), "a tap takes the tool");
  await touch("touchStart", await place(page, 6, 2));
  for (let y = 3; y <= 10; y += 1) await touch("touchMove", await place(page, 6, y));
  await touch("touchEnd");
  await settled(page);
  assert.equal((await lanes(page))[0].answer.status, "found");
  const walls = await page.evaluate(() =>
    /** @type {any} */ (globalThis).mediant.model.cells.reduce(
      (/** @type {number} */ sum, /** @type {number} */ cell) => sum + cell,
      0,
    ),
  );
  assert.ok(walls >= 8, `${walls} walls`);

  const width = async () => (await place(page, 10, 5)).x - (await place(page, 0, 5)).x;
  const before = await width();
  const middle = await place(page, 10, 6);
  const fingers = (/** @type {number} */ apart) => [
    { x: middle.x - apart, y: middle.y, id: 1 },
    { x: middle.x + apart, y: middle.y, id: 2 },
  ];
  await touch("touchStart", ...fingers(30));
  for (const apart of [40, 60, 80]) await touch("touchMove", ...fingers(apart));
  await touch("touchEnd");
  // Events of fingers come with the next frame.
  for (let look = 0; look < 40 && (await width()) <= before * 1.5; look += 1) await page.waitForTimeout(50);
  assert.ok((await width()) > before * 1.5, "two fingers zoom in");
  await picture(page, "touch");
});

test("every control has a name", async () => {
  const page = await site.open();
  await page.locator("#maps > summary").click();
  const session = await page.context().newCDPSession(page);
  const { nodes } = await session.send("Accessibility.getFullAXTree");
  const roles = [
    "button",
    "slider",
    "combobox",
    "checkbox",
    "radio",
    "spinbutton",
    "textbox",
    "link",
    "tab",
    "img",
    "application",
    "DisclosureTriangle",
  ];
  const controls = nodes.filter(({ ignored, role }) => !ignored && roles.includes(role?.value));
  const unnamed = controls.filter(({ name }) => !name?.value?.trim());
  assert.deepEqual(
    unnamed.map(({ role, backendDOMNodeId }) => `${role?.value} ${backendDOMNodeId}`),
    [],
  );
  assert.ok(controls.length > 40, `${controls.length} controls`);
  await picture(page, "map-menu");
});

/** The contrast of two colors, as WCAG 2 defines it. @param {number[]} a @param {number[]} b */
function contrast(a, b) {
  const [light, dark] = [a, b]
    .map((color) => {
      const [red, green, blue] = color.map((value) => {
        const part = value / 255;
        return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
      });
      return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    })
    .sort((one, other) => other - one);
  return (light + 0.05) / (dark + 0.05);
}

for (const colorScheme of /** @type {const} */ (["light", "dark"])) {
  test(`${colorScheme}: text and controls have enough contrast`, async () => {
    const page = await site.open({ colorScheme });
    for (const [front, back, least] of /** @type {const} */ ([
      ["text", "page", 7],
      ["text", "panel", 7],
      ["muted", "page", 4.5],
      ["muted", "panel", 4.5],
      ["danger", "page", 4.5],
      ["on-accent", "accent", 4.5],
      ["focus", "page", 3],
      ["accent", "page", 3],
      ["control-line", "page", 3],
      ["wall", "free", 2],
      ["reference", "page", 7],
      ["reference", "free", 7],
      ["reference", "wall", 4],
      ["reference", "land-grass", 4],
      ["reference", "land-forest", 4],
      ["reference", "land-swamp", 4],
      ["reference", "expanded-first", 4],
      ["reference", "expanded-last", 4],
      ["reference", "open", 4],
      ["agent", "page", 4],
      ["agent", "free", 4],
      ["lane-0", "free", 3],
      ["lane-1", "free", 3],
      ["lane-2", "free", 3],
      ["lane-3", "free", 2.5],
    ])) {
      const found = contrast(await token(page, front), await token(page, back));
      assert.ok(found >= least, `--${front} on --${back}: ${found.toFixed(2)}, at least ${least}`);
    }
  });
}
