// Runs step by step: of the paper's wording, of the kit's scenarios, of files.

import { html, id } from "../shell/dom.js";
import { Chart } from "../shell/chart.js";
import { causeOf, load, opened, post, runOf, save, strayed, trouble } from "../shell/model.js";
import * as scene from "../shell/scene.js";

const GOALS = [
  ["Idle", null], ["HelpRequested", "requester"], ["HelpRequested", "helper"], ["RoleEstablished", "leader"], ["RoleEstablished", "follower"],
  ["ManeuverExecuting", "leader"], ["ManeuverExecuting", "follower"],
];
const EVENTS = [["somebody is on the road", "personOnRoad"], ["a sign shows go", "showsGo"], ["a body falls back", "fallsBack"]];

let scenarios = [], properties = new Map(), runs = [];
let shown = null, count = 0, chart = null;

// Fills the page: a run, the frames that are known of it, and the steps that may follow the last of them.
async function show(run) {
  shown = run;
  trouble();
  if (!run.frames) {
    const walk = await post("api/walk", runOf(run.scenario, run.text, run.steps));
    Object.assign(run, { robots: walk.robots, frames: walk.frames, possible: walk.possible, stray: strayed(walk, run.steps) });
  }
  if (run.beside) run.beside.frames ??= (await post("api/walk", runOf(run.beside.scenario, null, run.beside.steps))).frames;
  trouble(run.stray);
  about(run);
  id("now").classList.toggle("both", Boolean(run.beside));
  id("beside").hidden = !run.beside;
  chart = new Chart(id("steps"), run.robots, go);
  chart.fill(run.steps, run.repeatsAfter);
  id("slider").max = run.steps.length;
  id("save").disabled = Boolean(run.isPaper);
  go(run.isStart ? 0 : run.at ?? 0);
}

function about(run) {
  const quoted = (text) => text.split("`").map((part, place) => place % 2 ? html("code", {}, part) : part);
  const pair = ([term, value]) => value ? [html("dt", {}, term), html("dd", {}, quoted(value))] : [];
  id("what").textContent = run.title;
  id("about").replaceChildren(html("p", {}, html("b", {}, run.title)), run.isPaper || run.broken ? html("dl", {}, [
    ["breaks", run.broken], ["how", run.explanation], ["for a person", run.person], ["the paper", run.passage], ["closed by", run.closedBy],
  ].flatMap(pair)) : "");
}

// Goes to where this many steps are taken.
function go(to) {
  count = Math.max(0, Math.min(to, shown.steps.length));
  id("slider").value = count;
  const step = shown.steps[count - 1];
  id("step").textContent = `Step ${count} of ${shown.steps.length}${step ? "" : ": nothing has happened yet"}`;
  chart.at(count);
  const frame = shown.frames[count];
  const parts = ["street", "robots", "touched", "possible"].map(id);
  id("person").textContent = "";
  if (!frame) {
    parts.forEach((part) => part.replaceChildren());
    id("robots").replaceChildren(html("p", { class: "faint" }, "The state after this step is not known."));
    return;
  }
  const [street, robots, touched, possible] = parts;
  robots.replaceChildren(...scene.robots(shown.robots, frame));
  if (frame.person) drawStreet("", frame);
  else street.replaceChildren(html("p", { class: "faint" }, "This run is about messages alone. The runs that begin with W have a street."));
  if (shown.isPaper) {
    if (shown.beside) besides();
    else if (frame.person) id("person").append(" Nobody is on the road at the end of this run, so no run of the kit is beside it.");
    touched.replaceChildren(html("p", { class: "faint" }, count === shown.steps.length ? `Broken: ${shown.broken}.` : "The properties of the paper's wording are judged at the end of its runs."));
    possible.replaceChildren(html("p", { class: "faint" }, "The paper's wording is shown as it was found; choose a scenario to go on by hand."));
    return;
  }
  touched.replaceChildren(scene.touched(frame, properties));
  choices();
}

