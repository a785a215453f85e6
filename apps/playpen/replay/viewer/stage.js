// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A picture of a run, or of two runs over each other, on a canvas that can be moved and zoomed.
"use strict";

const Stages = (function () {
  // An off-screen picture that is drawn again only when its key changes.
  class Cache {
    constructor() {
      this.canvas = document.createElement("canvas");
      this.key = "";
    }

    // @param draw  called with a context in pixels of CSS if the picture is out of date.
    get(key, view, ratio, draw) {
      if (this.key !== key) {
        this.key = key;
        this.canvas.width = Math.round(view.width * ratio);
        this.canvas.height = Math.round(view.height * ratio);
        const ctx = this.canvas.getContext("2d");
        ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
        draw(ctx);
      }
      return this.canvas;
    }
  }

  // The picture of a layer, a pixel per cell.
  class LayerPicture {
    constructor(tape) {
      this.tape = tape;
      this.canvas = document.createElement("canvas");
      this.canvas.width = tape.width;
      this.canvas.height = tape.height;
      this.ctx = this.canvas.getContext("2d");
      this.image = new ImageData(new Uint8ClampedArray(tape.cells.buffer), tape.width, tape.height);
      this.isNew = true; // and shows nothing yet
    }

    seek(t) {
      let rows = this.tape.seek(t);
      if (this.isNew) rows = [0, this.tape.height];
      this.isNew = false;
      if (rows === null) return;
      this.ctx.putImageData(this.image, 0, 0, 0, rows[0], this.tape.width, rows[1] - rows[0]);
    }
  }

  class Stage {
    // @param runs  the first one with its arena; further ones are drawn as ghosts.
    constructor(canvas, runs) {
      this.canvas = canvas;
      this.view = new Views.View();
      this.show(runs);
    }

    // The view stays as it is.
    show(runs) {
      this.runs = runs;
      this.ground = new Cache();
      this.solids = new Cache();
      this.layers = [];
      this.hasLaser = runs[0].robots.map((robot, i) => runs[0].devices.some((device) =>
        device.robot === i && device.beams !== null && device.beams.step > 0));
    }

    // Adapts to the size of the element. Returns whether it has changed.
    resize() {
      const box = this.canvas.getBoundingClientRect();
      const ratio = window.devicePixelRatio || 1;
      const width = Math.max(Math.round(box.width * ratio), 1);
      const height = Math.max(Math.round(box.height * ratio), 1);
      if (this.canvas.width === width && this.canvas.height === height) return false;
      const fitted = this.view.width === 1 || this.view.scale === this.view.fitScale;
      this.canvas.width = width;
      this.canvas.height = height;
      this.view.resize(box.width, box.height);
      if (fitted) this.fit();
      return true;
    }

    fit() {
      const arena = this.runs[0].arena;
      const margin = Math.min(38 * this.view.unit, 0.04 * this.view.width + 6);
      this.view.fit(arena.origin, arena.size, margin);
    }

    // @param options  trail [s], scans, names, selected, hidden (names of layers), paper; frame:
    //     whether to draw what lies beside the arena, the scale and the countdowns; steered (indices
    //     of robots), placing ({robot, pose}, or null).
    draw(t, options) {
      const ratio = this.canvas.width / Math.max(this.view.width, 1);
      this.drawOn(this.canvas.getContext("2d"), ratio, t, options);
    }

    // The picture at t with a given size and view, as a data URL of a PNG.
    picture(width, height, place, t, options) {
      const canvas = document.createElement("canvas");
      canvas.width = width;
      canvas.height = height;
      const shown = this.view;
      this.view = new Views.View();
      this.view.resize(width, height);
      Object.assign(this.view, place);
      this.drawOn(canvas.getContext("2d"), 1, t, options);
      this.view = shown;
      return canvas.toDataURL("image/png");
    }

    drawOn(ctx, ratio, t, options) {
      const [run, ...others] = this.runs;
      const view = this.view;
      const blocks = run.obstacles.map((obstacle) => ({obstacle, now: obstacle.at(t)}));
      const fixed = blocks.filter(({obstacle}) => !obstacle.movable);
      const key = view.key() + ratio + options.paper + fixed.map(({now}) =>
        [now.state, now.x, now.y, now.a, now.size, now.colour].join()).join(";");
      ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
      const blit = (canvas) => ctx.drawImage(canvas, 0, 0, view.width, view.height);
      blit(this.ground.get(key, view, ratio, (to) => {
        to.fillStyle = options.paper || Scene.colour("paper");
        to.fillRect(0, 0, view.width, view.height);
        Scene.drawFloor(to, view, run.arena);
        Scene.drawDocks(to, view, run.arena);
      }));
      this.drawLayers(ctx, t, options.hidden);
      Scene.drawRetracted(ctx, view, blocks);
      const scans = Robots.scansAt(run, t);
      this.onFloor(ctx, () => {
        if (options.scans) {
          Robots.drawCones(ctx, view, run, scans);
          Robots.drawFans(ctx, view, run, scans);
        }
        if (options.trail > 0) {
          Marks.drawTracks(ctx, view, run, blocks);
          for (const other of others) {
            other.robots.forEach((one) => Robots.drawTrail(ctx, view, one, t, options.trail, 0.6));
          }
          run.robots.forEach((one) => Robots.drawTrail(ctx, view, one, t, options.trail,
            1 - 0.9 * this.colouredShare(one, t, options)));
        }
        Marks.drawTraps(ctx, view, run, t);
      });
      blit(this.solids.get(key, view, ratio, (to) => Scene.drawSolids(to, view, run, fixed)));
      Marks.drawMovingBlocks(ctx, view, blocks);
      Marks.drawMovers(ctx, view, blocks);
      if (options.scans) Robots.drawSurfaces(ctx, view, run, scans);
      for (const other of others) {
        other.robots.forEach((one) => Robots.drawGhost(ctx, view, one, one.at(t)));
      }
      run.robots.forEach((robot, i) => Robots.drawRobot(ctx, view, robot, t,
        {selected: options.selected === i, hasLaser: this.hasLaser[i]}));
      options.steered.forEach((i) => Robots.drawSteered(ctx, view, run.robots[i], t));
      if (options.placing !== null && options.placing.pose !== null) {
        Robots.drawGhost(ctx, view, run.robots[options.placing.robot], options.placing.pose);
      }
      Marks.drawGoals(ctx, view, run, t);
      Marks.drawCollisions(ctx, view, run, t);
      Marks.drawEvents(ctx, view, run, blocks, t);
      Marks.drawTexts(ctx, view, run, t, options);
      if (!options.frame) return;
      Marks.drawCountdowns(ctx, view, run, t);
      this.drawScale(ctx);
    }

    // Without borders, scans and trails may extend beyond the floor.
    onFloor(ctx, draw) {
      const box = Scene.floorBox(this.view, this.runs[0].arena);
      ctx.save();
      ctx.beginPath();
      ctx.rect(box.left, box.top, box.width, box.height);
      ctx.clip();
      draw();
      ctx.restore();
    }

    // @param hidden  names of layers.
    drawLayers(ctx, t, hidden) {
      const {canvas, layers} = this.runs[0];
      while (this.layers.length < layers.length) {
        this.layers.push(new LayerPicture(layers[this.layers.length]));
      }
      const view = this.view;
      const cell = canvas.cell * view.scale;
      const [left, bottom] = view.point(canvas.origin);
      ctx.imageSmoothingEnabled = cell * (window.devicePixelRatio || 1) < 1;
      const order = this.layers.map((picture, i) => i).sort((a, b) =>
        this.layers[a].tape.priority - this.layers[b].tape.priority || a - b);
      this.onFloor(ctx, () => {
        for (const i of order) {
          const {tape, canvas: picture} = this.layers[i];
          if (hidden.has(tape.name)) continue;
          this.layers[i].seek(t);
          const height = tape.height * cell;
          ctx.drawImage(picture, left, bottom - height, tape.width * cell, height);
        }
      });
    }

    // The share of a robot's trail that lies on coloured cells, so probably on its own drawing.
    // White, grey and black are a map.
    colouredShare(robot, t, options) {
      const {canvas} = this.runs[0];
      const last = robot.frames.before(t);
      const first = Math.max(robot.frames.before(t - options.trail), 0);
      const step = Math.max(Math.floor((last - first) / 200), 1);
      const shown = this.layers.filter((layer) => !options.hidden.has(layer.tape.name));
      let points = 0;
      let coloured = 0;
      for (let i = first; i <= last; i += step, ++points) {
        const column = Math.floor((robot.x.at(i) - canvas.origin[0]) / canvas.cell);
        const up = Math.floor((robot.y.at(i) - canvas.origin[1]) / canvas.cell);
        coloured += shown.some(({tape: {width, height}, image: {data}}) => {
          if (column < 0 || up < 0 || column >= width || up >= height) return false;
          const at = 4 * ((height - 1 - up) * width + column);
          const rgb = data.subarray(at, at + 3);
          return data[at + 3] >= 128 && Math.max(...rgb) - Math.min(...rgb) >= 60;
        }) ? 1 : 0;
      }
      return points > 0 ? coloured / points : 0;
    }

    // A bar of round length in the lower left corner.
    drawScale(ctx) {
      const view = this.view;
      const length = Scene.roundBelow(130 / view.scale);
      const [x, y] = [14, view.height - 14];
      ctx.fillStyle = "rgba(255,255,255,0.8)";
      ctx.fillRect(x - 8, y - 24, length * view.scale + 16, 33);
      const points = [[x, y - 5], [x, y], [x + length * view.scale, y], [x + length * view.scale, y - 5]];
      Robots.line(ctx, points, Scene.colour("ink"), 1.5);
      ctx.font = "12px system-ui, sans-serif";
      ctx.textAlign = "left";
      ctx.textBaseline = "alphabetic";
      ctx.fillStyle = Scene.colour("ink");
      ctx.fillText(Plots.shortNumber(length) + " m", x, y - 9);
    }

    // Index of the robot under a pixel; -1: none.
    robotAt(px, py, t) {
      let best = -1;
      let least = Infinity;
      this.runs[0].robots.forEach((robot, i) => {
        const X = robot.at(t);
        const away = Math.hypot(this.view.px(X.x) - px, this.view.py(X.y) - py);
        if (away < Math.max(Robots.markedRadius(this.view, robot), 18) && away < least) {
          best = i;
          least = away;
        }
      });
      return best;
    }

    // Lets pointers move and zoom the picture. @param on  {changed(), picked(robot, place)}; tool(view)
    //     may return {hover, down, move, up}, which get the place in the world instead; cursor(place)
    //     gives the pointer's look.
    listen(on, time) {
      const canvas = this.canvas;
      const pointers = new Map();
      let moved = 0;
      let tool = null; // of the present gesture
      const place = (event) => this.view.world(...at(event));
      const at = (event) => {
        const box = canvas.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
      };
      canvas.addEventListener("pointerdown", (event) => {
        pointers.set(event.pointerId, at(event));
        canvas.setPointerCapture(event.pointerId);
        tool = pointers.size === 1 ? on.tool(this.view) : null;
        if (tool !== null) tool.down(place(event));
        if (pointers.size === 1) moved = 0;
      });
      canvas.addEventListener("pointermove", (event) => {
        if (pointers.size === 0) {
          const hovering = on.tool(this.view);
          if (hovering !== null) hovering.hover(place(event));
          canvas.style.cursor = on.cursor(place(event));
        }
        if (!pointers.has(event.pointerId)) return;
        if (tool !== null) {
          tool.move(place(event));
          return;
        }
        const before = [...pointers.values()];
        const old = pointers.get(event.pointerId);
        const now = at(event);
        pointers.set(event.pointerId, now);
        moved += Math.hypot(now[0] - old[0], now[1] - old[1]);
        if (pointers.size === 2) {
          const after = [...pointers.values()];
          const spread = ([a, b]) => Math.max(Math.hypot(a[0] - b[0], a[1] - b[1]), 1);
          const middle = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
          const [from, to] = [middle(before), middle(after)];
          this.view.pan(to[0] - from[0], to[1] - from[1]);
          this.view.zoom(to[0], to[1], spread(after) / spread(before));
        } else if (moved > 4) {
          this.view.pan(now[0] - old[0], now[1] - old[1]);
        }
        on.changed();
      });
      const end = (event) => {
        if (!pointers.delete(event.pointerId) || event.type !== "pointerup") return;
        if (tool !== null) tool.up();
        else if (moved <= 4) on.picked(this.robotAt(...at(event), time()), place(event));
        tool = null;
      };
      canvas.addEventListener("pointerup", end);
      canvas.addEventListener("pointercancel", end);
      canvas.addEventListener("wheel", (event) => {
        event.preventDefault();
        const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : 1);
        this.view.zoom(...at(event), Math.exp(-pixels * 0.0015));
        on.changed();
      }, {passive: false});
    }
  }

  return {Stage};
})();
