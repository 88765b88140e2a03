// Facts of a run in words and numbers: robots, drops, times, trials, verdicts.

import { html, id, key, ms, seconds, svg, table } from "../shell/dom.js";

const n = (value) => [value, "n"];

// Last shown values of each robot, and since when each is otherwise than before.
const shown = new Map();
const NEW_US = 1_000_000;

// A value that has changed is marked for a second of the run, and for as long as the run stands there.
function news(key, value, at) {
  const before = shown.get(key) ?? { value, at: null };
  const now = before.value === value ? before : { value, at };
  shown.set(key, now);
  return value && now.at !== null && Math.abs(at - now.at) < NEW_US ? html("mark", {}, value) : value;
}

export function robots(opening, moment) {
  const names = new Map(opening.overview.robots.flatMap((robot) => robot.stations.map((station) => [station, robot.name])));
  const name = (station) => names.get(station) ?? `station ${station}`;
  const pair = (term, value) => value ? [html("dt", {}, term), html("dd", {}, value)] : [];
  return moment.robots.map((robot, lane) => {
    const told = (term, value) => news(`${lane} ${term}`, value, moment.at);
    const fact = (term, value) => pair(term, told(term, value));
    return html("article", { class: robot.isRunning ? "robot" : "robot off", "aria-label": opening.overview.robots[lane].name },
    html("h3", {}, key(lane), opening.overview.robots[lane].name, html("span", { class: "state" }, told("state", robot.isRunning ? robot.state ?? "" : "not running"))),
    html("dl", {},
      pair("station", robot.station === null ? "" : String(robot.station)),
      fact("role", robot.role), fact("session", robot.session), fact("executes", robot.executes),
      fact("on the road", robot.duty), fact("may help", robot.availability),
      robot.followers.flatMap((it) => fact(name(it.station), `${it.task || "no task yet"}, ${it.hasLease ? "lease stands" : "no lease"}`)),
      pair("corridor", robot.sign ? `open for ${ms(robot.sign[0])} more` : ""),
      pair("speed", robot.body?.speed === null || !robot.body ? "" : `${robot.body.speed.toFixed(2)} m/s`),
      pair("last place", robot.body ? `${robot.body.place.map((it) => it.toFixed(1)).join(" m E, ")} m N, ${ms(robot.body.ageMs)} ago` : "")),
    robot.timers.length ? html("ul", { class: "timers", "aria-label": "Timers" }, robot.timers.map(timer)) : html("p", { class: "faint" }, "No timer runs."));
  });
}

// Bars are logarithmic: 10 ms to 100 s, so that a lease and a maneuver are seen on one scale.
function timer([name, left]) {
  const part = left <= 10 ? 0.02 : Math.min(Math.log10(left / 10) / 4, 1);
  return html("li", {}, html("span", { class: "timer-name" }, name),
    svg("svg", { viewBox: "0 0 100 6", preserveAspectRatio: "none", "aria-hidden": "true" }, svg("rect", { width: 100, height: 6, class: "timer-whole" }), svg("rect", { width: part * 100, height: 6, class: "timer-left" })),
    html("span", { class: "n" }, ms(left)));
}

export function drops(opening, moment) {
  const rows = opening.overview.causes.map(([layer, cause], place) => ({ counts: moment.robots.map((robot) => robot.drops[place]), layer, cause }));
  const some = rows.filter((row) => row.counts.some((count) => count > 0));
  if (!some.length) return html("p", { class: "faint" }, "Nothing.");
  return table("Dropped or ignored, by cause", ["cause", "layer", ...opening.overview.robots.map((robot) => n(robot.name))],
    some.map((row) => ({ cells: [row.cause, row.layer, ...row.counts.map(n)] })));
}

export function times(overview) {
  const pair = (it, digits) => n(`${it.mean.toFixed(digits)} ± ${it.sd.toFixed(digits)}`);
  const rows = overview.times.flatMap((it) => [
    { cells: [it.task, n(it.trials), pair(it.tNegS, 4), pair(it.roundTripS, 4), pair(it.tExecS, 2), pair(it.tTmctS, 3)] },
    ...(it.paper ? [{ attributes: { class: "faint" }, cells: [`${it.task} in the paper`, n(it.paper.trials), pair(it.paper.tNegS, 3), n("–"), n(it.paper.tExecS.toFixed(2)), pair(it.paper.tTmctS, 3)] }] : [])]);
  const notes = overview.notesOnTimes.map((note) => html("p", { class: "faint" }, note));
  if (!rows.length) return [html("p", { class: "faint" }, "No maneuver was completed between robots whose logs are here."), ...notes];
  return [table("Times of maneuvers in seconds", ["maneuver", n("completed"), n("T_neg [s]"), n("round trip [s]"), n("T_exec [s]"), n("T_TMCT [s]")], rows),
    html("p", { class: "faint" }, "Mean ± standard deviation. T_neg: from the leader's first transmission of the command to its reception, one way. T_exec: in the robots' own time."), ...notes];
}

export function trials(overview, choose) {
  if (!overview.trials.length) return html("p", { class: "faint" }, "There was no session.");
  return table("Trials", ["trial", "session", "leader", "team", n("from [s]"), n("lasted [s]"), n("corridor open [s]"), "corridor closed because"],
    overview.trials.map((it, place) => ({
      cells: [html("button", { type: "button", class: "link", onclick: () => choose(place) }, `${place + 1}`), it.session, it.leader || "–", it.team.join(", ") || "–",
        n(seconds(it.from)), n(seconds(it.to - it.from)), n(seconds(it.open)), it.closed || "–"],
    })));
}

export function verdict(verdict, seek) {
  const where = verdict.at === null ? "" : html("button", { type: "button", class: "link", onclick: () => seek(verdict.at) }, `at ${seconds(verdict.at)} s`);
  const rows = verdict.properties.map((it) => ({ attributes: { class: it.isBroken ? "broken" : undefined }, cells: [it.id, it.isBroken ? "✗ broken" : "✓ kept", it.statement] }));
  return [html("ul", { class: "sentences" }, verdict.sentences.map((it) => html("li", {}, it, " ", where))),
    rows.length ? table("Properties", ["property", "verdict", "what it says"], rows) : ""];
}
