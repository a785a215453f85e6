// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A live run: parts that are appended, what is forgotten, the connection, and commands.
"use strict";

const assert = require("assert");
const {load, run, FakeFile} = require("./load.js");
const {Encoder, wholeUntil, partOf, kLive} = require("./parts.js");

const {Columns, Runs, Layers, Clocks, Live, Joystick, Commands} = load();
const plain = (value) => JSON.parse(JSON.stringify(value));
const close = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, a + " is not " + b);

const kFrames = 300;
const kFrame = 20; // [s]; in the end, times in microseconds exceed 32 bits
const range = (count, value) => Array.from({length: count}, (none, i) => value(i));

// A robot that turns and turns, a block, a laser, drawings, and all that happens.
function replay() {
  const file = new FakeFile();
  const micro = (seconds) => seconds * 1e6;
  const times = (seconds) => file.add(seconds.map(micro), true);
  const numbers = (count, value) => file.add(range(count, value));
  const log = (seconds, records) => ({t: times(seconds), n: file.add(records.map((one) => one.length)),
    v: file.add([].concat(...records), true)});
  const every = (n) => range(kFrames / n, (i) => i * n * kFrame);
  const poses = (n) => ({x: numbers(kFrames / n, (i) => 3 * i * n), y: numbers(kFrames / n, (i) => -i * n),
    a: numbers(kFrames / n, (i) => 5000 * i * n)});
  const robot = {name: "r1", colour: "#ff0000", parts: [[[0.1, 0]]], core: [], superstructures: [],
    bumpers: [], lights: [], poses: poses(1), v: numbers(kFrames, (i) => i), side: numbers(kFrames, () => 0),
    w: numbers(kFrames, (i) => -i), stalled: numbers(kFrames, (i) => i % 2),
    looks: log(every(3), range(100, (i) => [i % 2, ...range(i % 2, () => 1), 0, 0, 0]))};
  const laser = {robot: 0, name: "laser", type: "laser", t: times(every(2)),
    series: [{name: "gain", unit: "", words: [], scale: 0.5, v: numbers(150, (i) => i - 70)}],
    lists: [{name: "ranges", unit: "m", scale: 1e-3, n: numbers(150, (i) => i % 4),
      v: numbers(225, (i) => 1000 + i)}],
    beams: {mounts: [[0.1, 0, 0]], first: -1, step: 0.5, cone: 0, most: [4], poses: poses(2)}};
  const motion = (of) => ({robot: of, name: "motion", type: "motion", t: times([]), series: [],
    lists: []});
  const head = {format: 1, thinned: "", palette: {}, runs: [{name: "one", world: "room", notes: [],
    end: micro(kFrames * kFrame), canvas: {cell: 0.1, origin: [0, 0]},
    arena: {walls: {n: file.add([3]), solid: file.add([1]), xy: file.add([0, 0, 1, 0, 0, 1])}},
    frames: times(every(1)), tracks: [], traps: [], timers: ["gate"], robots: [robot],
    trap_states: log(every(50), range(6, (i) => [i % 3])),
    timer_dues: log(every(100), [[1e6], [-1], [9e9]]), scores: log([0, 3000], [[0], [1500]]),
    obstacles: [{name: "block", shape: "box", outline: [], size: [1, 1], height: 160, dynamic: true,
      log: log([0, 1000, 1020], [[0, 0, 0, 1, 1, 0, 1, -1, -1], [0, 0, 0, 1, 1, 80, 2, -1, 0xffffff00],
        [0, 0, 0, 1, 1, 160, 0, -1, -1]])}],
    devices: [laser, motion(0), motion(1)],
    collisions: [{t: micro(900), robot: 0, partner: "border", place: [0, 0]}],
    events: range(40, (i) => ({t: micro(100 * i), kind: "placed", what: "", who: "", text: "event " + i})),
    spoken: [{t: micro(2500), robot: 0, text: "hello"}],
    goals: [{t: 0, robot: 0, place: [1, 1], reached: micro(3000)},
      {t: micro(3100), robot: 0, place: [2, 2], reached: null}],
    texts: [{t: micro(10), gone: micro(2000), text: "open", place: [0, 0], colour: "#000000"}],
    commands: {t: times(every(1)), device: numbers(kFrames, (i) => (i % 3 === 0 ? 2 : 1)),
      text: numbers(kFrames, (i) => i % 7),
      texts: range(7, (i) => "go " + i)},
    output: range(50, (i) => [micro(77 * i), "line " + i, i % 2]),
    layers: [{name: "map", colour: "#000000", visible: true, priority: 0, grey: false, width: 4, height: 3,
      t: times(every(2)), runs: numbers(150, () => 2), first: numbers(300, (i) => i % 9),
      count: numbers(300, (i) => 1 + i % 3), colours: numbers(300, (i) => i % 5),
      palette: [0, 0xff0000ff, 0x00ff00ff, 0x0000ffff, 0x808080ff]}]}]};
  return {head, file};
}

