// The time that is shown: slider, buttons, keys, playing.

import { id, seconds } from "../shell/dom.js";

const still = matchMedia("(prefers-reduced-motion: reduce)");

export class Player {
  // `show(at)` shows a time and gives the moment, with the times of its neighbours.
  constructor(opening, show) {
    this.show = show;
    this.lasted = opening.overview.lasted;
    this.span = [0, this.lasted];
    this.trials = opening.overview.trials;
    this.trial = -1;
    this.invalidAt = opening.verdict.at;
    this.at = 0;
    this.moment = null;
    this.pending = null;
    this.timer = null;
    this.slider = id("slider");
    this.slider.addEventListener("input", () => { this.pause(); this.seek(Number(this.slider.value)); });
    const click = (name, act) => id(name).addEventListener("click", act);
    click("first", () => this.seek(this.span[0]));
    click("last", () => this.seek(this.span[1]));
    click("previous", () => this.step("previous"));
    click("next", () => this.step("next"));
    click("play", () => this.toggle());
    id("trial").addEventListener("change", (event) => this.choose(Number(event.target.value)));
    id("repeats").addEventListener("change", () => this.seek(this.at));
    document.addEventListener("keydown", (event) => this.key(event));
    this.bound();
  }

  bound() {
    const [from, to] = this.span;
    this.slider.min = from;
    this.slider.max = Math.max(to, from + 1);
    this.slider.step = 1;
  }

  choose(trial) {
    this.pause();
    this.trial = trial;
    const it = this.trials[trial];
    this.span = it ? [it.from, it.to] : [0, this.lasted];
    id("trial").value = String(trial);
    this.bound();
    return this.seek(this.span[0]);
  }

  async seek(at) {
    this.at = Math.round(Math.min(Math.max(at, this.span[0]), this.span[1]));
    this.slider.value = this.at;
    const told = `${seconds(this.at)} s of ${seconds(this.span[1])} s`;
    this.slider.setAttribute("aria-valuetext", told);
    id("time").textContent = told;
    const shown = this.show(this.at).then((moment) => { this.moment = moment ?? this.moment; });
    this.pending = Promise.all([this.pending, shown]);
    return shown;
  }

  // The neighbours are those of the time that was asked for last, however fast keys are pressed.
  async step(name) {
    this.pause();
    await this.pending;
    const at = this.moment?.messages[name];
    if (at !== null && at !== undefined) return this.seek(at);
  }

  toggle() {
    if (this.timer) return this.pause();
    if (this.at >= this.span[1]) this.at = this.span[0];
    id("play").textContent = "Pause";
    let before = performance.now();
    const tick = async () => {
      const now = performance.now();
      const at = this.at + (now - before) * 1000 * Number(id("speed").value);
      before = now;
      await this.seek(at);
      if (this.timer === null) return;
      if (this.at >= this.span[1]) return this.pause();
      this.timer = setTimeout(tick, still.matches ? 500 : 60);
    };
    this.timer = setTimeout(tick, 0);
  }

  pause() {
    clearTimeout(this.timer);
    this.timer = null;
    id("play").textContent = "Play";
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const name = event.target.tagName;
    const isSlider = event.target === this.slider;
    if (name === "SELECT" || (name === "INPUT" && !isSlider && event.key === " ")) return;
    const isButton = ["BUTTON", "SUMMARY", "A"].includes(name);
    const act = {
      " ": isButton ? null : () => this.toggle(),
      ArrowLeft: () => event.shiftKey ? this.jump(-1e6) : this.step("previous"),
      ArrowRight: () => event.shiftKey ? this.jump(1e6) : this.step("next"),
      Home: () => this.jump(-Infinity),
      End: () => this.jump(Infinity),
      "[": () => this.choose(Math.max(this.trial - 1, -1)),
      "]": () => this.choose(Math.min(this.trial + 1, this.trials.length - 1)),
      v: () => this.invalidAt !== null && this.choose(-1).then(() => this.seek(this.invalidAt)),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  jump(by) {
    this.pause();
    return this.seek(this.at + by);
  }
}
