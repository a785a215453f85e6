// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Small plots of numbers over time.
"use strict";

const Plots = (function () {
  // At most four significant digits.
  function shortNumber(value) {
    if (!Number.isFinite(value)) return "–";
    if (value !== 0 && (Math.abs(value) >= 1e5 || Math.abs(value) < 1e-4)) return value.toExponential(2);
    return String(Number(value.toPrecision(Math.abs(value) >= 1000 ? 6 : 4)));
  }

  // The least and the greatest number in each of `columns` stretches of time, in order:
  // [column, least, greatest].
  function extent(times, numbers, [begin, end], columns) {
    const parts = [];
    const length = Math.max(end - begin, 1e-9);
    let last = -1;
    for (let i = Math.max(times.before(begin), 0); i < times.length && times.at(i) <= end + 1e-6; ++i) {
      const value = numbers.at(i);
      if (!Number.isFinite(value)) continue;
      const column = Math.min(Math.max(Math.floor((times.at(i) - begin) / length * columns), 0), columns - 1);
      if (column === last) {
        const part = parts[parts.length - 1];
        part[1] = Math.min(part[1], value);
        part[2] = Math.max(part[2], value);
      } else {
        parts.push([column, value, value]);
        last = column;
      }
    }
    return parts;
  }

  // A plot whose curve is drawn again only if it has grown or the span has changed. The cursor moves.
  class Plot {
    // @param curve  {times, numbers()}
    // @param spanAt  (t) => [begin, end], what is shown at t [s].
    constructor(canvas, curve, spanAt) {
      this.canvas = canvas;
      this.curve = curve;
      this.spanAt = spanAt;
      this.cache = null;
    }

    draw(t) {
      const box = this.canvas.getBoundingClientRect();
      if (box.width === 0) return;
      const ratio = window.devicePixelRatio || 1;
      const [width, height] = [Math.round(box.width * ratio), Math.round(box.height * ratio)];
      const style = getComputedStyle(this.canvas);
      const span = this.spanAt(t);
      const key = [width, height, style.color, span, this.curve.times.length].join();
      if (this.cache === null || this.cache.key !== key) this.drawCurve(key, width, height, style, span);
      if (this.canvas.width !== width || this.canvas.height !== height) {
        this.canvas.width = width;
        this.canvas.height = height;
      }
      const ctx = this.canvas.getContext("2d");
      ctx.clearRect(0, 0, width, height);
      ctx.drawImage(this.cache.canvas, 0, 0);
      ctx.fillStyle = style.color;
      ctx.globalAlpha = 0.55;
      const share = (t - span[0]) / Math.max(span[1] - span[0], 1e-9);
      ctx.fillRect(Math.round(Math.min(share, 1) * (width - ratio)), 0, ratio, height);
      ctx.globalAlpha = 1;
    }

    drawCurve(key, width, height, style, span) {
      const canvas = this.cache === null ? document.createElement("canvas") : this.cache.canvas;
      canvas.width = width;
      canvas.height = height;
      this.cache = {key, canvas};
      const ctx = canvas.getContext("2d");
      const parts = extent(this.curve.times, this.curve.numbers(), span, width);
      if (parts.length === 0) return;
      let low = Math.min(...parts.map((part) => part[1]));
      let high = Math.max(...parts.map((part) => part[2]));
      if (high - low < 1e-12) [low, high] = [low - 1, high + 1];
      const ratio = window.devicePixelRatio || 1;
      const y = (value) => height - 3 * ratio - (value - low) / (high - low) * (height - 6 * ratio);
      ctx.strokeStyle = style.borderTopColor;
      ctx.lineWidth = ratio;
      if (low < 0 && high > 0) {
        ctx.beginPath();
        ctx.moveTo(0, y(0));
        ctx.lineTo(width, y(0));
        ctx.stroke();
      }
      ctx.strokeStyle = style.color;
      ctx.lineWidth = 1.3 * ratio;
      ctx.lineJoin = "round";
      ctx.beginPath();
      parts.forEach(([x, least, greatest], i) => {
        if (i === 0) ctx.moveTo(x, y(least));
        else ctx.lineTo(x, y(least));
        if (greatest > least) ctx.lineTo(x, y(greatest));
      });
      ctx.stroke();
    }
  }

  return {shortNumber, extent, Plot};
})();
