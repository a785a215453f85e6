// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Times, poses, changes, layers and their keyframes.
"use strict";

const assert = require("assert");
const {load, run, FakeFile} = require("./load.js");

const {Runs, Layers, Plots, Clocks} = load();
const close = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, a + " is not " + b);

function timeline(seconds) {
  return new Runs.Timeline(Float64Array.from(seconds, (t) => Math.round(t * 1e6)));
}

// A robot at (0, 0), (1, 0), (5, 0) at 0, 1 and 2 s, with 1 m/s.
function robotOf(file) {
  const log = (times, records) => new Runs.ChangeLog(timeline(times),
    records.map((record) => record.length), Int32Array.from([].concat(...records)));
  const zero = () => file.add([0, 0, 0]);
  const speed = file.add([10000, 10000, 10000]);
  const json = {name: "r", colour: "#ff0000", parts: [[[0.1, 0], [0, 0.1], [-0.3, 0]]], core: [],
    superstructures: [], bumpers: [], lights: [],
    poses: {x: file.add([0, 10000, 50000]), y: zero(), a: file.add([0, 9000, 18000])}, v: speed,
    side: zero(), w: zero(), stalled: file.add([0, 1, 0]), looks: null};
  // Two bumpers, the second pressed; no lights; a paddle of two points; no arms.
  const looks = log([0, 1], [[2, 0, 1, 0, 1, 2, 100, 0, 0, -200, 0], [0, 0, 0, 0]]);
  return new Runs.Robot(json, timeline([0, 1, 2]), (index) => file.column(index), () => looks);
}

// A layer of 3 x 2 cells with many changes.
function tapeOf(changes, size = {width: 3, height: 2}) {
  const file = new FakeFile();
  const runs = [].concat(...changes.map((change) => change.runs));
  return new Layers.Tape({name: "l", colour: "#000000", visible: true, priority: 0, grey: false,
    width: size.width, height: size.height, t: file.add(changes.map((change) => change.t * 1e6)),
    runs: file.add(changes.map((change) => change.runs.length)), first: file.add(runs.map((one) => one[0])),
    count: file.add(runs.map((one) => one[1])), colours: file.add(runs.map((one) => one[2])),
    palette: [0, 0xff0000ff, 0x00ff00ff]}, (index) => file.column(index));
}

// A run of 2 s with a robot, a laser of three beams, a text, and commands.
function runOf() {
  const file = new FakeFile();
  const times = (...seconds) => file.add(seconds.map((t) => t * 1e6), true);
  const none = () => ({t: times(), n: file.add([]), v: file.add([])});
  const zero = () => file.add([0, 0, 0]);
  const device = (name, more) => Object.assign({robot: 0, name, type: name, t: times(), series: [],
    lists: []}, more);
  const json = {name: "one", world: "room", notes: [], end: 2e6, canvas: {cell: 0.1, origin: [0, 0]},
    arena: {origin: [0, 0], size: [2, 1], walls: {n: file.add([3]), solid: file.add([1]),
      xy: file.add([0, 0, 10000, 0, 0, 10000])}},
    frames: times(0, 1, 2), tracks: [], traps: [], trap_states: none(), scores: none(),
    timers: ["gate"], timer_dues: {t: times(0, 1.5), n: file.add([1, 1]), v: file.add([1500, -1])},
    robots: [{name: "r1", colour: "#ff0000", parts: [[[0.1, 0]]], core: [], superstructures: [],
      bumpers: [], lights: [], poses: {x: zero(), y: zero(), a: zero()}, v: zero(), side: zero(), w: zero(),
      stalled: zero(), looks: none()}],
    obstacles: [{name: "block", shape: "box", outline: [], size: [1, 1], height: 160, dynamic: true,
      log: {t: times(0, 1, 2), n: file.add([9, 9, 9]), v: file.add([0, 0, 0, 1, 1, 0, 0, -1, -1,
        10000, 0, 0, 1, 1, 160, 2, -1, -1, 10000, 0, 0, 1, 1, 160, 1, -1, 0x0102ff])}}],
    devices: [device("laser", {t: times(0.5, 1.5), lists: [{name: "ranges", unit: "m", scale: 1e-3,
      n: file.add([3, 3]), v: file.add([1000, 2000, 3000, 500, 500, 500])}],
    beams: {mounts: [[0.1, 0, 0]], first: -Math.PI / 2, step: Math.PI / 2, cone: 0, most: [4],
      poses: {x: file.add([10000, 10000]), y: file.add([0, 0]), a: file.add([9000, 9000])}}}),
    device("motion", {})],
    collisions: [{t: 1e6, robot: 0, partner: "border", place: [0, 0]}], events: [], texts: [],
    spoken: [{t: 0.5e6, robot: 0, text: "<b>"}],
    goals: [{t: 0, robot: 0, place: [1, 1], reached: 1.5e6}, {t: 0, robot: 0, place: [2, 2],
      reached: null}],
    commands: {t: times(0, 0.2, 0.4), device: file.add([1, 1, 1]), text: file.add([0, 1, 0]),
      texts: ["go", "stop"]},
    output: [[0, "a", 0], [1e6, "b", 1], [1e6, "c", 0]], layers: []};
  return new Runs.Run(json, file);
}

