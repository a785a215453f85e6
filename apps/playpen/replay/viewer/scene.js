// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Draws the arena as libsim/src/render does: floor, docks, walls, obstacles. The colours come from
// the same palette (sim/render/palette.h), inside the page's data.
"use strict";

const Scene = (function () {
  let palette = {};
  function setPalette(colours) {
    palette = colours;
  }
  function colour(name) {
    return palette[name];
  }

  function channels(hex) {
    return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
  }
  // From colour a to colour b.
  function mix(a, b, share) {
    const to = channels(b);
    const parts = channels(a).map((part, i) => Math.round(part + (to[i] - part) * share));
    return "#" + parts.map((part) => part.toString(16).padStart(2, "0")).join("");
  }
  // BT.601.
  function luma(hex) {
    const [r, g, b] = channels(hex);
    return (0.299 * r + 0.587 * g + 0.114 * b) / 255;
  }
  function withAlpha(hex, alpha) {
    return "rgba(" + channels(hex).join() + "," + alpha + ")";
  }

  // Adds a closed outline of pixels to a path.
  function addOutline(path, points) {
    points.forEach(([x, y], i) => (i === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
    path.closePath();
  }
  function pathOf(outlines) {
    const path = new Path2D();
    for (const outline of outlines) addOutline(path, outline);
    return path;
  }
  function fill(ctx, path, style, opacity = 1) {
    ctx.globalAlpha = opacity;
    ctx.fillStyle = style;
    ctx.fill(path);
    ctx.globalAlpha = 1;
  }
  function stroke(ctx, path, style, width, opacity = 1) {
    ctx.globalAlpha = opacity;
    ctx.strokeStyle = style;
    ctx.lineWidth = width;
    ctx.lineJoin = "round";
    ctx.lineCap = "round";
    ctx.stroke(path);
    ctx.globalAlpha = 1;
  }
  // Soft shadows to the lower right.
  function shadow(ctx, path, unit, distances, opacity) {
    for (const distance of distances) {
      ctx.save();
      ctx.translate(0.8 * distance * unit, distance * unit);
      fill(ctx, path, colour("shadow"), opacity);
      ctx.restore();
    }
  }

  // The largest of ..., 0.1, 0.2, 0.5, 1, 2, 5, ... that is at most `limit`.
  function roundBelow(limit) {
    const power = Math.pow(10, Math.floor(Math.log10(limit)));
    const digit = limit / power;
    return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
  }

  function floorBox(view, arena) {
    const left = view.px(arena.origin[0]);
    const bottom = view.py(arena.origin[1]);
    const width = arena.size[0] * view.scale;
    const height = arena.size[1] * view.scale;
    return {left, top: bottom - height, right: left + width, bottom, width, height};
  }
  // Width of the border in pixels.
  function borderOf(view, arena) {
    return arena.border ? Math.min(Math.max(0.035 * view.scale, 6 * view.unit), 40 * view.unit) : 0;
  }

  function drawFloor(ctx, view, arena) {
    const box = floorBox(view, arena);
    ctx.fillStyle = colour("floor");
    ctx.fillRect(box.left, box.top, box.width, box.height);
    let step = 0.5;
    if (step * view.scale < 28 * view.unit) step = roundBelow(100 * view.unit / view.scale);
    else if (step * view.scale > 450 * view.unit) step = roundBelow(200 * view.unit / view.scale);
    const grid = new Path2D();
    const low = view.world(0, view.height);
    const high = view.world(view.width, 0);
    for (const axis of [0, 1]) {
      const begin = Math.max(arena.origin[axis], low[axis]);
      const end = Math.min(arena.origin[axis] + arena.size[axis], high[axis]);
      for (let i = Math.floor(begin / step) + 1; i * step < end; ++i) {
        if (axis === 0) {
          grid.moveTo(view.px(i * step), Math.max(box.top, 0));
          grid.lineTo(view.px(i * step), Math.min(box.bottom, view.height));
        } else {
          grid.moveTo(Math.max(box.left, 0), view.py(i * step));
          grid.lineTo(Math.min(box.right, view.width), view.py(i * step));
        }
      }
    }
    stroke(ctx, grid, colour("grid"), view.line(1, 0.7));
  }

  function drawDocks(ctx, view, arena) {
    arena.docks.forEach((dock, index) => {
      const corners = dock.corners.map((p) => view.point(p));
      fill(ctx, pathOf([corners]), colour("dock"));
      const marks = new Path2D();
      corners.forEach((corner, i) => {
        const toward = (other) => [0, 1].map((k) => corner[k] + 0.18 * (other[k] - corner[k]));
        marks.moveTo(...toward(corners[(i + 3) % 4]));
        marks.lineTo(...corner);
        marks.lineTo(...toward(corners[(i + 1) % 4]));
      });
      stroke(ctx, marks, colour("dockInk"), view.line(2));
      const center = [0, 1].map((k) => (corners[0][k] + corners[2][k]) / 2);
      const side = Math.hypot(corners[1][0] - corners[0][0], corners[1][1] - corners[0][1]);
      const h = 0.3 * side;
      const bolt = [[0.22, -1], [-0.52, 0.16], [-0.06, 0.16], [-0.22, 1], [0.52, -0.16], [0.06, -0.16]];
      fill(ctx, pathOf([bolt.map(([x, y]) => [center[0] + h * x, center[1] + h * y])]),
        colour("dockInk"), 0.75);
      const size = Math.min(0.15 * side, 40 * view.unit);
      if (size < 5) return;
      const digits = (/\d+$/.exec(dock.name) || [""])[0];
      // The rear right corner is the last one of the box's corners.
      const rear = corners[3];
      ctx.font = "600 " + size / 0.72 + "px system-ui, sans-serif";
      ctx.textAlign = "center";
      ctx.textBaseline = "middle";
      ctx.fillStyle = colour("dockInk");
      ctx.fillText(digits !== "" && digits.length <= 3 ? digits : String(index + 1),
        rear[0] + 0.38 * (center[0] - rear[0]), rear[1] + 0.38 * (center[1] - rear[1]));
    });
  }

  // Outline in the world of an obstacle in its present state.
  function outlineOf(obstacle, now) {
    const [w, h] = now.size;
    let points = [[w / 2, -h / 2], [w / 2, h / 2], [-w / 2, h / 2], [-w / 2, -h / 2]];
    if (obstacle.shape === "polygon") {
      points = obstacle.outline.map(([x, y]) =>
        [x * w / obstacle.size[0], y * h / obstacle.size[1]]);
    } else if (obstacle.shape === "circle") {
      points = [];
      for (let i = 0; i < 72; ++i) {
        points.push([w / 2 * Math.cos(i * Math.PI / 36), w / 2 * Math.sin(i * Math.PI / 36)]);
      }
    }
    return points.map(([x, y]) => place(now, x, y));
  }

  // A point of a body at pose X, in the world.
  function place(X, x, y) {
    const c = Math.cos(X.a);
    const s = Math.sin(X.a);
    return [X.x + c * x - s * y, X.y + s * x + c * y];
  }

  function ownColour(obstacle, now) {
    return now.colour || colour(obstacle.dynamic ? "dynamic" : "static");
  }
  function edgeColour(obstacle, now) {
    if (now.colour) return mix(now.colour, colour("ink"), 0.4);
    return colour(obstacle.dynamic ? "dynamicEdge" : "staticEdge");
  }

  // Retracted obstacles: dashed outlines on the floor.
  function drawRetracted(ctx, view, blocks) {
    const path = pathOf(blocks.filter(({now}) => now.state === "retracted")
      .map(({obstacle, now}) => outlineOf(obstacle, now).map((p) => view.point(p))));
    ctx.setLineDash([view.line(5, 3), view.line(5, 3)]);
    stroke(ctx, path, colour("dynamic"), view.line(1.6), 0.6);
    ctx.setLineDash([]);
  }

  function drawBlock(ctx, view, {obstacle, now}, fillIt) {
    const points = outlineOf(obstacle, now).map((p) => view.point(p));
    const path = pathOf([points]);
    if (fillIt) fill(ctx, path, ownColour(obstacle, now));
    const width = view.line(1.6);
    if (Math.min(...now.size) * view.scale <= 2 * width) return;
    // The edge lies inside, so that adjacent blocks do not overlap.
    ctx.save();
    ctx.clip(path);
    stroke(ctx, path, edgeColour(obstacle, now), 2 * width);
    ctx.restore();
  }

  // Border, walls, separators and standing obstacles.
  function drawSolids(ctx, view, run, blocks) {
    const arena = run.arena;
    const box = floorBox(view, arena);
    const border = borderOf(view, arena);
    const standing = blocks.filter(({now}) => now.state === "standing");
    const loops = (solid) => pathOf(run.walls.filter((loop) => loop.solid === solid)
      .map((loop) => loop.points.map((p) => view.point(p))));
    const walls = loops(true);
    const separators = pathOf(arena.separators.map((outline) => outline.map((p) => view.point(p))));
    fill(ctx, loops(false), colour("wall"));
    standing.filter(({obstacle}) => !obstacle.solid).forEach((one) => drawBlock(ctx, view, one, true));
    const solid = standing.filter(({obstacle}) => obstacle.solid);
    const bodies = new Path2D(separators);
    bodies.addPath(walls);
    for (const {obstacle, now} of solid) {
      addOutline(bodies, outlineOf(obstacle, now).map((p) => view.point(p)));
    }
    shadow(ctx, bodies, view.unit, [1, 2.2, 3.6, 5], 0.075);
    if (arena.border) {
      for (const depth of [1.5, 3, 5]) {
        const d = depth * view.unit;
        fill(ctx, pathOf([[[box.left, box.top], [box.right, box.top], [box.right, box.top + d],
          [box.left + 0.8 * d, box.top + d], [box.left + 0.8 * d, box.bottom],
          [box.left, box.bottom]]]), colour("shadow"), 0.06);
      }
    }
    fill(ctx, walls, colour("wall"));
    stroke(ctx, walls, colour("wallEdge"), view.line(1, 0.7));
    const frame = (grown) => [[box.left - grown, box.top - grown],
      [box.right + grown, box.top - grown], [box.right + grown, box.bottom + grown],
      [box.left - grown, box.bottom + grown]];
    if (arena.border) {
      fill(ctx, pathOf([frame(border), frame(0).reverse()]), colour("border"));
      stroke(ctx, pathOf([frame(border), frame(0)]), colour("borderEdge"), view.line(1.2));
    } else {
      stroke(ctx, pathOf([frame(0)]), colour("faintInk"), view.line(1.2), 0.6);
    }
    fill(ctx, separators, colour("border"));
    stroke(ctx, separators, colour("borderEdge"), view.line(1.2));
    solid.forEach((one) => drawBlock(ctx, view, one, true));
  }

  return {setPalette, colour, mix, luma, withAlpha, pathOf, fill, stroke, shadow, roundBelow,
    floorBox, drawFloor, drawDocks, outlineOf, place, drawRetracted, drawSolids};
})();
