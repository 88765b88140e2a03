// Results from files: a section for each, with its plots and with what the paper says.

import { html, id, table } from "/shell/dom.js";
import { causeOf, load, trouble } from "/shell/model.js";
import { Plot } from "./plot.js";

function section(numbered, place) {
  const plots = numbered.figures.map((figure, at) => new Plot(figure, `figure-${place + 1}-${at + 1}`).root);
  const rows = numbered.statements.map((it) => ({ cells: [it.about, it.paper, it.measured, it.rule, [it.outcome, it.outcome === "met" ? "met" : "unmet"]] }));
  return html("section", { "aria-label": numbered.file },
    html("h2", {}, numbered.about, " ", html("span", { class: "faint" }, numbered.file)),
    html("div", { class: "figures" }, plots),
    rows.length ? [html("h3", {}, "Beside the paper"), table(`Statements of the paper, and ${numbered.file}`, ["about", "paper", "measured", "rule", "outcome"], rows)] : "");
}

async function start() {
  const files = await load("api/figures");
  id("what").textContent = files.map((it) => it.file).join(", ");
  id("figures").replaceChildren(...files.map(section));
  if (!files.length) {
    id("figures").replaceChildren(html("p", {}, "This studio was given no results. These commands make some, and show them:"),
      html("pre", {}, "crossguard odds --json > odds.json\ncrossguard simulate obs --json > obs.json\ncrossguard simulate cbr --json > cbr.json\ncrossguard studio --numbers odds.json --numbers obs.json --numbers cbr.json"));
  }
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => trouble(`The page could not be filled: ${causeOf(error)}`));
