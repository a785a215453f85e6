// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The part of the world that a picture shows. Pictures: pixels of CSS, x right, y down; the world:
// m, x right, y up.
"use strict";

const Views = (function () {
  class View {
    constructor() {
      this.width = 1;
      this.height = 1;
      this.x = 0; // of the picture's middle in the world
      this.y = 0;
      this.scale = 100; // pixels per m
      this.fitScale = 100; // of the last fit()
      this.unit = 1; // line widths are multiples of it, as Layout::unit_px
    }

    resize(width, height) {
      this.width = width;
      this.height = height;
      this.unit = Math.min(Math.max(Math.max(width, height) / 1000, 0.65), 1.6);
    }

    // Shows a whole rectangle of the world, with `margin` pixels around it.
    fit(origin, size, margin) {
      const room = (length) => Math.max(length - 2 * margin, 20);
      this.scale = Math.min(room(this.width) / size[0], room(this.height) / size[1]);
      this.fitScale = this.scale;
      this.x = origin[0] + size[0] / 2;
      this.y = origin[1] + size[1] / 2;
    }

    px(x) {
      return this.width / 2 + (x - this.x) * this.scale;
    }

    py(y) {
      return this.height / 2 - (y - this.y) * this.scale;
    }

    point(p) {
      return [this.px(p[0]), this.py(p[1])];
    }

    // The place in the world under a pixel.
    world(px, py) {
      return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
    }

    pan(dx, dy) {
      this.x -= dx / this.scale;
      this.y += dy / this.scale;
    }

    // Zooms by a factor; the place under the pixel stays there.
    zoom(px, py, factor) {
      const [x, y] = this.world(px, py);
      this.scale = Math.min(Math.max(this.scale * factor, this.fitScale / 8), this.fitScale * 100);
      this.x = x - (px - this.width / 2) / this.scale;
      this.y = y + (py - this.height / 2) / this.scale;
    }

    // A line width: thousandths of the picture, but at least `least` pixels.
    line(thousandths, least = 0.8) {
      return Math.max(thousandths * this.unit, least);
    }

    // Whether a circle around a place of the world reaches into the picture.
    shows(x, y, radius) {
      const r = radius * this.scale;
      const px = this.px(x);
      const py = this.py(y);
      return px > -r && py > -r && px < this.width + r && py < this.height + r;
    }

    key() {
      return [this.width, this.height, this.x, this.y, this.scale].join();
    }
  }

  return {View};
})();
