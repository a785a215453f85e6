// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Draws what moves and what is marked in the arena: moving obstacles, traps, goals, collisions,
// events, texts and names.
"use strict";

const Marks = (function () {
  const {colour, mix, luma, pathOf, fill, stroke, shadow, outlineOf} = Scene;
  const {disc, ring, line, markedRadius} = Robots;
  const kShownEvent = 1; // how long an event is shown [s]
  const kMostCountdowns = 6;

  function moverColour(obstacle, now) {
    return now.colour || colour(obstacle.pushable ? "crate" : obstacle.movable ? "driven" : "dynamic");
  }

  function drawTracks(ctx, view, run, blocks) {
    for (const track of run.tracks) {
      if (track.points.length < 2) continue;
      const style = moverColour(blocks[track.obstacle].obstacle, blocks[track.obstacle].now);
      const points = track.points.map((p) => view.point(p));
      const closed = track.closed && points.length > 2;
      line(ctx, closed ? [...points, points[0]] : points, style, view.line(1.6), 0.3);
      points.forEach((p) => disc(ctx, p, view.line(3.2, 1.8), style, 0.3));
    }
  }

  // Obstacles that move, or can be pushed.
  function drawMovers(ctx, view, blocks) {
    const movers = blocks.filter(({obstacle, now}) => obstacle.movable && now.state === "standing");
    const outlines = movers.map(({obstacle, now}) => outlineOf(obstacle, now).map((p) => view.point(p)));
    shadow(ctx, pathOf(outlines), view.unit, [1, 2.2, 3.6, 5], 0.075);
    movers.forEach(({obstacle, now}, i) => {
      const style = moverColour(obstacle, now);
      const edge = mix(style, colour("ink"), 0.45);
      const outline = outlines[i];
      fill(ctx, pathOf([outline]), style);
      if (obstacle.pushable) drawCrate(ctx, view, obstacle, now, outline, edge);
      else if (obstacle.faces) drawChevron(ctx, view, now, edge);
      stroke(ctx, pathOf([outline]), edge, view.line(1.6));
    });
  }

  function drawCrate(ctx, view, obstacle, now, outline, edge) {
    const width = view.line(1.4);
    if (0.5 * Math.min(...now.size) * view.scale < 3 * width) return;
    if (obstacle.shape === "box") {
      line(ctx, [outline[0], outline[2]], edge, width, 0.7);
      line(ctx, [outline[1], outline[3]], edge, width, 0.7);
      return;
    }
    const middle = [0, 1].map((k) => outline.reduce((sum, p) => sum + p[k], 0) / outline.length);
    stroke(ctx, pathOf([outline.map((p) => [0, 1].map((k) => middle[k] + 0.6 * (p[k] - middle[k])))]),
      edge, width, 0.7);
  }

  function drawChevron(ctx, view, now, edge) {
    const half = 0.25 * Math.min(...now.size) * view.scale;
    if (half < 2) return;
    const [x, y] = view.point([now.x, now.y]);
    const at = (along, aside) => [x + half * (along * Math.cos(now.a) - aside * Math.sin(now.a)),
      y - half * (along * Math.sin(now.a) + aside * Math.cos(now.a))];
    fill(ctx, pathOf([[at(1, 0), at(-0.8, 0.9), at(-0.3, 0), at(-0.8, -0.9)]]), edge, 0.7);
  }

  // Blocks that rise or sink are filled like a gauge; those that wait are dashed in orange.
  function drawMovingBlocks(ctx, view, blocks) {
    for (const {obstacle, now} of blocks) {
      if (obstacle.movable || now.state === "standing" || now.state === "retracted") continue;
      const outline = outlineOf(obstacle, now).map((p) => view.point(p));
      const path = pathOf([outline]);
      const center = view.point([now.x, now.y]);
      const size = Math.min(0.31 * Math.min(...now.size) * view.scale, view.line(11, 5));
      if (now.state === "waiting") {
        fill(ctx, path, colour("alert"), 0.1);
        ctx.setLineDash([view.line(6.5, 3.5), view.line(6.5, 3.5)]);
        stroke(ctx, path, colour("alert"), view.line(2.8, 1.4));
        ctx.setLineDash([]);
        sign(ctx, view, center, size, "alert", [[-0.42, -0.56], [0.42, -0.56], [-0.42, 0.56], [0.42, 0.56]]);
        continue;
      }
      const style = now.colour || colour("dynamic");
      const edge = now.colour ? mix(now.colour, colour("ink"), 0.4) : colour("dynamicEdge");
      const share = obstacle.height > 0 ? Math.min(Math.max(now.height / obstacle.height, 0), 1) : 1;
      shadow(ctx, path, view.unit * share, [1, 2.2, 3.6, 5], 0.075);
      fill(ctx, path, mix(colour("floor"), style, 0.3));
      ctx.save();
      ctx.clip(path);
      const xs = outline.map(([x]) => x);
      const ys = outline.map(([, y]) => y);
      const [left, top] = [Math.min(...xs), Math.min(...ys)];
      const [width, height] = [Math.max(...xs) - left, Math.max(...ys) - top];
      ctx.fillStyle = style;
      if (width >= height) ctx.fillRect(left, top, share * width, height);
      else ctx.fillRect(left, top + (1 - share) * height, width, share * height);
      ctx.restore();
      stroke(ctx, path, edge, view.line(1.6));
      const up = now.state === "rising" ? 1 : -1;
      sign(ctx, view, center, size, null, [[0, -0.62], [0.52, -0.02], [0.19, -0.02], [0.19, 0.58],
        [-0.19, 0.58], [-0.19, -0.02], [-0.52, -0.02]].map(([x, y]) => [x, y * up]), edge);
    }
  }

  // A small figure on a light disc.
  function sign(ctx, view, center, radius, name, points, style = colour(name || "ink")) {
    if (radius < 3) return;
    disc(ctx, center, radius, colour("light"));
    ring(ctx, center, radius, view.line(1.2), style);
    fill(ctx, pathOf([points.map(([x, y]) => [center[0] + radius * x, center[1] + radius * y])]), style);
  }

  function trapPath(view, trap) {
    if (trap.outline.length > 0) return pathOf([trap.outline.map((p) => view.point(p))]);
    const path = new Path2D();
    path.arc(...view.point(trap.center), trap.radius * view.scale, 0, 2 * Math.PI);
    return path;
  }

  // States of traps: 0 off, 1 on, 2 on with a robot inside.
  function drawTraps(ctx, view, run, t) {
    const states = run.trapStates.at(t) || [];
    run.traps.forEach((trap, i) => {
      const state = states[i];
      const path = trapPath(view, trap);
      if (state > 0) fill(ctx, path, colour("trap"), state === 2 ? 0.2 : 0.07);
      if (state !== 2) ctx.setLineDash([view.line(6, 3.5), view.line(6, 3.5)]);
      stroke(ctx, path, colour("trap"), view.line(state === 2 ? 2.6 : 1.7, 1), [0.35, 0.85, 1][state]);
      ctx.setLineDash([]);
    });
  }

  function drawGoals(ctx, view, run, t) {
    const newest = new Map();
    const given = run.goals.filter((goal) => goal.t <= t + 1e-9);
    given.forEach((goal) => newest.set(goal.robot, goal));
    for (const goal of given) {
      const isNewest = newest.get(goal.robot) === goal;
      const center = view.point(goal.place);
      const share = isNewest ? 1 : 0.6;
      const style = mix(run.robots[goal.robot].colour, colour("ink"), 0.3);
      const radius = share * view.line(10, 5);
      const width = share * view.line(3.2, 1.8);
      ring(ctx, center, radius, width + 2 * view.line(1.6, 0.9), colour("halo"));
      ring(ctx, center, radius, width, style);
      if (isNewest) {
        for (const [x, y] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
          line(ctx, [0.75, 1.6].map((k) => [center[0] + k * radius * x, center[1] + k * radius * y]),
            style, 0.8 * width);
        }
      }
      if (goal.reached > t + 1e-9) continue;
      disc(ctx, center, 0.52 * radius + view.line(1.4, 0.8), colour("halo"));
      disc(ctx, center, 0.52 * radius, style);
    }
  }

  function drawCollisions(ctx, view, run, t) {
    const arm = view.line(6, 3.5);
    const places = [];
    for (const collision of run.collisions) {
      if (collision.t > t + 1e-9) continue;
      const center = view.point(collision.place);
      const near = (p) => Math.hypot(p[0] - center[0], p[1] - center[1]) < 1.5 * arm;
      if (!places.some(near)) places.push(center);
    }
    const crosses = new Path2D();
    for (const [x, y] of places) {
      crosses.moveTo(x - arm, y - arm);
      crosses.lineTo(x + arm, y + arm);
      crosses.moveTo(x - arm, y + arm);
      crosses.lineTo(x + arm, y - arm);
    }
    stroke(ctx, crosses, colour("halo"), view.line(6, 3.6), 0.9);
    stroke(ctx, crosses, colour("stalled"), view.line(3, 1.8));
  }

  // Halos around obstacles, traps and robots of the last second's events.
  function drawEvents(ctx, view, run, blocks, t) {
    const colours = {extended: "dynamic", retracted: "dynamic", placed: "dynamic", waiting: "alert",
      refused: "alert", blocked: "alert", pushed: "alert", trap: "trap", enabled: "trap",
      restart: "trap"};
    for (const event of run.events) {
      const age = (t - event.t) / kShownEvent;
      if (age < 0 || age > 1 || !(event.kind in colours)) continue;
      const style = colour(colours[event.kind]);
      const width = (3 + 11 * age) * view.unit;
      const trap = run.traps.find((one) => one.name === event.what);
      const block = blocks.find(({obstacle}) => obstacle.name === event.what);
      const robot = run.robots.find((one) =>
        one.name === (event.kind === "restart" ? event.who : event.what));
      if (trap) stroke(ctx, trapPath(view, trap), style, width, 0.6 * (1 - age));
      else if (block) {
        stroke(ctx, pathOf([outlineOf(block.obstacle, block.now).map((p) => view.point(p))]), style,
          width, 0.6 * (1 - age));
      } else if (robot) {
        const X = robot.at(t);
        ring(ctx, view.point([X.x, X.y]), markedRadius(view, robot) + (4 + 12 * age) * view.unit,
          view.line(3, 1.5), style, 0.8 * (1 - age));
      }
    }
  }

  // A text with a light rim.
  function label(ctx, view, text, [x, y], size, style, align = "center") {
    ctx.font = "600 " + Math.max(size * view.unit, 11) + "px system-ui, sans-serif";
    ctx.textAlign = align;
    ctx.textBaseline = "middle";
    ctx.lineJoin = "round";
    ctx.lineWidth = Math.max(4.8 * view.unit, 3);
    ctx.strokeStyle = colour("halo");
    ctx.strokeText(text, x, y);
    ctx.fillStyle = style;
    ctx.fillText(text, x, y);
  }

  // Names, scores, what robots say, and the arena controller's texts.
  function drawTexts(ctx, view, run, t, options) {
    for (const text of run.texts) {
      if (text.t > t + 1e-9 || text.gone <= t) continue;
      label(ctx, view, text.text, view.point(text.place), 18, text.colour);
    }
    const scores = run.scores.at(t) || [];
    run.robots.forEach((robot, i) => {
      const X = robot.at(t);
      const center = view.point([X.x, X.y]);
      const away = markedRadius(view, robot) + (options.selected === i ? 26 : 12) * view.unit;
      const style = mix(robot.colour, colour("ink"), luma(robot.colour) > 0.5 ? 0.8 : 0.55);
      const above = center[1] - away > 14 * view.unit;
      let words = options.names ? robot.name : "";
      if (scores[i]) words += " " + scores[i] / 1000;
      if (words !== "") {
        label(ctx, view, words, [center[0], center[1] + (above ? -away : away)], 16, style);
      }
      const said = run.spoken.filter((one) => one.robot === i && one.t <= t + 1e-9).pop();
      if (said && said.text !== "" && t - said.t < 5) {
        drawBubble(ctx, view, said.text, center, away, robot.colour);
      }
    });
  }

  // The next timers, in the upper right corner.
  function drawCountdowns(ctx, view, run, t) {
    run.countdownsAt(t).sort((a, b) => a.left - b.left).slice(0, kMostCountdowns).forEach((timer, i) => {
      label(ctx, view, timer.name + " " + timer.left.toFixed(1) + " s", [view.width - 12, 18 + 20 * i], 15,
        colour("trap"), "right");
    });
  }

  function drawBubble(ctx, view, text, center, away, style) {
    const words = text.length > 60 ? text.slice(0, 59) + "…" : text;
    ctx.font = Math.max(15 * view.unit, 11) + "px system-ui, sans-serif";
    const width = ctx.measureText(words).width + 16 * view.unit;
    const height = 28 * view.unit;
    const left = Math.min(Math.max(center[0] + away, 4), Math.max(view.width - width - 4, 4));
    const top = center[1] - away - height;
    const box = pathOf([[[left, top], [left + width, top], [left + width, top + height],
      [left, top + height]]]);
    stroke(ctx, box, mix(style, colour("ink"), 0.3), 2 * view.line(1.5, 1));
    fill(ctx, box, colour("light"));
    ctx.fillStyle = colour("ink");
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    ctx.fillText(words, left + 8 * view.unit, top + height / 2);
  }

  return {drawTracks, drawMovers, drawMovingBlocks, drawTraps, drawGoals, drawCollisions, drawEvents,
    drawTexts, drawCountdowns};
})();