const read = (bytes) => new Columns.File(bytes);
const runOf = (file) => new Runs.Run(file.head.runs[0], file);

// What a page shows of a run at t.
function shown(one, t) {
  one.layers.forEach((tape) => tape.seek(t));
  return plain([one.robots.map((robot) => [robot.at(t), robot.lookAt(t)]),
    one.obstacles.map((obstacle) => obstacle.at(t)),
    one.devices.map((device) => [device.measuredAt(t), device.times.before(t) < 0 ? null
      : device.series.map(({numbers}) => numbers.at(device.times.before(t))),
    device.lists.map((list) => device.list(list, Math.max(device.times.before(t), 0)))]),
    one.commandsBefore(0, t, 8), one.outputBefore(t, 5), one.countdownsAt(t),
    Array.from(one.trapStates.at(t)), Array.from(one.scores.at(t)),
    one.layers.map((tape) => Array.from(tape.cells))]);
}

// A run in memory whose last frame is at `until` [s], and a function that appends a part.
function grown(until) {
  const {head, file} = replay();
  const one = runOf(read(wholeUntil(head, file, until * 1e6)));
  one.ended = false;
  let from = until;
  const grow = (to) => {
    const part = read(partOf(head, file, from * 1e6, to * 1e6));
    from = to;
    return one.append(part.head.runs[0], part);
  };
  return {one, grow};
}

// Changes a limit for a test.
function withMost(most, test) {
  const before = Object.assign({}, Runs.kMost);
  Object.assign(Runs.kMost, most);
  try {
    test();
  } finally {
    Object.assign(Runs.kMost, before);
  }
}

// Sockets, timers and what the page hears, all by hand.
function connection(token = "secret") {
  const made = {sockets: [], heard: [], waits: [], sent: []};
  const connect = () => {
    const socket = {send: (text) => made.sent.push(JSON.parse(text)), close: () => { socket.onclose(); }};
    made.sockets.push(socket);
    return socket;
  };
  const hear = (name) => (...what) => made.heard.push([name, ...what]);
  made.link = new Live.Link(connect, () => token, {whole: hear("whole"), part: hear("part"),
    rights: hear("rights"), answer: hear("answer"), state: hear("state")},
  {setTimeout: (action, wait) => made.waits.push([action, wait])});
  made.says = (message) => made.sockets[made.sockets.length - 1].onmessage({data: JSON.stringify(message)});
  made.gets = (bytes) => made.sockets[made.sockets.length - 1].onmessage({data: bytes.buffer.slice(
    bytes.byteOffset, bytes.byteOffset + bytes.length)});
  return made;
}
const message = (head) => new Encoder().file(head);

// A Steering with a clock by hand.
function steering() {
  const made = {sent: [], now: 0, repeat: null};
  made.steering = new Live.Steering((command) => made.sent.push(plain(command.steer)), {
    now: () => made.now, clearInterval: () => { made.repeat = null; },
    setInterval: (action) => { made.repeat = action; return 1; }});
  return made;
}

// An element that events can be sent to.
function node() {
  const listeners = {};
  return {style: {}, firstElementChild: {style: {}}, setPointerCapture() {},
    getBoundingClientRect: () => ({left: 100, top: 100, width: 200, height: 200}),
    addEventListener: (name, action) => { listeners[name] = action; },
    send: (name, clientX, clientY, pointerId = 1) =>
      listeners[name]({clientX, clientY, pointerId, preventDefault() {}})};
}