run({
  readsWalls() {
    assert.deepStrictEqual(JSON.parse(JSON.stringify(runOf().walls)),
      [{solid: true, points: [[0, 0], [1, 0], [0, 1]]}]);
  },
  scansLieInTheWorld() {
    const laser = runOf().devices[0];
    assert.strictEqual(laser.measuredAt(0.4), null);
    // The robot is at (1, 0) and looks along y; the laser is 0.1 m ahead. Beams: right, ahead, left.
    const {origin, ends} = laser.measuredAt(1);
    close(origin[1], 0.1);
    close(ends[0][0], 2);
    close(ends[1][1], 2.1);
    close(ends[2][0], -2);
    close(laser.measuredAt(1.5).ends[1][1], 0.6);
  },
  commandsAndLinesUntilATime() {
    const one = runOf();
    assert.deepStrictEqual(Array.from(one.commandsBefore(0, 0.3, 8), (command) => command.text),
      ["stop", "go"]);
    assert.deepStrictEqual(Array.from(one.commandsBefore(0, 9, 1), (command) => command.t.toFixed(2)),
      ["0.40"]);
    assert.strictEqual(one.commandsBefore(7, 9, 1).length, 0);
    assert.deepStrictEqual(Array.from(one.outputBefore(1, 2), (line) => line.text), ["b", "c"]);
    assert.deepStrictEqual(Array.from(one.outputBefore(0.5, 2), (line) => line.text), ["a"]);
  },
  happeningsAreInOrder() {
    assert.deepStrictEqual(Array.from(runOf().happenings(), (one) => one.t + " " + one.text),
      ["0.5 r1 says: <b>", "1 r1 collides with border", "1.5 r1 reaches its goal", "2 end of the run"]);
  },
  countdownsEnd() {
    const left = (t) => Array.from(runOf().countdownsAt(t), (timer) => timer.left.toFixed(2));
    assert.deepStrictEqual([left(0), left(1.25), left(1.5)], [["1.50"], ["0.25"], []]);
  },
  obstaclesMoveBetweenFrames() {
    const block = runOf().obstacles[0];
    close(block.at(0.5).x, 0.5);
    assert.strictEqual(block.at(0.5).state, "standing");
    assert.strictEqual(block.at(1.2).state, "rising");
    assert.strictEqual(block.at(2).state, "retracted");
    assert.strictEqual(block.at(2).colour, "#000102");
    assert.strictEqual(block.at(1).colour, null);
  },
  findsTheLastTime() {
    const times = timeline([0, 0.05, 0.1]);
    assert.deepStrictEqual([-0.01, 0, 0.049, 0.05, 7].map((t) => times.before(t)), [-1, 0, 0, 1, 2]);
    assert.strictEqual(timeline([]).before(1), -1);
  },
  sharesATimeBetweenTwo() {
    const times = timeline([0, 2, 2]);
    close(times.share(0, 0.5), 0.25);
    assert.strictEqual(times.share(2, 9), 0);
    assert.strictEqual(times.share(1, 2), 0);
  },
  readsWhatIsNoNumber() {
    const numbers = new Runs.Numbers(Int32Array.from([-2147483648, 5]), 0.5);
    assert.ok(Number.isNaN(numbers.at(0)));
    assert.strictEqual(numbers.at(1), 2.5);
  },
  interpolatesPoses() {
    const robot = robotOf(new FakeFile());
    close(robot.at(0.25).x, 0.25);
    close(robot.at(0.25).a, Math.PI / 8);
    assert.strictEqual(robot.at(-1).x, 0);
    assert.strictEqual(robot.at(99).x, 5);
    assert.strictEqual(robot.at(1.5).stalled, true);
    close(robot.radius, 0.3);
  },
  doesNotInterpolateJumps() {
    // From 1 to 2 s it moves by 4 m: it was placed there.
    assert.strictEqual(robotOf(new FakeFile()).at(1.9).x, 1);
  },
  readsLooks() {
    const robot = robotOf(new FakeFile());
    assert.deepStrictEqual(JSON.parse(JSON.stringify(robot.lookAt(0.5))),
      {pressed: [0, 1], lit: [], paddles: [[[0.01, 0], [0, -0.02]]], arms: []});
    assert.strictEqual(robot.lookAt(1).pressed.length, 0);
  },
  layersFollowTheTime() {
    const tape = tapeOf([{t: 1, runs: [[0, 2, 1]]}, {t: 2, runs: [[1, 5, 2], [0, 1, 0]]}]);
    const red = Layers.inMemory(0xff0000ff);
    const green = Layers.inMemory(0x00ff00ff);
    assert.strictEqual(tape.seek(0.5), null);
    assert.deepStrictEqual(Array.from(tape.seek(1)), [0, 1]);
    assert.deepStrictEqual(Array.from(tape.cells), [red, red, 0, 0, 0, 0]);
    assert.deepStrictEqual(Array.from(tape.seek(2)), [0, 2]);
    assert.deepStrictEqual(Array.from(tape.cells), [0, green, green, green, green, green]);
    assert.deepStrictEqual(Array.from(tape.seek(1.9)), [0, 2]);
    assert.deepStrictEqual(Array.from(tape.cells), [red, red, 0, 0, 0, 0]);
  },
  bytesOfColoursAreRedFirst() {
    const bytes = new Uint8Array(Uint32Array.from([Layers.inMemory(0x01020304)]).buffer);
    assert.deepStrictEqual(Array.from(bytes), [1, 2, 3, 4]);
  },
  keyframesGiveTheSameCells() {
    const size = {width: 100, height: 100};
    let seed = 1;
    const random = (below) => {
      seed = (seed * 48271) % 2147483647;
      return seed % below;
    };
    const changes = [];
    for (let i = 0; i < 2000; ++i) {
      changes.push({t: i, runs: [[random(5000), 1 + random(5000), random(3)]]});
    }
    const tape = tapeOf(changes, size);
    assert.ok(tape.keyframes.length > 5);
    const plain = new Uint32Array(10000);
    const checked = [1999, 3, 1000, 1001, 500, 1999, 0];
    for (const t of checked) {
      plain.fill(0);
      for (const {runs: [[first, count, colour]]} of changes.slice(0, t + 1)) {
        plain.fill(tape.palette[colour], first, first + count);
      }
      tape.seek(t);
      assert.deepStrictEqual(Array.from(tape.cells), Array.from(plain), "at " + t);
    }
  },
  aSeekAppliesFewChanges() {
    const changes = [];
    for (let i = 0; i < 5000; ++i) changes.push({t: i, runs: [[0, 10000, 1 + i % 2]]});
    const tape = tapeOf(changes, {width: 100, height: 100});
    let applied = 0;
    const apply = tape.apply.bind(tape);
    tape.apply = (from, to) => {
      applied = Math.max(applied, to - from);
      apply(from, to);
    };
    for (const t of [4000, 10, 4999, 2500]) tape.seek(t);
    // 200 000 cells lie between keyframes, 10 008 are the cost of a change.
    assert.ok(applied <= 21, applied + " changes");
  },
  plotsKeepExtremes() {
    const numbers = new Runs.Numbers(Int32Array.from([1, 9, -3, 2, 2]), 1);
    assert.deepStrictEqual(JSON.parse(JSON.stringify(Plots.extent(timeline([0, 0.1, 0.2, 5, 9.9]),
      numbers, [0, 10], 2))), [[0, -3, 9], [1, 2, 2]]);
  },
  shortensNumbers() {
    assert.deepStrictEqual([0, 0.123456, 12345.678, NaN, 1e-7, 2].map(Plots.shortNumber),
      ["0", "0.1235", "12345.7", "–", "1.00e-7", "2"]);
  },
  stepsByFrames() {
    let drawn = 0;
    const clock = new Clocks.Clock(timeline([0, 1, 2]), 2, () => { ++drawn; });
    clock.seek(1.5);
    clock.step(-1);
    assert.strictEqual(clock.t, 1);
    clock.step(-1);
    clock.step(-1);
    assert.strictEqual(clock.t, 0);
    clock.step(1);
    assert.strictEqual(clock.t, 1);
    clock.seek(99);
    assert.strictEqual(clock.t, 2);
    assert.strictEqual(drawn, 6);
  },
  playsToTheEnd() {
    const clock = new Clocks.Clock(timeline([0, 1, 2]), 2, () => {});
    clock.speed = 4;
    clock.play(true);
    clock.tick(1000);
    clock.tick(1100);
    close(clock.t, 0.4);
    clock.tick(99000); // the page was hidden: a quarter of a second counts
    close(clock.t, 1.4);
    clock.tick(99250);
    assert.strictEqual(clock.t, 2);
    assert.strictEqual(clock.playing, false);
    clock.play(true);
    assert.strictEqual(clock.t, 0);
  },
  readsFragments() {
    const said = (text) => JSON.parse(JSON.stringify(Clocks.ofFragment(text)));
    assert.deepStrictEqual(said("#t=31.4&robot=r%201"), {t: 31.4, robot: "r 1"});
    assert.deepStrictEqual(said("#t=x&robot=%"), {t: null, robot: null});
    assert.deepStrictEqual(said(""), {t: null, robot: null});
  },
});
