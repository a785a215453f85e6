// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A layer of drawings over time: changes of cells, and the whole layer at a few times, so that any
// moment is a few changes away.
"use strict";

const Layers = (function () {
  const kMostKeyframeBytes = 96e6; // of a layer
  const kMostRuns = 3e5; // of a layer that grows
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
      this.first = new Runs.Numbers(column(json.first));
      this.count = new Runs.Numbers(column(json.count));
      this.colours = new Runs.Numbers(column(json.colours));
      this.palette = json.palette.map(inMemory);
      this.begins = new Runs.Begins([]); // of each change: index of its first run
      this.costs = new Runs.Begins([]); // before each change
      this.cells = new Uint32Array(this.width * this.height);
      this.done = 0; // changes that `cells` shows; -1: `cells` is out of date
      this.base = {done: 0, cells: null}; // before the first change; null: blank
      this.keyframes = [];
      this.apart = Math.max(4 * this.cells.length, 200000); // cost between keyframes
      this.addChanges(column(json.runs));
    }

    append(json, column) {
      this.times.append(column(json.t));
      this.first.append(column(json.first));
      this.count.append(column(json.count));
      const places = json.palette.map(inMemory).map((colour) => {
        const known = this.palette.indexOf(colour);
        return known >= 0 ? known : this.palette.push(colour) - 1;
      });
      this.colours.append(column(json.colours).map((i) => places[i]));
      this.addChanges(column(json.runs));
      if (this.first.length > kMostRuns) this.fold(this.times.length >> 1);
    }

    // @param runs  how many runs each new change has.
    addChanges(runs) {
      const counts = new Float64Array(runs.length);
      let at = this.begins.values[this.begins.length - 1];
      for (let i = 0; i < runs.length; ++i) {
        for (const end = at + runs[i]; at < end; ++at) counts[i] += this.count.values[at] + kRunCost;
      }
      this.begins.append(runs);
      this.costs.append(counts);
      for (let done = this.costs.length - runs.length; done < this.costs.length; ++done) {
        this.addKeyframe(done);
      }
    }

    // Keyframes lie where applying changes would cost more than copying the cells a few times.
    addKeyframe(done) {
      const last = this.keyframes[this.keyframes.length - 1] || this.base;
      if (this.costs.values[done] - this.costs.values[last.done] < this.apart) return;
      this.keyframes.push(this.frameAt(done));
      if (this.keyframes.length * 4 * this.cells.length <= kMostKeyframeBytes) return;
      this.keyframes = this.keyframes.filter((frame, i) => i % 2 === 1);
      this.apart *= 2;
    }

    // The newest of base and keyframes that shows at most `done` changes.
    before(done) {
      let found = this.base;
      for (const keyframe of this.keyframes) if (keyframe.done <= done) found = keyframe;
      return found;
    }

    frameAt(done) {
      const start = this.before(done);
      const cells = start.cells === null ? new Uint32Array(this.cells.length) : start.cells.slice();
      this.paint(cells, start.done, done);
      return {done, cells};
    }

    // Makes the first `count` changes a part of the base.
    fold(count) {
      this.base = {done: 0, cells: this.frameAt(count).cells};
      this.keyframes = this.keyframes.filter(({done}) => done > count);
      for (const keyframe of this.keyframes) keyframe.done -= count;
      this.done = this.done < count ? -1 : this.done - count;
      this.times.drop(count);
      this.costs.drop(count);
      const runs = this.begins.drop(count);
      for (const numbers of [this.first, this.count, this.colours]) numbers.drop(runs);
    }

    paint(cells, from, to) {
      const end = this.begins.values[to];
      for (let k = this.begins.values[from]; k < end; ++k) {
        const first = this.first.values[k];
        cells.fill(this.palette[this.colours.values[k]], first, first + this.count.values[k]);
      }
    }

    // Applies the changes [from, to).
    apply(from, to) {
      this.paint(this.cells, from, to);
      this.done = to;
    }

    // Makes `cells` those at t. Returns the rows that may have changed, [top, bottom), or null.
    seek(t) {
      const to = this.times.before(t) + 1;
      if (to === this.done) return null;
      const start = this.before(to);
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
      for (let k = this.begins.values[from]; k < this.begins.values[to]; ++k) {
        const first = this.first.values[k];
        top = Math.min(top, Math.floor(first / this.width));
        bottom = Math.max(bottom, Math.ceil((first + this.count.values[k]) / this.width));
      }
      return [top, bottom];
    }
  }

  return {Tape, inMemory, kMostRuns};
})();
