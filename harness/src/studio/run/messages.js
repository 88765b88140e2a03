// The sequence chart: a row for each broadcast, with all who heard it, and for each note.

import { html, id, key, look, marker, ms, seconds, svg } from "../shell/dom.js";

const ROW = 24;

export class Messages {
  constructor(opening, seek) {
    this.names = opening.overview.lanes;
    this.robots = opening.overview.robots.length;
    this.seek = seek;
    this.lane = Math.max(18, Math.min(46, Math.floor(230 / Math.max(this.names.length, 1))));
    this.width = this.names.length * this.lane + 8;
    this.summary = html("p", { class: "faint", id: "messages-count" });
    this.list = html("ol", { class: "rows", tabindex: 0, "aria-label": "Messages and notes around this time" });
    const heads = this.names.map((name, lane) => html("li", {}, this.robots > lane ? key(lane) : "○", name));
    id("messages").append(html("ul", { class: "legend lanes", "aria-label": "Columns from left to right" }, heads), this.list, this.summary);
  }

  x(lane) { return 4 + this.lane / 2 + lane * this.lane; }

  draw(moment) {
    const { rows, count, past, shownFrom } = moment.messages;
    const now = past - shownFrom;
    this.list.replaceChildren(...rows.map((row, place) => this.row(row, place < now, place === now - 1)));
    const last = shownFrom + rows.length;
    this.summary.textContent = count ? `${past} of ${count} so far; ${shownFrom + 1} to ${last} are listed.` : "Nothing was said in this stretch of time.";
    const current = this.list.children[Math.max(now - 1, 0)];
    if (current) this.list.scrollTop = current.offsetTop - this.list.clientHeight * 0.6;
  }

  row(row, isPast, isCurrent) {
    const from = this.names[row.from] ?? "?";
    const names = (lanes) => lanes.map((lane) => this.names[lane] ?? "?").join(", ");
    const fate = [row.heard.length ? `→ ${names(row.heard)}` : "", row.lost.length ? `lost at ${names(row.lost)}` : ""].filter(Boolean).join("; ");
    const reach = row.kind && !fate ? "→ heard by nobody whose log is here" : fate;
    const title = row.kind ? [row.why && `sent because: ${row.why}`, row.tookUs && `heard after ${ms(Math.round(row.tookUs / 1000))} at most`].filter(Boolean).join("; ") : undefined;
    const attributes = {
      class: ["row", isPast ? "" : "future", isCurrent ? "current" : "", row.isWarning || row.lost.length ? "warning" : ""].filter(Boolean).join(" "),
      "aria-current": isCurrent ? "time" : undefined, title,
    };
    const item = html("li", attributes,
      html("span", { class: "at" }, seconds(row.at)),
      this.drawing(row),
      html("span", { class: "said" },
        html("b", {}, from), row.kind ? html("span", { class: "reach" }, ` ${reach} `) : " ",
        " ", row.text));
    item.addEventListener("click", () => this.seek(row.at));
    return item;
  }

  drawing(row) {
    const y = ROW / 2;
    const shapes = this.names.map((_, lane) => svg("line", { x1: this.x(lane), y1: 0, x2: this.x(lane), y2: ROW, class: "life" }));
    const from = this.x(row.from);
    if (row.kind) {
      const ends = [...row.heard, ...row.lost].map((lane) => this.x(lane));
      const [left, right] = [Math.min(from, ...ends), Math.max(from, ...ends)];
      shapes.push(svg("line", { x1: left, y1: y, x2: right, y2: y, class: `arrow line ${look(row.from)}` }));
      for (const lane of row.heard) {
        const x = this.x(lane), back = from < x ? -6 : 6;
        shapes.push(svg("path", { d: `M${x} ${y}l${back} -4v8Z`, class: `fill ${look(row.from)}` }));
      }
      for (const lane of row.lost) {
        const x = this.x(lane);
        shapes.push(svg("path", { d: `M${x - 4} ${y - 4}l8 8m0 -8l-8 8`, class: "lost" }));
      }
      shapes.push(svg("path", { d: marker(row.from, from, y, 3.5), class: row.from < this.robots ? `fill ${look(row.from)}` : "fill stranger" }));
    } else {
      shapes.push(svg("path", { d: marker(row.from, from, y, 3.5), class: `note line ${look(row.from)}` }));
    }
    return svg("svg", { width: this.width, height: ROW, viewBox: `0 0 ${this.width} ${ROW}`, "aria-hidden": "true" }, shapes);
  }
}