// A Desk with a page of elements that remember; it has the right to command robot r1 of a run.
function desk() {
  const elements = new Map();
  const byId = (id) => {
    if (!elements.has(id)) {
      elements.set(id, Object.assign(node(), {appendChild: (child) => child, classList: {toggle() {}}}));
    }
    return elements.get(id);
  };
  const listeners = {};
  const hears = {addEventListener: (name, action) => { listeners[name] = action; }};
  const made = {sent: [], said: [], byId, listeners};
  const browser = load({document: Object.assign({getElementById: byId, body: byId("body")}, hears),
    window: hears, Option: class {}, performance: {now: () => 0}, setInterval: () => 1, clearInterval() {}});
  made.state = {runs: [grown(1000).one], clock: {t: 10, following: true, follow() {}},
    options: {selected: -1}, live: Object.assign({}, kLive, {can: {place: true, blocks: ["block"]}})};
  made.desk = new browser.Commands.Desk({state: made.state, changed() {},
    say: (text) => made.said.push(text)}, (command) => made.sent.push(plain(command)));
  made.desk.setRights({command: true});
  made.desk.setConnected(true);
  made.key = (key, shiftKey = false) => made.desk.key({key, shiftKey, target: {matches: () => false}});
  return made;
}

run({
  partsGiveTheWholeRun() {
    const {head, file} = replay();
    const complete = runOf(read(wholeUntil(head, file, 6000e6)));
    const {one, grow} = grown(500);
    const happened = one.happenings();
    for (const to of [520, 521, 1000, 1010, 1999, 2000, 2200, 3000, 3050, 4000, 5990, 6000]) {
      happened.push(...grow(to));
      assert.strictEqual(one.end, to);
    }
    for (let t = 0; t <= 6000; t += 90) {
      assert.deepStrictEqual(shown(one, t), shown(complete, t), "at " + t);
    }
    close(one.obstacles[0].at(1010).height, 0.12); // between two frames
    for (const name of ["collisions", "events", "spoken", "goals", "texts", "output"]) {
      assert.deepStrictEqual(plain(one[name]), plain(complete[name]), name);
    }
    assert.deepStrictEqual(plain(happened), plain(complete.happenings()).slice(0, -1));
    assert.deepStrictEqual(plain(one.happenings()), plain(happened));
  },
  aPartMayBeAlmostEmpty() {
    const {one} = grown(500);
    const before = shown(one, 500);
    assert.deepStrictEqual(plain(one.append({end: 510e6}, null)), []);
    assert.strictEqual(one.end, 510);
    assert.deepStrictEqual(shown(one, 500), before);
  },
  headingsGoOnOverParts() {
    const {one, grow} = grown(100);
    grow(2000);
    // 50 degrees a frame; frame 100 is at 2000 s.
    close(one.robots[0].at(2000).a, 100 * 50 * Math.PI / 180);
  },
  headingsExceed32Bits() {
    const {one} = grown(20);
    const {robots: [robot]} = one;
    robot.a = new Runs.Numbers(Int32Array.from([2147483000]));
    const columns = [[0], [0], [17000, 18000], [0], [0], [0]].map((values) => Int32Array.from(values));
    robot.append({poses: {x: 0, y: 1, a: 2}, v: 3, side: 3, w: 3, stalled: 3, looks: {t: 3, n: 1, v: 3}},
      (index) => columns[index]);
    assert.ok(robot.a.at(2) > robot.a.at(1));
    assert.ok(Math.abs(robot.a.at(1) - robot.a.at(0)) <= 18000);
  },
  numbersOfAnotherUnit() {
    const numbers = new Runs.Numbers(Int32Array.from([3, -2147483648]), 0.5);
    numbers.append(Int32Array.from([25, -2147483648]), 0.01);
    numbers.append(Int32Array.from([4]), 0.5);
    assert.deepStrictEqual(plain(range(5, (i) => numbers.at(i))), [1.5, null, 0.25, null, 2]);
  },
  newSeriesListsAndLayers() {
    const {one} = grown(100);
    const encoder = new Encoder();
    const added = (values) => encoder.add(values);
    const laser = one.devices[0];
    const before = laser.times.length;
    laser.append({t: added([110e6]),
      series: [{v: added([1]), scale: 0.5},
        {name: "volts", unit: "V", words: [], v: added([12]), scale: 0.1}],
      lists: [{n: added([1]), v: added([7]), scale: 1e-3},
        {name: "echoes", unit: "", n: added([2]), v: added([5, 6]), scale: 1}],
      beams: {poses: {x: added([0]), y: added([0]), a: added([0])}}}, (index) =>
      new Columns.File(encoder.file({})).column(index));
    assert.ok(Number.isNaN(laser.series[1].numbers.at(before - 1)));
    close(laser.series[1].numbers.at(before), 1.2);
    assert.deepStrictEqual(plain(laser.list(laser.lists[1], before - 1)), []);
    assert.deepStrictEqual(plain(laser.list(laser.lists[1], before)), [5, 6]);
    close(laser.leastOf(laser.lists[1]).at(before), 5);
  },
  memoryIsBounded() {
    withMost({frames: 40, records: 20, deviceNumbers: 60, commands: 50, output: 10, events: 8}, () => {
      const {head, file} = replay();
      const complete = runOf(read(wholeUntil(head, file, 6000e6)));
      const {one, grow} = grown(20);
      for (let to = 40; to <= 5980; to += 20) {
        grow(to);
        const laser = one.devices[0];
        const kept = laser.series[0].numbers.length + laser.lists[0].numbers.length;
        assert.ok(one.frames.length <= 40 && one.robots[0].a.length === one.frames.length);
        assert.ok(kept <= 60, kept + " numbers");
        assert.ok(one.robots[0].looks.times.length <= 20);
        assert.ok(one.commands.times.length <= 50 && one.commands.texts.length <= 7);
        assert.ok(one.output.length <= 10 && one.events.length <= 8);
      }
      assert.ok(one.begin > 5000 && one.begin === one.frames.at(0), one.begin + " s");
      for (let t = one.devices[0].times.at(0); t < 5980; t += 30) {
        const [now, then] = [shown(one, t), shown(complete, t)];
        for (const i of [1, 2, 5, 6, 7, 8]) assert.deepStrictEqual(now[i], then[i], i + " at " + t);
        if (t > one.commands.times.at(12)) assert.deepStrictEqual(now[3], then[3], "commands at " + t);
        close(now[0][0][0].x, then[0][0][0].x);
      }
    });
  },
  leastNumbersAreForgottenToo() {
    withMost({deviceNumbers: 60}, () => {
      const {one, grow} = grown(20);
      for (let to = 40; to <= 5980; to += 20) {
        grow(to);
        one.devices[0].leastOf(one.devices[0].lists[0]);
      }
      const [laser] = one.devices;
      const least = laser.leastOf(laser.lists[0]);
      assert.strictEqual(least.length, laser.times.length);
      for (let i = 0; i < least.length; ++i) {
        const ranges = laser.list(laser.lists[0], i);
        assert.deepStrictEqual(plain(least.at(i)), ranges.length > 0 ? Math.min(...ranges) : null);
      }
    });
  },
  goalsKeepTheirIndices() {
    withMost({goals: 4}, () => {
      const {one} = grown(20);
      one.goals = [];
      const goal = (t, reached = null) => ({t, robot: 0, place: [0, 0], reached});
      range(5, (i) => one.replace("goals", i, [goal(i * 1e6)]));
      one.trim();
      assert.deepStrictEqual(plain(one.goals.map(({t}) => t)), [2, 3, 4]);
      one.replace("goals", 4, [goal(4e6, 5e6), goal(6e6)]);
      assert.deepStrictEqual(plain(one.goals.map(({t}) => t)), [2, 3, 4, 6]);
      assert.strictEqual(one.goals[2].reached, 5);
      one.replace("goals", 0, range(8, (i) => goal(i * 1e6)));
      assert.deepStrictEqual(plain(one.goals.map(({t}) => t)), [2, 3, 4, 5, 6, 7]);
    });
  },
  oldChangesBecomeTheBase() {
    const size = 100;
    const columns = (list) => ({column: (i) => list[i], json: {name: "l", colour: "#000000", visible: true,
      priority: 0, grey: false, width: size, height: size, t: 0, runs: 1, first: 2, count: 3, colours: 4}});
    const start = columns([[], [], [], [], []].map((values) => Int32Array.from(values)));
    const tape = new Layers.Tape(Object.assign(start.json, {palette: []}), start.column);
    const changes = [];
    for (let t = 0; t < 12; ++t) {
      const runs = Layers.kMostRuns / 8;
      const part = columns([[t * 1e6], [runs], range(runs, (i) => (i * 7 + t) % (size * size)),
        range(runs, () => 1), range(runs, (i) => (i + t) % 3)].map((values) => Int32Array.from(values)));
      const palette = [0xff0000ff, t, 0x00ff00ff]; // in each part another one
      tape.append(Object.assign(part.json, {palette}), part.column);
      changes.push({first: part.column(2), colours: part.column(4), palette});
      if (t === 6) tape.seek(2);
    }
    assert.ok(tape.first.length <= Layers.kMostRuns);
    assert.ok(tape.times.at(0) > 2);
    const cells = new Uint32Array(size * size);
    changes.forEach(({first, colours, palette}, t) => {
      first.forEach((cell, i) => { cells[cell] = Layers.inMemory(palette[colours[i]]); });
      if (t < tape.times.at(0) - 1) return;
      tape.seek(t);
      assert.deepStrictEqual(Array.from(tape.cells), Array.from(cells), "at " + t);
    });
    tape.seek(0); // before the memory: its begin
    assert.ok(tape.cells.some((cell) => cell !== 0));
  },
  theClockFollowsUntilAsked() {
    const clock = new Clocks.Clock(new Runs.Timeline(Int32Array.from([0, 1e6, 2e6])), 2, () => {});
    clock.setLive(true);
    clock.grow(0, 3);
    assert.deepStrictEqual([clock.t, clock.following, clock.playing], [3, true, true]);
    clock.seek(1);
    clock.grow(0, 4);
    assert.deepStrictEqual([clock.t, clock.following, clock.playing], [1, false, false]);
    clock.speed = 16;
    clock.play(true);
    clock.tick(0);
    clock.tick(250);
    assert.deepStrictEqual([clock.t, clock.following, clock.playing], [4, true, true]);
    clock.play(false);
    clock.grow(2, 5);
    assert.deepStrictEqual([clock.t, clock.following], [4, false]);
    clock.grow(4.5, 6); // what it showed is forgotten
    assert.strictEqual(clock.t, 4.5);
    clock.seek(6);
    assert.ok(clock.following);
    clock.step(-1);
    assert.ok(!clock.following && !clock.playing);
    clock.follow(true);
    clock.setLive(false);
    clock.grow(4.5, 7);
    assert.deepStrictEqual([clock.t, clock.following, clock.playing], [6, false, false]);
  },
  theTokenLeavesTheAddress() {
    const store = new Map();
    const view = {sessionStorage: {getItem: (key) => (store.has(key) ? store.get(key) : null),
      setItem: (key, value) => store.set(key, value)}, location: {hash: "#token=ab=c&t=3", pathname: "/",
      search: ""}, history: {replaceState: (state, title, url) => { view.address = url; }}};
    assert.strictEqual(Live.takeToken(view), "ab=c");
    assert.strictEqual(view.address, "/#t=3");
    view.location.hash = "#t=3"; // after a reload
    assert.strictEqual(Live.takeToken(view), "ab=c");
    view.sessionStorage.removeItem = (key) => store.delete(key);
    Live.forgetToken(view);
    assert.strictEqual(Live.takeToken(view), null);
    const blocked = () => { throw new Error("blocked"); };
    view.sessionStorage = {getItem: blocked, setItem: blocked};
    view.address = null;
    assert.strictEqual(Live.takeToken(view), null);
    view.location.hash = "#token=x";
    assert.strictEqual(Live.takeToken(view), "x");
    assert.strictEqual(view.address, null);
    Live.forgetToken(view);
  },
  aLinkShowsItsTokenAndReads() {
    const made = connection();
    made.sockets[0].onopen();
    assert.deepStrictEqual(made.sent, [{token: "secret"}]);
    made.link.send({pause: true}); // without rights yet
    made.says({rights: {command: true}});
    made.gets(message({part: true})); // before the whole
    made.gets(message({runs: []}));
    made.gets(message({part: true}));
    made.says({refused: "block b3 cannot rise"});
    made.link.send({pause: true});
    assert.deepStrictEqual(plain(made.heard.map(([name, what]) => (name === "whole" || name === "part"
      ? name : [name, what]))), [["rights", {command: true}], "whole", ["state", "live"], "part",
      ["answer", "block b3 cannot rise"]]);
    assert.deepStrictEqual(made.sent.slice(1), [{pause: true}]);
  },
  aRunMayWaitForPrograms() {
    const doing = (live) => Live.doing(Object.assign({}, kLive, live));
    assert.strictEqual(doing({}), "live");
    assert.strictEqual(doing({waiting_for: 1}), "waiting for a program");
    assert.strictEqual(doing({waiting_for: 3}), "waiting for 3 programs");
    assert.strictEqual(doing({waiting_for: 3, paused: true}), "paused");
  },
  watchersSendNoCommands() {
    const made = connection(null);
    made.sockets[0].onopen();
    made.says({rights: {command: false}});
    made.link.send({pause: true});
    assert.deepStrictEqual(made.sent, [{}]);
  },
  aLostLinkIsTriedAgainLaterAndLater() {
    const made = connection();
    for (let i = 0; i < 6; ++i) {
      made.sockets[i].onclose();
      made.waits[i][0]();
    }
    assert.deepStrictEqual(made.waits.map(([, wait]) => wait), [1000, 2000, 4000, 8000, 15000, 15000]);
    assert.ok(made.heard.every(([name, state]) => name === "state" && state === "lost"));
    made.says({rights: {command: true}});
    made.gets(message({runs: []}));
    made.sockets[6].onclose();
    assert.strictEqual(made.waits[6][1], 1000);
    assert.strictEqual(made.heard.pop()[2], "connection lost, trying again");
    made.link.send({pause: true});
    assert.strictEqual(made.sent.length, 0);
  },
  anEndIsNotTriedAgain() {
    for (const [words, state] of [[{over: true}, "over"], [{refused: "the token is wrong"}, "refused"]]) {
      const made = connection();
      made.says(words);
      made.sockets[0].onclose();
      assert.strictEqual(made.waits.length, 0);
      assert.strictEqual(made.heard[0][1], state);
    }
  },
  anotherTokenConnectsAnew() {
    const made = connection();
    made.link.reopen();
    assert.strictEqual(made.sockets.length, 2);
    assert.strictEqual(made.waits.length, 0); // that the old one closes means nothing
    made.sockets[0].onmessage({data: JSON.stringify({over: true})});
    assert.strictEqual(made.heard.length, 0);
  },
  steeringIsRepeatedWhileHeld() {
    const made = steering();
    made.steering.drive(0, 0.5, 0);
    made.now = 200;
    made.repeat();
    made.steering.drive(0, 0.5, 0); // no change
    made.now = 210;
    made.steering.drive(0, 0.6, 0); // too soon: with the next
    made.now = 400;
    made.repeat();
    made.steering.drive(0, 0, 0);
    made.steering.drive(0, 0, 0);
    assert.strictEqual(made.repeat, null);
    assert.deepStrictEqual(made.sent.map(({ahead}) => ahead), [0.5, 0.5, 0.6, 0]);
  },
  anotherRobotReleasesTheFirst() {
    const made = steering();
    made.steering.drive(0, 1, 0);
    made.steering.drive(1, 1, 0);
    made.steering.release();
    made.steering.release();
    assert.deepStrictEqual(made.sent.map(({robot, ahead}) => [robot, ahead]),
      [[0, 1], [0, 0], [1, 1], [1, 0]]);
  },
  keysAddUp() {
    const keys = new Joystick.Keys();
    assert.ok(!keys.down("a", false));
    keys.down("ArrowUp", false);
    keys.down("ArrowLeft", true);
    assert.deepStrictEqual(plain(keys.direction()), {ahead: 1, left: 1});
    keys.down("ArrowRight", false);
    assert.deepStrictEqual(plain(keys.direction()), {ahead: 0.6, left: 0});
    assert.ok(keys.up("ArrowUp") && !keys.up("ArrowUp"));
  },
  directionsOfThePad() {
    const {directionOf} = Joystick;
    assert.deepStrictEqual(plain(directionOf(0.05, 0.05)), {ahead: 0, left: 0});
    assert.deepStrictEqual(plain(directionOf(0, -1)), {ahead: 1, left: 0});
    assert.deepStrictEqual(plain(directionOf(-5, 0)), {ahead: 0, left: 1});
    const {ahead, left} = directionOf(3, 3);
    assert.deepStrictEqual([ahead, left], [-0.71, -0.71]);
  },
  thePadFollowsOnePointer() {
    const pad = node();
    const driven = [];
    const made = new Joystick.Pad(pad, (ahead, left) => { driven.push([ahead, left]); });
    pad.send("pointermove", 200, 100);
    pad.send("pointerdown", 200, 100);
    pad.send("pointerdown", 300, 200, 2);
    pad.send("pointermove", 300, 200, 2);
    pad.send("pointermove", 100, 200);
    assert.strictEqual(made.knob.style.transform, "translate(-75%,0%)");
    pad.send("pointerup", 300, 200, 2);
    pad.send("pointerup", 100, 200);
    pad.send("lostpointercapture", 100, 200);
    assert.deepStrictEqual(driven, [[1, 0], [0, 1], [0, 0]]);
    assert.strictEqual(made.knob.style.transform, "translate(0%,0%)");
  },
  keysDriveThePresentRobot() {
    const made = desk();
    assert.ok(made.key("ArrowUp", true));
    made.listeners.keyup({key: "ArrowUp"});
    assert.ok(made.key(" "));
    assert.ok(!made.key("x"));
    assert.deepStrictEqual(made.sent, [{steer: {robot: 0, ahead: 1, left: 0}},
      {steer: {robot: 0, ahead: 0, left: 0}}, {pause: true}]);
    // Which one, if there are two?
    made.state.runs[0].robots.push(made.state.runs[0].robots[0]);
    made.key("ArrowUp");
    assert.strictEqual(made.sent.length, 3);
    assert.ok(made.said[0].startsWith("Select the robot to drive"));
    made.desk.show();
    assert.ok(made.byId("pad").hidden);
    made.state.options.selected = 1;
    made.desk.show();
    assert.ok(!made.byId("pad").hidden);
  },
  whatIsHeldIsReleased() {
    for (const release of [(made) => made.listeners.blur(), (made) => made.listeners.visibilitychange(),
      (made) => made.desk.setConnected(false)]) {
      const made = desk();
      made.key("ArrowLeft");
      release(made);
      release(made);
      assert.deepStrictEqual(made.sent.map(({steer}) => steer.left), [0.6, 0]);
    }
  },
  noCommandsToThePastOrWithoutRights() {
    const made = desk();
    const nothing = () => {
      assert.ok(!made.key("ArrowUp") && !made.key(" ") && !made.desk.clicked([0, 0]));
      assert.deepStrictEqual(made.sent, []);
    };
    made.state.clock.following = false;
    nothing();
    made.desk.show();
    assert.ok(made.byId("pad").hidden && !made.byId("live-bar").hidden);
    made.state.clock.following = true;
    made.desk.setRights({command: false});
    nothing();
    assert.ok(made.byId("pad").hidden && made.byId("live-bar").hidden);
  },
  aDragPlacesARobot() {
    const made = desk();
    const view = {scale: 100};
    assert.strictEqual(made.desk.tool(view), null);
    made.desk.startPlacing();
    assert.ok(made.key("Escape"));
    assert.strictEqual(made.desk.tool(view), null);
    made.desk.startPlacing();
    const tool = made.desk.tool(view);
    tool.down([1, 2]);
    tool.move([1.05, 2.05]); // by 7 pixels: not meant as a drag
    tool.move([1, 3]);
    tool.up();
    assert.strictEqual(made.desk.tool(view), null);
    assert.deepStrictEqual(made.sent, [{place: {robot: 0, x: 1, y: 2, a: Math.PI / 2}}]);
    made.state.live.can.place = "a program drives it";
    made.desk.show();
    assert.ok(made.byId("place").disabled);
    assert.strictEqual(made.byId("place").title, "a program drives it");
  },
  aClickRaisesABlock() {
    const made = desk();
    assert.ok(made.desk.clicked([0, 0]));
    assert.ok(!made.desk.clicked([3, 0]));
    assert.deepStrictEqual(made.sent, [{block: {name: "block", up: true}}]);
  },
  clicksMeanBlocks() {
    const {one} = grown(1000);
    // It is retracted, and then rises.
    assert.deepStrictEqual(plain(Commands.blockAt(one, ["block"], [0, 0], 10)), {name: "block", up: true});
    assert.deepStrictEqual(plain(Commands.blockAt(one, ["block"], [0, 0], 1000)), {name: "block", up: false});
    assert.strictEqual(Commands.blockAt(one, ["block"], [1, 0], 10), null);
    assert.strictEqual(Commands.blockAt(one, kLive.can.blocks, [0, 0], 10), null);
  },
});
