// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

/**
 * Objects as they travel: CDR (XCDR1), little-endian, without an encapsulation header. Each number stands at a multiple of its
 * size, counted from the first byte of the object.
 * @typedef {import("./layout.js").Type} Type
 */

/** @type {Record<string, {size: number, get: (view: DataView, at: number) => number}>} */
const NUMBERS = {
  octet: { size: 1, get: (v, at) => v.getUint8(at) },
  uint8: { size: 1, get: (v, at) => v.getUint8(at) },
  int8: { size: 1, get: (v, at) => v.getInt8(at) },
  int16: { size: 2, get: (v, at) => v.getInt16(at, true) },
  uint16: { size: 2, get: (v, at) => v.getUint16(at, true) },
  int32: { size: 4, get: (v, at) => v.getInt32(at, true) },
  uint32: { size: 4, get: (v, at) => v.getUint32(at, true) },
  // A double holds an instant of this century to 256 ns, which is enough for eyes.
  int64: { size: 8, get: (v, at) => Number(v.getBigInt64(at, true)) },
  uint64: { size: 8, get: (v, at) => Number(v.getBigUint64(at, true)) },
  float: { size: 4, get: (v, at) => v.getFloat32(at, true) },
  double: { size: 8, get: (v, at) => v.getFloat64(at, true) },
};
const TEXT = new TextDecoder("utf-8");

/** Reads values one after the other. */
class CdrReader {
  /** @param {ArrayBuffer} buffer @param {number} begin  first byte of the object */
  constructor(buffer, begin) {
    this.buffer = buffer;
    this.begin = begin;
    this.view = new DataView(buffer, begin);
    this.at = 0;
  }

  /** @param {number} size @param {number} count @returns {number} where that many bytes begin, which are now read */
  take(size, count = 1) {
    const from = Math.ceil(this.at / size) * size;
    const to = from + size * count;
    if (to > this.view.byteLength) throw new RangeError(`object ends after ${this.view.byteLength} bytes, ${to} are needed`);
    this.at = to;
    return from;
  }

  /** @param {string} basic @returns {number | boolean | string} */
  basic(basic) {
    if (basic === "bool") return this.view.getUint8(this.take(1)) !== 0;
    if (basic === "string") return this.text();
    const number = NUMBERS[basic];
    return number.get(this.view, this.take(number.size));
  }

  text() {
    const length = this.view.getUint32(this.take(4), true);
    const from = this.take(1, length);
    return TEXT.decode(new Uint8Array(this.buffer, this.begin + from, Math.max(0, length - 1)));
  }

  /** @param {Type} of @param {number} count @returns {any} */
  several(of, count) {
    if (of.kind === "basic" && of.basic in NUMBERS) return this.numbers(of.basic, count);
    if (count > this.view.byteLength - this.at) throw new RangeError(`a list of ${count} elements does not fit into the object`);
    const values = new Array(count);
    for (let i = 0; i < count; ++i) values[i] = this.value(of);
    return values;
  }

  /** @param {string} basic @param {number} count */
  numbers(basic, count) {
    const { size, get } = NUMBERS[basic];
    if (count === 0) return new Float64Array(0);
    const from = this.take(size, count);
    if (size === 1 && basic !== "int8") return new Uint8Array(this.buffer, this.begin + from, count);
    const values = new Float64Array(count);
    for (let i = 0; i < count; ++i) values[i] = get(this.view, from + size * i);
    return values;
  }

  /** @param {Type} type @returns {any} */
  value(type) {
    switch (type.kind) {
      case "basic":
        return this.basic(type.basic);
      case "enum": {
        const index = this.view.getUint32(this.take(4), true);
        return type.words[index] ?? String(index);
      }
      case "list":
        return this.several(type.of, this.view.getUint32(this.take(4), true));
      case "array":
        return this.several(type.of, type.size);
      case "struct": {
        /** @type {Record<string, any>} */
        const values = {};
        for (const field of type.fields) values[field.name] = this.value(field.type);
        return values;
      }
    }
  }
}

/**
 * Decodes an object.
 * @param {Type} type
 * @param {ArrayBuffer} buffer
 * @param {number} [begin]  where the object begins in it
 * @returns {any} structs as objects, lists of numbers as typed arrays, enumerators and texts as strings
 * @throws {RangeError} if the bytes end before the object does
 */
export function decode(type, buffer, begin = 0) {
  return new CdrReader(buffer, begin).value(type);
}
