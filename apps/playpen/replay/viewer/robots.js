// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Draws robots, their trails and what their range sensors measured, as
// libsim/src/render/robot_painter.cpp does.
"use strict";

const Robots = (function () {
  const {colour, mix, luma, withAlpha, pathOf, fill, stroke, shadow, place} = Scene;
  const kMostFans = 20; // with more, fans are short
  const kShades = 24; // of a trail
  const kTolerance = 0.25; // of a trail [px]
  const kArm = "#c6cdd8";

  function disc(ctx, [x, y], radius, style, opacity = 1) {
    const path = new Path2D();
    path.arc(x, y, Math.max(radius, 0), 0, 2 * Math.PI);
    fill(ctx, path, style, opacity);
  }
  function ring(ctx, [x, y], radius, width, style, opacity = 1) {
    const path = new Path2D();
    path.arc(x, y, Math.max(radius, 0), 0, 2 * Math.PI);
    stroke(ctx, path, style, width, opacity);
  }
  function line(ctx, points, style, width, opacity = 1) {
    const path = new Path2D();
    points.forEach(([x, y], i) => (i === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
    stroke(ctx, path, style, width, opacity);
  }

  function markedRadius(view, robot) {
    return Math.max(robot.radius * view.scale, 8 * view.unit);
  }

  // The scans of all robots at t: the newest one of each robot's first laser, and all cones.
  function scansAt(run, t) {
    const scans = run.robots.map(() => ({fan: null, cones: []}));
    for (const device of run.devices) {
      if (device.beams === null) continue;
      const measured = device.measuredAt(t);
      if (measured === null) continue;
      const own = scans[device.robot];
      if (measured.cones) own.cones.push(...measured.cones);
      else if (own.fan === null && measured.ends.length > 0) own.fan = measured;
    }
    return scans;
  }

  // A gradient whose opacity falls with the square of the distance.
  function fading(ctx, [x, y], radius, style, center, rim) {
    const gradient = ctx.createRadialGradient(x, y, 0, x, y, radius);
    for (const at of [0, 0.25, 0.5, 0.75, 1]) {
      gradient.addColorStop(at, withAlpha(style, center + (rim - center) * at * at));
    }
    return gradient;
  }

  // The fans of scans in pixels: {robot, origin, ends}, and the share that each has of the ink.
  function fansOf(view, run, scans) {
    const fans = [];
    scans.forEach(({fan}, i) => {
      if (fan === null) return;
      fans.push({robot: run.robots[i], origin: view.point(fan.origin),
        ends: fan.ends.map((p) => view.point(p))});
    });
    return {fans, strength: 1 / Math.pow(Math.max(fans.length, 1), 0.7)};
  }

  function drawFans(ctx, view, run, scans) {
    const {fans, strength} = fansOf(view, run, scans);
    for (const {robot, origin, ends} of fans) {
      const length = (p) => Math.hypot(p[0] - origin[0], p[1] - origin[1]);
      if (fans.length > kMostFans) {
        const reach = Math.max(5 * robot.radius * view.scale, 2 * markedRadius(view, robot));
        const near = ends.map((p) => {
          const share = Math.min(1, reach / Math.max(length(p), 1e-9));
          return [0, 1].map((k) => origin[k] + share * (p[k] - origin[k]));
        });
        fill(ctx, pathOf([[origin, ...near]]), fading(ctx, origin, reach, robot.colour, 0.42, 0));
        continue;
      }
      const reach = Math.max(1, ...ends.map(length));
      fill(ctx, pathOf([[origin, ...ends]]),
        fading(ctx, origin, reach, robot.colour, 0.34 * strength, 0.13 * strength));
      line(ctx, [ends[0], origin, ends[ends.length - 1]], robot.colour, view.line(0.9, 0.7),
        0.6 * strength);
    }
  }

  function drawCones(ctx, view, run, scans) {
    const count = scans.filter((scan) => scan.cones.length > 0).length;
    const strength = 1 / Math.sqrt(Math.max(count, 1));
    scans.forEach((scan, i) => {
      const robot = run.robots[i];
      const share = strength * (scan.fan === null ? 1 : 0.55);
      const ink = mix(robot.colour, colour("ink"), 0.2);
      for (const cone of scan.cones) {
        const apex = view.point([cone.x, cone.y]);
        const opacity = share * (cone.cone > 0 ? 1 : 2.2) * (cone.met ? 0.16 : 0.07);
        const echo = Math.min(1, 0.75 * share + 0.1);
        const radius = cone.range * view.scale;
        if (cone.cone > 0) {
          const arc = new Path2D();
          arc.arc(apex[0], apex[1], radius, -cone.a - cone.cone / 2, -cone.a + cone.cone / 2);
          const area = new Path2D(arc);
          area.lineTo(...apex);
          area.closePath();
          fill(ctx, area, robot.colour, opacity);
          if (cone.met) stroke(ctx, arc, ink, view.line(1.6, 0.9), echo);
        } else {
          const end = [apex[0] + radius * Math.cos(cone.a), apex[1] - radius * Math.sin(cone.a)];
          line(ctx, [apex, end], robot.colour, view.line(1.2, 0.8), opacity);
          if (cone.met) disc(ctx, end, view.line(2.6, 1.4), ink, echo);
        }
      }
    });
  }

  // The rims of fans where they meet surfaces.
  function drawSurfaces(ctx, view, run, scans) {
    const {fans, strength} = fansOf(view, run, scans);
    if (fans.length > kMostFans) return;
    for (const {robot, origin, ends: hits} of fans) {
      const from = hits.map((p) => [p[0] - origin[0], p[1] - origin[1]]);
      const lengths = from.map(([x, y]) => Math.hypot(x, y));
      const farthest = Math.max(...lengths);
      const path = new Path2D();
      for (let k = 1; k < hits.length; ++k) {
        const [a, b] = [from[k - 1], from[k]];
        const least = Math.min(lengths[k - 1], lengths[k]);
        const missed = least >= farthest * (1 - 1e-6);
        const along = least * Math.atan2(Math.abs(a[0] * b[1] - a[1] * b[0]), a[0] * b[0] + a[1] * b[1]);
        const step = Math.hypot(b[0] - a[0], b[1] - a[1]);
        if (missed || step > 8 * along + 1.5 * view.unit) continue;
        path.moveTo(...hits[k - 1]);
        path.lineTo(...hits[k]);
      }
      stroke(ctx, path, robot.colour, view.line(1.8, 1), 0.35 + 0.5 * strength);
    }
  }

  // A path without the points that lie less than kTolerance beside a straight line from the one that
  // was kept last (K. Reumann and A. Witkam, "Optimizing curve segmentation in computer graphics",
  // 1974). Strokes of many short lines take long.
  function simplified(places) {
    const kept = [places[0]];
    let [dx, dy] = [0, 0]; // of the line; 0: not known yet
    for (let i = 1; i < places.length; ++i) {
      const [x, y] = kept[kept.length - 1];
      const [ax, ay] = places[i];
      const backward = (ax - places[i - 1][0]) * dx + (ay - places[i - 1][1]) * dy < 0;
      if (backward || Math.abs((ax - x) * dy - (ay - y) * dx) > kTolerance) {
        kept.push(places[i - 1]);
        [dx, dy] = [0, 0];
      }
      if (dx === 0 && dy === 0) {
        const from = kept[kept.length - 1];
        const away = Math.hypot(ax - from[0], ay - from[1]);
        if (away > kTolerance) [dx, dy] = [(ax - from[0]) / away, (ay - from[1]) / away];
      }
    }
    kept.push(places[places.length - 1]);
    return kept;
  }

  // The path of a robot until t, fading with age; of the last `length` seconds only.
  function drawTrail(ctx, view, robot, t, length, opacity = 1) {
    const last = robot.frames.before(t);
    if (last < 0) return;
    const first = Math.max(robot.frames.before(t - length), 0);
    const places = [];
    for (let i = first; i <= last; ++i) places.push([view.px(robot.x.at(i)), view.py(robot.y.at(i))]);
    const now = robot.at(t);
    places.push([view.px(now.x), view.py(now.y)]);
    const points = simplified(places);
    let total = 0;
    for (let i = 1; i < points.length; ++i) {
      total += Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
    }
    const style = mix(robot.colour, colour("ink"), 0.12);
    let done = 0;
    let at = 0;
    ctx.strokeStyle = style;
    ctx.lineWidth = view.line(2.4, 1.2);
    ctx.lineJoin = "round";
    ctx.lineCap = "butt";
    for (let shade = 0; shade < kShades && at + 1 < points.length; ++shade) {
      ctx.beginPath();
      ctx.moveTo(...points[at]);
      while (at + 1 < points.length && (done < total * (shade + 1) / kShades || shade + 1 === kShades)) {
        done += Math.hypot(points[at + 1][0] - points[at][0], points[at + 1][1] - points[at][1]);
        ctx.lineTo(...points[++at]);
      }
      ctx.globalAlpha = opacity * (0.8 - 0.6 * (1 - (shade + 1) / kShades));
      ctx.stroke();
    }
    ctx.globalAlpha = 1;
  }

  function drawRobot(ctx, view, robot, t, marks) {
    const X = robot.at(t);
    if (!view.shows(X.x, X.y, robot.radius + 0.5)) return;
    const onBody = ([x, y]) => view.point(place(X, x, y));
    const center = view.point([X.x, X.y]);
    const dark = mix(robot.colour, colour("wheel"), 0.65);
    const radius = robot.radius * view.scale;
    const marked = markedRadius(view, robot);
    const small = radius < marked;
    if (small) drawMarker(ctx, view, center, X.a, marked, robot.colour);
    if (X.stalled) {
      ring(ctx, center, marked + 6 * view.unit, view.line(6), colour("halo"));
      ring(ctx, center, marked + 6 * view.unit, view.line(3.2), colour("stalled"));
    }
    if (marks.selected) drawSelection(ctx, view, center, marked + 13 * view.unit);
    const parts = robot.parts.map((part) => part.map(onBody));
    const area = pathOf(parts);
    shadow(ctx, area, view.unit, [1, 2.2, 3.4], 0.09);
    if (parts.length > 1) stroke(ctx, area, dark, 2 * view.line(1.5));
    fill(ctx, area, robot.colour);
    if (!small) {
      drawBody(ctx, view, robot, onBody, marks.hasLaser, dark);
      if (parts.length === 1) stroke(ctx, area, dark, view.line(1.5));
    } else if (parts.length === 1) {
      stroke(ctx, area, dark, view.line(1));
    }
    drawLook(ctx, view, robot, robot.lookAt(t), onBody, small);
  }

  function drawMarker(ctx, view, center, a, radius, style) {
    const rim = mix(style, colour("wheel"), 0.3);
    disc(ctx, center, radius, style, 0.35);
    line(ctx, [center, [center[0] + 1.7 * radius * Math.cos(a), center[1] - 1.7 * radius * Math.sin(a)]],
      rim, view.line(2, 1));
    ring(ctx, center, radius, view.line(1.4), rim);
  }

  function drawSelection(ctx, view, [x, y], reach) {
    const arm = 0.45 * reach;
    for (const [width, style] of [[6.5, "halo"], [3.4, "ink"]]) {
      for (const [sx, sy] of [[1, 1], [1, -1], [-1, -1], [-1, 1]]) {
        const corner = [x + reach * sx, y + reach * sy];
        line(ctx, [[corner[0] - arm * sx, corner[1]], corner, [corner[0], corner[1] - arm * sy]],
          colour(style), view.line(width));
      }
    }
  }

  // Wheels, nose, laser and superstructures.
  function drawBody(ctx, view, robot, onBody, hasLaser, dark) {
    const xs = robot.core.map(([x]) => x);
    const ys = robot.core.map(([, y]) => y);
    const [front, back] = [Math.max(...xs), -Math.min(...xs)];
    const [left, right] = [Math.max(...ys), -Math.min(...ys)];
    const at = (x, y) => onBody([x * (x >= 0 ? front : back), y * (y >= 0 ? left : right)]);
    const wheel = colour("wheel");
    fill(ctx, pathOf([-1, 1].map((side) => [at(-0.42, 0.98 * side), at(0.42, 0.98 * side),
      at(0.42, 0.74 * side), at(-0.42, 0.74 * side)])), wheel);
    const radius = robot.radius * view.scale;
    line(ctx, [at(0.5, 0.46), at(0.82, 0), at(0.5, -0.46)],
      luma(robot.colour) > 0.78 ? wheel : colour("light"), Math.max(0.1 * radius, view.line(1.2)));
    if (hasLaser) disc(ctx, at(0.4, 0), 0.12 * radius, wheel);
    for (const part of robot.superstructures) {
      const path = pathOf([part.map(onBody)]);
      fill(ctx, path, mix(robot.colour, colour("light"), 0.25), 0.8);
      stroke(ctx, path, dark, view.line(0.8));
    }
  }

  // Bumpers, paddles, lights and arms.
  function drawLook(ctx, view, robot, look, onBody, small) {
    const dark = mix(robot.colour, colour("wheel"), 0.65);
    if (!small) {
      fill(ctx, pathOf(look.paddles.map((paddle) => paddle.map(onBody))), colour("wheel"));
      robot.bumpers.forEach((bumper, i) => {
        const points = bumper.map(onBody);
        if (!look.pressed[i]) return line(ctx, points, dark, view.line(2.2));
        line(ctx, points, colour("halo"), view.line(6.5));
        return line(ctx, points, colour("stalled"), view.line(4));
      });
    }
    const size = Math.max(0.13 * robot.radius * view.scale, view.line(2.6, 1.6));
    robot.lights.forEach((light, i) => {
      const center = onBody(light.place);
      const lit = look.lit[i] !== undefined && look.lit[i] !== -1;
      const style = lit ? Runs.colourOf(look.lit[i]) : light.colour.slice(0, 7);
      if (lit) disc(ctx, center, 7 * size, fading(ctx, center, 7 * size, style, 0.85, 0));
      disc(ctx, center, size + view.line(1, 0.6), colour("wheel"));
      disc(ctx, center, size, lit ? style : mix(style, colour("wheel"), 0.7));
      if (lit) disc(ctx, center, 0.5 * size, colour("light"), 0.85);
    });
    if (small) return;
    const link = Math.max(0.03 * view.scale, view.line(2));
    for (const arm of look.arms) {
      const points = arm.map(onBody);
      if (points.length === 0) continue;
      line(ctx, points, colour("wheel"), link + 2 * view.line(1.2));
      line(ctx, points, kArm, link);
      points.forEach((joint) => disc(ctx, joint, 0.4 * link, colour("wheel")));
      disc(ctx, points[points.length - 1], 0.4 * link, colour("stalled"));
    }
  }

  // Marks a robot that a person steers: four arrows on a disc beside it.
  function drawSteered(ctx, view, robot, t) {
    const X = robot.at(t);
    const [x, y] = view.point([X.x, X.y]);
    const size = Math.max(11 * view.unit, 8);
    const center = [x + markedRadius(view, robot) + 20 * view.unit + size, y];
    disc(ctx, center, size, colour("light"));
    ring(ctx, center, size, view.line(1.6), mix(robot.colour, colour("ink"), 0.3));
    const arrows = [[1, 0], [0, 1], [-1, 0], [0, -1]].map(([c, s]) => [[0.78, 0], [0.32, 0.36], [0.32, -0.36]]
      .map(([u, v]) => [center[0] + size * (u * c - v * s), center[1] + size * (u * s + v * c)]));
    fill(ctx, pathOf(arrows), colour("ink"));
  }

  // The robot at another pose or of another run, half transparent, as SceneSnapshot::ghosts.
  function drawGhost(ctx, view, robot, X) {
    const onBody = ([x, y]) => view.point(place(X, x, y));
    const dark = mix(robot.colour, colour("wheel"), 0.5);
    const area = pathOf(robot.parts.map((part) => part.map(onBody)));
    const front = Math.max(...[].concat(...robot.parts).map(([x]) => x));
    fill(ctx, area, robot.colour, 0.3);
    stroke(ctx, area, dark, view.line(1.5), 0.7);
    line(ctx, [onBody([0, 0]), onBody([front, 0])], dark, view.line(2), 0.7);
  }

  return {disc, ring, line, markedRadius, scansAt, drawFans, drawCones, drawSurfaces, simplified,
    drawTrail, drawRobot, drawSteered, drawGhost};
})();
