// Questions about runs through scenarios, and runs as files and in addresses.

import { html, id } from "../shell/dom.js";

async function answerOf(answer) {
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return answer.json();
}

export const load = async (path) => answerOf(await fetch(path));

// The studio answers; pages on a server of files ask the model that is beside them.
export async function post(path, body) {
  const text = JSON.stringify(body), beside = document.documentElement.dataset.model;
  if (!beside) return answerOf(await fetch(path, { method: "POST", body: text }));
  worker ??= new Worker(beside, { type: "module" });
  const { port1, port2 } = new MessageChannel();
  const answer = await new Promise((then, fail) => {
    port1.onmessage = ({ data }) => then(data);
    worker.onerror = () => fail(new Error("The model cannot be started in this browser: it wants WebAssembly and module workers."));
    worker.postMessage(`${path.replace("api/", "")}\n${text}`, [port2]);
  });
  if (answer[0] !== "+") throw new Error(answer.slice(1));
  return JSON.parse(answer.slice(1));
}

let worker = null;

const through = async (octets, stream) => new Uint8Array(await new Response(new Blob([octets]).stream().pipeThrough(stream)).arrayBuffer());

// A run for the end of an address: its JSON, deflated, in the base64 of addresses.
export async function packed(run) {
  const octets = await through(JSON.stringify(run), new CompressionStream("deflate-raw"));
  return btoa(Array.from(octets, (it) => String.fromCharCode(it)).join("")).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

// The run at the end of the page's address, if there is one.
export async function linked() {
  const text = /^#run=(.*)/.exec(location.hash)?.[1];
  if (text === undefined) return null;
  try {
    const octets = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (it) => it.charCodeAt(0));
    const run = JSON.parse(new TextDecoder().decode(await through(octets, new DecompressionStream("deflate-raw"))));
    if (Array.isArray(run.steps) && typeof run.scenario === "string") return run;
  } catch { /* It is said below. */ }
  throw new Error("The address holds no run that can be read: it was cut or changed. Copy the whole link; the play begins anew.");
}

export function trouble(...texts) {
  id("troubles").replaceChildren(...texts.filter(Boolean).map((text) => html("p", { class: "trouble" }, text)));
}

// The server's error text, or that the server does not answer.
export const causeOf = (error) => error instanceof TypeError
  ? "The server does not answer. Was it ended? Start it again, and load this page anew."
  : error.message;

// A run as `studio --replay` reads it.
export const runOf = (scenario, text, steps) => ({ scenario, ...(text ? { text } : {}), property: "", steps });

export function save(name, run) {
  const url = URL.createObjectURL(new Blob([JSON.stringify(run, null, 2) + "\n"], { type: "application/json" }));
  html("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

// The run in a file that was chosen in the page.
export async function opened(input) {
  const file = input.files[0];
  input.value = "";
  if (!file) return null;
  let run;
  try {
    run = JSON.parse(await file.text());
  } catch (error) {
    throw new Error(`${file.name}: this is no JSON: ${error.message}`);
  }
  if (!Array.isArray(run?.steps) || typeof run.scenario !== "string") throw new Error(`${file.name}: this is no run: it has no "scenario" and "steps". The studio and \`crossguard check --charts FOLDER\` write such files.`);
  return { file: file.name, run };
}

// Where a run left its scenario, in words.
export function strayed(walk, steps) {
  if (!walk.stray) return null;
  const { step, putsOut: output } = walk.stray;
  const what = `Step ${step + 1}, “${steps[step].action}”,`;
  return output
    ? `${what} goes otherwise now: the robot puts out ${output.join(", ") || "nothing"}. The states from there on are not known.`
    : `${what} cannot happen in this scenario as the protocol is now. The states from there on are not known.`;
}
