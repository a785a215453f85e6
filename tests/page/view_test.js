// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The view transform, colours, and rules for the scripts' texts.
"use strict";

const assert = require("assert");
const fs = require("fs");
const path = require("path");
const {load, run, folder, names} = require("./load.js");

const {Views, Scene, Robots} = load();
const close = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, a + " is not " + b);

function viewOf(width, height) {
  const view = new Views.View();
  view.resize(width, height);
  return view;
}

run({
  fitShowsTheWholeArena() {
    const view = viewOf(300, 200);
    view.fit([1, 2], [4, 2], 10);
    // 280 pixels for 4 m; the middle is (3, 3).
    close(view.scale, 70);
    assert.deepStrictEqual(Array.from(view.point([3, 3])), [150, 100]);
    assert.deepStrictEqual(Array.from(view.point([1, 4])), [10, 30]);
  },
  pixelsAndPlacesAgree() {
    const view = viewOf(300, 200);
    view.fit([0, 0], [1, 5], 0);
    const [x, y] = view.world(17, 91);
    close(view.px(x), 17);
    close(view.py(y), 91);
  },
  trailsKeepTheirCorners() {
    const plain = (points) => JSON.parse(JSON.stringify(points));
    const along = [0, 1, 2, 3, 4].map((x) => [x, 0.01 * x * x]);
    assert.deepStrictEqual(plain(Robots.simplified([...along, [4, 5], [4, 9]])),
      [[0, 0], [4, 0.16], [4, 9]]);
    // Forward and back on the same line.
    assert.deepStrictEqual(plain(Robots.simplified([[0, 0], [5, 0], [9, 0], [4, 0], [1, 0]])),
      [[0, 0], [9, 0], [1, 0]]);
    assert.deepStrictEqual(plain(Robots.simplified([[3, 3]])), [[3, 3], [3, 3]]);
    assert.deepStrictEqual(plain(Robots.simplified([[3, 3], [3, 3.1], [3, 3]])), [[3, 3], [3, 3]]);
  },
  trailsStayWithinHalfAPixel() {
    const spiral = [];
    for (let i = 0; i < 2000; ++i) spiral.push([0.1 * i * Math.cos(i / 30), 0.1 * i * Math.sin(i / 30)]);
    const kept = Robots.simplified(spiral);
    assert.ok(kept.length < 900, kept.length + " points");
    const away = ([x, y]) => Math.min(...kept.slice(1).map(([bx, by], i) => {
      const [ax, ay] = kept[i];
      const length = Math.hypot(bx - ax, by - ay) || 1;
      const share = Math.min(Math.max(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length ** 2, 0), 1);
      return Math.hypot(x - ax - share * (bx - ax), y - ay - share * (by - ay));
    }));
    const most = Math.max(...spiral.map(away));
    assert.ok(most < 0.5, most + " px");
  },
  zoomKeepsThePlaceUnderThePointer() {
    const view = viewOf(300, 200);
    view.fit([0, 0], [3, 2], 0);
    const before = view.world(40, 50);
    view.zoom(40, 50, 2.5);
    const after = view.world(40, 50);
    close(before[0], after[0]);
    close(before[1], after[1]);
    close(view.scale, 250);
  },
  zoomHasLimits() {
    const view = viewOf(300, 200);
    view.fit([0, 0], [3, 2], 0);
    view.zoom(0, 0, 1e9);
    close(view.scale, 100 * 100);
    view.zoom(0, 0, 1e-9);
    close(view.scale, 100 / 8);
  },
  panMovesWithThePointer() {
    const view = viewOf(300, 200);
    view.fit([0, 0], [3, 2], 0);
    const [px, py] = view.point([1, 1]);
    view.pan(12, -7);
    close(view.px(1), px + 12);
    close(view.py(1), py - 7);
  },
  mixesColours() {
    assert.strictEqual(Scene.mix("#000000", "#ff8000", 0.5), "#804000");
    assert.strictEqual(Scene.withAlpha("#ff8000", 0.25), "rgba(255,128,0,0.25)");
    close(Scene.luma("#ffffff"), 1);
  },
  gridStepsAreRound() {
    assert.deepStrictEqual([0.3, 1, 7, 0.02].map((x) => Number(Scene.roundBelow(x).toFixed(6))),
      [0.2, 1, 5, 0.02]);
  },
  polygonsScaleWithTheirSize() {
    const obstacle = {shape: "polygon", outline: [[0, 0], [1, 0], [0, 1]], size: [1, 1]};
    const points = Scene.outlineOf(obstacle, {x: 5, y: 0, a: Math.PI / 2, size: [2, 1]});
    close(points[1][0], 5);
    close(points[1][1], 2);
    close(points[2][0], 4);
  },
  // Texts of a run must never become markup, and the scripts are part of an HTML page.
  scriptsMakeNoMarkup() {
    for (const name of names) {
      const text = fs.readFileSync(path.join(folder, "viewer", name + ".js"), "utf8");
      for (const word of ["innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "eval(",
        "</script", "<!--", "fetch(", "XMLHttpRequest", ")viewer"]) {
        assert.ok(!text.includes(word), name + ".js has " + word);
      }
    }
  },
});
