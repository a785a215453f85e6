// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The connection of a live page, and steering commands, which must be repeated.
"use strict";

const Live = (function () {
  const kWaits = [1, 2, 4, 8, 15]; // before connecting again [s]
  const kRepeat = 200; // between steering commands [ms]
  const kLeastApart = 40; // of steering commands that differ [ms]
  const kKey = "playpen-token";

  // The token of a link "…#token=…", which goes from the address to the tab's storage, so that it
  // survives a reload. Null if there is none. @param view  the window.
  function takeToken(view) {
    const {location, history} = view;
    const parts = location.hash.replace(/^#/, "").split("&");
    const said = parts.find((part) => part.startsWith("token="));
    try {
      if (said === undefined) return view.sessionStorage.getItem(kKey);
      view.sessionStorage.setItem(kKey, said.slice(6));
    } catch (error) {
      // Without storage, the token stays in the address.
      return said === undefined ? null : said.slice(6);
    }
    const others = parts.filter((part) => part !== said).join("&");
    history.replaceState(null, "", location.pathname + location.search + (others ? "#" + others : ""));
    return said.slice(6);
  }

  // After a refusal: a reload may watch without a token.
  function forgetToken(view) {
    try {
      view.sessionStorage.removeItem(kKey);
    } catch (error) {
      return; // it was never stored
    }
  }

  // What the simulation does, in words. @param live  see `state.live` of the page.
  function doing(live) {
    if (live.paused) return "paused";
    if (live.waiting_for === 0) return "live";
    return "waiting for " + (live.waiting_for === 1 ? "a program" : live.waiting_for + " programs");
  }

  class Link {
    // @param connect  () => a new WebSocket
    // @param token  () => the token or null
    // @param on  {whole(file), part(file), rights({command}), answer(text), state(name, text)};
    //     names of states: "connecting", "live", "lost", "refused", "over"
    // @param timers  {setTimeout}
    constructor(connect, token, on, timers) {
      Object.assign(this, {connect, token, on, timers});
      this.tries = 0;
      this.open();
    }

    open() {
      const socket = this.connect();
      socket.binaryType = "arraybuffer";
      this.socket = socket;
      this.rights = null; // until the other side answers
      this.ready = false; // has a whole run
      this.end = null; // why the connection must not be tried again
      socket.onopen = () => {
        const token = this.token();
        socket.send(JSON.stringify(token === null ? {} : {token}));
      };
      socket.onmessage = ({data}) => {
        if (socket !== this.socket) return;
        if (typeof data === "string") this.read(JSON.parse(data));
        else this.grow(new Columns.File(new Uint8Array(data)));
      };
      socket.onclose = () => {
        if (socket === this.socket) this.closed();
      };
    }

    // Begins anew, e.g. with another token.
    reopen() {
      const old = this.socket;
      this.tries = 0;
      this.open();
      old.close();
    }

    read(message) {
      if (message.over) {
        this.end = ["over", "the run is over"];
      } else if (message.refused !== undefined && this.rights === null) {
        this.end = ["refused", message.refused];
      } else if (message.refused !== undefined) {
        this.on.answer(message.refused);
      } else if (message.rights) {
        this.rights = message.rights;
        this.on.rights(this.rights);
      }
      if (this.end !== null) this.on.state(...this.end);
    }

    grow(file) {
      if (!file.head.part) {
        this.ready = true;
        this.tries = 0;
        this.on.whole(file);
        this.on.state("live", "");
      } else if (this.ready) {
        this.on.part(file);
      }
    }

    closed() {
      this.rights = null;
      if (this.end !== null) return;
      const wait = kWaits[Math.min(this.tries++, kWaits.length - 1)];
      this.on.state("lost", this.tries > 1 ? "no connection, trying again every " + wait + " s"
        : "connection lost, trying again");
      const {socket} = this;
      this.timers.setTimeout(() => {
        if (socket === this.socket) this.open();
      }, wait * 1000);
    }

    // @param command  an object.
    send(command) {
      if (this.rights !== null && this.rights.command) this.socket.send(JSON.stringify(command));
    }
  }

  // Steers one robot: repeats the command while it is held.
  class Steering {
    // @param send  (command); @param timers  {setInterval, clearInterval, now()}
    constructor(send, timers) {
      this.send = send;
      this.timers = timers;
      this.held = null; // {robot, ahead, left}
      this.sent = -Infinity; // when [ms]
      this.timer = null;
    }

    // @param ahead, left  shares of the top speeds, -1..1; both 0: releases the robot.
    drive(robot, ahead, left) {
      const {held} = this;
      if (held !== null && (held.robot !== robot || (ahead === 0 && left === 0))) this.release();
      if (ahead === 0 && left === 0) return;
      if (this.held !== null && held.ahead === ahead && held.left === left) return;
      this.held = {robot, ahead, left};
      if (this.timer === null) this.timer = this.timers.setInterval(() => this.repeat(), kRepeat);
      // What comes too soon waits for the next change, or for the timer.
      if (this.timers.now() - this.sent >= kLeastApart) this.repeat();
    }

    repeat() {
      this.sent = this.timers.now();
      this.send({steer: this.held});
    }

    release() {
      if (this.held === null) return;
      const {robot} = this.held;
      this.timers.clearInterval(this.timer);
      this.timer = null;
      this.held = null;
      this.sent = -Infinity;
      this.send({steer: {robot, ahead: 0, left: 0}});
    }
  }

  return {takeToken, forgetToken, doing, Link, Steering};
})();
