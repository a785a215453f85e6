// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The time that the page shows, and its playback.
"use strict";

const Clocks = (function () {
  const kSpeeds = [0.25, 0.5, 1, 2, 4, 8, 16];

  class Clock {
    // @param changed  called after each change of the time or of the playback.
    constructor(frames, end, changed) {
      this.frames = frames;
      this.end = end;
      this.changed = changed;
      this.t = 0;
      this.speed = 1;
      this.playing = false;
      this.last = null; // when the last picture was shown, by the browser's clock [ms]
    }

    seek(t) {
      this.t = Math.min(Math.max(t, 0), this.end);
      this.changed();
    }

    // By whole frames, forward or back.
    step(frames) {
      this.playing = false;
      const now = this.frames.before(this.t);
      const between = this.t - this.frames.at(Math.max(now, 0)) > 1e-6;
      const to = now + frames + (frames < 0 && between ? 1 : 0);
      this.seek(this.frames.at(Math.min(Math.max(to, 0), this.frames.length - 1)));
    }

    play(on) {
      if (on && this.t >= this.end) this.t = 0;
      this.playing = on;
      this.last = null;
      this.changed();
    }

    // Advances a playback to the browser's time `now` [ms].
    tick(now) {
      if (!this.playing) return;
      // After a pause of the page itself, go on from where it was.
      if (this.last !== null) this.t += Math.min(now - this.last, 250) / 1000 * this.speed;
      this.last = now;
      if (this.t >= this.end) {
        this.t = this.end;
        this.playing = false;
      }
      this.changed();
    }
  }

  // What a fragment like "#t=31.4&robot=r1" says.
  function ofFragment(text) {
    const said = {t: null, robot: null};
    for (const part of text.replace(/^#/, "").split("&")) {
      const [key, value] = part.split("=");
      if (value === undefined) continue;
      if (key === "t" && Number.isFinite(parseFloat(value))) said.t = parseFloat(value);
      if (key === "robot") {
        try {
          said.robot = decodeURIComponent(value);
        } catch (error) {
          said.robot = null; // a stray percent sign
        }
      }
    }
    return said;
  }

  return {kSpeeds, Clock, ofFragment};
})();
