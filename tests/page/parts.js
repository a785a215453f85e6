// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Makes the messages of a live run from a replay: a whole run until a time, and the parts after it.
"use strict";

const kTurn = 36000; // in hundredths of a degree

// The bytes of a head and columns, as replay_encoder.cpp writes them.
class Encoder {
  constructor() {
    this.bytes = [];
    this.columns = [];
  }

  // Returns the column's index.
  add(values, lag = 1) {
    const wide = Array.from(values).some((value) => value < -0x80000000 || value > 0x7fffffff);
    this.columns.push([this.bytes.length, values.length, lag, wide ? 1 : 0]);
    for (let i = 0; i < values.length; ++i) {
      const difference = values[i] - (i >= lag ? values[i - lag] : 0);
      let code = difference >= 0 ? 2 * difference : -2 * difference - 1;
      for (; code >= 0x80; code = Math.floor(code / 0x80)) this.bytes.push(0x80 | (code % 0x80));
      this.bytes.push(code);
    }
    return this.columns.length - 1;
  }

  file(head) {
    const text = Buffer.from(JSON.stringify(Object.assign({}, head, {columns: this.columns})));
    const length = Buffer.alloc(4);
    length.writeUInt32LE(text.length);
    return new Uint8Array(Buffer.concat([length, text, Buffer.from(this.bytes)]));
  }
}

// What a run's JSON says of the times in (from, to], in microseconds.
class Slicer {
  // @param file  the run's columns: column(index)
  constructor(json, file, encoder, from, to) {
    Object.assign(this, {json, file, encoder, from, to});
  }

  isIn(t) {
    return t > this.from && t <= this.to;
  }

  // Of a column with times: [first index, end].
  rows(index) {
    const times = Array.from(this.file.column(index));
    const until = (limit) => times.filter((t) => t <= limit).length;
    return [until(this.from), until(this.to)];
  }
  cut(index, [first, end], change = (values) => values) {
    return this.encoder.add(change(Array.from(this.file.column(index).slice(first, end))));
  }

  poses(json, rows) {
    const begin = (values) => {
      const turns = this.from < 0 || values.length === 0 ? 0 : Math.round(values[0] / kTurn) * kTurn;
      return values.map((value) => value - turns);
    };
    return {x: this.cut(json.x, rows), y: this.cut(json.y, rows), a: this.cut(json.a, rows, begin)};
  }

  // Records {t, n, v}, or lists of readings.
  records(counts, values, [first, end]) {
    const lengths = Array.from(this.file.column(counts));
    const sum = (until) => lengths.slice(0, until).reduce((a, b) => a + b, 0);
    return {n: this.cut(counts, [first, end]), v: this.cut(values, [sum(first), sum(end)])};
  }
  log(json) {
    const rows = this.rows(json.t);
    return Object.assign({t: this.cut(json.t, rows)}, this.records(json.n, json.v, rows));
  }
  count(json) {
    const [first, end] = this.rows(json.t);
    return end - first;
  }

  robot(one, rows) {
    const made = {poses: this.poses(one.poses, rows), looks: this.log(one.looks)};
    for (const name of ["v", "side", "w", "stalled"]) made[name] = this.cut(one[name], rows);
    return made;
  }

  device(one) {
    const rows = this.rows(one.t);
    const made = {t: this.cut(one.t, rows),
      series: one.series.map((series) => Object.assign({}, series, {v: this.cut(series.v, rows)})),
      lists: one.lists.map((list) => Object.assign({}, list, this.records(list.n, list.v, rows)))};
    if (one.beams) made.beams = Object.assign({}, one.beams, {poses: this.poses(one.beams.poses, rows)});
    return made;
  }

  commands() {
    const rows = this.rows(this.json.commands.t);
    const {texts} = this.json.commands;
    const own = []; // in an order of their own
    const text = this.cut(this.json.commands.text, rows, (values) => values.map((i) => {
      if (!own.includes(texts[i])) own.unshift(texts[i]);
      return texts[i];
    }).map((one) => own.indexOf(one)));
    return {t: this.cut(this.json.commands.t, rows), device: this.cut(this.json.commands.device, rows), text,
      texts: own};
  }

  layer(one) {
    const rows = this.rows(one.t);
    const {v: count} = this.records(one.runs, one.count, rows);
    const {v: first} = this.records(one.runs, one.first, rows);
    const {v: colours} = this.records(one.runs, one.colours, rows);
    return {t: this.cut(one.t, rows), runs: this.cut(one.runs, rows), first, count, colours,
      palette: one.palette};
  }

  // Goals and texts until `to`; what becomes known later is not in them yet.
  known(name, end) {
    return this.json[name].filter((one) => one.t <= this.to).map((one) => Object.assign({}, one,
      {[end]: one[end] !== null && one[end] <= this.to ? one[end] : null}));
  }

  lists(made) {
    for (const name of ["collisions", "events", "spoken"]) {
      made[name] = this.json[name].filter((one) => this.isIn(one.t));
    }
    made.output = this.json.output.filter(([t]) => this.isIn(t));
    for (const name of ["trap_states", "timer_dues", "scores"]) made[name] = this.log(this.json[name]);
    made.commands = this.commands();
    made.goals = this.known("goals", "reached");
    made.texts = this.known("texts", "gone");
    return made;
  }

  whole() {
    const {json} = this;
    const rows = this.rows(json.frames);
    const also = (all, more) => all.map((one) => Object.assign({}, one, more(one)));
    const {walls} = json.arena;
    const all = (index) => this.encoder.add(this.file.column(index));
    return this.lists(Object.assign({}, json, {end: this.to, frames: this.cut(json.frames, rows),
      arena: Object.assign({}, json.arena, {walls: {n: all(walls.n), solid: all(walls.solid),
        xy: all(walls.xy)}}),
      robots: also(json.robots, (one) => this.robot(one, rows)),
      obstacles: also(json.obstacles, (one) => ({log: this.log(one.log)})),
      devices: also(json.devices, (one) => this.device(one)),
      layers: also(json.layers, (one) => this.layer(one))}));
  }

  part() {
    const {json} = this;
    const rows = this.rows(json.frames);
    const indexed = (all, has, make) => all.map((one, i) => [one, i]).filter(([one]) => has(one))
      .map(([one, i]) => Object.assign({i}, make(one)));
    return this.lists({end: this.to, frames: this.cut(json.frames, rows), notes: [], goals_from: 0,
      texts_from: 0, robots: json.robots.map((one) => this.robot(one, rows)),
      obstacles: indexed(json.obstacles, (one) => this.count(one.log) > 0,
        (one) => ({log: this.log(one.log)})),
      devices: indexed(json.devices, (one) => this.count(one) > 0, (one) => this.device(one)),
      layers: indexed(json.layers, (one) => this.count(one) > 0, (one) => this.layer(one))});
  }
}

const kLive = {paused: false, waiting_for: 0, factor: 1, paced: true, steered: [], over: false,
  can: {speed: true, place: true, blocks: []}};

// The bytes of a message with a run until `to`. @param head  of the replay.
function wholeUntil(head, file, to, live = kLive) {
  const encoder = new Encoder();
  const run = new Slicer(head.runs[0], file, encoder, -1, to).whole();
  return encoder.file(Object.assign({}, head, {runs: [run], live}));
}
function partOf(head, file, from, to, live = kLive) {
  const encoder = new Encoder();
  const run = new Slicer(head.runs[0], file, encoder, from, to).part();
  return encoder.file({format: 1, part: true, runs: [run], live});
}

module.exports = {Encoder, Slicer, wholeUntil, partOf, kLive};
