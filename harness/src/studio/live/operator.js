// Orders to robots by their operator ports. Each is asked first, by the name that the robot itself says, and nothing counts as
// done but what the robot says afterwards.

import { html, id } from "../shell/dom.js";

const PATIENCE_MS = 5000;
const AGAIN_MS = 1000;
const SHOWN = 6;

let offered = null, asking = null;
const names = [];
const at = () => new Date().toLocaleTimeString();

async function ask(question) {
  const answer = await fetch("api/operator", {
    method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(question), signal: AbortSignal.timeout(PATIENCE_MS),
  });
  if (!answer.ok) throw new Error((await answer.text()).trim());
  const said = await answer.json();
  names[question.port] = said.robot;
  relabel();
  return said;
}

// Without an answer of the server nobody knows more than that.
const cause = (error) => error instanceof TypeError || error.name === "TimeoutError" ? "The studio does not answer." : error.message;

const chosen = () => Number(id("port").value);
const called = () => names[chosen()] ?? "this robot";

function relabel() {
  [...id("port").options].forEach((it, place) => { it.textContent = names[place] ? `${names[place]}, ${offered.ports[place]}` : offered.ports[place]; });
  offered.keys.forEach(([label, key], place) => { id("keys").children[place].textContent = `${label} ${called()}… (${key})`; });
  id("order").textContent = `Ask to tell ${called()}…`;
}

// How a robot is, by a line of its port. A guard counts no people: somebody may be beside it.
function condition(state) {
  const has = [state.state, state.role === "none" ? null : state.role, state.availability === "available" ? null : `unavailable: ${state.availability}`,
    state.corridor === "open" ? "its sign shows go" : null, state.duty ? "on duty until clear" : null].filter(Boolean).join(", ");
  const isNear = state.roadOccupied || state.duty || state.executes || state.corridor !== "clear";
  return `${has}. ${isNear ? "Somebody may be on the road." : "It knows of nobody on the road."}`;
}

// Whether a person confirms it, who sees how the robot is meanwhile.
async function confirmed(there, port, line, command, isStop) {
  const box = id("asked");
  id("asked-title").textContent = `Tell ${there.robot}: ${line}?`;
  id("asked-meaning").textContent = `${there.robot}: ${command.meaning}.`;
  id("asked-road").textContent = `For somebody on the road: ${command.onRoad}.`;
  id("tell").textContent = `Tell ${there.robot}: ${line}`;
  const show = (text, can) => { id("asked-now").textContent = text; id("tell").disabled = !can; };
  show(`${there.robot} at ${at()}: ${condition(there.state)}`, true);
  box.returnValue = "";
  box.showModal();
  id(isStop ? "tell" : "cancel").focus();
  const closed = new Promise((done) => box.addEventListener("close", done, { once: true }));
  while (await Promise.race([closed.then(() => false), new Promise((done) => setTimeout(done, AGAIN_MS, true))])) {
    try {
      const now = await ask({ port });
      const isSame = now.robot === there.robot && now.boot === there.boot;
      show(isSame ? `${now.robot} at ${at()}: ${condition(now.state)}` : `${now.robot} has started since you were asked: cancel, and ask again.`, isSame);
    } catch (error) {
      show(`At ${at()}: ${cause(error)}`, false);
    }
  }
  return box.returnValue === "tell";
}

function words(robot, line) {
  switch (line.type) {
    case "refused": return `${robot} refuses it: ${line.why}`;
    case "stopped": return `${robot} has stopped.`;
    default: return `${robot}: ${line.text}`;
  }
}

function answered(...text) {
  const item = html("li", {}, text);
  id("answers").prepend(item);
  while (id("answers").children.length > SHOWN) id("answers").lastChild.remove();
  return item;
}

async function order(line, isStop = false) {
  const command = offered.commands.find((it) => it.name === line.split(" ")[0]), port = chosen();
  if (asking === port || id("asked").open) return;
  asking = port;
  let there;
  try {
    there = await ask({ port });
  } catch (error) {
    answered(`${at()} ${cause(error)}`);
    return;
  } finally {
    asking = null;
  }
  if (id("asked").open) return;
  if (!await confirmed(there, port, line, command, isStop)) {
    answered(`${at()} ${there.robot} was told nothing.`);
    return;
  }
  const sent = `${at()} “${line}” to ${there.robot}`;
  const item = answered(`${sent}: it has not answered yet.`);
  try {
    const { robot, state, said } = await ask({ port, order: { robot: there.robot, boot: there.boot, line } });
    const lines = said.map((it) => words(robot, it));
    if (!said.length) lines.push(state ? `${robot} said nothing of it.` : `${robot} has said nothing since: it may hang, and take the order when it goes on.`);
    if (state) lines.push(`${robot} then: ${condition(state)}`);
    item.replaceChildren(`${sent}, and within a second:`, html("ul", {}, lines.map((it) => html("li", {}, it))));
  } catch (error) {
    item.textContent = `${sent}: ${cause(error)}${cause(error) === error.message ? "" : " It is not known whether the robot has it."}`;
  }
}

function choose() {
  const command = offered.commands[id("word").selectedIndex];
  id("words").placeholder = command.usage;
  id("words").disabled = !command.usage;
}

async function offer() {
  offered = await (await fetch("api/operators")).json();
  if (!offered.ports.length) return;
  id("operator").hidden = false;
  id("port").append(...offered.ports.map((_, place) => html("option", { value: place })));
  id("keys").append(...offered.keys.map(([, , line], place) => html("button", { type: "button", onclick: () => order(line, !place) })));
  id("word").append(...offered.commands.map((it) => html("option", {}, it.name)));
  id("port").addEventListener("change", relabel);
  id("word").addEventListener("change", choose);
  id("words").addEventListener("keydown", (event) => { if (event.key === "Enter") id("order").click(); });
  id("order").addEventListener("click", () => order(`${id("word").value} ${id("words").disabled ? "" : id("words").value}`.trim()));
  for (const button of ["tell", "cancel"]) id(button).addEventListener("click", () => id("asked").close(button));
  document.addEventListener("keydown", (event) => {
    const place = offered.keys.findIndex(([, key]) => key === event.key);
    if (place < 0 || event.ctrlKey || event.altKey || event.metaKey || event.target.closest("input, select, dialog")) return;
    event.preventDefault();
    order(offered.keys[place][2], !place);
  });
  choose();
  relabel();
  // Asks each port for its robot; a port without a robot is asked again with the next order.
  offered.ports.forEach((_, port) => ask({ port }).catch(() => {}));
}

offer();
