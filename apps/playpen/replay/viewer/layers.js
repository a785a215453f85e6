// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A layer of drawings over time: changes of cells, and the whole layer at a few times, so that any
// moment is a few changes away.
"use strict";

const Layers = (function () {
  const kMostKeyframeBytes = 96e6; // of a layer
  const kRunCost = 8; // of a run of cells, besides its cells

  // Bytes R, G, B, A in memory, as a number of this machine's byte order.
  const kLittle = new Uint8Array(new Uint32Array([1]).buffer)[0] === 1;
  function inMemory(rgba) {
    const r = Math.floor(rgba / 0x1000000);
    const g = Math.floor(rgba / 0x10000) % 256;
    const b = Math.floor(rgba / 0x100) % 256;
    const a = rgba % 256;
    return kLittle ? ((a << 24) | (b << 16) | (g << 8) | r) >>> 0 : rgba;
  }

  class Tape {
    constructor(json, column) {
      this.name = json.name;
      this.colour = json.colour;
      this.visible = json.visible;
      this.priority = json.priority;
      this.grey = json.grey;
      this.width = json.width;
      this.height = json.height;
      this.times = new Runs.Timeline(column(json.t));
      this.first = column(json.first);
      this.count = column(json.count);
      this.colours = column(json.colours);
      this.palette = Uint32Array.from(json.palette, inMemory);
      const runs = column(json.runs);
      this.begins = [0]; // of each change: index of its first run
      this.costs = [0]; // before each change
      for (let i = 0; i < runs.length; ++i) {
        const begin = this.begins[i];
        let cost = this.costs[i];
        for (let k = begin; k < begin + runs[i]; ++k) cost += this.count[k] + kRunCost;
        this.begins.push(begin + runs[i]);
        this.costs.push(cost);
      }
      this.cells = new Uint32Array(this.width * this.height);
      this.done = 0; // changes that `cells` shows
      this.keyframes = [];
      this.addKeyframes();
    }

    // Keyframes lie where applying changes would cost more than copying the cells a few times.
    addKeyframes() {
      const bytes = 4 * this.cells.length;
      const total = this.costs[this.costs.length - 1];
      const most = Math.max(Math.floor(kMostKeyframeBytes / bytes), 1);
      const apart = Math.max(4 * this.cells.length, 200000, total / most);
      let next = apart;
      for (let i = 0; i + 1 < this.costs.length; ++i) {
        if (this.costs[i + 1] < next) continue;
        this.apply(this.done, i + 1);
        this.keyframes.push({done: i + 1, cells: this.cells.slice()});
        next = this.costs[i + 1] + apart;
      }
      this.cells.fill(0);
      this.done = 0;
    }

    // Applies the changes [from, to).
    apply(from, to) {
      for (let k = this.begins[from]; k < this.begins[to]; ++k) {
        const first = this.first[k];
        this.cells.fill(this.palette[this.colours[k]], first, first + this.count[k]);
      }
      this.done = to;
    }

    // Makes `cells` those at t. Returns the rows that may have changed, [top, bottom), or null.
    seek(t) {
      const to = this.times.before(t) + 1;
      if (to === this.done) return null;
      let start = {done: 0, cells: null};
      for (const keyframe of this.keyframes) if (keyframe.done <= to) start = keyframe;
      if (to > this.done && this.done >= start.done) {
        const rows = this.rowsOf(this.done, to);
        this.apply(this.done, to);
        return rows;
      }
      if (start.cells === null) this.cells.fill(0);
      else this.cells.set(start.cells);
      this.apply(start.done, to);
      return [0, this.height];
    }

    rowsOf(from, to) {
      let top = this.height;
      let bottom = 0;
      for (let k = this.begins[from]; k < this.begins[to]; ++k) {
        top = Math.min(top, Math.floor(this.first[k] / this.width));
        bottom = Math.max(bottom, Math.ceil((this.first[k] + this.count[k]) / this.width));
      }
      return [top, bottom];
    }
  }

  return {Tape, inMemory};
})();
