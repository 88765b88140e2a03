// The protocol at work. The model computes each state from the scenario and the steps that were taken.

import { html, id } from "../shell/dom.js";
import { Chart } from "../shell/chart.js";
import { causeOf, linked, load, opened, packed, post, runOf, save, strayed, trouble } from "../shell/model.js";
import * as scene from "../shell/scene.js";
import * as guide from "./guide.js";
import { nameIn, own, withRoom } from "./setup.js";

const PAUSE_MS = 350;
const FATES = { arrives: "Deliver", lost: "Lose", delayed: "Delay", arrivesLate: "Deliver", arrivesLateAndAgain: "Deliver, and once more" };
const BREAKDOWN = /crashes|hangs/;

let scenarios = [], properties = new Map();
// The scenario with its file where it is none of the kit, the steps that were taken, and those that were taken back.
let play = { scenario: "pair", text: null, steps: [], redo: [] };
// The scenario of the guide, whether the reader wants it, and the steps that it offers.
let guideText = null, isGuided = true, offered = {};
let walk = null, chart = null, timer = null, work = Promise.resolve();

// One thing after the other, however fast keys are pressed.
function attempt(doing) {
  work = work.then(doing).catch((error) => { stop(); trouble(causeOf(error)); });
  return work;
}

// Shows a play, if the model can follow it; otherwise the page stays as it was.
async function show(wanted) {
  const answer = await post("api/walk", runOf(wanted.scenario, wanted.text, wanted.steps));
  const stray = strayed(answer, wanted.steps);
  if (stray) wanted = { ...wanted, steps: wanted.steps.slice(0, answer.frames.length - 1), redo: [] };
  const isNew = !walk || walk.robots.join() !== answer.robots.join();
  [play, walk] = [wanted, answer];
  trouble(stray);
  if (isNew) chart = new Chart(id("steps"), walk.robots, (taken) => attempt(() => back(taken)));
  draw();
  // A reload, or a copied link, shows the same.
  history.replaceState(null, "", `#run=${await packed(runOf(play.scenario, play.text, play.steps))}`);
}

// A run from a file or an address.
async function open({ scenario, text, steps }) {
  stop();
  await show({ scenario, text: text ?? null, steps, redo: [] });
  id("text").value = text ?? scenarios.find((it) => it.name === scenario)?.text ?? "";
}

const take = (step) => show({ ...play, steps: [...play.steps, step], redo: [] });

// To where this many steps are taken; what comes after can be done again.
function back(taken) {
  if (taken < 0 || taken > play.steps.length) return undefined;
  return show({ ...play, steps: play.steps.slice(0, taken), redo: [...play.steps.slice(taken), ...play.redo] });
}

function again() {
  const [step, ...redo] = play.redo;
  return step && show({ ...play, steps: [...play.steps, step], redo });
}

const isUnderWay = (step) => Boolean(step.place.between);

// All that may become of each message, first things first.
function messages() {
  const groups = new Map();
  for (const step of walk.possible.filter(isUnderWay)) {
    const { from, to, fate } = step.place.between;
    const name = `${from} ${to} ${step.action}`;
    // A message may be on air and delayed; it cannot be both to be decided now.
    groups.set(name, [...(groups.get(name) ?? []), { fate, step }]);
  }
  return [...groups.values()];
}

function line(step) {
  const between = step.place.between;
  if (!between) return `${walk.robots[step.place.at]}: ${step.action}`;
  const remark = { arrives: "arrives", lost: "is lost", delayed: "is delayed", arrivesLate: "arrives late", arrivesLateAndAgain: "arrives late, and not for the last time" }[between.fate];
  return `${walk.robots[between.from]} → ${walk.robots[between.to]}: ${step.action} ${remark}`;
}

