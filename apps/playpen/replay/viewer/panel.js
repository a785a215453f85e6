// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The panel of a robot: motion, devices with their readings and plots, commands, printed lines.
// Texts of the run become text nodes only.
"use strict";

const Panels = (function () {
  const kShownCommands = 8;
  const kShownLines = 12;
  const kShownNumbers = 16; // of a list

  function element(name, className, text) {
    const made = document.createElement(name);
    if (className) made.className = className;
    if (text !== undefined) made.textContent = text;
    return made;
  }
  function setText(node, text) {
    if (node.textContent !== text) node.textContent = text;
  }
  const degrees = (radians) => radians * 180 / Math.PI;

  // A row "name | value | plot" of a table.
  class Row {
    constructor(table, name, curve, spanAt) {
      const row = table.appendChild(element("tr"));
      const head = row.appendChild(element("th", "", name));
      head.scope = "row";
      this.value = row.appendChild(element("td", "value"));
      const cell = row.appendChild(element("td", "plot"));
      if (!curve) return;
      const canvas = cell.appendChild(element("canvas"));
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", name + " over time");
      this.plot = new Plots.Plot(canvas, curve, spanAt);
    }

    update(text, t) {
      setText(this.value, text);
      if (this.plot) this.plot.draw(t);
    }
  }

  class DeviceView {
    constructor(device, spanAt) {
      this.device = device;
      this.spanAt = spanAt;
      this.node = element("details", "device");
      const summary = this.node.appendChild(element("summary"));
      summary.appendChild(element("b", "", device.name));
      if (device.type !== device.name) summary.appendChild(element("span", "type", device.type));
      this.brief = summary.appendChild(element("span", "brief"));
      this.rows = null;
      this.node.open = device.times.length > 0 && (device.series.length <= 4 || device.beams !== null);
    }

    // Rows are made when they are first seen.
    makeRows() {
      if (this.rows !== null) this.node.lastChild.remove();
      const table = this.node.appendChild(element("table"));
      const {device, spanAt} = this;
      this.rows = [];
      for (const series of device.series) {
        const row = new Row(table, series.name, {times: device.times, numbers: () => series.numbers}, spanAt);
        this.rows.push((i, t) => row.update(valueText(series, series.numbers.at(i)), t));
      }
      for (const list of device.lists) {
        const row = new Row(table, "least of " + list.name,
          {times: device.times, numbers: () => device.leastOf(list)}, spanAt);
        const all = table.appendChild(element("tr")).appendChild(element("td", "numbers"));
        all.colSpan = 3;
        this.rows.push((i, t) => {
          const numbers = device.list(list, i);
          row.update(numbers.length === 0 ? "–"
            : Plots.shortNumber(Math.min(...numbers)) + " " + list.unit, t);
          const step = Math.max(Math.ceil(numbers.length / kShownNumbers), 1);
          const shown = numbers.filter((number, k) => k % step === 0);
          setText(all, (step > 1 ? shown.length + " of " : "") + numbers.length + " numbers: " +
            shown.map(Plots.shortNumber).join(" "));
        });
      }
    }

    update(t) {
      const {device} = this;
      const i = device.times.before(t);
      setText(this.brief, device.times.length === 0 ? "no readings"
        : i < 0 ? "none yet" : "at " + device.times.at(i).toFixed(2) + " s");
      if (this.rows !== null) this.node.lastChild.hidden = i < 0;
      if (!this.node.open || i < 0) return;
      const {series, lists} = device;
      // A live run's devices may get new ones.
      if (this.rows === null || this.rows.length < series.length + lists.length) this.makeRows();
      for (const update of this.rows) update(i, t);
    }
  }

  function valueText(series, value) {
    if (series.words.length > 0 && series.words[value] !== undefined) return series.words[value];
    return Plots.shortNumber(value) + (series.unit ? " " + series.unit : "");
  }

  // A robot of a run in an element.
  class Panel {
    // @param spanAt  (t) => [begin, end], the time that plots show at t.
    constructor(node, spanAt) {
      this.node = node;
      this.spanAt = spanAt;
      this.shown = null;
    }

    // @param robot  its index; -1: hides the panel.
    show(run, robot) {
      this.node.textContent = "";
      this.shown = null;
      if (robot < 0 || robot >= run.robots.length) return;
      const one = run.robots[robot];
      const motion = this.node.appendChild(element("table", "motion"));
      const rows = [
        ["x", one.x, (X) => Plots.shortNumber(X.x) + " m"],
        ["y", one.y, (X) => Plots.shortNumber(X.y) + " m"],
        ["heading", null, (X) => degrees(Math.atan2(Math.sin(X.a), Math.cos(X.a))).toFixed(1) + "°"],
        ["speed", one.v, (X) => Plots.shortNumber(X.v) + " m/s" + (X.stalled ? ", stalled" : "")],
        ["turn rate", one.w, (X) => degrees(X.w).toFixed(1) + "°/s"],
      ].map(([name, numbers, text]) => ({text, row: new Row(motion, name,
        numbers ? {times: run.frames, numbers: () => numbers} : null, this.spanAt)}));
      this.node.appendChild(element("h3", "", "Devices"));
      const devices = run.devices.filter((device) => device.robot === robot)
        .sort((a, b) => (b.times.length > 0) - (a.times.length > 0))
        .map((device) => new DeviceView(device, this.spanAt));
      devices.forEach((view) => this.node.appendChild(view.node));
      if (devices.length === 0) this.node.appendChild(element("p", "note", "none"));
      this.node.appendChild(element("h3", "", "Last commands"));
      const commands = this.node.appendChild(element("ol", "log"));
      this.shown = {run, robot, rows, devices, commands};
      devices.forEach((view) => view.node.addEventListener("toggle", () => view.update(this.time)));
    }

    update(t) {
      this.time = t;
      if (this.shown === null) return;
      const {run, robot, rows, devices, commands} = this.shown;
      const X = run.robots[robot].at(t);
      for (const {text, row} of rows) row.update(text(X), t);
      for (const view of devices) view.update(t);
      showLines(commands, run.commandsBefore(robot, t, kShownCommands).map((command) =>
        ({t: command.t, text: command.device + ": " + command.text})), "none so far");
    }
  }

  // Fills a list with lines {t, text, error}.
  function showLines(list, lines, nothing) {
    const key = lines.map((one) => one.t + one.text).join("\n");
    if (list.dataset.key === key && list.childElementCount > 0) return;
    list.dataset.key = key;
    list.textContent = "";
    for (const one of lines) {
      const item = list.appendChild(element("li", one.error ? "error" : ""));
      item.appendChild(element("span", "time", one.t.toFixed(2)));
      item.appendChild(element("bdi", "", one.text));
    }
    if (lines.length === 0) list.appendChild(element("li", "note", nothing));
  }

  return {Panel, element, setText, showLines, kShownLines};
})();
