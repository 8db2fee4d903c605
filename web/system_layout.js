// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { componentOf, isSource, shortPort } from "./system_model.js";

/**
 * Where components stand in the drawing of the graph: boxes with their ports, processes and machines around them. Pixels, x to
 * the right and y down.
 *
 * @typedef {import("./system_model.js").Port} Port
 * @typedef {import("./system_model.js").Component} Component
 * @typedef {import("./system_model.js").Wire} Wire
 * @typedef {{name: string, group: string, width: number, height: number, inputs: string[], outputs: string[]}} Box
 * @typedef {{name: string, parent: string, kind: "process" | "machine"}} Group
 * @typedef {{boxes: Box[], groups: Group[], links: Link[]}} Plan  links of components
 * @typedef {{x: number, y: number}} Point
 * @typedef {Record<string, Point>} Places  middle of each box
 */

export const HEAD = 38;
export const ROW = 17;
const LETTER = 6.3;
const EDGE = 10;
const GAP = 18;
const ROOM = 14;
const TITLE = 22;
const SPACE = 24;  // between two boxes
const MANNER = { rankdir: "LR", acyclicer: "greedy", nodesep: SPACE, ranksep: 64, edgesep: 6 };
const MANY = 30;  // components that dagre does not arrange at once
const PUSH_WEIGHT = 3;  // so that what sensors push leads to the right, and what is ordered in return may lead back

/**
 * @param {Port} port
 * @returns {string} its name in the drawing, where the mark beside it says Push, Send or Query
 */
export function drawnName(port) {
  const name = shortPort(port.port);
  return name.endsWith(port.pattern) && name !== port.pattern ? name.slice(0, -port.pattern.length) : name;
}

/**
 * Returns what is to be arranged.
 * @param {Component[]} components
 * @param {Port[]} ports
 * @param {Wire[]} wires
 * @param {boolean} all  ports without a connection too
 * @returns {Plan}
 */
export function planOf(components, ports, wires, all) {
  /** @type {Map<string, Port[]>} */
  const owned = new Map();
  for (const port of ports) {
    if (port.disabled || (!all && port.connected_to.length === 0)) continue;
    const owner = componentOf(port.port);
    owned.set(owner, [...(owned.get(owner) ?? []), port]);
  }
  const boxes = components.map((component) => boxOf(component, owned.get(component.name) ?? []));
  /** @type {Map<string, Group>} */
  const groups = new Map();
  for (const { process, machine } of components) {
    if (machine) groups.set(`machine ${machine}`, { name: machine, parent: "", kind: "machine" });
    groups.set(`process ${process}`, { name: process, parent: machine ? `machine ${machine}` : "", kind: "process" });
  }
  const known = new Set(components.map((component) => component.name));
  /** @type {Map<string, {from: string, to: string, weight: number}>} */
  const links = new Map();
  for (const wire of wires) {
    const [from, to] = [componentOf(wire.from), componentOf(wire.to)];
    if (!known.has(from) || !known.has(to) || from === to) continue;
    const link = links.get(`${from}>${to}`) ?? { from, to, weight: 0 };
    link.weight += wire.pattern === "Push" ? PUSH_WEIGHT : 1;
    links.set(`${from}>${to}`, link);
  }
  return { boxes, groups: [...groups.values()], links: [...links.values()] };
}

/**
 * @param {Component} component
 * @param {Port[]} ports
 * @returns {Box}
 */
function boxOf(component, ports) {
  const inputs = ports.filter((port) => !isSource(port));
  const outputs = ports.filter(isSource);
  const longest = (/** @type {Port[]} */ some) => Math.max(0, ...some.map((port) => drawnName(port).length)) * LETTER;
  const title = 30 + 8 * Math.max(component.name.length, component.type.length * 0.8);
  return {
    name: component.name,
    group: `process ${component.process}`,
    inputs: inputs.map((port) => port.port),
    outputs: outputs.map((port) => port.port),
    width: Math.max(130, title, longest(inputs) + longest(outputs) + 2 * EDGE + GAP),
    height: HEAD + ROW * Math.max(inputs.length, outputs.length) + 8,
  };
}

/** @typedef {{from: string, to: string, weight: number}} Link */
/** @typedef {{name: string, width: number, height: number}} Tile */

/** @typedef {{places: Places, width: number, height: number}} Arranged */

/**
 * Arranges tiles so that most links lead to the right; those without a link stand below in rows.
 * @param {any} dagre  the library
 * @param {Tile[]} tiles
 * @param {Link[]} links
 * @returns {Arranged}
 */
