// A plot: curves with their spread, the paper's ranges, a reading by pointer or by keys, and files of it.

import { html, key, look, marker, svg, table } from "/shell/dom.js";

const [WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM] = [560, 320, 62, 14, 14, 44];
const DASHES = ["", "7 4", "2 3", "9 3 2 3", "4 4", "1 2"];
const THEME = ":root{color-scheme:light}svg{background:#fff;font:12px system-ui,sans-serif}text{fill:#1d2126}.grid{stroke:#d3d9df}.axis{stroke:#57616c}.band{fill:#8a6400;fill-opacity:.16}.cursor{display:none}.curve{fill:none;stroke-width:2}" +
  ["#0067a3", "#b9500b", "#00785a", "#a3467d", "#8a6400", "#3d5a98"].map((color, at) => `.robot-${at + 1}.line{stroke:${color}}.robot-${at + 1}.fill{fill:${color}}.robot-${at + 1}.spread{fill:${color};fill-opacity:.14;stroke:none}`).join("");

// Round numbers that span a range.
function ticks(from, to) {
  const step = 10 ** Math.floor(Math.log10((to - from) / 4 || 1));
  const wide = [1, 2, 5, 10].map((it) => it * step).find((it) => (to - from) / it <= 6);
  const first = Math.ceil(from / wide - 1e-9);
  return Array.from({ length: Math.floor(to / wide + 1e-9) - first + 1 }, (_, at) => (first + at) * wide);
}

export const shown = (value) => value === 0 ? "0" : Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6 ? value.toExponential(3) : String(Number(value.toPrecision(7)));
const tick = (value) => value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e5) ? value.toExponential(0) : String(Number(value.toPrecision(6)));

// Where a value stands, in pixels.
function scales({ series, bands, is_log: isLog }) {
  const points = series.flatMap((it) => it.points);
  const xs = points.map((it) => it[0]);
  const ys = points.flatMap((it) => it.slice(1)).concat(bands.flatMap((it) => [it.from, it.to])).filter((it) => !isLog || it > 0);
  const bounds = (values, from = Infinity) => [Math.min(from, ...values), Math.max(...values)];
  let [left, right] = bounds(xs), [low, high] = bounds(ys, isLog ? Infinity : 0);
  if (left === right) right = left + 1;
  if (!Number.isFinite(low)) [low, high] = [1e-6, 1];
  if (isLog) [low, high] = [Math.floor(Math.log10(low)), Math.ceil(Math.log10(high))];
  if (low === high) high = low + 1;
  const x = (value) => LEFT + (value - left) / (right - left) * (WIDTH - LEFT - RIGHT);
  const linear = (value) => HEIGHT - BOTTOM - (value - low) / (high - low) * (HEIGHT - TOP - BOTTOM);
  const y = (value) => isLog ? linear(Math.max(Math.log10(Math.max(value, 1e-300)), low)) : linear(value);
  const decades = Math.max(1, Math.ceil((high - low) / 7));
  const yTicks = isLog ? Array.from({ length: Math.floor((high - low) / decades) + 1 }, (_, at) => 10 ** (low + at * decades)) : ticks(low, high);
  return { x, y, xTicks: ticks(left, right), yTicks };
}

export class Plot {
  constructor(figure, name) {
    this.figure = figure;
    this.name = name;
    this.at = scales(figure);
    this.place = null;
    this.cursor = svg("g", { class: "cursor" });
    this.reading = html("output", { class: "reading", "aria-live": "polite" }, "");
    this.picture = this.draw();
    this.root = html("figure", {}, html("figcaption", {}, figure.title), this.legend(), this.picture, this.reading, this.actions());
    this.picture.addEventListener("pointermove", (event) => this.point(event));
    this.picture.addEventListener("keydown", (event) => this.key(event));
  }

  legend() {
    return html("ul", { class: "legend" }, this.figure.series.map((it, lane) => html("li", {}, key(lane), lane < 6 ? it.name : `${it.name} (dashed)`)),
      this.figure.is_log ? html("li", {}, "what is below the axis stands at its foot") : "",
      this.figure.bands.map((it) => html("li", {}, "▒ ", it.name)), html("li", {}, `shaded: ${this.figure.spread}`));
  }

  draw() {
    const { series, bands, x: xName, y: yName, title } = this.figure;
    const { x, y, xTicks, yTicks } = this.at;
    const [right, bottom] = [WIDTH - RIGHT, HEIGHT - BOTTOM];
    return svg("svg", { class: "plot", viewBox: `0 0 ${WIDTH} ${HEIGHT}`, tabindex: 0, role: "img", "aria-label": `${title}: ${series.map((it) => it.name).join(", ")}. Arrow keys read its points; the table below has all of them.` },
      bands.map((it) => svg("rect", { x: LEFT, width: right - LEFT, y: y(it.to), height: Math.max(1, y(it.from) - y(it.to)), class: "band" })),
      yTicks.flatMap((it) => [svg("line", { x1: LEFT, x2: right, y1: y(it), y2: y(it), class: "grid" }), svg("text", { x: LEFT - 6, y: y(it) + 4, "text-anchor": "end" }, tick(it))]),
      xTicks.map((it) => svg("text", { x: x(it), y: bottom + 16, "text-anchor": "middle" }, tick(it))),
      svg("path", { d: `M${LEFT} ${TOP}V${bottom}H${right}`, class: "axis", fill: "none" }),
      svg("text", { x: (LEFT + right) / 2, y: HEIGHT - 8, "text-anchor": "middle" }, xName),
      svg("text", { x: 14, y: (TOP + bottom) / 2, "text-anchor": "middle", transform: `rotate(-90 14 ${(TOP + bottom) / 2})` }, yName),
      series.map((it, lane) => this.curve(it.points, lane)),
      this.cursor);
  }

