// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Puts the page together: with data in it a replay, else a live page.
"use strict";

const Page = (function () {
  const {element, setText, showLines} = Panels;
  const byId = (id) => document.getElementById(id);
  const kTrails = {whole: 1e9, short: 10, off: 0};
  const kPanelPeriod = 100; // between updates of the panel during a playback [ms]
  const kMarksPeriod = 1000; // between pictures of the marks of a live run [ms]
  const kLivePlot = 60; // what plots of a live run show [s]
  const kLeastPlot = 10; // and at its begin [s]
  const kMostHappenings = 500; // in the list of a live run
  const kShownMessage = 6000; // [ms]

  const state = {
    runs: [], stages: [], clock: null, panel: null, panelRun: null, over: false,
    dirty: true, // the picture is out of date
    panelAt: 0, // when the panel was updated last, by the browser's clock [ms]
    marksAt: 0, // when the scrubber's marks were drawn last [ms]
    lastHappening: null, // the newest item of the list that is in the past
    options: {trail: kTrails.whole, scans: true, names: true, frame: true, selected: -1,
      hidden: new Set(), paper: null, steered: [], placing: null},
    live: null, // of a live page: what the simulation does and can do
    link: null, // of a live page: its connection
    desk: null, // of a live page: where a person commands
    grown: false, // the run has grown since the controls were updated
    happened: [], // what is not in the list of happenings yet
    knownLayers: new Set(), // names of layers that have had a switch
  };

  function changed() {
    state.dirty = true;
  }

  // The stages for the present mode: one for all runs, or one for each.
  function makeStages() {
    const box = byId("stages");
    box.textContent = "";
    const groups = state.over || state.runs.length < 2 ? [state.runs] : state.runs.map((run) => [run]);
    state.stages = groups.map((runs) => {
      const figure = box.appendChild(element("figure", "stage"));
      const canvas = figure.appendChild(element("canvas"));
      canvas.tabIndex = 0;
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", "Picture of the arena of " + runs[0].name +
        ". Press w for the robots' positions.");
      if (state.runs.length > 1) {
        figure.appendChild(element("figcaption", "", runs.map((run) => run.name).join(", over it ")));
      }
      const stage = new Stages.Stage(canvas, runs);
      stage.listen({changed, picked: (robot, place) => picked(robot, place, runs[0]),
        tool: (view) => (state.desk === null ? null : state.desk.tool(view)),
        cursor: (place) => (state.desk !== null && state.desk.blockAt(place) !== null ? "pointer" : "")},
      () => state.clock.t);
      return stage;
    });
    changed();
  }

  function picked(robot, place, run) {
    if (robot < 0 && state.desk !== null && state.desk.clicked(place)) return;
    select(robot, run);
  }

  function zoom(factor) {
    for (const {view} of state.stages) view.zoom(view.width / 2, view.height / 2, factor);
    changed();
  }
  function fit() {
    state.stages.forEach((stage) => stage.fit());
    changed();
  }

  // Marks a robot in all pictures, and shows it in the panel. @param run  in which it was picked.
  function select(robot, run = state.panelRun) {
    state.options.selected = robot;
    state.panelRun = run;
    byId("robot").value = String(robot);
    state.panel.show(run, robot);
    setText(byId("of-run"), state.runs.length > 1 && robot >= 0 ? "in " + run.name : "");
    byId("hint").hidden = robot >= 0;
    if (state.desk !== null) {
      state.desk.release();
      state.desk.show();
    }
    changed();
  }

  // Shows a short message in the live region of a live page.
  let messageTimer = 0;
  function showMessage(text) {
    setText(byId("live"), text);
    clearTimeout(messageTimer);
    messageTimer = setTimeout(() => setText(byId("live"), ""), kShownMessage);
  }

  // Says time and positions in the live region.
  function say() {
    const t = state.clock.t;
    const robots = state.runs[0].robots.map((robot) => {
      const X = robot.at(t);
      const heading = Math.round(Math.atan2(Math.sin(X.a), Math.cos(X.a)) * 180 / Math.PI);
      return robot.name + " at x " + X.x.toFixed(2) + ", y " + X.y.toFixed(2) + " metres, heading " +
        heading + " degrees" + (X.stalled ? ", stalled" : "");
    });
    const text = t.toFixed(2) + " seconds. " + robots.join("; ") + ".";
    if (state.live !== null) showMessage(text);
    else byId("live").textContent = text;
  }

  function drawScrubber() {
    const canvas = byId("marks");
    const {begin, end} = state.clock;
    const box = canvas.getBoundingClientRect();
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.max(Math.round(box.width * ratio), 1);
    canvas.height = Math.max(Math.round(box.height * ratio), 1);
    const ctx = canvas.getContext("2d");
    const colours = {collision: Scene.colour("stalled"), event: Scene.colour("trap"),
      goal: Scene.colour("passed"), end: getComputedStyle(canvas).color};
    state.runs.forEach((run, row) => {
      const height = canvas.height / state.runs.length;
      for (const {t, kind} of run.happenings()) {
        // The thumb's centre moves between half its width from either end.
        const x = (8 + (t - begin) / Math.max(end - begin, 1e-9) * (box.width - 16)) * ratio;
        ctx.fillStyle = colours[kind];
        ctx.fillRect(x - ratio, row * height, 2 * ratio, height - ratio);
      }
    });
  }

  function draw(now) {
    const {clock} = state;
    clock.tick(now);
    let resized = false;
    for (const stage of state.stages) resized = stage.resize() || resized;
    // A live run grows also while the past is shown.
    if (state.grown && now - state.panelAt > kPanelPeriod) showGrowth(now);
    if (state.dirty || resized) {
      state.dirty = false;
      const dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
      state.options.paper = dark ? "#26292e" : null;
      state.stages.forEach((stage) => stage.draw(clock.t, state.options));
      showControls();
      if (!clock.playing || now - state.panelAt > kPanelPeriod) {
        state.panelAt = now;
        showTexts();
      }
      if (resized) drawScrubber();
    }
    requestAnimationFrame(draw);
  }

  function showGrowth(now) {
    const {clock} = state;
    state.grown = false;
    byId("scrubber").min = String(clock.begin);
    byId("scrubber").max = String(clock.end);
    addHappenings(state.happened.splice(0));
    if (!clock.following) state.panelAt = now;
    if (now - state.marksAt < kMarksPeriod) return;
    state.marksAt = now;
    drawScrubber();
  }

  function showControls() {
    const {clock} = state;
    if (state.desk !== null) {
      const {command, pad} = state.desk;
      byId("to-live").hidden = !clock.live;
      byId("to-live").setAttribute("aria-pressed", String(clock.following));
      byId("speed-box").hidden = clock.following;
      if (command && pad.node.hidden === clock.following) state.desk.show();
    }
    const play = byId("play");
    setText(play, clock.playing ? "❚❚" : "►");
    const what = state.live === null ? "" : " the view";
    play.setAttribute("aria-label", (clock.playing ? "Pause" : "Play") + what);
    const scrubber = byId("scrubber");
    scrubber.value = String(clock.t);
    scrubber.setAttribute("aria-valuetext", clock.t.toFixed(2) + " seconds");
    setText(byId("time"), clock.t.toFixed(2) + " s");
  }

  function showTexts() {
    const t = state.clock.t;
    state.panel.update(t);
    const lines = [].concat(...state.runs.map((run) => run.outputBefore(t, Panels.kShownLines)
      .map((line) => Object.assign({}, line, {text: namedIfSeveral(run, line.text)}))));
    lines.sort((a, b) => a.t - b.t);
    showLines(byId("output"), lines.slice(-Panels.kShownLines), "nothing so far");
    const list = byId("happenings");
    let last = null;
    for (const item of list.children) {
      const past = Number(item.dataset.t) <= t + 1e-9;
      if (item.classList.contains("past") !== past) item.classList.toggle("past", past);
      if (past) last = item;
    }
    if (last !== state.lastHappening) {
      state.lastHappening = last;
      list.scrollTop = last === null ? 0 : last.offsetTop - list.offsetTop - list.clientHeight / 2;
    }
  }

  function button(id, action) {
    byId(id).addEventListener("click", action);
  }
  function toggle(id, name) {
    const box = byId(id);
    box.checked = state.options[name];
    box.addEventListener("change", () => {
      state.options[name] = box.checked;
      changed();
    });
  }

  function makeLayers() {
    const box = byId("layers");
    box.textContent = "";
    // Layers of the same name share a switch, also in two runs.
    const tapes = new Map();
    for (const tape of [].concat(...state.runs.map((run) => run.layers))) {
      if (!tape.visible && !state.knownLayers.has(tape.name)) state.options.hidden.add(tape.name);
      state.knownLayers.add(tape.name);
      if (tape.times.length > 0 && !tapes.has(tape.name)) tapes.set(tape.name, tape);
    }
    byId("layer-box").hidden = tapes.size === 0;
    [...tapes.values()].map((tape, i) => ({tape, i}))
      .sort((a, b) => b.tape.priority - a.tape.priority || b.i - a.i)
      .forEach(({tape}) => {
        const label = box.appendChild(element("label", "layer"));
        const check = label.appendChild(element("input"));
        check.type = "checkbox";
        check.checked = !state.options.hidden.has(tape.name);
        check.addEventListener("change", () => {
          if (check.checked) state.options.hidden.delete(tape.name);
          else state.options.hidden.add(tape.name);
          changed();
        });
        if (!tape.grey) swatch(label, tape.colour.slice(0, 7));
        label.appendChild(element("bdi", "", tape.name));
        if (!tape.grey) return;
        for (const [shade, word] of [["#ffffff", "free"], ["#808080", "unknown"], ["#000000", "occupied"]]) {
          swatch(label, shade);
          label.appendChild(element("small", "", word));
        }
      });
  }
  function swatch(label, colour) {
    label.appendChild(element("span", "swatch")).style.background = colour;
  }

  function makeHappenings() {
    byId("happenings").textContent = "";
    state.lastHappening = null;
    const all = [].concat(...state.runs.map((run) => run.happenings().map((one) =>
      Object.assign(one, {text: namedIfSeveral(run, one.text)}))));
    addHappenings(all.sort((a, b) => a.t - b.t));
  }
  function addHappenings(all) {
    const list = byId("happenings");
    for (const one of all) {
      const item = list.appendChild(element("li", one.kind));
      item.dataset.t = String(one.t);
      const link = item.appendChild(element("button"));
      link.type = "button";
      link.appendChild(element("span", "time", one.t.toFixed(2)));
      link.appendChild(element("bdi", "", one.text));
      link.addEventListener("click", () => state.clock.seek(one.t));
    }
    if (state.live === null) return;
    while (list.childElementCount > kMostHappenings) list.firstChild.remove();
  }

  function namedIfSeveral(run, text) {
    return state.runs.length > 1 ? run.name + ": " + text : text;
  }

  function makeControls() {
    const {clock} = state;
    button("play", () => clock.play(!clock.playing));
    button("back", () => clock.step(-1));
    button("forward", () => clock.step(1));
    button("start", () => clock.seek(clock.begin));
    button("to-live", () => clock.follow(true));
    button("zoom-in", () => zoom(1.4));
    button("zoom-out", () => zoom(1 / 1.4));
    button("fit", fit);
    button("where", say);
    button("help-button", () => byId("help").showModal());
    toggle("scans", "scans");
    toggle("names", "names");
    const speed = byId("speed");
    for (const factor of Clocks.kSpeeds) speed.appendChild(new Option(factor + "×", String(factor)));
    speed.value = "1";
    speed.addEventListener("change", () => { clock.speed = Number(speed.value); });
    byId("trail").addEventListener("change", (event) => {
      state.options.trail = kTrails[event.target.value];
      changed();
    });
    const scrubber = byId("scrubber");
    scrubber.max = String(clock.end);
    scrubber.addEventListener("input", () => clock.seek(Number(scrubber.value)));
    byId("robot").addEventListener("change", (event) => select(Number(event.target.value)));
    byId("mode-box").hidden = state.runs.length < 2;
    byId("mode").addEventListener("change", (event) => {
      state.over = event.target.value === "over";
      makeStages();
    });
  }

  function makeRobots() {
    const robot = byId("robot");
    robot.textContent = "";
    robot.appendChild(new Option("none", "-1"));
    state.runs[0].robots.forEach((one, i) => robot.appendChild(new Option(one.name, String(i))));
  }

  // The next or last thing that happened, from the present time.
  function toHappening(way) {
    const times = [].concat(...state.runs.map((run) => run.happenings().map((one) => one.t)));
    const found = times.filter((t) => (way > 0 ? t > state.clock.t + 1e-3 : t < state.clock.t - 1e-3));
    if (found.length > 0) state.clock.seek(way > 0 ? Math.min(...found) : Math.max(...found));
  }

  function keyAction(event) {
    const {clock} = state;
    const flip = (id) => byId(id).click();
    const step = (way) => (event.shiftKey ? clock.seek(clock.t + way) : clock.step(way));
    return {
      " ": () => clock.play(!clock.playing), "ArrowRight": () => step(1), "ArrowLeft": () => step(-1),
      "Home": () => clock.seek(clock.begin), "End": () => clock.seek(clock.end), "+": () => zoom(1.4),
      "=": () => zoom(1.4), "-": () => zoom(1 / 1.4), "0": fit, "s": () => flip("scans"),
      "m": () => flip("names"), "n": () => toHappening(1), "p": () => toHappening(-1), "w": say,
      "t": () => {
        const trail = byId("trail");
        trail.selectedIndex = (trail.selectedIndex + 1) % trail.length;
        trail.dispatchEvent(new Event("change"));
      },
      "l": () => {
        const boxes = [...byId("layers").querySelectorAll("input")];
        const any = boxes.some((box) => box.checked);
        boxes.filter((box) => box.checked === any).forEach((box) => box.click());
      },
      "r": () => select(state.options.selected + 1 < state.runs[0].robots.length
        ? state.options.selected + 1 : -1),
      "<": () => faster(-1), ">": () => faster(1), "?": () => byId("help").showModal(),
      "Escape": () => select(-1),
    }[event.key];
  }
  function faster(way) {
    const speed = byId("speed");
    speed.selectedIndex = Math.min(Math.max(speed.selectedIndex + way, 0), speed.length - 1);
    state.clock.speed = Number(speed.value);
  }

  function listenToKeys() {
    document.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || byId("help").open) return;
      const target = event.target;
      if (state.desk !== null && !target.matches("select") && state.desk.key(event)) {
        event.preventDefault();
        return;
      }
      // Controls keep the keys that they use themselves.
      if (target.matches("select, summary, button, input[type=checkbox]") &&
          [" ", "Enter", "ArrowUp", "ArrowDown"].includes(event.key)) return;
      if (target.matches("select")) return;
      const action = keyAction(event);
      if (!action) return;
      event.preventDefault();
      action();
    });
  }

  function openFragment() {
    const said = Clocks.ofFragment(window.location.hash);
    if (said.robot !== null) {
      const robot = state.runs[0].robotNamed(said.robot);
      if (robot >= 0) select(robot);
    }
    if (said.t !== null) state.clock.seek(said.t);
  }

  // Plots show a whole replay, but the last minute of a live run.
  function plotSpan(t) {
    const {begin, end, live} = state.clock;
    if (!live) return [begin, end];
    const from = Math.max(t - kLivePlot, begin);
    return [from, Math.max(t, from + kLeastPlot)];
  }

  // Shows the first runs of the page.
  function open(file) {
    Scene.setPalette(file.head.palette);
    state.runs = file.head.runs.map((json) => new Runs.Run(json, file));
    state.runs[0].ended = state.live === null;
    setText(byId("title"), state.runs.map((run) => run.name).join(" and "));
    const longest = state.runs.reduce((a, b) => (b.end > a.end ? b : a));
    state.clock = new Clocks.Clock(longest.frames, longest.end, changed);
    if (state.live !== null) state.clock.setLive(true);
    state.panel = new Panels.Panel(byId("panel"), plotSpan);
    state.panelRun = state.runs[0];
    makeControls();
    makeStages();
    showRuns(file.head);
    listenToKeys();
    select(state.runs[0].robots.length === 1 ? 0 : -1);
    openFragment();
    window.addEventListener("hashchange", openFragment);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      drawScrubber();
      changed();
    });
    document.body.classList.add("ready");
    byId("link").hidden = state.live === null;
    byId("status").remove();
    requestAnimationFrame(draw);
  }

  function showRuns(head) {
    showHead(head.thinned);
    makeLayers();
    makeHappenings();
    makeRobots();
  }

  async function start() {
    const node = byId("replay-data");
    if (node === null) return startLive();
    try {
      const file = new Columns.File(await Columns.inflated(Columns.bytesOfBase64(node.textContent)));
      node.remove();
      return open(file);
    } catch (error) {
      setText(byId("status"), "The replay cannot be shown: " + error.message);
      throw error;
    }
  }

  function startLive() {
    document.body.classList.add("is-live");
    byId("picture").appendChild(byId("live"));
    byId("live-keys").hidden = false;
    byId("trail").value = "short";
    state.options.trail = kTrails.short;
    setText(byId("title"), "Live");
    setText(byId("status"), "Connecting …");
    let token = Live.takeToken(window);
    const address = window.location.origin.replace(/^http/, "ws") + "/live";
    state.desk = new Commands.Desk({state, changed, say: showMessage},
      (command) => state.link.send(command));
    state.link = new Live.Link(() => new WebSocket(address), () => token,
      {whole, part, rights: (rights) => state.desk.setRights(rights), answer: showMessage,
        state: showLink}, window);
    window.addEventListener("hashchange", () => {
      if (!window.location.hash.includes("token=")) return;
      token = Live.takeToken(window);
      state.link.reopen();
    });
  }

  // A whole run: the first one, or one that replaces the run.
  function whole(file) {
    const {head} = file;
    state.live = head.live;
    state.happened = [];
    if (state.clock === null) {
      open(file);
    } else {
      const selected = state.runs[0].robots[state.options.selected];
      const [run] = state.runs = [new Runs.Run(head.runs[0], file)];
      run.ended = false;
      state.clock.frames = run.frames;
      state.panelRun = run;
      state.stages.forEach((stage) => stage.show(state.runs));
      showRuns(head);
      select(selected === undefined ? -1 : run.robotNamed(selected.name));
    }
    grown();
  }

  function part(file) {
    const [run] = state.runs;
    const layers = run.layers.filter((tape) => tape.times.length > 0).length;
    const [json] = file.head.runs;
    const known = [run.verdict, run.notes.length].join();
    state.happened.push(...run.append(json, file));
    if (state.happened.length > 2 * kMostHappenings) state.happened.splice(0, kMostHappenings);
    if (run.layers.filter((tape) => tape.times.length > 0).length > layers) makeLayers();
    if ([run.verdict, run.notes.length].join() !== known) showHead("");
    state.live = file.head.live;
    grown();
  }

  function grown() {
    const [run] = state.runs;
    state.grown = true;
    state.options.steered = state.clock.following ? state.live.steered : [];
    state.clock.grow(run.begin, run.end);
    if (state.clock.following) changed();
    state.desk.show();
    showLink("live", "");
    if (state.live.over) showLink("over", "the run is over");
  }

  // @param name  of a state of Live.Link
  function showLink(name, text) {
    const {live, clock, desk} = state;
    const node = byId("link");
    desk.setConnected(name === "live");
    if (name === "refused") Live.forgetToken(window);
    node.className = name;
    const rights = desk.command ? "commanding" : "watching";
    setText(node, name === "live" ? Live.doing(live) + " · " + rights : text);
    if (clock === null) {
      if (name !== "live") setText(byId("status"), text);
      return;
    }
    if (name === "over" && clock.live) {
      state.runs[0].ended = true;
      desk.setRights({command: false});
      clock.setLive(false);
      makeHappenings();
      drawScrubber();
    }
    if (name !== "live") {
      state.options.steered = [];
      changed();
    }
  }

  function showHead(thinned) {
    byId("verdict").textContent = "";
    byId("notes").textContent = "";
    for (const run of state.runs) {
      if (run.verdict) {
        byId("verdict").appendChild(element("span", run.verdict.passed ? "passed" : "failed",
          namedIfSeveral(run, (run.verdict.passed ? "passed" : "failed") +
          (run.verdict.reason ? ": " + run.verdict.reason : ""))));
      }
    }
    const notes = [].concat(...state.runs.map((run) => run.notes), thinned ? [thinned] : []);
    for (const note of notes) byId("notes").appendChild(element("p", "", note));
  }

  if (typeof document !== "undefined") start();
  return {state};
})();