function arrangeTiles(dagre, tiles, links) {
  const linked = new Set(links.flatMap(({ from, to }) => [from, to]));
  const above = arrangeLinked(dagre, tiles.filter(({ name }) => linked.has(name)), links);
  const below = arrangeLoose(tiles.filter(({ name }) => !linked.has(name)));
  const shift = above.height > 0 && below.height > 0 ? above.height + SPACE : above.height;
  const width = Math.max(above.width, below.width);
  /** @type {Places} */
  const places = {};
  for (const [name, { x, y }] of Object.entries(above.places)) places[name] = { x: x + (width - above.width) / 2, y };
  for (const [name, { x, y }] of Object.entries(below.places)) places[name] = { x: x + (width - below.width) / 2, y: y + shift };
  return { places, width, height: shift + below.height };
}

/**
 * @param {any} dagre
 * @param {Tile[]} tiles
 * @param {Link[]} links
 * @returns {Arranged}
 */
function arrangeLinked(dagre, tiles, links) {
  if (tiles.length === 0) return { places: {}, width: 0, height: 0 };
  const graph = new dagre.graphlib.Graph();
  graph.setGraph(MANNER);
  graph.setDefaultEdgeLabel(() => ({}));
  for (const { name, width, height } of tiles) graph.setNode(name, { width, height });
  for (const { from, to, weight } of links) graph.setEdge(from, to, { weight });
  dagre.layout(graph);
  const places = Object.fromEntries(tiles.map(({ name }) => [name, { x: graph.node(name).x, y: graph.node(name).y }]));
  return { places, width: graph.graph().width, height: graph.graph().height };
}

/**
 * @param {Tile[]} tiles
 * @returns {Arranged}
 */
function arrangeLoose(tiles) {
  const columns = Math.max(1, Math.round(Math.sqrt(tiles.length)));
  const column = Math.max(0, ...tiles.map((tile) => tile.width));
  /** @type {Places} */
  const places = {};
  let top = 0;
  for (let first = 0; first < tiles.length; first += columns) {
    const row = tiles.slice(first, first + columns);
    const height = Math.max(...row.map((tile) => tile.height));
    row.forEach(({ name }, i) => (places[name] = { x: i * (column + SPACE) + column / 2, y: top + height / 2 }));
    top += height + SPACE;
  }
  return { places, width: Math.min(columns, tiles.length) * (column + SPACE) - (tiles.length > 0 ? SPACE : 0), height: Math.max(0, top - SPACE) };
}

/**
 * Arranges a graph.
 * @param {any} dagre  the library
 * @param {Plan} plan
 * @returns {Places}
 */
export function arrange(dagre, plan) {
  if (plan.boxes.length > MANY) return arrangeByGroups(dagre, plan);
  try {
    return arrangeTogether(dagre, plan);
  } catch {
    return arrangeByGroups(dagre, plan);  // dagre fails on some graphs with groups
  }
}

/**
 * Arranges all boxes at once, so that connections between groups find a way, too.
 * @param {any} dagre
 * @param {Plan} plan
 * @returns {Places}
 */
function arrangeTogether(dagre, plan) {
  const graph = new dagre.graphlib.Graph({ compound: true });
  graph.setGraph(MANNER);
  graph.setDefaultEdgeLabel(() => ({}));
  for (const group of plan.groups) graph.setNode(`${group.kind} ${group.name}`, {});
  for (const group of plan.groups) if (group.parent !== "") graph.setParent(`${group.kind} ${group.name}`, group.parent);
  for (const { name, width, height, group } of plan.boxes) {
    graph.setNode(`component ${name}`, { width, height });
    graph.setParent(`component ${name}`, group);
  }
  for (const { from, to, weight } of plan.links) graph.setEdge(`component ${from}`, `component ${to}`, { weight });
  dagre.layout(graph);
  return Object.fromEntries(plan.boxes.map(({ name }) => {
    const { x, y } = graph.node(`component ${name}`);
    return [name, { x, y }];
  }));
}

/**
 * Arranges the boxes of each group, then the groups like boxes. All at once would let dagre think for minutes about 200 components.
 * @param {any} dagre
 * @param {Plan} plan
 * @returns {Places}
 */