  curve(points, lane) {
    const { x, y } = this.at;
    const line = (of, list) => list.map((it) => `${x(it[0]).toFixed(1)} ${y(of(it)).toFixed(1)}`).join("L");
    const area = `M${line((it) => it[3], points)}L${line((it) => it[2], [...points].reverse())}Z`;
    const few = points.length <= 12;
    return svg("g", {},
      svg("path", { d: area, class: `spread ${look(lane)}` }),
      svg("path", { d: `M${line((it) => it[1], points)}`, class: `curve line ${look(lane)}`, "stroke-dasharray": DASHES[Math.floor(lane / 6) % DASHES.length] || undefined }),
      few ? points.map((it) => svg("path", { d: marker(lane, x(it[0]), y(it[1]), 4), class: `fill ${look(lane)}` })) : "");
  }

  // The point that is nearest to the pointer.
  point(event) {
    const box = this.picture.getBoundingClientRect();
    const [px, py] = [(event.clientX - box.left) * WIDTH / box.width, (event.clientY - box.top) * HEIGHT / box.height];
    let best = null, least = Infinity;
    this.figure.series.forEach((series, lane) => series.points.forEach((it, at) => {
      const far = (this.at.x(it[0]) - px) ** 2 + (this.at.y(it[1]) - py) ** 2;
      if (far < least) [best, least] = [[lane, at], far];
    }));
    if (best) this.read(...best);
  }

  key(event) {
    const ways = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowDown: [1, 0], ArrowUp: [-1, 0] };
    const way = ways[event.key];
    if (!way || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    const [lane, at] = this.place ?? [0, way[1] > 0 ? -1 : 0];
    const { series } = this.figure;
    const to = (lane + way[0] + series.length) % series.length;
    this.read(to, Math.max(0, Math.min(at + way[1], series[to].points.length - 1)));
  }

  read(lane, at) {
    this.place = [lane, at];
    const series = this.figure.series[lane];
    const [x, value, low, high] = series.points[at];
    const spread = low === value && high === value ? "" : ` (${this.figure.spread}: ${shown(low)} to ${shown(high)})`;
    this.reading.textContent = `${series.name}: ${this.figure.y} ${shown(value)} at ${this.figure.x} ${shown(x)}${spread}`;
    this.cursor.replaceChildren(
      svg("line", { x1: this.at.x(x), x2: this.at.x(x), y1: TOP, y2: HEIGHT - BOTTOM, class: "now" }),
      svg("circle", { cx: this.at.x(x), cy: this.at.y(value), r: 6, class: `ring line ${look(lane)}` }));
  }

  actions() {
    const rows = () => this.figure.series.flatMap((it) => it.points.map((point) => [it.name, ...point]));
    const head = ["series", this.figure.x, this.figure.y, "lower", "upper"];
    const details = html("details", {}, html("summary", {}, "Table"));
    details.addEventListener("toggle", () => {
      if (details.open && details.children.length === 1) {
        const n = (value) => [shown(value), "n"];
        details.append(table(`Numbers of ${this.figure.title}`, head, rows().slice(0, 1_000).map(([name, ...values]) => ({ cells: [name, ...values.map(n)] }))));
        if (rows().length > 1_000) details.append(html("p", { class: "faint" }, `The first 1,000 of ${rows().length} points; the CSV file has all.`));
      }
    });
    const quoted = (value) => typeof value === "string" ? `"${value.replaceAll('"', '""')}"` : String(value);
    const csv = () => [head, ...rows()].map((row) => row.map(quoted).join(",")).join("\n") + "\n";
    const picture = () => {
      const copy = this.picture.cloneNode(true);
      copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
      copy.setAttribute("width", WIDTH);
      copy.setAttribute("height", HEIGHT + 18 * (this.figure.series.length + this.figure.bands.length) + 24);
      copy.setAttribute("viewBox", `0 -24 ${WIDTH} ${copy.getAttribute("height")}`);
      copy.prepend(svg("style", {}, THEME), svg("title", {}, this.figure.title), svg("text", { x: 8, y: -8 }, this.figure.title));
      [...this.figure.series, ...this.figure.bands].forEach((it, lane) => {
        const y = HEIGHT + 10 + 18 * lane;
        copy.append(lane < this.figure.series.length ? svg("path", { d: marker(lane, LEFT, y - 4, 5), class: `fill ${look(lane)}` }) : svg("rect", { x: LEFT - 5, y: y - 9, width: 10, height: 10, class: "band" }), svg("text", { x: LEFT + 12, y }, it.name));
      });
      return new XMLSerializer().serializeToString(copy);
    };
    const button = (label, end, type, content) => html("button", { type: "button", onclick: () => this.save(end, type, content()) }, label);
    return html("div", {}, html("div", { class: "actions" }, button("Save as SVG", "svg", "image/svg+xml", picture), button("Save as CSV", "csv", "text/csv", csv)), details);
  }

  save(end, type, content) {
    const url = URL.createObjectURL(new Blob([content], { type }));
    html("a", { href: url, download: `${this.name}.${end}` }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
  }
}
