// Plays the searches: as many expansions of each at the same pace, or in real time, slowed down.

import { changes, eachFrame, h, part, select, setText } from "./dom.js";
import { iconButton, setIcon } from "./icons.js";
import { count, time } from "./words.js";

/** Expansions a second. */
const PACES = [10, 30, 100, 300, 1000, 3000, 10_000, 30_000, 100_000, 1_000_000];
/** Seconds that the longest search takes. */
const SECONDS = [20, 10, 5, 2, 1];

export class PlaybackBar {
  #player;
  #play;
  #scrubber = h("input", {
    type: "range",
    min: 0,
    max: 1000,
    step: "any",
    class: "scrubber",
    "aria-label": "Position in the search",
  });
  #text = h("output", { class: "playback-text" });
  #said = "";
  #mode;
  #speed;
  #slowed = h("span", { class: "muted small slowed" });

  /** @param {import("../../types").Player} player */
  constructor(player) {
    this.#player = player;
    this.#play = iconButton("play", "Play", () => player.toggle(), "P");
    this.#scrubber.addEventListener("input", () => player.seek(Number(this.#scrubber.value)));
    this.#mode = select(
      { pace: "same pace", time: "real time" },
      (mode) => {
        player.mode = mode === "time" ? "time" : "pace";
      },
      {
        "aria-label": "How fast each lane is shown",
        title:
          "Same pace: as many expansions of each lane. " + "Real time: what each had done after as long.",
      },
    );
    const setSpeed = (/** @type {string} */ speed) => {
      player.speed = Number(speed);
    };
    this.#speed = select({}, setSpeed, { "aria-label": "Speed" });
    const first = iconButton("first", "To the beginning", () => player.seek(0));
    const last = iconButton("last", "To the end", () => player.seek(player.length));
    for (const end of [first, last]) end.toggleAttribute("data-end", true);
    part("playback", HTMLElement).append(
      first,
      iconButton("back", "One expansion back", () => player.step(-1), ","),
      this.#play,
      iconButton("forward", "One expansion on", () => player.step(1), "."),
      last,
      this.#scrubber,
      this.#text,
      h("span", { class: "playback-how" }, this.#mode, this.#speed),
      this.#slowed,
    );
    const show = eachFrame(() => this.#show());
    changes(player, show);
    show();
  }

  #show() {
    const { playing, position, length, mode } = this.#player;
    const name = playing ? "Pause" : "Play";
    if (!this.#play.title.startsWith(name)) {
      this.#play.title = `${name} (P)`;
      setIcon(this.#play, playing ? "pause" : "play");
      const label = this.#play.querySelector(".sr-only");
      if (label) label.textContent = name;
    }
    this.#scrubber.max = String(Math.max(length, 1e-9));
    this.#scrubber.value = String(position);
    this.#scrubber.style.setProperty("--at", String(length > 0 ? position / length : 1));
    const text =
      mode === "pace"
        ? `${count(Math.floor(position))} of ${count(length)} expansions`
        : `${time(position)} of ${time(length)}`;
    if (this.#said !== text) {
      this.#said = text;
      this.#text.replaceChildren(
        text.replace(/ expansions$/, ""),
        ...(mode === "pace" ? [h("span", { class: "word" }, " expansions")] : []),
      );
    }
    this.#scrubber.setAttribute("aria-valuetext", text);
    this.#scrubber.disabled = length === 0;
    this.#play.disabled = length === 0;
    this.#mode.value = mode;
    this.#showSpeed(mode, length);
  }

  /** @param {"pace" | "time"} mode @param {number} length */
  #showSpeed(mode, length) {
    const values = mode === "pace" ? PACES : SECONDS.map((seconds) => 1000 / seconds);
    const speed = this.#player.speed;
    const known = values.includes(speed) ? values : [...values, speed].sort((a, b) => a - b);
    const key = `${mode} ${known.join(" ")}`;
    if (this.#speed.dataset.key !== key) {
      this.#speed.dataset.key = key;
      this.#speed.replaceChildren(
        ...known.map((value) =>
          h("option", { value }, mode === "pace" ? `${count(value)} a second` : secondsText(1000 / value)),
        ),
      );
    }
    this.#speed.value = String(speed);
    const slower = mode === "time" && length > 0 ? 1e6 / speed / length : 0;
    setText(this.#slowed, slower > 0 ? `slowed down ${count(Number(slower.toPrecision(2)))} times` : "");
  }
}

/** @param {number} seconds */
const secondsText = (seconds) => `${Number(seconds.toPrecision(2))} s in all`;
