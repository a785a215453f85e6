// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The file inside the page: base64, zlib, a JSON text, and columns of whole numbers. columns.h
// describes the columns.
"use strict";

const Columns = (function () {
  function bytesOfBase64(text) {
    const raw = atob(text.trim());
    const bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
    return bytes;
  }

  // Inflates bytes in zlib's format. Rejects with a text for people in browsers that cannot.
  async function inflated(bytes) {
    if (typeof DecompressionStream === "undefined") {
      throw new Error("This browser is too old for this page: it cannot inflate data " +
        "(DecompressionStream). Chrome 80, Firefox 113 and Safari 16.4 can, and newer ones.");
    }
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  // Decodes `count` numbers from `offset` on, each a difference from the one `lag` before it.
  // Returns an Int32Array, or a Float64Array if the column is wide.
  function decode(bytes, offset, count, lag, wide) {
    const values = wide ? new Float64Array(count) : new Int32Array(count);
    let at = offset;
    for (let i = 0; i < count; ++i) {
      let code = 0;
      let factor = 1;
      let byte = bytes[at++];
      // Shifts would cut off what exceeds 32 bits.
      while (byte >= 0x80) {
        code += (byte - 0x80) * factor;
        factor *= 0x80;
        byte = bytes[at++];
      }
      code += byte * factor;
      const difference = code % 2 === 0 ? code / 2 : -(code + 1) / 2;
      values[i] = difference + (i >= lag ? values[i - lag] : 0);
    }
    return values;
  }

  // A decoded file. Columns are decoded when they are first used.
  class File {
    constructor(bytes) {
      const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
      this.head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
      this.bytes = bytes.subarray(4 + length);
      this.decoded = new Map();
    }

    column(index) {
      if (!this.decoded.has(index)) {
        const [offset, count, lag, wide] = this.head.columns[index];
        this.decoded.set(index, decode(this.bytes, offset, count, lag, wide === 1));
      }
      return this.decoded.get(index);
    }
  }

  return {bytesOfBase64, inflated, decode, File};
})();
