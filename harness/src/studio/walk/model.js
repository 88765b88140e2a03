// Questions to the server about runs through scenarios, and runs as files.

import { html, id } from "/shell/dom.js";

async function answerOf(answer) {
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return answer.json();
}

export const load = async (path) => answerOf(await fetch(path));
export const post = async (path, body) => answerOf(await fetch(path, { method: "POST", body: JSON.stringify(body) }));

export function trouble(...texts) {
  id("troubles").replaceChildren(...texts.filter(Boolean).map((text) => html("p", { class: "trouble" }, text)));
}

// What the server said, or that it says nothing.
export const causeOf = (error) => error instanceof TypeError
  ? "The server does not answer. Was it ended? Start crossguard studio again, and load this page anew."
  : error.message;

// A run as `check --replay` reads it.
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
