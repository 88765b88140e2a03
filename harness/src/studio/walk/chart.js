// The sequence chart of a run: a row for each step.

import { html, key, look, marker, svg } from "../shell/dom.js";

const ROW = 26;
const REMARKS = { arrives: "", arrivesLate: "late", arrivesLateAndAgain: "late, and not for the last time", lost: "lost", delayed: "delayed" };

export class Chart {
  // `pick` receives the number of steps that are taken up to and with a row that is clicked.
  constructor(root, names, pick) {
    this.names = names;
    this.pick = pick;
    this.lane = Math.max(26, Math.min(60, Math.floor(240 / names.length)));
    this.width = names.length * this.lane + 8;
    this.list = html("ol", { class: "rows steps", tabindex: 0, "aria-label": "Steps of the run" });
    const heads = names.map((name, lane) => html("li", {}, key(lane), name));
    root.replaceChildren(html("ul", { class: "legend lanes", "aria-label": "Columns from left to right" }, heads), this.list);
  }

  x(lane) { return 4 + this.lane / 2 + lane * this.lane; }

  // All steps; `repeatsAfter` of them come before the ones that are repeated for ever.
  fill(steps, repeatsAfter) {
    const loop = (place) => repeatsAfter !== null && repeatsAfter !== undefined && place >= repeatsAfter;
    const rows = steps.map((step, place) => this.row(step, place, loop(place)));
    if (repeatsAfter === steps.length) rows.push(html("li", { class: "turn" }, "And then nothing happens any more."));
    this.list.replaceChildren(...rows.flatMap((row, place) => place === repeatsAfter && place < steps.length
      ? [html("li", { class: "turn" }, `↻ From here on for ever: steps ${repeatsAfter + 1} to ${steps.length} again and again.`), row] : [row]));
    if (!steps.length) this.list.replaceChildren(html("li", { class: "turn" }, "Nothing has happened yet."));
  }

  // The first `count` steps are taken.
  at(count) {
    for (const row of this.list.children) {
      const number = Number(row.dataset.step);
      if (!number) continue;
      row.classList.toggle("future", number > count);
      row.classList.toggle("current", number === count);
      if (number === count) row.setAttribute("aria-current", "step"); else row.removeAttribute("aria-current");
      if (number === count) this.list.scrollTop = row.offsetTop - this.list.clientHeight * 0.6;
    }
    if (!count) this.list.scrollTop = 0;
  }

  row(step, place, isRepeated) {
    const between = step.place.between;
    const name = (lane) => this.names[lane] ?? "?";
    const remark = between ? REMARKS[between.fate] : "";
    const isWarning = between?.fate === "lost" || /crashes|hangs|breaks down|steps on the road/.test(step.action);
    const item = html("li", { class: ["row", isRepeated ? "repeated" : "", isWarning ? "warning" : ""].filter(Boolean).join(" "), "data-step": place + 1 },
      html("span", { class: "at" }, place + 1),
      this.drawing(step),
      html("span", { class: "said" },
        html("b", {}, between ? `${name(between.from)} → ${name(between.to)}` : name(step.place.at)), " ", step.action, remark ? html("span", { class: "reach" }, ` (${remark})`) : "",
        step.outputs.length ? html("span", { class: "reach outputs" }, step.outputs.join("; ")) : ""));
    item.addEventListener("click", () => this.pick(place + 1));
    return item;
  }

  drawing(step) {
    const y = ROW / 2;
    const shapes = this.names.map((_, lane) => svg("line", { x1: this.x(lane), y1: 0, x2: this.x(lane), y2: "100%", class: "life" }));
    const between = step.place.between;
    if (between) {
      const [from, to] = [this.x(between.from), this.x(between.to)];
      const end = between.fate === "delayed" ? (from + to) / 2 : to;
      const late = between.fate.startsWith("arrivesLate");
      shapes.push(svg("line", { x1: from, y1: y, x2: end, y2: y, class: `arrow line ${look(between.from)}${late || between.fate === "delayed" ? " dashed" : ""}` }));
      const back = from < to ? -6 : 6;
      if (between.fate === "lost") shapes.push(svg("path", { d: `M${to - 4} ${y - 4}l8 8m0 -8l-8 8`, class: "lost" }));
      else shapes.push(svg("path", { d: `M${end} ${y}l${back} -4v8Z`, class: `fill ${look(between.from)}` }));
      shapes.push(svg("path", { d: marker(between.from, from, y, 3.5), class: `fill ${look(between.from)}` }));
    } else {
      shapes.push(svg("path", { d: marker(step.place.at, this.x(step.place.at), y, 4), class: `note line ${look(step.place.at)}` }));
    }
    return svg("svg", { width: this.width, height: ROW, class: "drawing", "aria-hidden": "true" }, shapes);
  }
}
