// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { decode } from "./cdr.js";
import { parseLayout } from "./layout.js";

/**
 * The one connection to orcaview (docs/orcaview-messages.md). It comes back by itself, and looks that were under way go on then.
 *
 * @typedef {{ok: boolean, records: Record<string, any>[], text: string, notes: string[], error: string, type: string, object: any}} Answer
 * @typedef {{passed: number, created: number, lost: number, leftOut: number, bytes: number, type: string}} Passage
 *   passed and created by the run's clock [s]; lost and leftOut count objects since the look began
 * @typedef {{port: string, rate: number, take: (object: any, passage: Passage) => void, state: (text: string, type: string) => void,
 *   type: string, again: number}} Look
 * @typedef {{system: string, role: string, time: number, version: string, recorded?: boolean}} Hello
 */

/** The roles, each of which includes those before it. */
const ROLES = ["observe", "operate", "change"];
/** What this page may order, as on a command line. `line` is what sends an object to a port; `file --keep` keeps a layout beside the graph. */
const ORDERS = ["estop", "line", "suspend", "resume", "restart", "swap", "set", "connect", "disconnect", "apply", "pace 1", "pause", "step", "file --keep"];

const PROTOCOL = "orca.view.v1";
const HEAD = 32;
const FIRST_PAUSE = 250;
const LONGEST_PAUSE = 4000;
const LOOK_AGAIN = 1000;

/** @type {Answer} */
const CUT_OFF = { ok: false, records: [], text: "", notes: [], error: "the connection to orcaview is lost", type: "", object: null };

/**
 * Events: `hello` when a system is there, `gone` when it has ended, `moved` when the time of a recording was set, `state` when the
 * connection comes or goes or it is known what this page may do, `figures` when objects were dropped for this page.
 */
export class Connection extends EventTarget {
  /** @param {string} url  of the WebSocket, with the token */
  constructor(url) {
    super();
    this.url = url;
    /** @type {WebSocket | null} */
    this.socket = null;
    /** @type {Hello | null} */
    this.hello = null;
    this.role = "";
    /** @type {Map<string, string>} the role that each order takes, as the system says it */
    this.takes = new Map();
    this.isOpen = false;
    this.dropped = 0;
    this.next = 1;
    this.pause = FIRST_PAUSE;
    /** @type {Map<number, {resolve: (answer: Answer) => void, record: ((record: any) => void) | null, object: any}>} */
    this.asked = new Map();
    /** @type {Map<number, Look>} */
    this.looks = new Map();
    /** @type {Record<string, {parent: string, layout: string}>} */
    this.types = {};
    /** @type {Map<string, import("./layout.js").Struct>} */
    this.parsed = new Map();
  }