function draw() {
  const frame = walk.frames[walk.frames.length - 1];
  id("what").textContent = `${walk.scenario}: ${walk.summary}`;
  // Of a scenario that is nobody's but one's own, the list has none.
  id("scenario").value = walk.scenario.replace(/-with-room$/, "");
  chart.fill(play.steps, null);
  chart.at(play.steps.length);
  id("undo").disabled = !play.steps.length;
  id("redo").disabled = !play.redo.length;
  id("street").replaceChildren(scene.street(walk.robots, frame));
  id("person").textContent = scene.person(walk.robots, frame).words;
  id("touched").replaceChildren(scene.touched(frame, properties));
  const last = play.steps[play.steps.length - 1];
  id("said").textContent = last ? `${play.steps.length}. ${line(last)}${last.outputs.length ? ` — ${last.outputs.join("; ")}` : ""}` : "Nothing has happened yet. Let a robot detect somebody.";
  id("broken").replaceChildren(...frame.broken.map((it) => html("p", { class: "trouble" }, html("b", {}, `${it} is broken: `), properties.get(it)?.statement ?? "", ". The run ends here; undo goes on.")));
  air();
  id("robots").replaceChildren(...scene.robots(walk.robots, frame, card));
  offered = guide.draw(play, walk.possible, isGuided && play.text === guideText, line);
}

const button = (label, step, kind) => html("button", { type: "button", class: kind, onclick: () => attempt(() => take(step)) }, label);

function air() {
  const groups = messages();
  const rows = groups.map((ways) => {
    const { from, to } = ways[0].step.place.between;
    const what = `${walk.robots[from]} → ${walk.robots[to]}: ${ways[0].step.action}`;
    return html("li", {}, html("span", { class: "what" }, what), html("span", { class: "buttons", role: "group", "aria-label": what },
      ways.map(({ fate, step }) => button(FATES[fate], step, fate === "lost" ? "harm" : undefined))));
  });
  const all = groups.some((ways) => ways.some(({ fate }) => fate === "arrives"))
    ? html("p", {}, html("button", { type: "button", id: "all", onclick: () => attempt(deliverAll) }, "Deliver all that is on air")) : "";
  const frame = walk.frames[walk.frames.length - 1];
  const waiting = frame.onAir.length > 1 ? html("p", { class: "faint" }, `${frame.onAir.length} messages are on air; what becomes of them is decided one after the other.`) : "";
  id("air").replaceChildren(rows.length ? html("ul", { class: "ways" }, rows) : html("p", { class: "faint" }, "None."), waiting, all);
}

function card(robot, lane) {
  const own = walk.possible.filter((step) => step.place.at === lane);
  if (!own.length && walk.possible.some(isUnderWay) && !robot.isDown) return html("p", { class: "faint" }, "First decide what becomes of the messages on air.");
  const label = (step) => step.action.replace(/^timer (.*) expires$/, "let timer $1 run out").replace(/^./, (first) => first.toUpperCase());
  return html("div", { class: "acts", role: "group", "aria-label": `What may happen at ${walk.robots[lane]}` }, own.map((step) => button(label(step), step, BREAKDOWN.test(step.action) ? "harm" : undefined)));
}

// The next message whose fate is decided, if it can have this one.
const fated = (fate) => messages()[0]?.find((it) => it.fate === fate)?.step;

// A message to a robot that is down can only be lost.
async function deliverAll() {
  while (walk.frames[walk.frames.length - 1].onAir.length) {
    const step = fated("arrives") ?? fated("lost");
    if (!step) return;
    await take(step);
  }
}

// Asks for the next step: the crossing goes on, messages get lost and delayed as often as the sliders say, and now and
// then something fails. Nothing more once all are across and idle.
function next() {
  const number = (name) => Number(id(name).value);
  const chances = { seed: number("seed"), loss: number("loss"), delay: number("delay"), breakdowns: id("breakdowns").checked };
  return post("api/next", { run: runOf(play.scenario, play.text, play.steps), chances });
}

// The guide leads on by this choice.
const lead = (kind) => offered[kind] && take(offered[kind]);

// Begins the guide where the play is on its way; elsewhere it begins a play anew.
async function guided() {
  isGuided = true;
  draw();
  if (id("guide").hidden) await choose("pair");
  id("guide-next").focus();
}

function free() {
  isGuided = false;
  draw();
}

