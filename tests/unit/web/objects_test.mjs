// SPDX-License-Identifier: GPL-3.0-or-later
// Objects as orcaview sends them, read by the page. tests/data/view/frames.json holds frames of a running system, and what the
// system's own tools say is in them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

import { decode } from "../../../web/cdr.js";
import { numbersOf, parseLayout, valueAt } from "../../../web/layout.js";

const HEAD = 32;
const FRAMES = JSON.parse(readFileSync(new URL("../../data/view/frames.json", import.meta.url), "utf8"));

/** Makes typed arrays comparable with lists. */
function plain(value) {
  if (ArrayBuffer.isView(value) || Array.isArray(value)) return Array.from(value, plain);
  if (value !== null && typeof value === "object") return Object.fromEntries(Object.entries(value).map(([name, each]) => [name, plain(each)]));
  return value;
}

function bytesOf(hex) {
  return Uint8Array.from(hex.match(/../g), (byte) => parseInt(byte, 16)).buffer;
}

for (const { type, layout, frame, object } of FRAMES) {
  test(`a frame with ${type} is read to the last bit`, () => {
    assert.deepEqual(plain(decode(parseLayout(layout), bytesOf(frame), HEAD)), object);
  });

  test(`a frame with ${type} that was cut off is refused, wherever it ends`, () => {
    const buffer = bytesOf(frame);
    const read = parseLayout(layout);
    for (let end = HEAD; end < buffer.byteLength; end += 3) assert.throws(() => decode(read, buffer.slice(0, end), HEAD), RangeError);
  });
}

test("a list whose length lies is refused before memory is taken for it", () => {
  const buffer = new Uint8Array([255, 255, 255, 127]).buffer;
  assert.throws(() => decode(parseLayout("A{x:sequence<double>}"), buffer), RangeError);
  assert.throws(() => decode(parseLayout("A{x:sequence<B{y:string}>}"), buffer), RangeError);
});

test("numbers stand at multiples of their size", () => {
  const bytes = new DataView(new ArrayBuffer(32));
  bytes.setUint8(0, 1);
  bytes.setUint32(4, 7, true);
  bytes.setFloat64(8, 0.5, true);
  bytes.setInt32(16, -3, true);
  bytes.setBigInt64(24, 5n, true);
  const read = decode(parseLayout("A{a:bool,b:uint32,c:double {m},d:int32,e:int64}"), bytes.buffer);
  assert.deepEqual(read, { a: true, b: 7, c: 0.5, d: -3, e: 5 });
});

test("a layout tells parent, units, enumerators, lists and arrays apart", () => {
  const { parent, fields } = parseLayout("Door:GoalPoint{width:double {m},kind:Kind(OPEN,SHUT),poses:sequence<P{x:double {m}}>,c:double[4] {m2, m rad}}");
  assert.equal(parent, "GoalPoint");
  assert.deepEqual(fields.map(({ name, unit }) => [name, unit]), [["width", "m"], ["kind", ""], ["poses", ""], ["c", "m2, m rad"]]);
  assert.deepEqual(fields[1].type, { kind: "enum", name: "Kind", words: ["OPEN", "SHUT"] });
  assert.equal(fields[2].type.of.fields[0].unit, "m");
  assert.equal(fields[3].type.size, 4);
});

test("what is no layout is refused with the place", () => {
  for (const text of ["", "A", "A{", "A{x}", "A{x:double", "A{x:double}}", "double", `${"A{a:".repeat(30)}bool${"}".repeat(30)}`]) {
    assert.throws(() => parseLayout(text), /layout: expected .* at character \d+/);
  }
});

test("numbers of a type are offered for plots by their paths", () => {
  const type = parseLayout("A{name:string,point:P{x:double {m}},ranges:sequence<double> {m},on:bool}");
  assert.deepEqual(numbersOf(type), [{ path: "point.x", unit: "m" }, { path: "ranges[0]", unit: "m" }, { path: "on", unit: "" }]);
  const object = { point: { x: 2 }, ranges: [3, 4] };
  assert.equal(valueAt(object, "point.x"), 2);
  assert.equal(valueAt(object, "ranges[1]"), 4);
  assert.equal(valueAt(object, "ranges[9]"), undefined);
  assert.equal(valueAt(object, "point.x.y"), undefined);
});
