// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Loads the scripts of the replay page as the page does: as one script, in the order of
// apps/playpen/replay/CMakeLists.txt.
"use strict";

const fs = require("fs");
const path = require("path");
const vm = require("vm");

const folder = path.join(__dirname, "../../apps/playpen/replay");
const list = /set\(viewer_scripts ([a-z\s]+)\)/.exec(
  fs.readFileSync(path.join(folder, "CMakeLists.txt"), "utf8"));
const names = list[1].split(/\s+/);

// The namespaces of all scripts except the last one, which needs a document.
// @param globals  what a browser has and a test needs
function load(globals = {}) {
  const texts = names.slice(0, -1).map((name) =>
    fs.readFileSync(path.join(folder, "viewer", name + ".js"), "utf8"));
  const context = vm.createContext({atob, Blob, Response, DecompressionStream, TextDecoder, URL,
    console, ...globals});
  return vm.runInContext(texts.join("") +
    "\n({Columns, Runs, Layers, Views, Scene, Robots, Marks, Plots, Panels, Stages, Clocks, Live, " +
    "Joystick, Commands});", context);
}

// Columns for a run's JSON: column(values) gives the index, file.column(index) the typed array.
class FakeFile {
  constructor() {
    this.columns = [];
  }

  add(values, wide = false) {
    this.columns.push(wide ? Float64Array.from(values) : Int32Array.from(values));
    return this.columns.length - 1;
  }

  column(index) {
    return this.columns[index];
  }
}

// Runs test functions by name; prints failures, and exits with 1 if there are any.
async function run(tests) {
  let failed = 0;
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test();
    } catch (error) {
      ++failed;
      console.error("FAILED " + name + "\n" + error.stack);
    }
  }
  console.log(path.basename(require.main.filename) + ": " + (Object.keys(tests).length - failed) +
    " of " + Object.keys(tests).length + " passed");
  process.exitCode = failed > 0 ? 1 : 0;
}

module.exports = {load, FakeFile, run, folder, names};
