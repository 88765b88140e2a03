// Elements and words that all parts of the page share. Text of logs is only ever set as text.

const SVG = "http://www.w3.org/2000/svg";

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name === "onclick") element.addEventListener("click", value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

export const html = (name, attributes = {}, ...children) => fill(document.createElement(name), attributes, children);
export const svg = (name, attributes = {}, ...children) => fill(document.createElementNS(SVG, name), attributes, children);
export const id = (name) => document.getElementById(name);

// Robots have a colour and a shape, either of which tells them apart.
const SHAPES = ["circle", "square", "triangle", "diamond", "pentagon", "cross"];
export const look = (lane) => `robot-${(lane % SHAPES.length) + 1}`;

// The outline of the marker of a robot around a point, about 2 r wide.
export function marker(lane, x, y, r) {
  const polygon = (points) => "M" + points.map(([px, py]) => `${(x + px * r).toFixed(1)} ${(y + py * r).toFixed(1)}`).join("L") + "Z";
  switch (SHAPES[lane % SHAPES.length]) {
    case "circle": return `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`;
    case "square": return polygon([[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]);
    case "triangle": return polygon([[0, -1.2], [1.1, 0.9], [-1.1, 0.9]]);
    case "diamond": return polygon([[0, -1.25], [1.25, 0], [0, 1.25], [-1.25, 0]]);
    case "pentagon": return polygon([[0, -1.15], [1.1, -0.35], [0.7, 0.95], [-0.7, 0.95], [-1.1, -0.35]]);
    default: return polygon([[-0.4, -1.1], [0.4, -1.1], [0.4, -0.4], [1.1, -0.4], [1.1, 0.4], [0.4, 0.4], [0.4, 1.1], [-0.4, 1.1], [-0.4, 0.4], [-1.1, 0.4], [-1.1, -0.4], [-0.4, -0.4]]);
  }
}

export const key = (lane) => svg("svg", { class: "key", width: 16, height: 16, viewBox: "0 0 16 16", "aria-hidden": "true" },
  svg("path", { d: marker(lane, 8, 8, 5), class: `fill ${look(lane)}` }));

export const seconds = (us, digits = 3) => (us / 1e6).toFixed(digits);
export const ms = (value) => value >= 1000 ? `${(value / 1000).toFixed(1)} s` : `${value} ms`;

export function table(label, head, rows) {
  const cell = (value, name, scope) => {
    const [content, kind] = Array.isArray(value) ? value : [value, ""];
    return html(name, { class: kind || undefined, scope }, content ?? "");
  };
  return html("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": label },
    html("table", {},
      html("thead", {}, html("tr", {}, head.map((it) => cell(it, "th", "col")))),
      html("tbody", {}, rows.map((row) => html("tr", row.attributes ?? {}, row.cells.map((it, place) => cell(it, place ? "td" : "th", place ? undefined : "row")))))));
}