function arrangeByGroups(dagre, plan) {
  /** @type {Map<string, string>} the tile that a component or group is a part of; each step goes one level up */
  const outer = new Map();
  for (const box of plan.boxes) outer.set(`component ${box.name}`, box.group);
  for (const group of plan.groups) outer.set(`${group.kind} ${group.name}`, group.parent);
  /** @type {Tile[]} */
  let tiles = plan.boxes.map(({ name, width, height }) => ({ name: `component ${name}`, width, height }));
  let links = plan.links.map(({ from, to, weight }) => ({ from: `component ${from}`, to: `component ${to}`, weight }));
  /** @type {Places} */
  const offsets = {};
  for (const kind of ["process", "machine", ""]) {
    const names = kind === "" ? [""] : plan.groups.filter((group) => group.kind === kind).map((group) => `${kind} ${group.name}`);
    const made = names.map((name) => arrangeInside(dagre, name, tiles.filter((tile) => outer.get(tile.name) === name), links, offsets));
    tiles = [...tiles.filter((tile) => !names.includes(outer.get(tile.name) ?? "")), ...made];
    links = lifted(links, (name) => (names.includes(outer.get(name) ?? "?") ? outer.get(name) ?? "" : name));
  }
  return Object.fromEntries(plan.boxes.map(({ name }) => [name, placeOf(`component ${name}`, outer, offsets)]));
}

/**
 * @param {any} dagre
 * @param {string} name  of the group; "" is the whole sheet
 * @param {Tile[]} tiles  in it
 * @param {Link[]} links
 * @param {Places} offsets  gets the places of the tiles, from the middle of the group
 * @returns {Tile} the group
 */
function arrangeInside(dagre, name, tiles, links, offsets) {
  const known = new Set(tiles.map((tile) => tile.name));
  const { places, width, height } = arrangeTiles(dagre, tiles, links.filter(({ from, to }) => known.has(from) && known.has(to)));
  for (const [tile, { x, y }] of Object.entries(places)) offsets[tile] = { x: x - width / 2, y: y - height / 2 + TITLE / 2 };
  return { name, width: width + 2 * ROOM, height: height + 2 * ROOM + TITLE };
}

/**
 * @param {Link[]} links
 * @param {(name: string) => string} up  from a tile to the one that it is a part of
 * @returns {Link[]} links of these, without those within one
 */
function lifted(links, up) {
  /** @type {Map<string, Link>} */
  const found = new Map();
  for (const link of links) {
    const [from, to] = [up(link.from), up(link.to)];
    if (from === to) continue;
    const known = found.get(`${from}>${to}`) ?? { from, to, weight: 0 };
    known.weight += link.weight;
    found.set(`${from}>${to}`, known);
  }
  return [...found.values()];
}

/**
 * @param {string} name
 * @param {Map<string, string>} outer
 * @param {Places} offsets
 * @returns {Point}
 */
function placeOf(name, outer, offsets) {
  let [x, y] = [0, 0];
  for (let at = name; at in offsets; at = outer.get(at) ?? "") {
    x += offsets[at].x;
    y += offsets[at].y;
  }
  return { x, y };
}

/**
 * Returns where a port stands at its component.
 * @param {Box} box
 * @param {Point} middle  of the box
 * @param {string} port
 * @returns {Point | null} null: the box does not show it
 */
export function portPlace(box, middle, port) {
  const input = box.inputs.indexOf(port);
  const row = input >= 0 ? input : box.outputs.indexOf(port);
  if (row < 0) return null;
  const x = middle.x + (input >= 0 ? -box.width / 2 : box.width / 2);
  return { x, y: middle.y - box.height / 2 + HEAD + ROW * (row + 0.5) };
}

const STUB = 18;
const n = (/** @type {number} */ value) => value.toFixed(1);

/**
 * @param {Point} from
 * @param {Point} to
 * @returns {string} a curve of SVG that leaves to the right and arrives from the left
 */
export function curve(from, to) {
  const reach = Math.max(34, Math.min(160, Math.abs(to.x - from.x) / 2));
  return `M${n(from.x)},${n(from.y)} C${n(from.x + reach)},${n(from.y)} ${n(to.x - reach)},${n(to.y)} ${n(to.x)},${n(to.y)}`;
}

/**
 * @param {Point} from
 * @param {Point} to
 * @param {number} share  0: from, 1: to
 * @returns {Point} a place on that curve, nearly
 */
export function along(from, to, share) {
  return { x: from.x + share * (to.x - from.x), y: from.y + (3 - 2 * share) * share * share * (to.y - from.y) };
}

/**
 * Returns the way of a connection that leads back: over or under the boxes, where fewest are in its way.
 * @param {Point} from
 * @param {Point} to
 * @param {Rectangle[]} boxes
 * @param {number} lane  number of this way among those that lead back, so that they do not lie on each other
 * @returns {{path: string, middle: Point}}
 */
