// States of the robots over the whole run, or over the trial that is chosen, with the time that is shown.

import { html, id, key, seconds, svg } from "../shell/dom.js";

const ROW = 22;
const STATES = { Idle: ["idle", 0.25], HelpRequested: ["help", 0.5], RoleEstablished: ["role", 0.75], ManeuverExecuting: ["exec", 1] };

export class Timeline {
  constructor(opening, player) {
    this.robots = opening.overview.robots;
    this.verdict = opening.verdict;
    this.player = player;
    this.height = this.robots.length * (ROW + 8) + 20;
    const names = this.robots.map((robot, lane) => html("li", {}, key(lane), robot.name));
    this.picture = svg("svg", { height: this.height, role: "img", "aria-label": "States of the robots over time; the trials below say the same in numbers" });
    this.frame = html("div", { class: "tracks" }, this.picture);
    const legend = [["idle", "Idle"], ["help", "HelpRequested"], ["role", "RoleEstablished"], ["exec", "ManeuverExecuting"], ["open", "corridor open"], ["waits", "people wait"], ["crosses", "people on the road"]];
    const swatch = (kind) => svg("svg", { class: "key", width: 18, height: 12, viewBox: "0 0 18 12", "aria-hidden": "true" }, svg("rect", { width: 18, height: 12, class: kind }));
    id("timeline").append(html("div", { class: "timeline" }, html("ul", { class: "who" }, names), this.frame),
      html("ul", { class: "legend" }, legend.map(([kind, words]) => html("li", {}, swatch(kind), words)),
        this.verdict.at === null ? "" : html("li", {}, svg("svg", { class: "key", width: 12, height: 12, viewBox: "0 0 12 12", "aria-hidden": "true" }, svg("path", { d: "M6 0l6 11H0Z", class: "bad" })), "first record that is not valid")));
    this.picture.addEventListener("click", (event) => {
      const box = this.picture.getBoundingClientRect();
      const [from, to] = player.span;
      player.pause();
      player.seek(from + (event.clientX - box.left) / box.width * (to - from));
    });
    new ResizeObserver(() => this.redraw()).observe(this.frame);
  }

  x(at) {
    const [from, to] = this.player.span;
    return (at - from) / Math.max(to - from, 1) * this.width;
  }

  redraw() {
    this.width = Math.max(this.frame.clientWidth, 100);
    this.picture.setAttribute("width", this.width);
    const shapes = [];
    const block = (from, to, y, height, kind, text, label) => {
      const [left, right] = [Math.max(this.x(from), 0), Math.min(this.x(to), this.width)];
      if (right < 0 || left > this.width || right < left) return;
      const width = Math.max(right - left, 1);
      shapes.push(svg("rect", { x: left.toFixed(1), y, width: width.toFixed(1), height, class: kind }, svg("title", {}, `${seconds(from)} s to ${seconds(to)} s: ${text}`)));
      if (label && width > label.length * 6.4 + 8) shapes.push(svg("text", { x: left + 4, y: y + height - 4, class: kind === "exec" ? "on-exec" : "on-block" }, label));
    };
    this.robots.forEach((robot, lane) => {
      const bottom = lane * (ROW + 8) + ROW;
      for (const { from, to, state, text } of robot.states) {
        const [kind, part] = STATES[state];
        block(from, to, bottom - ROW * part, ROW * part, kind, `${robot.name}: ${state} ${text}`, part > 0.6 ? text : "");
      }
      for (const [from, to] of robot.waiting) block(from, to, bottom + 1, 3, "waits", "people wait");
      for (const [from, to] of robot.crossing) block(from, to, bottom + 1, 3, "crosses", "people on the road");
      for (const [from, to, why] of robot.corridor) block(from, to, bottom + 4, 3, "open", `corridor open; closed: ${why || "end of the log"}`);
    });
    const [from, to] = this.player.span;
    const step = [1, 2, 5].flatMap((it) => [0.001, 0.01, 0.1, 1, 10, 100, 1000, 1e4, 1e5].map((power) => it * power)).sort((a, b) => a - b).find((it) => it * 1e6 / Math.max(to - from, 1) * this.width > 64) ?? 1e6;
    for (let at = Math.ceil(from / 1e6 / step) * step; at * 1e6 <= to; at += step) {
      const x = this.x(at * 1e6);
      shapes.push(svg("line", { x1: x, y1: this.height - 18, x2: x, y2: this.height - 12, class: "tick" }));
      const label = `${Number(at.toFixed(3))} s`;
      if (x + 3 + label.length * 7 < this.width) shapes.push(svg("text", { x: x + 3, y: this.height - 3, class: "tick-text" }, label));
    }
    if (this.verdict.at !== null) {
      const x = Math.min(Math.max(this.x(this.verdict.at), 6), this.width - 6);
      shapes.push(svg("path", { d: `M${x} ${this.height - 18}l6 11h-12Z`, class: "bad" }, svg("title", {}, this.verdict.sentences.join(" "))));
    }
    this.now = svg("line", { y1: 0, y2: this.height - 12, class: "now" });
    this.picture.replaceChildren(...shapes, this.now);
    this.draw();
  }

  draw() {
    if (!this.now) return;
    const x = this.x(this.player.at);
    this.now.setAttribute("x1", x);
    this.now.setAttribute("x2", x);
  }
}
