// Where the page has its run from: the server, or the page itself where it was saved.

import { id } from "../shell/dom.js";

const saved = id("saved") && JSON.parse(id("saved").textContent);
if (saved) {
  id("repeats").parentElement.hidden = true;
  id("logs").parentElement.remove();
}

async function load(path, options) {
  const answer = await fetch(path, options);
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
}

export const opening = async () => saved ? saved.opening : load("api/opening");

// Sends logs: names and lengths in a line, and then what is in them.
export function send(logs) {
  const heads = JSON.stringify(logs.map((it) => [it.name, it.size]));
  return load("api/logs", { method: "POST", body: new Blob([heads, "\n", ...logs]) });
}

// The first of things in the order of time that are later.
function later(things, at) {
  let [low, high] = [0, things.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (things[middle].at <= at) low = middle + 1; else high = middle;
  }
  return low;
}

export async function moment({ run, at, from, to, repeats }) {
  if (!saved) return load(`api/moment?run=${run}&at=${at}&from=${from}&to=${to}&repeats=${repeats ? 1 : 0}`);
  const { moments, rows } = saved.run;
  const [first, end, now, earlier] = [from - 1, to, at, at - 1].map((it) => later(rows, it));
  const shownFrom = Math.max(now - 80, first);
  return {
    at, robots: moments[Math.max(later(moments, at) - 1, 0)].robots,
    messages: {
      count: end - first, past: now - first, shownFrom: shownFrom - first, rows: rows.slice(shownFrom, Math.min(now + 40, end)),
      previous: earlier > first ? rows[earlier - 1].at : null, next: now < end ? rows[now].at : null,
    },
  };
}
