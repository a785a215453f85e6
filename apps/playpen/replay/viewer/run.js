// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A run: columns over time.
// Times are in seconds, lengths in m, angles in rad.
"use strict";

const Runs = (function () {
  const kPlace = 1e-4;
  const kAngle = Math.PI / 18000;
  const kMicrosecond = 1e-6;
  const kNoNumber = -2147483648;
  const kJump = 0.3; // a robot that moves so much farther than at twice its speed was placed [m]

  // Numbers in a typed array, times a unit.
  class Numbers {
    constructor(values, unit = 1) {
      this.values = values;
      this.length = values.length;
      this.unit = unit;
    }

    at(i) {
      const value = this.values[i];
      return value === kNoNumber ? NaN : value * this.unit;
    }
  }

  // Increasing times.
  class Timeline extends Numbers {
    constructor(values) {
      super(values, kMicrosecond);
    }

    // Index of the last time <= t; -1 if all are later. Half a microsecond is forgiven.
    before(t) {
      const limit = t / this.unit + 0.5;
      let low = 0;
      let high = this.length;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (this.values[middle] <= limit) low = middle + 1;
        else high = middle;
      }
      return low - 1;
    }

    // How far t is from time i to the next one, 0..1.
    share(i, t) {
      if (i < 0 || i + 1 >= this.length) return 0;
      const length = this.at(i + 1) - this.at(i);
      return length > 0 ? Math.min(Math.max((t - this.at(i)) / length, 0), 1) : 0;
    }
  }

  // Records of whole numbers, each valid from its time on.
  class ChangeLog {
    constructor(times, lengths, values) {
      this.times = times;
      this.values = values;
      this.begins = [];
      let begin = 0;
      for (let i = 0; i < lengths.length; ++i) {
        this.begins.push(begin);
        begin += lengths[i];
      }
      this.begins.push(begin);
    }

    record(i) {
      return this.values.subarray(this.begins[i], this.begins[i + 1]);
    }

    // The record at t; the first one before its time; null if there is none.
    at(t) {
      return this.times.length === 0 ? null : this.record(Math.max(this.times.before(t), 0));
    }
  }

  function posesOf(json, column) {
    return {x: new Numbers(column(json.x), kPlace), y: new Numbers(column(json.y), kPlace),
      a: new Numbers(column(json.a), kAngle)};
  }

  // A robot over the frames of its run.
  class Robot {
    constructor(json, frames, column, log) {
      this.name = json.name;
      this.colour = json.colour;
      this.parts = json.parts;
      this.core = json.core;
      this.superstructures = json.superstructures;
      this.bumpers = json.bumpers;
      this.lights = json.lights;
      this.frames = frames;
      Object.assign(this, posesOf(json.poses, column));
      this.v = new Numbers(column(json.v), kPlace);
      this.side = new Numbers(column(json.side), kPlace);
      this.w = new Numbers(column(json.w), kAngle);
      this.stalled = new Numbers(column(json.stalled));
      this.looks = log(json.looks);
      this.radius = Math.max(...[].concat(...this.parts).map(([x, y]) => Math.hypot(x, y)));
    }

    // Pose and velocity at t, between two frames linearly.
    at(t) {
      const i = Math.max(this.frames.before(t), 0);
      const k = Math.min(i + 1, this.frames.length - 1);
      const way = Math.hypot(this.x.at(k) - this.x.at(i), this.y.at(k) - this.y.at(i));
      const speed = (n) => Math.hypot(this.v.at(n), this.side.at(n));
      const most = kJump + 2 * Math.max(speed(i), speed(k)) * (this.frames.at(k) - this.frames.at(i));
      const share = way > most ? 0 : this.frames.share(i, t);
      const mix = (numbers) => numbers.at(i) + (numbers.at(k) - numbers.at(i)) * share;
      return {x: mix(this.x), y: mix(this.y), a: mix(this.a), v: mix(this.v),
        side: mix(this.side), w: mix(this.w), stalled: this.stalled.at(i) === 1};
    }

    // What moves on it at t; see look_of() in replay_builder.cpp.
    lookAt(t) {
      const record = this.looks.at(t);
      const look = {pressed: [], lit: [], paddles: [], arms: []};
      if (record === null) return look;
      let at = 0;
      const numbers = (into) => {
        for (let left = record[at++]; left > 0; --left) into.push(record[at++]);
      };
      numbers(look.pressed);
      numbers(look.lit);
      for (const shapes of [look.paddles, look.arms]) {
        for (let left = record[at++]; left > 0; --left) {
          const points = [];
          for (let point = record[at++]; point > 0; --point) {
            points.push([record[at] * kPlace, record[at + 1] * kPlace]);
            at += 2;
          }
          shapes.push(points);
        }
      }
      return look;
    }
  }

  const kStates = ["standing", "retracted", "rising", "sinking", "waiting"];

  class Obstacle {
    constructor(json, period, log) {
      Object.assign(this, json);
      this.height = json.height * 1e-3;
      this.period = period;
      this.log = log(json.log);
    }

    at(t) {
      const times = this.log.times;
      const i = Math.max(times.before(t), 0);
      const now = this.log.record(i);
      const moves = i + 1 < times.length && times.at(i + 1) - times.at(i) < 1.5 * this.period;
      const next = moves ? this.log.record(i + 1) : now;
      const share = moves ? times.share(i, t) : 0;
      const mix = (k) => now[k] + (next[k] - now[k]) * share;
      return {x: mix(0) * kPlace, y: mix(1) * kPlace, a: mix(2) * kAngle,
        size: [now[3] * kPlace, now[4] * kPlace], height: mix(5) * 1e-3, state: kStates[now[6]],
        carrier: now[7], colour: now[8] < 0 ? null : colourOf(now[8])};
    }
  }

  // "#rrggbb" of a packed RGBA.
  function colourOf(rgba) {
    return "#" + Math.floor(rgba / 256).toString(16).padStart(6, "0");
  }

  // A device and its readings.
  class Device {
    constructor(json, column) {
      this.robot = json.robot;
      this.name = json.name;
      this.type = json.type;
      this.times = new Timeline(column(json.t));
      this.series = json.series.map((one) => ({name: one.name, unit: one.unit, words: one.words,
        numbers: new Numbers(column(one.v), one.scale)}));
      this.lists = json.lists.map((one) => {
        const counts = column(one.n);
        const begins = new Float64Array(counts.length + 1);
        for (let i = 0; i < counts.length; ++i) begins[i + 1] = begins[i] + counts[i];
        return {name: one.name, unit: one.unit, begins, numbers: new Numbers(column(one.v), one.scale)};
      });
      this.beams = json.beams
        ? Object.assign({}, json.beams, posesOf(json.beams.poses, column)) : null;
    }

    // The numbers of a list in reading i.
    list(list, i) {
      const numbers = [];
      for (let k = list.begins[i]; k < list.begins[i + 1]; ++k) numbers.push(list.numbers.at(k));
      return numbers;
    }

    // What the range sensor measured last before t, in W: {laser, origin, ends} or cones; null
    // before the first reading.
    measuredAt(t) {
      const i = this.times.before(t);
      if (i < 0 || this.beams === null) return null;
      const beams = this.beams;
      const X = {x: beams.x.at(i), y: beams.y.at(i), a: beams.a.at(i)};
      const ranges = this.list(this.lists[0], i);
      const most = (k) => beams.most[Math.min(k, beams.most.length - 1)];
      const mount = (k) => {
        const [x, y, a] = beams.mounts[k];
        return {x: X.x + x * Math.cos(X.a) - y * Math.sin(X.a),
          y: X.y + x * Math.sin(X.a) + y * Math.cos(X.a), a: X.a + a};
      };
      if (beams.step > 0) {
        const from = mount(0);
        const ends = ranges.map((range, k) => {
          const a = from.a + beams.first + beams.step * k;
          return [from.x + range * Math.cos(a), from.y + range * Math.sin(a)];
        });
        return {origin: [from.x, from.y], ends, cones: null};
      }
      return {origin: null, ends: null, cones: ranges.map((range, k) => Object.assign(mount(k),
        {range, cone: beams.cone, met: range < most(k) - 1e-3}))};
    }
  }

  // Indices of `times` grouped by key(i): for lists of the last ones of a group.
  function grouped(times, key) {
    const groups = new Map();
    for (let i = 0; i < times.length; ++i) {
      if (!groups.has(key(i))) groups.set(key(i), []);
      groups.get(key(i)).push(i);
    }
    return groups;
  }

  class Run {
    constructor(json, file) {
      const column = (index) => file.column(index);
      const log = (one) =>
        new ChangeLog(new Timeline(column(one.t)), column(one.n), column(one.v));
      this.name = json.name;
      this.world = json.world;
      this.notes = json.notes;
      this.end = json.end * kMicrosecond;
      this.arena = json.arena;
      this.canvas = json.canvas;
      this.walls = wallsOf(json.arena.walls, column);
      this.frames = new Timeline(column(json.frames));
      const period = this.frames.length > 1 ? this.frames.at(1) - this.frames.at(0) : 1;
      this.robots = json.robots.map((one) => new Robot(one, this.frames, column, log));
      this.obstacles = json.obstacles.map((one) => new Obstacle(one, period, log));
      this.tracks = json.tracks;
      this.devices = json.devices.map((one) => new Device(one, column));
      for (const name of ["collisions", "events", "spoken", "goals", "texts"]) {
        this[name] = json[name].map((one) => Object.assign({}, one, {t: one.t * kMicrosecond}));
      }
      for (const goal of this.goals) {
        goal.reached = goal.reached === null ? Infinity : goal.reached * kMicrosecond;
      }
      for (const text of this.texts) {
        text.gone = text.gone === null ? Infinity : text.gone * kMicrosecond;
      }
      this.traps = json.traps;
      this.trapStates = log(json.trap_states);
      this.timers = json.timers;
      this.timerDues = log(json.timer_dues);
      this.scores = log(json.scores);
      this.verdict = json.verdict || null;
      this.commands = {times: new Timeline(column(json.commands.t)),
        device: column(json.commands.device), text: column(json.commands.text),
        texts: json.commands.texts};
      this.commandsOf = grouped(this.commands.times,
        (i) => this.devices[this.commands.device[i]].robot);
      this.output = json.output.map(([t, text, error]) => ({t: t * kMicrosecond, text,
        error: error === 1}));
      this.layers = json.layers.map((one) => new Layers.Tape(one, column));
    }

    robotNamed(name) {
      return this.robots.findIndex((robot) => robot.name === name);
    }

    // The last `most` commands to a robot before t, newest first: {t, device, text}.
    commandsBefore(robot, t, most) {
      const own = this.commandsOf.get(robot) || [];
      const last = this.commands.times.before(t);
      let low = 0;
      let high = own.length;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (own[middle] <= last) low = middle + 1;
        else high = middle;
      }
      return own.slice(Math.max(low - most, 0), low).reverse().map((i) => ({
        t: this.commands.times.at(i), device: this.devices[this.commands.device[i]].name,
        text: this.commands.texts[this.commands.text[i]]}));
    }

    // Countdowns of the arena controller's timers at t: {name, left}.
    countdownsAt(t) {
      const dues = this.timerDues.at(t) || [];
      return this.timers.map((name, i) => ({name, left: dues[i] * 1e-3 - t}))
        .filter((timer) => timer.left >= 0);
    }

    // The last `most` printed lines before t, oldest first.
    outputBefore(t, most) {
      let end = this.output.length;
      while (end > 0 && this.output[end - 1].t > t + 1e-9) --end;
      return this.output.slice(Math.max(end - most, 0), end);
    }

    // What happened, in order: {t, kind, text}; kind: "collision", "event", "goal" or "end".
    happenings() {
      const names = this.robots.map((robot) => robot.name);
      const all = [].concat(
        this.collisions.map((one) => ({t: one.t, kind: "collision",
          text: names[one.robot] + " collides with " + one.partner})),
        this.events.map((one) => ({t: one.t, kind: "event", text: one.text})),
        this.spoken.map((one) => ({t: one.t, kind: "event",
          text: names[one.robot] + " says: " + one.text})),
        this.goals.filter((one) => one.reached < Infinity).map((one) => ({t: one.reached,
          kind: "goal", text: names[one.robot] + " reaches its goal"})),
        [{t: this.end, kind: "end", text: "end of the run"}]);
      return all.sort((a, b) => a.t - b.t);
    }
  }

  function wallsOf(json, column) {
    const counts = column(json.n);
    const solid = column(json.solid);
    const xy = column(json.xy);
    const loops = [];
    let at = 0;
    for (let i = 0; i < counts.length; ++i) {
      const points = [];
      for (let k = 0; k < counts[i]; ++k, at += 2) points.push([xy[at] * kPlace, xy[at + 1] * kPlace]);
      loops.push({solid: solid[i] === 1, points});
    }
    return loops;
  }

  return {Numbers, Timeline, ChangeLog, Robot, Obstacle, Device, Run, colourOf};
})();
