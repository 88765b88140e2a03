// The page: it takes the run as a whole once, and then the moment that is looked at.

import { html, id, seconds } from "../shell/dom.js";
import { StreetMap } from "../shell/map.js";
import { Messages } from "../shell/messages.js";
import * as panels from "../shell/panels.js";
import { Player } from "./player.js";
import * as source from "./source.js";
import { Timeline } from "./timeline.js";

const VERDICTS = { valid: "✓ Valid", incomplete: "! Valid, and not all of it is there", invalid: "✗ Not valid" };

function trouble(...texts) {
  id("troubles").replaceChildren(...texts.map((text) => html("p", { class: "trouble" }, text)));
}

// A server that is gone gives no answer; one that is there says why not.
const causeOf = (error) => error instanceof TypeError ? `The server does not answer (${error.message}). Was it ended? Start crossguard studio again, and load this page anew.` : error.message;

// Shows the run of these files, as if the studio had been started with them.
async function openLogs(files) {
  if (!files.length) return;
  id("main").ariaBusy = "true";
  try {
    await source.send([...files]);
    history.replaceState(null, "", "./");
    location.reload();
  } catch (error) {
    id("not-opened")?.remove();
    id("troubles").prepend(html("p", { class: "trouble", id: "not-opened" }, `The logs are not shown: ${causeOf(error)}`));
  } finally {
    id("main").ariaBusy = null;
  }
}

function takeLogs() {
  const picker = id("logs");
  if (!picker) return;
  picker.addEventListener("change", () => openLogs([...picker.files]).then(() => { picker.value = ""; }));
  for (const kind of ["dragover", "drop"]) {
    document.addEventListener(kind, (event) => {
      if (!event.dataTransfer.types.includes("Files")) return;
      event.preventDefault();
      if (kind === "drop") openLogs([...event.dataTransfer.files]);
    });
  }
}

// The newest time that was asked for is shown; those in between are left out when the server is slower.
function shower(draw) {
  let busy = false, next = null;
  return async function show(wanted) {
    if (busy) { next = wanted; return null; }
    busy = true;
    try {
      let moment;
      do {
        next = null;
        moment = await source.moment(wanted);
        draw(moment);
        wanted = next;
      } while (wanted);
      return moment;
    } catch (error) {
      trouble(causeOf(error));
      return null;
    } finally {
      busy = false;
    }
  };
}

function head(opening) {
  const { overview, verdict, logs } = opening;
  const began = new Date(overview.beganMs);
  const when = Number.isNaN(began.getTime()) ? "" : `${began.toISOString().slice(0, 19).replace("T", " ")} UTC · `;
  id("what").textContent = `${logs.join(", ")} · ${when}${seconds(overview.lasted, 1)} s · ${overview.records.toLocaleString("en")} records · ${overview.robots.map((it) => it.name).join(", ")}`;
  id("chip").textContent = VERDICTS[verdict.kind];
  id("chip").classList.add(verdict.kind);
  const left = overview.leftOut ? [`${overview.leftOut.toLocaleString("en")} records are left out: the page has no room for more.`] : [];
  trouble(...overview.troubles.map((text) => `${text}. What came before is shown.`), ...left);
  const trials = overview.trials.map((it, place) => html("option", { value: place }, `${place + 1}: ${it.leader || it.session}, ${seconds(it.from, 1)} s`));
  id("trial").append(html("option", { value: -1 }, trials.length ? `all ${trials.length}` : "none"), ...trials);
}

async function start() {
  takeLogs();
  const opening = await source.opening();
  head(opening);
  const seek = (at) => player.seek(at);
  const map = new StreetMap(opening);
  const messages = new Messages(opening, (at) => { player.pause(); seek(at); });
  const show = shower((moment) => {
    map.draw(moment);
    messages.draw(moment);
    id("robots").replaceChildren(...panels.robots(opening, moment));
    id("drops").replaceChildren(panels.drops(opening, moment));
  });
  let span = null;
  const player = new Player(opening, (at) => {
    const [from, to] = player.span;
    if (span !== player.span) { span = player.span; timeline.redraw(); }
    timeline.draw();
    return show({ run: opening.run, at, from, to, repeats: id("repeats").checked });
  });
  const timeline = new Timeline(opening, player);
  id("times").append(...panels.times(opening.overview));
  id("trials").append(panels.trials(opening.overview, (trial) => { player.choose(trial); id("play").focus(); scrollTo(0, 0); }));
  id("verdict").append(...panels.verdict(opening.verdict, (at) => player.choose(-1).then(() => seek(at)).then(() => scrollTo(0, 0))));
  // A link may name the moment: #at=MICROSECONDS.
  const named = /^#at=(\d+)$/.exec(location.hash);
  await seek(named ? Number(named[1]) : opening.verdict.at ?? 0);
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => trouble(`The page could not be filled: ${error.message}`));
