// Robots that run. What is old is said to be old: a picture that stands still must not look alive.

import { html, id, ms } from "../shell/dom.js";
import { StreetMap } from "../shell/map.js";
import { Messages } from "../shell/messages.js";
import * as panels from "../shell/panels.js";
import "./operator.js";

const EVERY_MS = 500;
const PATIENCE_MS = 3000;
// A robot writes at least a RAM a second.
const SILENT_MS = 2000;

let map = null, messages = null, shape = "", extent = null;
let isHeld = false, answered = null, said = "";

async function ask() {
  const answer = await fetch("api/now", { signal: AbortSignal.timeout(PATIENCE_MS) });
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
}

// Alerts are put in anew only when they say something else, so that screen readers say them once.
function trouble(texts) {
  const now = texts.map((it) => it.key).join("\n");
  const box = id("troubles");
  if (now !== said) {
    said = now;
    box.replaceChildren(...texts.map(() => html("p", { class: "trouble" })));
  }
  texts.forEach((it, place) => { box.children[place].textContent = it.text; });
}

// The map keeps its scale when something leaves the minute that is known.
function widened(overview) {
  const known = overview.street.extent;
  if (known && extent) extent = known.map((it, at) => at < 2 ? Math.min(it, extent[at]) : Math.max(it, extent[at]));
  else extent = known ?? extent;
  overview.street.extent = extent;
}

function draw(now) {
  const { overview, moment, ages } = now;
  widened(overview);
  const next = JSON.stringify([overview.lanes, overview.street, overview.robots.map((it) => it.stations)]);
  if (next !== shape) {
    shape = next;
    for (const part of ["map", "map-legend", "messages"]) id(part).replaceChildren();
    map = new StreetMap(now);
    messages = new Messages(now, () => {});
  }
  const stale = overview.robots.map((robot, lane) => ages[lane] > SILENT_MS && !robot.hasStopped);
  // A silent robot is drawn as one that does not run: where it is, nobody knows.
  map.draw({ ...moment, robots: moment.robots.map((robot, lane) => stale[lane] ? { ...robot, isRunning: false } : robot) });
  messages.draw(moment);
  const cards = panels.robots(now, moment);
  cards.forEach((card, lane) => {
    card.classList.toggle("stale", stale[lane]);
    const words = overview.robots[lane].hasStopped ? "has stopped" : stale[lane] ? `SILENT for ${ms(ages[lane])}: what stands here is old` : `wrote ${ms(ages[lane])} ago`;
    card.querySelector("h3").after(html("p", { class: "age" }, words));
  });
  id("robots").replaceChildren(...cards);
  id("drops").replaceChildren(panels.drops(now, moment));
  const silent = overview.robots.flatMap((robot, lane) => stale[lane] ? [{ key: `silent ${robot.name}`, text: `${robot.name} has written nothing for ${ms(ages[lane])}. It may have crashed or hang, or its log is not reached: what is shown of it is old.` }] : []);
  const logs = now.logs.filter((it) => it.trouble).map((it) => ({ key: `${it.name} ${it.trouble}`, text: `${it.name}: ${it.trouble}. Nothing after that is shown.` }));
  trouble([...silent, ...logs]);
  id("logs").replaceChildren(...now.logs.map((it) => html("li", {}, `${it.name}: ${it.trouble || "followed"}${it.restarts ? `; it began anew ${it.restarts} time${it.restarts > 1 ? "s" : ""}` : ""}`)));
  id("what").textContent = `${overview.robots.map((it) => it.name).join(", ") || "No robot has written anything yet"}`;
  const all = overview.robots.length;
  if (silent.length) chip("invalid", `✗ ${silent.length} of ${all} silent`);
  else if (!all) chip("incomplete", "Waiting for a record");
  else if (logs.length) chip("invalid", "✗ A log is not followed");
  else if (overview.robots.every((it) => it.hasStopped)) chip("incomplete", "■ All have stopped");
  else chip("valid", "● Live");
}

function chip(kind, text) {
  id("chip").className = `chip ${kind}`;
  id("chip").textContent = text;
}

async function look() {
  try {
    const now = await ask();
    answered = Date.now();
    id("main").classList.remove("is-old");
    if (!isHeld) draw(now);
  } catch (error) {
    const since = answered ? `since ${new Date(answered).toLocaleTimeString()}` : "";
    id("main").classList.add("is-old");
    chip("invalid", "✗ Not live");
    const cause = error instanceof TypeError || error.name === "TimeoutError" ? `The studio does not answer ${since}. Everything below is old.` : error.message;
    trouble([{ key: "server", text: cause }]);
  }
}

function hold() {
  isHeld = !isHeld;
  id("hold").setAttribute("aria-pressed", String(isHeld));
  id("hold").textContent = isHeld ? "Go on" : "Hold the picture";
  id("held").textContent = isHeld ? `Held since ${new Date().toLocaleTimeString()}: what is shown is old.` : "";
  id("main").classList.toggle("is-held", isHeld);
  if (isHeld) chip("incomplete", "‖ Held");
}

id("hold").addEventListener("click", hold);
document.addEventListener("keydown", (event) => {
  if (event.key !== " " || event.target.closest("button, a, input, select, dialog, .rows, .scroll")) return;
  event.preventDefault();
  hold();
});

async function run() {
  for (;;) {
    await look();
    document.documentElement.dataset.ready = "true";
    await new Promise((done) => setTimeout(done, EVERY_MS));
  }
}

run();