function drawStreet(which, frame) {
  id(`street${which}`).replaceChildren(scene.street(shown.robots, frame));
  id(`person${which}`).textContent = scene.person(shown.robots, frame).words;
}

// The kit beside the paper's wording, after as much of the story. Its robots have the names of the paper's.
function besides() {
  const kit = shown.beside;
  if (!kit.frames) return;
  drawStreet("-beside", kit.frames[kit.taken[count]]);
  const named = (text) => text.replace(/robot (\d+)/g, (robot, number) => shown.robots[number - 1] ?? robot);
  const steps = kit.steps.slice(kit.taken[count - 1] ?? 0, kit.taken[count]);
  id("steps-beside").replaceChildren(...steps.map((step) => html("li", {}, named([name(step, shown.robots), ...step.outputs].join("; ")))));
}

const name = (step, robots) => step.place.between
  ? `${robots[step.place.between.from]} → ${robots[step.place.between.to]}: ${step.action} (${step.place.between.fate.replace(/([A-Z])/g, " $1").toLowerCase()})`
  : `${robots[step.place.at]}: ${step.action}`;

// The steps that may come next. They are known for the end of the run; elsewhere they are asked for.
async function choices() {
  const at = count, run = shown;
  let possible = run.possible;
  if (at < run.steps.length) {
    // The ways of another step must not be taken from this one.
    id("possible").replaceChildren();
    try {
      possible = (await post("api/walk", runOf(run.scenario, run.text, run.steps.slice(0, at)))).possible;
    } catch (error) {
      trouble(causeOf(error));
      return;
    }
  }
  if (at !== count || run !== shown) return;
  id("possible").replaceChildren(possible.length
    ? html("ul", { class: "choices" }, possible.map((step) => html("li", {}, html("button", { type: "button", onclick: () => branch(step) }, name(step, run.robots)))))
    : html("p", { class: "faint" }, "Nothing: the run ends here."));
}

// Another way from here.
function branch(step) {
  const steps = [...shown.steps.slice(0, count), step];
  attempt(() => show({ title: `Your way through ${shown.scenario}`, scenario: shown.scenario, text: shown.text, steps, at: steps.length }));
}

async function attempt(work) {
  try {
    await work();
  } catch (error) {
    trouble(causeOf(error));
  }
}

const fromFile = ({ file, run }) => ({
  title: `${file}: ${run.scenario}${run.property ? `, breaks ${run.property}` : ""}`, scenario: run.scenario, text: run.text, steps: run.steps,
  repeatsAfter: run.repeatsAfter, broken: properties.get(run.property)?.statement ?? run.property, at: run.steps.length,
});

const fromPaper = (it) => ({
  title: `${it.id}: ${it.title}`, isPaper: true, robots: it.robots, steps: it.steps, repeatsAfter: it.repeatsAfter, broken: it.statement,
  explanation: it.explanation, person: it.person, passage: `${it.kind}: section ${it.section}, ${it.paragraph}`, closedBy: it.closedBy,
  frames: it.frames.map((frame) => ({ ...frame, isPaper: true, met: [], broken: [] })), beside: it.beside,
});

const fromScenario = (it) => ({ title: `${it.name}: ${it.summary}`, scenario: it.name, steps: [], isStart: true });

function offer(label, added) {
  const first = runs.length;
  runs.push(...added);
  const options = added.map((run, place) => html("option", { value: first + place }, run.title));
  const group = html("optgroup", { label });
  group.append(...options);
  id("run").append(group);
  return first;
}

async function choose(place) {
  id("run").value = place;
  const run = runs[place];
  if (run.scenario) setScenario(run.scenario);
  await show({ ...run });
}

function setScenario(name) {
  if (!scenarios.some((it) => it.name === name)) return;
  id("scenario").value = name;
  const stations = [...scenarios.find((it) => it.name === name).text.matchAll(/^station *= *(\d+)/gm)];
  id("who").replaceChildren(...stations.map(([, station], place) => html("option", { value: place }, `robot ${station} is`)), html("option", { value: "event" }, "it is so that"));
  goals();
}