function stop() {
  clearInterval(timer);
  timer = null;
  id("auto").textContent = "Run by itself";
  id("auto").setAttribute("aria-pressed", "false");
}

function toggle() {
  if (timer) { stop(); return; }
  isGuided = false;
  draw();
  id("auto").textContent = "Stop";
  id("auto").setAttribute("aria-pressed", "true");
  timer = setInterval(() => attempt(async () => {
    if (!timer) return;
    const step = await next();
    if (!step || play.steps.length >= 1_500) { stop(); return; }
    await take(step);
  }), PAUSE_MS);
}

function begin(text) {
  stop();
  const shipped = scenarios.find((it) => it.text === text);
  return show({ scenario: shipped ? shipped.name : nameIn(text), text: shipped ? null : text, steps: [], redo: [] });
}

function choose(name) {
  const it = scenarios.find((it) => it.name === name);
  id("text").value = withRoom(it.name, it.text) ?? it.text;
  return begin(id("text").value);
}

function keys(event) {
  if (event.target.closest("select, textarea, input, summary") || event.ctrlKey || event.altKey || event.metaKey) return;
  if (event.key === " " && event.target.closest("button, .rows")) return;
  const doing = {
    n: () => lead("next"), a: deliverAll, u: () => back(play.steps.length - 1), r: again, " ": toggle,
    d: () => { const step = fated("arrives") ?? fated("arrivesLate"); return step && take(step); },
    l: () => { const step = fated("lost"); return step && take(step); },
    w: () => { const step = fated("delayed"); return step && take(step); },
  }[event.key];
  if (!doing) return;
  event.preventDefault();
  attempt(doing);
}

async function start() {
  const [listed, texts] = await Promise.all(["scenarios", "properties"].map((it) => load(`api/${it}`)));
  scenarios = listed;
  guideText = withRoom("pair", scenarios.find((it) => it.name === "pair").text);
  properties = scene.byId(texts);
  id("scenario").replaceChildren(...scenarios.map((it) => html("option", { value: it.name }, `${it.name}: ${it.summary}`)));
  id("scenario").value = "pair";
  const on = (name, kind, doing) => id(name).addEventListener(kind, doing);
  on("scenario", "change", () => attempt(() => choose(id("scenario").value)));
  on("begin", "click", () => attempt(() => begin(id("text").value)));
  on("anew", "click", () => attempt(() => back(0)));
  on("undo", "click", () => attempt(() => back(play.steps.length - 1)));
  on("redo", "click", () => attempt(again));
  for (const kind of ["next", "lose", "power"]) on(`guide-${kind}`, "click", () => attempt(() => lead(kind)));
  on("guide-free", "click", free);
  on("guided", "click", () => attempt(guided));
  on("auto", "click", toggle);
  on("save", "click", () => save(`${play.scenario.replace(/[^\w-]+/g, "-")}.json`, runOf(play.scenario, play.text, play.steps)));
  on("setup", "submit", (event) => {
    event.preventDefault();
    const number = (name) => Number(id(name).value);
    id("text").value = own({ robots: number("robots-wanted"), detecting: number("detecting"), followers: number("followers"), task: id("task").value, delayed: number("delayed") });
    attempt(() => begin(id("text").value));
  });
  on("file", "change", () => attempt(async () => {
    const file = await opened(id("file"));
    if (file) await open(file.run);
  }));
  for (const name of ["loss", "delay"]) on(name, "input", () => { id(`${name}-now`).textContent = `${id(name).value} %`; });
  document.addEventListener("keydown", keys);
  on("link", "click", () => attempt(async () => {
    await navigator.clipboard.writeText(location.href);
    id("said").setAttribute("aria-live", "polite");
    id("said").textContent = "The link is copied: it shows this play in another browser, too.";
  }));
  const fromAddress = async () => {
    const run = await linked();
    if (run) await open(run);
  };
  addEventListener("hashchange", () => attempt(fromAddress));
  id("text").value = "";
  const refused = await fromAddress().then(() => null, causeOf);
  if (!walk) await choose("pair");
  if (refused) trouble(refused);
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => trouble(`The page could not be filled: ${causeOf(error)}`));
