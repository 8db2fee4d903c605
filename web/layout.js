// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

/**
 * The layout text of an object type, read into a tree. The text is the one that identifies a type (idl/README.md):
 * `Name:Parent{field:type {unit},...}`, where a type is a basic one, `sequence<T>`, `T[9]`, a struct in full, or an enum
 * `Name(FIRST,SECOND)`. The name of a type that is not Orca's own begins with its module: `my.Name`.
 *
 * @typedef {{kind: "basic", basic: string}} Basic
 * @typedef {{kind: "enum", name: string, words: string[]}} Enum
 * @typedef {{kind: "list", of: Type}} List
 * @typedef {{kind: "array", of: Type, size: number}} FixedArray
 * @typedef {{kind: "struct", name: string, parent: string, fields: Field[]}} Struct
 * @typedef {Basic | Enum | List | FixedArray | Struct} Type
 * @typedef {{name: string, type: Type, unit: string}} Field
 */

const BASIC = new Set([
  "bool", "octet", "string", "float", "double", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64",
]);
const DEEPEST = 20;

/** Reads one text from its beginning to its end. */
class Reader {
  /** @param {string} text */
  constructor(text) {
    this.text = text;
    this.at = 0;
  }

  /** @returns {never} @param {string} wanted */
  fail(wanted) {
    throw new Error(`layout: expected ${wanted} at character ${this.at} of "${this.text.slice(0, 60)}"`);
  }

  /** @param {string} mark @returns {boolean} whether it stood there, and is now read */
  take(mark) {
    if (!this.text.startsWith(mark, this.at)) return false;
    this.at += mark.length;
    return true;
  }

  /** @param {string} mark */
  need(mark) {
    if (!this.take(mark)) this.fail(`"${mark}"`);
  }

  /** @returns {string} */
  word() {
    const begin = this.at;
    while (/[\w.]/.test(this.text.charAt(this.at))) ++this.at;
    if (begin === this.at) this.fail("a name");
    return this.text.slice(begin, this.at);
  }

  /** @param {string} end @returns {string} */
  until(end) {
    const stop = this.text.indexOf(end, this.at);
    if (stop < 0) this.fail(`"${end}"`);
    const read = this.text.slice(this.at, stop);
    this.at = stop + end.length;
    return read;
  }

  /** @param {number} depth @returns {Type} */
  type(depth) {
    if (depth > DEEPEST) this.fail("fewer levels");
    let type = this.plainType(depth);
    while (this.take("[")) {
      const size = Number(this.until("]"));
      type = Number.isInteger(size) ? { kind: "array", of: type, size } : { kind: "list", of: type };
    }
    return type;
  }

  /** @param {number} depth @returns {Type} */
  plainType(depth) {
    const name = this.word();
    if (name === "sequence" && this.take("<")) {
      const of = this.type(depth + 1);
      this.need(">");
      return { kind: "list", of };
    }
    if (this.take("(")) return { kind: "enum", name, words: this.until(")").split(",") };
    if (BASIC.has(name)) return { kind: "basic", basic: name };
    return this.struct(name, depth);
  }

  /** @param {string} name @param {number} depth @returns {Struct} */
  struct(name, depth) {
    const parent = this.take(":") ? this.word() : "";
    this.need("{");
    /** @type {Field[]} */
    const fields = [];
    while (!this.take("}")) {
      if (fields.length > 0) this.need(",");
      const field = this.word();
      this.need(":");
      const type = this.type(depth + 1);
      fields.push({ name: field, type, unit: this.take(" {") ? this.until("}") : "" });
    }
    return { kind: "struct", name, parent, fields };
  }
}

/**
 * Reads a layout.
 * @param {string} text
 * @returns {Struct}
 * @throws {Error} that says where the text is no layout
 */
export function parseLayout(text) {
  const reader = new Reader(text);
  const type = reader.type(0);
  if (type.kind !== "struct" || reader.at !== text.length) return reader.fail("the end of one struct");
  return type;
}

/**
 * Returns the paths of all numbers of a type, such as `coordinate.point.x` and `covariance[0]`, with their units. Of a list only
 * the first element is named, since nobody knows how long it is.
 * @param {Type} type
 * @param {string} [path]
 * @param {string} [unit]
 * @returns {{path: string, unit: string}[]}
 */
export function numbersOf(type, path = "", unit = "") {
  switch (type.kind) {
    case "basic":
      return type.basic === "string" ? [] : [{ path, unit }];
    case "enum":
      return [];
    case "list":
      return numbersOf(type.of, `${path}[0]`, unit);
    case "array":
      return Array.from({ length: type.size }, (_, i) => numbersOf(type.of, `${path}[${i}]`, unit)).flat();
    case "struct":
      return type.fields.flatMap((f) => numbersOf(f.type, path === "" ? f.name : `${path}.${f.name}`, f.unit));
  }
}

/**
 * Returns what stands at a path of an object; undefined where there is nothing.
 * @param {any} object
 * @param {string} path  such as `poses[2].position.x`
 * @returns {any}
 */
export function valueAt(object, path) {
  let value = object;
  for (const step of path.split(/[.[\]]+/)) {
    if (step === "") continue;
    if (value === null || typeof value !== "object" || !(step in value)) return undefined;
    value = value[step];
  }
  return value;
}