function goals() {
  const isEvent = id("who").value === "event";
  id("goal").replaceChildren(...(isEvent ? EVENTS.map(([words], place) => html("option", { value: place }, words))
    : GOALS.map(([state, role], place) => html("option", { value: place }, role ? `${state} (${role})` : state))));
}

async function find(event) {
  event.preventDefault();
  const name = id("scenario").value, place = id("goal").value, who = id("who").value;
  const goal = who === "event" ? EVENTS[place][1] : { robot: { place: Number(who), state: GOALS[place][0], role: GOALS[place][1] } };
  id("found").textContent = "Looking…";
  const found = await post("api/search", { run: runOf(name, null, []), goal });
  const states = `${found.states.toLocaleString("en")} states looked at`;
  if (!found.steps) {
    id("found").textContent = found.isComplete ? `Never: all ${found.states.toLocaleString("en")} states were looked at.` : `Not found, and the search was cut off: ${states}.`;
    return;
  }
  id("found").textContent = `After ${found.steps.length} steps; ${states}.`;
  const words = [id("who"), id("goal")].map((it) => it.selectedOptions[0].textContent).join(" ");
  await show({ title: `${name}: the shortest way to where ${words}`, scenario: name, steps: found.steps, at: found.steps.length });
}

// The end of a run without end is its turn.
const next = () => go(count === shown.steps.length && shown.repeatsAfter !== null && shown.repeatsAfter < count ? shown.repeatsAfter : count + 1);

function keys(event) {
  const own = event.target.closest("select, textarea, input:not([type=range])");
  if (own || event.ctrlKey || event.altKey || event.metaKey) return;
  const ways = { ArrowRight: next, ArrowLeft: () => go(count - 1), Home: () => go(0), End: () => go(shown.steps.length) };
  if (!ways[event.key] || (event.target.closest(".rows") && event.key.startsWith("Arrow") === false)) return;
  event.preventDefault();
  ways[event.key]();
}

async function start() {
  const [given, listed, texts, paper] = await Promise.all(["given", "scenarios", "properties", "paper"].map((it) => load(`api/${it}`)));
  scenarios = listed;
  properties = scene.byId(texts);
  if (given.length) offer("From files", given.map(fromFile));
  const onStreet = (it) => it.frames[0].person !== null;
  offer("The paper's wording on the street", paper.filter(onStreet).map(fromPaper));
  offer("The paper's wording, messages alone", paper.filter((it) => !onStreet(it)).map(fromPaper));
  offer("Scenarios of the kit, from their start", scenarios.map(fromScenario));
  id("scenario").replaceChildren(...scenarios.map((it) => html("option", {}, it.name)));
  setScenario("pair");
  id("run").addEventListener("change", () => attempt(() => choose(Number(id("run").value))));
  id("scenario").addEventListener("change", () => setScenario(id("scenario").value));
  id("who").addEventListener("change", goals);
  id("search").addEventListener("submit", (event) => attempt(() => find(event)));
  id("file").addEventListener("change", () => attempt(async () => {
    const run = await opened(id("file"));
    if (run) await choose(offer("Opened here", [fromFile(run)]));
  }));
  id("save").addEventListener("click", () => save(`${shown.scenario.replace(/[^\w-]+/g, "-")}.json`, runOf(shown.scenario, shown.text, shown.steps)));
  id("open-beside").addEventListener("click", () => attempt(() => {
    const { scenario, steps, taken } = shown.beside;
    return show({ title: `The kit in the story of ${shown.title}`, scenario, steps, at: taken[count] });
  }));
  id("first").addEventListener("click", () => go(0));
  id("previous").addEventListener("click", () => go(count - 1));
  id("next").addEventListener("click", next);
  id("last").addEventListener("click", () => go(shown.steps.length));
  id("slider").addEventListener("input", () => go(Number(id("slider").value)));
  document.addEventListener("keydown", keys);
  // A given run that cannot be followed leaves the page usable.
  await attempt(() => choose(0));
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => trouble(`The page could not be filled: ${causeOf(error)}`));
