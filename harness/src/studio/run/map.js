// The street to scale: kerbs, lanes, zones, bodies, people, vehicles, the corridor with its lease.

import { html, id, key, look, marker, ms, svg } from "../shell/dom.js";

const MARGIN = 28;
const HEIGHT = 420;
// A car, in metres; no robot says how large one is.
const CAR = [1.8, 4.4];
const CONDUCTS = { elsewhere: "elsewhere", passing: "in the zone", waiting: "waits to cross", onRoad: "on the road", across: "across" };

export class StreetMap {
  constructor(opening) {
    this.street = opening.overview.street;
    this.robots = opening.overview.robots;
    this.lanes = new Map(this.robots.flatMap((robot, lane) => robot.stations.map((station) => [station, lane])));
    this.root = id("map");
    this.moment = null;
    if (!this.street.extent) {
      this.root.append(html("p", { class: "faint" }, "No robot says where it is."));
      return;
    }
    this.picture = svg("svg", { class: "map", role: "img", height: HEIGHT });
    this.root.append(this.picture);
    new ResizeObserver(() => this.moment && this.draw(this.moment)).observe(this.root);
    this.legend();
  }

  legend() {
    const sample = (...shapes) => svg("svg", { class: "key", width: 28, height: 16, viewBox: "0 0 28 16", "aria-hidden": "true" }, ...shapes);
    const box = (kind) => sample(svg("rect", { x: 2, y: 2, width: 24, height: 12, class: kind }));
    const items = this.robots.map((robot, lane) => [key(lane), robot.name]);
    if (this.street.waiting.some((it) => it.length)) items.push([box("zone"), "waiting zone"]);
    if (this.street.road.some((it) => it.length)) items.push([box("zone-road"), "its part of the road"]);
    if (this.street.places.length) items.push([sample(svg("path", { d: "M11 8h6m-3 -3v6", class: "spot" })), "place of the site"]);
    if (this.robots.length) items.push([box("corridor"), "escort; filled while the corridor is open"], [sample(svg("circle", { cx: 14, cy: 8, r: 6, class: "goal" })), "commanded place"]);
    if (this.robots.some((it) => it.waiting.length) || this.street.waiting.length) {
      items.push([box("cluster"), "cluster in RAM"], [sample(svg("rect", { x: 6, y: 4, width: 16, height: 8, class: "car" })), "vehicle, and its way in a second"]);
      for (const [conduct, words] of Object.entries(CONDUCTS)) items.push([sample(this.person(conduct, 14, 8)), words]);
    }
    id("map-legend").append(...items.map((item) => html("li", {}, item)));
  }

  person(conduct, x, y) {
    const kind = `person ${conduct}`;
    if (conduct === "waiting") return svg("rect", { x: x - 4, y: y - 4, width: 8, height: 8, class: kind });
    if (conduct === "onRoad") return svg("path", { d: `M${x} ${y - 5.5}l5.5 9.5h-11Z`, class: kind });
    return svg("circle", { cx: x, cy: y, r: conduct === "elsewhere" ? 2.5 : 3.5, class: kind });
  }

  draw(moment) {
    this.moment = moment;
    if (!this.picture) return;
    const width = Math.max(this.root.clientWidth, 200);
    const [west, south, east, north] = this.street.extent;
    const room = [Math.max(east - west, 6), Math.max(north - south, 6)];
    const scale = Math.min((width - 2 * MARGIN) / room[0], (HEIGHT - 2 * MARGIN) / room[1]);
    const x = (metres) => width / 2 + (metres - (west + east) / 2) * scale;
    const y = (metres) => HEIGHT / 2 - (metres - (south + north) / 2) * scale;
    const view = this.view = { width, scale, at: ([e, n]) => [x(e), y(n)] };
    const labels = [];
    // Labels stay clear of all bodies.
    view.bodies = moment.robots.flatMap((robot) => robot.body ? [view.at(robot.body.place)] : []);
    this.picture.setAttribute("viewBox", `0 0 ${width} ${HEIGHT}`);
    this.picture.setAttribute("aria-label", this.words(moment));
    this.picture.replaceChildren(
      svg("rect", { class: "ground", width, height: HEIGHT }),
      ...this.ground(view),
      ...moment.robots.flatMap((robot, lane) => this.escort(view, robot, lane)),
      ...moment.robots.flatMap((robot) => robot.vehicles.flatMap((car) => this.car(view, car, labels))),
      ...moment.robots.flatMap((robot) => this.people(view, robot, labels)),
      ...moment.robots.flatMap((robot, lane) => this.body(view, robot, lane, labels)),
      ...labels.map(({ x, y, text, kind, anchor }) => svg("text", { x, y, class: kind, "text-anchor": anchor ?? "start" }, text)),
      ...this.measure(view));
  }