  open() {
    const socket = new WebSocket(this.url, PROTOCOL);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.isOpen = true;
      this.pause = FIRST_PAUSE;
      this.dispatchEvent(new Event("state"));
    };
    socket.onmessage = (event) => {
      if (typeof event.data === "string") this.takeText(JSON.parse(event.data));
      else this.takeObject(event.data);
    };
    socket.onclose = () => this.lose();
    this.socket = socket;
  }

  lose() {
    this.isOpen = false;
    this.socket = null;
    this.hello = null;
    for (const { resolve } of this.asked.values()) resolve(CUT_OFF);
    this.asked.clear();
    this.dispatchEvent(new Event("state"));
    setTimeout(() => this.open(), this.pause);
    this.pause = Math.min(LONGEST_PAUSE, 2 * this.pause);
  }

  /** The system is not there. */
  end() {
    this.hello = null;
    this.dispatchEvent(new Event("gone"));
  }

  /** Whether there is a system that takes orders. A recording takes none. */
  get steers() {
    return this.hello !== null && this.hello.recorded !== true;
  }

  /**
   * @param {string} order  of ORDERS
   * @returns {string} why this page may not give it; "": it may
   */
  refusal(order) {
    const needed = this.takes.get(order);
    if (needed === undefined) return "";  // not known yet: the system refuses what may not be
    if (ROLES.indexOf(this.role) >= ROLES.indexOf(needed)) return "";
    return `This takes the role ${needed}; this address has ${this.role}.`;
  }

  /** @param {string} order  of ORDERS @returns {boolean} */
  may(order) {
    return this.steers && this.refusal(order) === "";
  }

  /** Learns which role each order takes: the system decides it. */
  async learnRoles() {
    const { records } = await this.ask("roles", ...ORDERS);
    this.takes = new Map(records.map(({ order, role }) => [order, role]));
    this.dispatchEvent(new Event("state"));
  }

  /** @param {any} message @returns {boolean} whether it could be sent */
  put(message) {
    if (this.socket === null || !this.isOpen) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  /** @param {any} message @param {((record: any) => void) | null} record @returns {{id: number, answer: Promise<Answer>}} */
  request(message, record = null) {
    const id = this.next++;
    const answer = new Promise((/** @type {(answer: Answer) => void} */ resolve) => {
      if (this.put({ ...message, id })) this.asked.set(id, { resolve, record, object: null });
      else resolve(CUT_OFF);
    });
    return { id, answer };
  }

  /**
   * Gives a command of orcactl.
   * @param {string} command
   * @param {...string} words
   * @returns {Promise<Answer>}
   */
  ask(command, ...words) {
    return this.request({ op: "ask", command, words }).answer;
  }

  /**
   * Gives `diff` or `apply` the text of a graph instead of a file of the deployer's machine.
   * @param {string} command
   * @param {string} graph
   * @returns {Promise<Answer>}
   */
  askWithGraph(command, graph) {
    return this.request({ op: "ask", command, words: [], graph }).answer;
  }

  /**
   * Asks for the layout that is kept beside the graph, or keeps one there.
   * @param {string} [layout]  two numbers for each component, as JSON
   * @returns {Promise<Answer>} in `text` the layout
   */
  layout(layout = "") {
    return this.request({ op: "layout", layout }).answer;
  }

  /** @returns {Promise<Answer>} in `text` the graph as it runs now, as a file to come back to */
  askGraphThatRuns() {
    return this.request({ op: "ask", command: "graph", words: ["--running"], as_text: true }).answer;
  }

  /**
   * Gives a command that goes on, such as `log --follow`.
   * @param {string} command @param {string[]} words @param {(record: any) => void} record
   * @returns {() => void} ends it
   */
  stream(command, words, record) {
    const { id } = this.request({ op: "ask", command, words, stream: true }, record);
    return () => {
      this.asked.delete(id);
      this.put({ op: "cancel", id });
    };
  }

  /**
   * Sends an object in its text form to a SendServer.
   * @param {string} port
   * @param {string} xml
   * @returns {Promise<Answer>}
   */
  send(port, xml) {
    return this.request({ op: "send", port, xml }).answer;
  }

  /**
   * Asks a QueryServer; the answer has the reply in `object`.
   * @param {string} port
   * @param {string} xml
   * @returns {Promise<Answer>}
   */
  query(port, xml) {
    return this.request({ op: "query", port, xml }).answer;
  }

  /**
   * Shows the objects that pass a port, until the returned function is called.
   * @param {string} port
   * @param {number} rate  at most so many per second, the newest ones
   * @param {(object: any, passage: Passage) => void} take
   * @param {(text: string, type: string) => void} [state]  "" while it looks, otherwise why there are no objects
   * @returns {() => void}
   */
  look(port, rate, take, state = () => {}) {
    const id = this.next++;
    this.looks.set(id, { port, rate, take, state, type: "", again: 0 });
    if (this.hello !== null) this.put({ op: "look", id, port, rate });
    return () => {
      clearTimeout(this.looks.get(id)?.again);
      if (this.looks.delete(id)) this.put({ op: "unlook", id });
    };
  }

  /** @param {string} name @returns {import("./layout.js").Struct | null} */
  typeOf(name) {
    const known = this.parsed.get(name);
    if (known !== undefined) return known;
    if (!(name in this.types)) return null;
    const parsed = parseLayout(this.types[name].layout);
    this.parsed.set(name, parsed);
    return parsed;
  }

  /** @param {string} type @param {string} wanted @returns {boolean} whether an object of `type` goes where `wanted` is asked for */
  isA(type, wanted) {
    for (let at = type, steps = 0; at !== "" && steps < 20; at = this.types[at]?.parent ?? "", ++steps) if (at === wanted) return true;
    return false;
  }

  /** @param {any} message */
  takeText(message) {
    switch (message.op) {
      case "hello":
        this.role = message.role;
        if (message.present === false) return this.end();
        this.hello = message;
        this.parsed.clear();
        this.put({ op: "types" });
        if (this.steers) this.learnRoles();
        return;
      case "types":
        this.types = message.types;
        this.dispatchEvent(new Event("hello"));
        for (const [id, look] of this.looks) {  // lines of an earlier run may still be there
          clearTimeout(look.again);
          this.put({ op: "unlook", id });
          this.put({ op: "look", id, port: look.port, rate: look.rate });
        }
        return;
      case "moved":
        this.dispatchEvent(new Event("moved"));
        return;
      case "system":
        return this.end();
      case "figures":
        this.dropped = message.dropped;
        this.dispatchEvent(new Event("figures"));
        return;
      case "record":
        this.asked.get(message.id)?.record?.(message.record);
        return;
      case "answer": {
        const asked = this.asked.get(message.id);
        this.asked.delete(message.id);
        asked?.resolve({ type: "", ...message, object: this.reply(asked.object, message.type) });
        return;
      }
      default:
        this.takeLook(message);
    }
  }

  /** @param {any} message */
  takeLook(message) {
    const look = this.looks.get(message.id);
    if (look === undefined) return;
    clearTimeout(look.again);
    if (message.op === "looking") {
      look.type = message.type;
      look.state("", message.type);
    } else {
      look.state(message.error, look.type);
      look.again = setTimeout(() => this.put({ op: "look", id: message.id, port: look.port, rate: look.rate }), LOOK_AGAIN);
    }
  }

  /** @param {ArrayBuffer | null} buffer @param {string} name */
  reply(buffer, name) {
    const type = buffer === null ? null : this.typeOf(name ?? "");
    return type === null || buffer === null ? null : decode(type, buffer, HEAD);
  }

  /** @param {ArrayBuffer} buffer */
  takeObject(buffer) {
    const view = new DataView(buffer);
    const id = view.getUint32(4, true);
    if (view.getUint8(0) === 2) {
      const asked = this.asked.get(id);
      if (asked !== undefined) asked.object = buffer;
      return;
    }
    const look = this.looks.get(id);
    const type = look === undefined ? null : this.typeOf(look.type);
    if (look === undefined || type === null) return;
    look.take(decode(type, buffer, HEAD), {
      passed: view.getFloat64(8, true),
      created: view.getFloat64(16, true),
      lost: view.getUint32(24, true),
      leftOut: view.getUint32(28, true),
      bytes: buffer.byteLength - HEAD,
      type: look.type,
    });
  }
}