export function detour(from, to, boxes, lane) {
  const [right, left] = [from.x + STUB + 4 * (lane % 4), to.x - STUB - 4 * (lane % 4)];
  const ends = boxes.filter((box) => [from, to].some((p) => p.y > box.y && p.y < box.y + box.height && p.x > box.x - STUB && p.x < box.x + box.width + STUB));
  const heights = ends.flatMap((box) => [box.y - STUB / 2 - 5 * (lane % 3), box.y + box.height + STUB / 2 + 5 * (lane % 3)]);
  const cost = (/** @type {number} */ y) => boxes.filter((box) => crosses(box, right, left, y)).length * 2000
    + Math.abs(y - from.y) + Math.abs(y - to.y) + blocked(boxes, right, from.y, y) + blocked(boxes, left, y, to.y);
  const y = heights.sort((a, b) => cost(a) - cost(b))[0] ?? Math.max(from.y, to.y) + 60;
  const bend = (/** @type {number} */ at) => Math.sign(y - at) * Math.min(8, Math.abs(y - at) / 2);
  const [down, up] = [bend(from.y), bend(to.y)];
  const path = `M${n(from.x)},${n(from.y)} H${n(right - 8)} Q${n(right)},${n(from.y)} ${n(right)},${n(from.y + down)} V${n(y - down)} `
    + `Q${n(right)},${n(y)} ${n(right - 8)},${n(y)} H${n(left + 8)} Q${n(left)},${n(y)} ${n(left)},${n(y - up)} V${n(to.y + up)} Q${n(left)},${n(to.y)} ${n(left + 8)},${n(to.y)} H${n(to.x)}`;
  return { path, middle: { x: (left + right) / 2, y } };
}

/** @typedef {{x: number, y: number, width: number, height: number}} Rectangle */

/**
 * @param {Rectangle} box
 * @param {number} right
 * @param {number} left
 * @param {number} y
 */
function crosses(box, right, left, y) {
  return y > box.y && y < box.y + box.height && right > box.x && left < box.x + box.width;
}

/**
 * @param {Rectangle[]} boxes
 * @param {number} x
 * @param {number} a
 * @param {number} b
 * @returns {number} the cost of boxes in the way up or down
 */
function blocked(boxes, x, a, b) {
  const [top, bottom] = [Math.min(a, b), Math.max(a, b)];
  return 2000 * boxes.filter((box) => x > box.x && x < box.x + box.width && bottom > box.y && top < box.y + box.height).length;
}

/**
 * Returns the rectangle around the boxes of a group, and of the groups in it.
 * @param {Plan} plan
 * @param {Places} places
 * @param {Group} group
 * @returns {{x: number, y: number, width: number, height: number}}
 */
export function frameOf(plan, places, group) {
  const key = `${group.kind} ${group.name}`;
  const inner = group.kind === "machine" ? plan.groups.filter((each) => each.parent === key).map((each) => `${each.kind} ${each.name}`) : [key];
  const room = group.kind === "machine" ? 2 * ROOM + TITLE : ROOM;
  const boxes = plan.boxes.filter((box) => inner.includes(box.group) && box.name in places);
  const left = Math.min(...boxes.map((box) => places[box.name].x - box.width / 2)) - room;
  const top = Math.min(...boxes.map((box) => places[box.name].y - box.height / 2)) - room - TITLE;
  const right = Math.max(...boxes.map((box) => places[box.name].x + box.width / 2)) + room;
  const bottom = Math.max(...boxes.map((box) => places[box.name].y + box.height / 2)) + room;
  return { x: left, y: top, width: right - left, height: bottom - top };
}

/**
 * Says whether two ports can be connected, before the deployer is asked.
 * @param {Port} from
 * @param {Port} to
 * @param {(type: string, wanted: string) => boolean} isA
 * @returns {string} "" if they fit, otherwise why not
 */
export function misfit(from, to, isA) {
  if (!isSource(from) || isSource(to)) return "connect an output on the right with an input on the left";
  if (from.pattern !== to.pattern) return `${from.pattern} does not go to ${to.pattern}`;
  if (!isA(from.type, to.type)) return `${from.type} is no ${to.type}`;
  if (from.pattern === "Query" && !isA(to.reply ?? "", from.reply ?? "")) return `the reply ${to.reply} is no ${from.reply}`;
  if (from.connected_to.includes(to.port)) return "they are connected already";
  return "";
}
