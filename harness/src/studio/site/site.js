// A site on its street: points are dragged, or moved by keys. The server says each time what the kit's check says of the
// site as it would be; the page has no rule of its own.

import { html, id } from "../shell/dom.js";
import { StreetMap } from "../shell/map.js";

const STEP_M = 0.1, STEP_FAR_M = 1;
const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const PATIENCE_MS = 5000;

let opening = null, map = null, points = [], handles = [], dragged = null, newest = 0, turn = Promise.resolve();

const places = (handle) => handle.of.map((it) => [...it.at]);
const isMoved = (point) => point.at.some((it, axis) => it !== point.was[axis]);

async function ask(what, question) {
  const post = { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(question) };
  const answer = await fetch(`api/${what}`, { ...(question ? post : {}), signal: AbortSignal.timeout(PATIENCE_MS) });
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return answer.json();
}

function show(kind, chip, said, trouble) {
  id("chip").className = `chip ${kind}`;
  id("chip").textContent = chip;
  id("said").replaceChildren(...said ? [html("p", { class: kind === "invalid" ? kind : "valid" }, said)] : []);
  id("troubles").replaceChildren(...trouble ? [html("p", { class: "trouble" }, trouble)] : []);
}

function fail(error) {
  const isAway = error instanceof TypeError || error.name === "TimeoutError";
  show("invalid", "✗ Not checked", "", isAway ? "The studio does not answer." : error.message);
}

// One question after the other; of those that wait, the newest is asked, and each that saves.
function check(save = false) {
  const number = ++newest;
  turn = turn.then(async () => {
    if (number !== newest && !save) return;
    const moved = Object.fromEntries(points.filter(isMoved).map((it) => [it.name, [...it.at]]));
    const { fits, said, saved } = await ask("moved", { version: opening.version, moved, save });
    if (saved) {
      opening.version = saved;
      for (const point of points) point.was = moved[point.name] ?? point.was;
    }
    if (number !== newest) return;
    const left = points.filter(isMoved).length, end = !save ? "" : saved ? "\nSaved." : "\nNot saved.";
    if (!fits) show("invalid", "✗ Does not fit", `✗ ${said}${end}`);
    else show(left ? "incomplete" : "valid", left ? `${left} moved, not saved` : "✓ As the file", `✓ ${said}${end}`);
  }).catch(fail);
}

// The scale stays while something is dragged. Dots are over the picture, whose size on the screen is nearly that of its drawing.
function draw() {
  const ends = [0, 1].map((axis) => points.map((it) => it.at[axis]));
  if (!dragged && points.length) opening.overview.street.extent = [Math.min, Math.max].flatMap((far) => ends.map((it) => far(...it)));
  map.draw({ robots: [] });
  const screen = map.picture.getScreenCTM(), { left, top } = id("dots").getBoundingClientRect();
  for (const handle of handles) {
    const middle = [0, 1].map((axis) => handle.of.reduce((sum, it) => sum + it.at[axis], 0) / handle.of.length);
    const { x, y } = new DOMPoint(...map.view.at(middle)).matrixTransform(screen);
    Object.assign(handle.dot.style, { left: `${x - left}px`, top: `${y - top}px` });
  }
}

function choose(handle) {
  for (const it of handles) it.dot.classList.toggle("chosen", it === handle);
  id("at").textContent = `${handle.name}: ${handle.of.map(({ at: [east, north] }) => `${east.toFixed(2)} m east, ${north.toFixed(2)} m north`).join("; ")}`;
}

// Each point of a handle as far from where it was, to the centimetre.
function move(handle, from, by) {
  handle.of.forEach((point, nth) => by.forEach((metres, axis) => { point.at[axis] = Math.round((from[nth][axis] + metres) * 100) / 100; }));
  draw();
  choose(handle);
  check();
}

function handle(name, kind, ...of) {
  const dot = html("button", { type: "button", class: `dot ${kind}`, "aria-label": name, title: name });
  const it = { name, of, dot };
  dot.addEventListener("focus", () => choose(it));
  dot.addEventListener("keydown", (event) => {
    const way = KEYS[event.key];
    if (!way || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    move(it, places(it), way.map((sign) => sign * (event.shiftKey ? STEP_FAR_M : STEP_M)));
  });
  dot.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    dot.setPointerCapture(event.pointerId);
    dragged = { x: event.clientX, y: event.clientY, from: places(it) };
  });
  dot.addEventListener("pointermove", (event) => {
    const pixels = dragged && [event.clientX - dragged.x, dragged.y - event.clientY];
    if (pixels) move(it, dragged.from, pixels.map((it) => it / map.view.scale / map.picture.getScreenCTM().a));
  });
  dot.addEventListener("lostpointercapture", () => { dragged = null; draw(); });
  return it;
}

async function read() {
  opening = await ask("opening");
  const { kerbs, lanes, places: spots } = opening.overview.street;
  // Arrays of the street, which the map draws as they are.
  const at = [...kerbs.flat(), ...lanes.flatMap(([, from, to]) => [from, to]), ...spots.map(([, it]) => it)];
  points = opening.points.map(([name, was], nth) => ({ name, was, at: at[nth] }));
  handles = points.map((it) => handle(it.name, it.name.split(" ")[0], it));
  for (let nth = 0; nth < 2 * (kerbs.length + lanes.length); nth += 2) {
    const name = points[nth].name.replace(/ from$/, "");
    handles.push(handle(name, `line ${name.split(" ")[0]}`, points[nth], points[nth + 1]));
  }
  for (const part of ["map", "map-legend", "at"]) id(part).replaceChildren();
  id("dots").replaceChildren(...handles.map((it) => it.dot));
  id("what").textContent = opening.file;
  opening.overview.street.extent = [0, 0, 0, 0];
  map = new StreetMap(opening);
  draw();
  check();
  await turn;
}

const again = () => read().catch(fail);
id("save").addEventListener("click", () => opening ? check(true) : again());
id("again").addEventListener("click", again);
new ResizeObserver(() => map && draw()).observe(id("street"));
addEventListener("beforeunload", (event) => { if (points.some(isMoved)) event.preventDefault(); });
again().then(() => { document.documentElement.dataset.ready = "true"; });
