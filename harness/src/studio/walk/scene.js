// One state: robots in words, the street as a scheme, properties that the step touches.

import { html, key, look, marker, svg } from "../shell/dom.js";

const SIGNS = { true: "shows go", false: "shows stop" };

// `more` gives what else a card has; without it, the card names the timers.
export function robots(names, frame, more) {
  return frame.robots.map((robot, lane) => html("article", { class: robot.isDown ? "robot off" : "robot", "aria-label": names[lane] },
    html("h3", {}, key(lane), names[lane], html("span", { class: "state" }, robot.isDown ? "down" : [robot.state, robot.role && `(${robot.role})`, robot.hangs && "hangs"].filter(Boolean).join(" "))),
    robot.isDown ? "" : html("p", { class: "words" }, robot.words.replace(/; timers: .*$/, "")),
    robot.timers?.length && !more ? html("p", { class: "faint" }, `Timers: ${robot.timers.join(", ")}`) : "",
    more ? more(robot, lane) : ""));
}

const PERSON = {
  waiting: (names, at, frame) => frame.isPaper || frame.robots.some((it) => it.showsGo) ? "Somebody waits at the kerb." : "Somebody waits at the kerb: no sign shows go.",
  across: () => "The person is across.",
  onRoad: (names, at, frame) => {
    const guards = names.filter((_, lane) => frame.robots[lane].guards);
    const by = `Somebody is on the road, at the ${frame.isPaper ? "word" : "sign"} of ${names[at] ?? "a robot"}.`;
    return `${by} ${guards.join(" and ") || "Nobody"} ${guards.length > 1 ? "guard" : "guards"}.`;
  },
};

export function person(names, frame) {
  const [kind, at] = typeof frame.person === "string" ? [frame.person, null] : Object.entries(frame.person)[0];
  return { kind, at, words: PERSON[kind](names, at, frame) };
}

// A scheme: the model knows places by their purpose, and no distances.
export function street(names, frame) {
  const where = person(names, frame);
  const [top, bottom] = [46, 134];
  const stripes = Array.from({ length: 6 }, (_, place) => svg("rect", { x: 290, y: top + 6 + place * 14, width: 60, height: 7, class: "stripe" }));
  const spots = { parked: [70, 165], underWay: [180, 112], inPosition: [235, 90], beside: [366, 86], fallingBack: [180, 150], ended: [70, 24] };
  const used = {};
  const bodies = frame.robots.map((robot, lane) => {
    // A guard is at the crossing: beside the person, in its place, or in a fallback that stays. A leader that fails stays at its sign.
    const atSign = robot.role === "leader" || robot.role === "requester" || robot.showsGo || (robot.isDown && where.at === lane);
    const kind = where.kind === "onRoad" && robot.escorts ? "beside" : robot.guards ? "inPosition" : atSign && robot.body === "parked" ? "sign" : robot.body;
    const row = used[kind] = (used[kind] ?? 0) + 1;
    const [x, y] = kind === "sign" ? [385 + (row - 1) * 90, 158] : [spots[kind][0] + (row - 1) * 62, spots[kind][1]];
    return svg("g", {},
      svg("g", { class: robot.isDown ? "gone" : "" },
        svg("path", { d: marker(lane, x, y, 8), class: `fill marker ${look(lane)}` }),
        svg("text", { x, y: y + 21, "text-anchor": "middle" }, short(names[lane]))),
      // The paper has a word to go, and no sign that shows stop.
      (kind === "sign" && !robot.isDown && !frame.isPaper) || robot.showsGo ? svg("g", { class: robot.showsGo ? "sign go" : "sign stop" },
        svg("rect", { x: x - 19, y: y - 31, width: 38, height: 18, rx: 3 }),
        svg("text", { x, y: y - 18, "text-anchor": "middle", class: "sign-text" }, robot.showsGo ? "GO" : "STOP")) : "");
  });
  const at = { waiting: [320, bottom + 18], onRoad: [320, (top + bottom) / 2], across: [320, top - 14] }[where.kind];
  const labels = names.map((name, lane) => `${name} ${frame.robots[lane].bodyWords}${frame.robots[lane].showsGo ? (frame.isPaper ? ", its word is go" : `, its sign ${SIGNS[true]}`) : ""}`);
  return svg("svg", { viewBox: "0 0 640 196", class: "scheme", role: "img", "aria-label": `${where.words} ${labels.join(". ")}.` },
    svg("rect", { x: 0, y: top, width: 640, height: bottom - top, class: "lane" }),
    svg("line", { x1: 0, y1: (top + bottom) / 2, x2: 640, y2: (top + bottom) / 2, class: "lane-middle" }),
    svg("line", { x1: 0, y1: top, x2: 640, y2: top, class: "kerb" }), svg("line", { x1: 0, y1: bottom, x2: 640, y2: bottom, class: "kerb" }),
    stripes, bodies,
    svg("g", { class: `walker ${where.kind}` },
      svg("circle", { cx: at[0], cy: at[1] - 9, r: 4.5 }), svg("rect", { x: at[0] - 5, y: at[1] - 3, width: 10, height: 16, rx: 4 })));
}

const short = (name) => name.replace(/^robot /, "");

// The properties of one state: broken ones first.
export function touched(frame, properties) {
  const row = (id, isBroken) => {
    const it = properties.get(id);
    return html("li", { class: isBroken ? "broken" : "" },
      html("details", {}, html("summary", {}, html("b", {}, id), isBroken ? " is broken: " : " ", it?.statement ?? ""),
        it ? html("dl", {},
          html("dt", {}, "when"), html("dd", {}, it.premise ?? "always"),
          html("dt", {}, "assumes"), html("dd", {}, it.assumes),
          html("dt", {}, "broken by"), html("dd", {}, `weakening ${it.weakening}`),
          html("dt", {}, "page"), html("dd", {}, `model-check/doc/verification.md, row ${id}`)) : ""));
  };
  const broken = frame.broken.map((id) => row(id, true));
  const met = frame.met.filter((id) => !frame.broken.includes(id)).map((id) => row(id, false));
  if (!broken.length && !met.length) return html("p", { class: "faint" }, "No property speaks about this step or the state after it.");
  return html("ul", { class: "touched" }, broken, met);
}

export const byId = (properties) => new Map(properties.map((it) => [it.id, it]));
