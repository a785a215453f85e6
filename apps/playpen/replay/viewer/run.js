// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A run: columns over time. A live run grows by parts: append(); trim() bounds its memory.
// Times are in seconds, lengths in m, angles in rad.
"use strict";

const Runs = (function () {
  const kPlace = 1e-4;
  const kAngle = Math.PI / 18000;
  const kMicrosecond = 1e-6;
  const kNoNumber = -2147483648;
  const kTurn = Math.round(2 * Math.PI / kAngle);
  const kJump = 0.3; // a robot that moves so much farther than at twice its speed was placed [m]

  // What a live run remembers; of a full list, the older half is dropped.
  const kMost = {robotFrames: 2e6, frames: 1e5, records: 20000, deviceNumbers: 1e6, numbers: 16e6,
    commands: 5000, output: 4000, events: 4000, spoken: 2000, collisions: 1000, goals: 1000,
    texts: 1000};

  const isWide = (array) => array.BYTES_PER_ELEMENT === 8;

  // Numbers in a typed array, times a unit. The array may be longer than the numbers.
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

    // Makes room for `length` numbers. @param wide  of 64 bits
    reserve(length, wide = isWide(this.values)) {
      const widens = wide && !isWide(this.values);
      if (length <= this.values.length && !widens) return;
      const Type = widens ? Float64Array : this.values.constructor;
      const room = new Type(Math.max(length, 2 * this.length));
      room.set(this.values.subarray(0, this.length));
      this.values = room;
    }

    // @param values  times `unit`. Numbers of different units are stored with the unit 1.
    append(values, unit = this.unit) {
      const length = this.length + values.length;
      if (unit !== this.unit) {
        if (this.unit !== 1 || !isWide(this.values)) {
          this.values = Float64Array.from({length: this.length}, (none, i) => this.at(i));
          this.unit = 1;
        }
        this.reserve(length);
        const added = new Numbers(values, unit);
        for (let i = 0; i < values.length; ++i) this.values[this.length + i] = added.at(i);
      } else {
        this.reserve(length, isWide(values));
        this.values.set(values, this.length);
      }
      this.length = length;
    }

    // Forgets the first `count` numbers.
    drop(count) {
      this.values.copyWithin(0, count, this.length);
      this.length -= count;
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

  // Where records begin in an array of all their elements, and where the last one ends.
  class Begins extends Numbers {
    constructor(counts) {
      super(new Float64Array(1));
      this.append(counts);
    }

    append(counts) {
      this.reserve(this.length + counts.length);
      for (let i = 0; i < counts.length; ++i, ++this.length) {
        this.values[this.length] = this.values[this.length - 1] + counts[i];
      }
    }

    // Forgets the first `count` records. Returns how many elements they had.
    drop(count) {
      super.drop(count);
      const first = this.values[0];
      for (let i = 0; i < this.length; ++i) this.values[i] -= first;
      return first;
    }
  }

  // Records of whole numbers, each valid from its time on.
  class ChangeLog {
    constructor(times, lengths, values) {
      this.times = times;
      this.numbers = new Numbers(values);
      this.begins = new Begins(lengths);
    }

    append(json, column) {
      this.times.append(column(json.t));
      this.begins.append(column(json.n));
      this.numbers.append(column(json.v));
    }

    trim() {
      if (this.times.length <= kMost.records) return;
      const count = this.times.length >> 1;
      this.times.drop(count);
      this.numbers.drop(this.begins.drop(count));
    }

    record(i) {
      return this.numbers.values.subarray(this.begins.values[i], this.begins.values[i + 1]);
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

  // Headings of a part begin within half a turn of 0. They go on within half a turn of the last one.
  function appendPoses(to, json, column) {
    to.x.append(column(json.x));
    to.y.append(column(json.y));
    const values = column(json.a);
    const {a} = to;
    const last = a.length > 0 ? a.values[a.length - 1] : 0;
    const turns = values.length > 0 ? Math.round((last - values[0]) / kTurn) * kTurn : 0;
    // After many turns, 32 bits do not suffice.
    a.append(Math.abs(turns) > 1e9 ? Float64Array.from(values, (value) => value + turns)
      : values.map((value) => value + turns));
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

    append(json, column) {
      appendPoses(this, json.poses, column);
      for (const name of ["v", "side", "w", "stalled"]) this[name].append(column(json[name]));
      this.looks.append(json.looks, column);
    }

    // Forgets the first `count` frames.
    drop(count) {
      for (const name of ["x", "y", "a", "v", "side", "w", "stalled"]) this[name].drop(count);
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
    constructor(json, frames, log) {
      Object.assign(this, json);
      this.height = json.height * 1e-3;
      this.frames = frames;
      this.log = log(json.log);
    }

    at(t) {
      const times = this.log.times;
      const i = Math.max(times.before(t), 0);
      const now = this.log.record(i);
      const moves = i + 1 < times.length &&
        this.frames.before(times.at(i + 1)) - this.frames.before(times.at(i)) <= 1;
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
      this.lists = json.lists.map((one) => ({name: one.name, unit: one.unit,
        begins: new Begins(column(one.n)), numbers: new Numbers(column(one.v), one.scale),
        least: new Numbers(new Float64Array(0))}));
      this.beams = json.beams
        ? Object.assign({}, json.beams, posesOf(json.beams.poses, column)) : null;
    }

    // Series and lists that are new have had no values so far.
    append(json, column) {
      const before = this.times.length;
      this.times.append(column(json.t));
      (json.series || []).forEach((one, i) => {
        if (i === this.series.length) {
          this.series.push({name: one.name, unit: one.unit, words: one.words || [],
            numbers: new Numbers(new Int32Array(before).fill(kNoNumber), one.scale)});
        }
        this.series[i].numbers.append(column(one.v), one.scale);
      });
      (json.lists || []).forEach((one, i) => {
        if (i === this.lists.length) {
          this.lists.push({name: one.name, unit: one.unit, begins: new Begins(new Int32Array(before)),
            numbers: new Numbers(new Int32Array(0), one.scale), least: new Numbers(new Float64Array(0))});
        }
        this.lists[i].begins.append(column(one.n));
        this.lists[i].numbers.append(column(one.v), one.scale);
      });
      if (this.beams !== null) appendPoses(this.beams, json.beams.poses, column);
    }

    // @param most  how many numbers may be kept.
    trim(most) {
      const sum = (all) => all.reduce((before, {numbers}) => before + numbers.length, 0);
      if (sum(this.series) + sum(this.lists) <= most) return;
      const count = this.times.length >> 1;
      this.times.drop(count);
      for (const {numbers} of this.series) numbers.drop(count);
      for (const {begins, numbers, least} of this.lists) {
        numbers.drop(begins.drop(count));
        least.drop(Math.min(count, least.length));
      }
      if (this.beams !== null) for (const name of ["x", "y", "a"]) this.beams[name].drop(count);
    }

    // The numbers of a list in reading i.
    list(list, i) {
      const numbers = [];
      const end = list.begins.values[i + 1];
      for (let k = list.begins.values[i]; k < end; ++k) numbers.push(list.numbers.at(k));
      return numbers;
    }

    // The least number of each reading of a list; NaN: it has none.
    leastOf(list) {
      const {least} = list;
      const added = new Float64Array(this.times.length - least.length);
      for (let i = 0; i < added.length; ++i) {
        added[i] = NaN;
        for (const value of this.list(list, least.length + i)) if (!(value >= added[i])) added[i] = value;
      }
      least.append(added);
      return least;
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
      this.robots = json.robots.map((one) => new Robot(one, this.frames, column, log));
      this.obstacles = json.obstacles.map((one) => new Obstacle(one, this.frames, log));
      this.tracks = json.tracks;
      this.devices = json.devices.map((one) => new Device(one, column));
      this.begin = 0;
      this.ended = true; // a live run has not
      for (const name of ["collisions", "events", "spoken", "goals", "texts"]) {
        this[name] = json[name].map(timed);
      }
      this.dropped = {goals: json.goals_from || 0, texts: json.texts_from || 0};
      this.traps = json.traps;
      this.trapStates = log(json.trap_states);
      this.timers = json.timers;
      this.timerDues = log(json.timer_dues);
      this.scores = log(json.scores);
      this.verdict = json.verdict || null;
      const {commands} = json;
      this.commands = {times: new Timeline(column(commands.t)), device: new Numbers(column(commands.device)),
        text: new Numbers(column(commands.text)), texts: commands.texts};
      this.groupCommands();
      this.output = json.output.map(printed);
      this.layers = json.layers.map((one) => new Layers.Tape(one, column));
    }

    groupCommands() {
      this.commandsOf = grouped(this.commands.times,
        (i) => this.devices[this.commands.device.values[i]].robot);
      this.textIndices = null; // see appendCommands()
    }

    // Adds what is new in a live run; what is not is left out. Returns what happened, as happenings().
    append(json, file) {
      const column = (index) => file.column(index);
      const all = (name) => json[name] || [];
      this.end = json.end * kMicrosecond;
      if (json.frames !== undefined) this.frames.append(column(json.frames));
      all("robots").forEach((one, i) => this.robots[i].append(one, column));
      for (const {i, log} of all("obstacles")) this.obstacles[i].log.append(log, column);
      for (const one of all("devices")) this.devices[one.i].append(one, column);
      if (json.commands) this.appendCommands(json.commands, column);
      if (json.trap_states) this.trapStates.append(json.trap_states, column);
      if (json.timer_dues) this.timerDues.append(json.timer_dues, column);
      if (json.scores) this.scores.append(json.scores, column);
      this.notes.push(...all("notes"));
      this.output.push(...all("output").map(printed));
      this.verdict = json.verdict || this.verdict;
      for (const one of all("layers")) {
        if (one.i < this.layers.length) this.layers[one.i].append(one, column);
        else this.layers.push(new Layers.Tape(one, column));
      }
      const added = {goals: []};
      for (const name of ["collisions", "events", "spoken"]) {
        added[name] = all(name).map(timed);
        this[name].push(...added[name]);
      }
      if (json.goals) {
        const old = this.replace("goals", json.goals_from, json.goals);
        added.goals = this.goals.slice(Math.max(json.goals_from - this.dropped.goals, 0))
          .filter((goal, i) => old[i] === undefined || old[i].reached === Infinity);
      }
      if (json.texts) this.replace("texts", json.texts_from, json.texts);
      this.trim();
      return this.happeningsIn(added);
    }

    // Replaces a list's elements from an index on. Returns the replaced ones.
    replace(name, from, json) {
      const at = from - this.dropped[name];
      return this[name].splice(Math.max(at, 0), Infinity, ...json.slice(Math.max(-at, 0)).map(timed));
    }

    appendCommands(json, column) {
      const {times, device, text, texts} = this.commands;
      if (this.textIndices === null) this.textIndices = new Map(texts.map((one, i) => [one, i]));
      const indices = json.texts.map((one) => {
        if (!this.textIndices.has(one)) this.textIndices.set(one, texts.push(one) - 1);
        return this.textIndices.get(one);
      });
      const first = times.length;
      times.append(column(json.t));
      device.append(column(json.device));
      text.append(column(json.text).map((i) => indices[i]));
      for (let i = first; i < times.length; ++i) {
        const {robot} = this.devices[device.values[i]];
        if (!this.commandsOf.has(robot)) this.commandsOf.set(robot, []);
        this.commandsOf.get(robot).push(i);
      }
    }

    trim() {
      const frames = this.frames.length;
      if (frames > Math.min(kMost.frames, kMost.robotFrames / this.robots.length)) {
        this.frames.drop(frames >> 1);
        for (const robot of this.robots) robot.drop(frames >> 1);
        this.begin = this.frames.at(0);
      }
      for (const robot of this.robots) robot.looks.trim();
      for (const obstacle of this.obstacles) obstacle.log.trim();
      for (const log of [this.trapStates, this.timerDues, this.scores]) log.trim();
      for (const device of this.devices) {
        device.trim(Math.min(kMost.deviceNumbers, kMost.numbers / this.devices.length));
      }
      for (const name of ["output", "collisions", "events", "spoken", "goals", "texts"]) {
        if (this[name].length <= kMost[name]) continue;
        const gone = this[name].splice(0, this[name].length >> 1);
        if (name in this.dropped) this.dropped[name] += gone.length;
      }
      if (this.commands.times.length > kMost.commands) this.dropCommands();
    }

    dropCommands() {
      const {times, device, text, texts} = this.commands;
      const count = times.length >> 1;
      for (const numbers of [times, device, text]) numbers.drop(count);
      const kept = [];
      const places = new Map(); // of kept texts, by their old places
      for (let i = 0; i < text.length; ++i) {
        const old = text.values[i];
        if (!places.has(old)) places.set(old, kept.push(texts[old]) - 1);
        text.values[i] = places.get(old);
      }
      this.commands.texts = kept;
      this.groupCommands();
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
        t: this.commands.times.at(i), device: this.devices[this.commands.device.values[i]].name,
        text: this.commands.texts[this.commands.text.values[i]]}));
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
      return this.happeningsIn(this).concat(
        this.ended ? [{t: this.end, kind: "end", text: "end of the run"}] : []);
    }

    happeningsIn({collisions, events, spoken, goals}) {
      const names = this.robots.map((robot) => robot.name);
      const all = [].concat(
        collisions.map((one) => ({t: one.t, kind: "collision",
          text: names[one.robot] + " collides with " + one.partner})),
        events.map((one) => ({t: one.t, kind: "event", text: one.text})),
        spoken.map((one) => ({t: one.t, kind: "event",
          text: names[one.robot] + " says: " + one.text})),
        goals.filter((one) => one.reached < Infinity).map((one) => ({t: one.reached,
          kind: "goal", text: names[one.robot] + " reaches its goal"})));
      return all.sort((a, b) => a.t - b.t);
    }
  }

  // An entry of a list with its times in seconds; null: never.
  function timed(json) {
    const one = Object.assign({}, json, {t: json.t * kMicrosecond});
    for (const name of ["reached", "gone"]) {
      if (name in json) one[name] = json[name] === null ? Infinity : json[name] * kMicrosecond;
    }
    return one;
  }
  function printed([t, text, error]) {
    return {t: t * kMicrosecond, text, error: error === 1};
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

  return {kMost, Numbers, Timeline, Begins, ChangeLog, Robot, Obstacle, Device, Run, colourOf};
})();
