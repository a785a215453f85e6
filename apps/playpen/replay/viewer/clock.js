// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The time that the page shows, and its playback. Of a live run it follows the end.
"use strict";

const Clocks = (function () {
  const kSpeeds = [0.25, 0.5, 1, 2, 4, 8, 16];

  class Clock {
    // @param changed  called after each change of the time or of the playback.
    constructor(frames, end, changed) {
      this.frames = frames;
      this.begin = 0;
      this.end = end;
      this.live = false; // the end moves on
      this.following = false; // and the time with it
      this.changed = changed;
      this.t = 0;
      this.speed = 1;
      this.playing = false;
      this.last = null; // when the last picture was shown, by the browser's clock [ms]
    }

    seek(t) {
      this.t = Math.min(Math.max(t, this.begin), this.end);
      const followed = this.following;
      this.following = this.live && this.t >= this.end;
      if (this.following !== followed) this.playing = this.following;
      this.changed();
    }

    // Shows a live run that lasts from `begin` to `end` by now.
    grow(begin, end) {
      this.begin = begin;
      this.end = end;
      if (this.following || this.t > end || this.t < begin) this.seek(this.following ? end : this.t);
    }

    // @param live  false: the run is over, so that it can be played like a replay.
    setLive(live) {
      this.live = live;
      this.follow(live);
    }

    follow(on) {
      this.following = on;
      this.playing = on;
      if (on) this.t = this.end;
      this.changed();
    }

    // By whole frames, forward or back.
    step(frames) {
      this.following = false;
      this.playing = false;
      const now = this.frames.before(this.t);
      const between = this.t - this.frames.at(Math.max(now, 0)) > 1e-6;
      const to = now + frames + (frames < 0 && between ? 1 : 0);
      this.seek(this.frames.at(Math.min(Math.max(to, 0), this.frames.length - 1)));
    }

    play(on) {
      if (on && this.t >= this.end) {
        if (this.live) return this.follow(true);
        this.t = this.begin;
      }
      this.following = false;
      this.playing = on;
      this.last = null;
      return this.changed();
    }

    // Advances a playback to the browser's time `now` [ms].
    tick(now) {
      if (!this.playing || this.following) return;
      // After a pause of the page itself, go on from where it was.
      if (this.last !== null) this.t += Math.min(now - this.last, 250) / 1000 * this.speed;
      this.last = now;
      if (this.t >= this.end) {
        this.t = this.end;
        this.playing = this.live;
        this.following = this.live;
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
