// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"use strict";

const assert = require("assert");
const zlib = require("zlib");
const {load, run} = require("./load.js");

const {Columns} = load();
const plain = (values) => Array.from(values);

// The file of a JSON text and columns' bytes, as replay_encoder.cpp writes it.
function fileOf(json, bytes) {
  const text = Buffer.from(JSON.stringify(json));
  const length = Buffer.alloc(4);
  length.writeUInt32LE(text.length);
  return new Uint8Array(Buffer.concat([length, text, Buffer.from(bytes)]));
}

run({
  // The same bytes as in columns_test.cpp.
  decodesDifferences() {
    const bytes = Uint8Array.from([10, 11, 2, 0xd8, 0x04]);
    assert.deepStrictEqual(plain(Columns.decode(bytes, 0, 4, 1, false)), [5, -1, 0, 300]);
  },
  decodesRecords() {
    const bytes = Uint8Array.from([99, 14, 0xc8, 0x01, 2, 0]);
    assert.deepStrictEqual(plain(Columns.decode(bytes, 1, 4, 2, false)), [7, 100, 8, 100]);
  },
  decodesWideNumbers() {
    // 2^40: zigzag 2^41 is bit 6 of the sixth group of 7 bits.
    const bytes = Uint8Array.from([0x80, 0x80, 0x80, 0x80, 0x80, 0x40]);
    assert.deepStrictEqual(plain(Columns.decode(bytes, 0, 1, 1, true)), [Math.pow(2, 40)]);
  },
  decodesNothing() {
    assert.strictEqual(Columns.decode(new Uint8Array(0), 0, 0, 1, false).length, 0);
  },
  readsAFile() {
    const file = new Columns.File(fileOf({name: "ü", columns: [[0, 2, 1, 0], [2, 1, 1, 0]]}, [2, 4, 7]));
    assert.strictEqual(file.head.name, "ü");
    assert.deepStrictEqual(plain(file.column(0)), [1, 3]);
    assert.deepStrictEqual(plain(file.column(1)), [-4]);
    assert.strictEqual(file.column(0), file.column(0));
  },
  async inflatesBase64() {
    const text = zlib.deflateSync(Buffer.from("a run")).toString("base64");
    const bytes = await Columns.inflated(Columns.bytesOfBase64(" " + text + "\n"));
    assert.strictEqual(Buffer.from(bytes).toString(), "a run");
  },
  async refusesDamage() {
    await assert.rejects(Columns.inflated(Uint8Array.from([1, 2, 3])));
  },
});