  outline(view, corners) {
    return "M" + corners.map((it) => view.at(it).map((n) => n.toFixed(1)).join(" ")).join("L") + "Z";
  }

  ground(view) {
    const { lanes, kerbs, places, waiting, road } = this.street;
    const shapes = [];
    for (const [, from, to, metres] of lanes) {
      const [[x1, y1], [x2, y2]] = [view.at(from), view.at(to)];
      const shared = { x1, y1, x2, y2 };
      shapes.push(svg("line", { ...shared, class: "lane", "stroke-width": metres * view.scale }));
      shapes.push(svg("line", { ...shared, class: "lane-middle" }));
    }
    for (const [from, to] of kerbs) {
      const [[x1, y1], [x2, y2]] = [view.at(from), view.at(to)];
      shapes.push(svg("line", { x1, y1, x2, y2, class: "kerb" }));
    }
    for (const corners of road) if (corners.length) shapes.push(svg("path", { d: this.outline(view, corners), class: "zone-road" }));
    for (const corners of waiting) if (corners.length) shapes.push(svg("path", { d: this.outline(view, corners), class: "zone" }));
    for (const [name, place] of places) {
      const [x, y] = view.at(place);
      shapes.push(svg("path", { d: `M${x - 3} ${y}h6m-3 -3v6`, class: "spot" }, svg("title", {}, name)));
    }
    return shapes;
  }

  escort(view, robot, leader) {
    return robot.areas.flatMap((area) => {
      const [x, y] = view.at(area.to);
      const title = svg("title", {}, `${area.task} for ${this.robots[this.lanes.get(area.follower)]?.name ?? `station ${area.follower}`}`);
      if (area.isEscort && area.from) {
        const [x0, y0] = view.at(area.from);
        return [svg("path", { d: `M${x0} ${y0}L${x} ${y}`, class: robot.sign ? "corridor open" : "corridor", "stroke-width": 1.5 * view.scale }, title)];
      }
      const lane = this.lanes.get(area.follower) ?? leader;
      return [svg("circle", { cx: x, cy: y, r: 12, class: `goal line ${look(lane)}` }, title)];
    });
  }

  people(view, robot, labels) {
    const shapes = robot.people.map((person) => this.person(person.conduct, ...view.at(person.place)));
    if (robot.cluster?.corners.length) {
      const { corners, count } = robot.cluster;
      shapes.unshift(svg("path", { d: this.outline(view, corners), class: "cluster" }));
      const points = corners.map((it) => view.at(it));
      const [top, right] = [Math.min(...points.map((it) => it[1])), Math.max(...points.map((it) => it[0]))];
      place(labels, view, { x: right + 4, y: top + 4, text: `cluster of ${count}`, kind: "label" });
    }
    return shapes;
  }

  // One that is out of the picture is at its edge, with its distance.
  car(view, { place: [e, n], velocity }, labels) {
    const { width, scale } = view;
    const [x, y] = view.at([e, n]);
    const speed = velocity ? Math.hypot(...velocity) : null;
    const text = speed === null ? "vehicle" : speed < 0.5 ? "stands" : `${Math.round(speed * 3.6)} km/h`;
    const [left, top] = [Math.min(Math.max(x, 14), width - 14), Math.min(Math.max(y, 14), HEIGHT - 14)];
    const turn = velocity ? Math.atan2(...velocity) * 180 / Math.PI : 0;
    const away = Math.hypot(x - left, y - top) / scale;
    if (away > 0) {
      place(labels, view, { x: left + 12, y: top + 4, text: `vehicle ${text}, ${away.toFixed(0)} m outside`, kind: "label" });
      return [svg("path", { d: "M0 -9l6 14h-12Z", transform: `translate(${left.toFixed(1)} ${top.toFixed(1)}) rotate(${turn.toFixed(1)})`, class: "car" })];
    }
    const [w, l] = CAR.map((metres) => metres * scale);
    const move = `translate(${x.toFixed(1)} ${y.toFixed(1)}) rotate(${turn.toFixed(1)})`;
    place(labels, view, { x: x + w, y: y + w, text, kind: "label" });
    return [
      svg("rect", { x: -w / 2, y: -l / 2, width: w, height: l, rx: w / 5, transform: move, class: "car" }),
      speed >= 0.5 ? svg("path", { d: `M0 ${-l / 2}v${(-speed * scale).toFixed(1)}m-4 7l4 -7l4 7`, transform: move, class: "car-way" }) : ""];
  }

