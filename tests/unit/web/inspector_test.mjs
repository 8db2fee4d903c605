// SPDX-License-Identifier: GPL-3.0-or-later
// What is shown of a component, without a browser: elements here only keep what is put into them.
import assert from "node:assert/strict";
import test from "node:test";

import { Inspector } from "../../../web/inspector.js";

class Element extends EventTarget {
  /** @param {string} [tag] */
  constructor(tag = "") {
    super();
    this.tag = tag;
    this.children = [];
    this.dataset = {};
    this.hidden = false;
  }
  append(...children) {
    this.children.push(...children);
  }
  replaceChildren(...children) {
    this.children = children;
  }
  setAttribute() {}
  closest() {
    return null;
  }
  querySelectorAll(tag) {
    return this.children.flatMap((child) => (child instanceof Element ? [...(child.tag === tag ? [child] : []), ...child.querySelectorAll(tag)] : []));
  }
  get childElementCount() {
    return this.children.length;
  }
  get textContent() {
    return this.children.map((child) => child.textContent ?? String(child)).join("");
  }
  set textContent(text) {
    this.children = [text];
  }
}

/** A connection whose log has one old line; what a stream shows is in the test's hands. */
class Talk extends EventTarget {
  constructor() {
    super();
    this.steers = false;
    this.takes = new Map();
    this.streams = [];
  }
  may() {
    return false;
  }
  refusal() {
    return "";
  }
  async ask(command) {
    return { ok: true, records: command === "log" ? [{ who: "goto", time: 1, level: "info", text: "old" }] : [], text: "", notes: [], error: "" };
  }
  stream(_command, _words, record) {
    const stream = { record, isOpen: true };
    this.streams.push(stream);
    return () => {
      stream.isOpen = false;
    };
  }
}

const settled = () => new Promise((resolve) => setTimeout(resolve));

test("the log of a component goes on after a new connection, and shows no line twice", async (t) => {
  globalThis.document = { createElement: (tag) => new Element(tag) };
  t.after(() => delete globalThis.document);
  const connection = new Talk();
  const system = Object.assign(new EventTarget(), { components: new Map(), ports: new Map(), wires: [], portsThat: () => [] });
  const inspector = new Inspector(new Element(), connection, system, () => {});
  inspector.show({ component: "goto" });
  await settled();
  connection.dispatchEvent(new Event("hello"));
  await settled();
  assert.deepEqual(connection.streams.map(({ isOpen }) => isOpen), [false, true]);
  connection.streams[1].record({ who: "goto", time: 2, level: "info", text: "new" });
  connection.streams[1].record({ who: "base", time: 2, level: "info", text: "of another" });
  assert.deepEqual(inspector.log.children.map((line) => line.textContent), ["1.0 old", "2.0 new"]);
});

test("a page that shows no component follows no log when it connects", async (t) => {
  globalThis.document = { createElement: (tag) => new Element(tag) };
  t.after(() => delete globalThis.document);
  const connection = new Talk();
  new Inspector(new Element(), connection, new EventTarget(), () => {});
  connection.dispatchEvent(new Event("hello"));
  await settled();
  assert.equal(connection.streams.length, 0);
});