  body(view, robot, lane, labels) {
    const shapes = [];
    const kind = look(lane);
    if (robot.trail.length > 1) {
      shapes.push(svg("path", { d: this.outline(view, robot.trail).slice(0, -1), class: `trail line ${kind}` }));
    }
    const body = robot.body;
    if (!body) return shapes;
    const [x, y] = view.at(body.place);
    const length = (body.length ?? 0.6) * view.scale, width = (body.width ?? 0.4) * view.scale;
    const turn = `translate(${x.toFixed(1)} ${y.toFixed(1)}) rotate(${(body.heading ?? 0).toFixed(1)})`;
    const gone = robot.isRunning ? "" : " gone";
    shapes.push(svg("rect", { x: -width / 2, y: -length / 2, width, height: length, transform: turn, class: `body line ${kind}${gone}` }));
    if (body.heading !== null) shapes.push(svg("path", { d: `M0 ${-length / 2 - 12}l4 7h-8Z`, transform: turn, class: `fill ${kind}${gone}` }));
    shapes.push(svg("path", { d: marker(lane, x, y, 5), class: `marker fill ${kind}${gone}` }));
    if (robot.sign) {
      const [left, told] = robot.sign;
      const r = 16, part = Math.min(left / told, 1);
      shapes.push(svg("circle", { cx: x, cy: y, r, class: "lease-whole" }),
        svg("circle", { cx: x, cy: y, r, class: "lease", "stroke-dasharray": `${part * 2 * Math.PI * r} 999`, transform: `rotate(-90 ${x} ${y})` }));
    }
    const state = robot.isRunning ? (robot.executes || (robot.role === "none" ? "" : robot.role)) : "not running";
    place(labels, view, { x: x + (robot.sign ? 22 : 14), y: y - 10, text: this.robots[lane].name + (state ? ` · ${state}` : "") + (robot.sign ? ` · go ${ms(robot.sign[0])}` : ""), kind: "label name" });
    return shapes;
  }

  measure({ width, scale }) {
    const steps = [0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
    const metres = steps.find((step) => step * scale >= 50) ?? 1000;
    const bar = metres * scale;
    return [
      svg("path", { d: `M12 ${HEIGHT - 16}v6h${bar.toFixed(1)}v-6`, class: "scale" }),
      svg("text", { x: 18 + bar, y: HEIGHT - 9, class: "label" }, `${metres} m`),
      svg("path", { d: `M${width - 18} 34v-20m-5 8l5 -8l5 8`, class: "scale" }),
      svg("text", { x: width - 18, y: 48, class: "label", "text-anchor": "middle" }, "N")];
  }

  words(moment) {
    const robots = moment.robots.map((robot, lane) => {
      const name = this.robots[lane].name;
      return robot.body ? `${name} at ${robot.body.place[0].toFixed(1)} m east, ${robot.body.place[1].toFixed(1)} m north` : `${name} at no known place`;
    });
    const [people, cars] = ["people", "vehicles"].map((kind) => Math.max(0, ...moment.robots.map((robot) => robot[kind].length)));
    const open = moment.robots.some((robot) => robot.sign);
    return `Street: ${robots.join("; ")}; ${people} people; ${cars} vehicles; the corridor is ${open ? "open" : "closed"}`;
  }
}

// Puts a label where none is: a line lower until it is free, and inside of the picture.
function place(labels, view, label) {
  const width = label.text.length * 6.6;
  if (label.x + width > view.width - 4) { label.x -= 28; label.anchor = "end"; }
  if (label.anchor === "end" && label.x - width < 4) { label.x = 4; label.anchor = "start"; }
  const left = (it) => it.anchor === "end" ? it.x - it.text.length * 6.6 : it.x;
  const meets = (it) => Math.abs(it.y - label.y) < 15 && left(it) < left(label) + width && left(label) < left(it) + it.text.length * 6.6;
  const covers = ([x, y]) => Math.abs(y + 4 - label.y) < 18 && left(label) < x + 12 && x - 12 < left(label) + width;
  label.y = Math.max(label.y, 14);
  for (let tries = 0; tries < 40 && (labels.some(meets) || view.bodies.some(covers)); tries += 1) label.y = label.y + 15 > HEIGHT - 8 ? 14 : label.y + 15;
  labels.push(label);
}
