// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What a person with the right to command does on a live page: the bar of the simulation, driving,
// placing robots, raising and lowering blocks.
"use strict";

const Commands = (function () {
  const kFactors = [0.25, 0.5, 1, 2, 4, 8, 16];
  const kSettle = 1500; // after a choice, until what the simulation does is shown again [ms]
  const kTurned = 14; // a drag that is longer sets the heading [px]
  const byId = (id) => document.getElementById(id);

  // The dynamic block that a click at a place of the world means; null: none.
  // @param names  of the blocks that may be commanded.
  function blockAt(run, names, [x, y], t) {
    const inside = (points) => points.filter(([ax, ay], i) => {
      const [bx, by] = points[(i + 1) % points.length];
      return (ay > y) !== (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax);
    }).length % 2 === 1;
    for (const obstacle of run.obstacles) {
      if (!names.includes(obstacle.name)) continue;
      const now = obstacle.at(t);
      if (!inside(Scene.outlineOf(obstacle, now))) continue;
      return {name: obstacle.name, up: now.state === "retracted" || now.state === "sinking"};
    }
    return null;
  }

  class Desk {
    // @param page  {state, changed(), say(text)}; @param send  (command)
    constructor(page, send) {
      Object.assign(this, page, {send});
      this.command = false; // may command
      this.connected = false;
      this.chosenAt = -Infinity;
      this.placing = null; // {robot, x, y, a, from, down}
      this.keys = new Joystick.Keys();
      this.steering = new Live.Steering(send, {setInterval: (f, ms) => setInterval(f, ms),
        clearInterval: (timer) => clearInterval(timer), now: () => performance.now()});
      this.pad = new Joystick.Pad(byId("pad"), (ahead, left) => this.drive(ahead, left));
      this.listen();
    }

    listen() {
      byId("pause").addEventListener("click", () => this.pause());
      byId("place").addEventListener("click", () => this.startPlacing());
      const factor = byId("factor");
      for (const one of kFactors) factor.appendChild(new Option(one + "×", String(one)));
      factor.appendChild(new Option("full", "full")).disabled = true;
      factor.addEventListener("change", () => {
        this.chosenAt = performance.now();
        this.send({speed: Number(factor.value)});
      });
      window.addEventListener("blur", () => this.release());
      document.addEventListener("visibilitychange", () => this.release());
      document.addEventListener("keyup", (event) => {
        if (this.keys.up(event.key)) this.driveByKeys();
      });
      // What a pointer has chosen shall not keep the focus, and so the keys.
      let byPointer = false;
      document.addEventListener("pointerdown", () => { byPointer = true; }, true);
      document.addEventListener("keydown", () => { byPointer = false; }, true);
      for (const [name, kind] of [["click", "button"], ["change", "select, input"]]) {
        document.addEventListener(name, ({target}) => {
          if (byPointer && this.command && target.closest(kind)) document.activeElement.blur();
        });
      }
    }

    setRights({command}) {
      this.command = command;
      this.show();
    }

    setConnected(connected) {
      if (this.connected === connected) return;
      this.connected = connected;
      if (!connected) {
        this.release();
        if (this.placing !== null) this.stopPlacing();
      }
      this.show();
    }

    // Whether commands make sense: they are about what is now.
    isOn() {
      return this.command && this.connected && this.state.clock !== null && this.state.clock.following;
    }

    // The robot that is driven and placed: the selected one, or the only one; -1: none.
    robot() {
      if (this.state.options.selected >= 0) return this.state.options.selected;
      return this.state.runs[0].robots.length === 1 ? 0 : -1;
    }

    // The bar and the pad, for the simulation's present state.
    show() {
      const {live} = this.state;
      byId("live-bar").hidden = !this.command;
      byId("pad").hidden = !this.isOn() || this.placing !== null || this.robot() < 0;
      byId("live-bar").classList.toggle("with-pad", !byId("pad").hidden);
      Panels.setText(byId("hint"), "Click a robot in the picture" +
        (this.command ? " to drive it and to see its readings." : "."));
      if (live === null || !this.command) return;
      const pause = byId("pause");
      for (const name of ["pause", "factor"]) byId(name).disabled = !this.connected;
      Panels.setText(pause, live.paused ? "► Continue" : "❚❚ Pause");
      byId("factor-box").hidden = !live.can.speed;
      if (performance.now() - this.chosenAt > kSettle) {
        this.showFactor(live.factor);
      }
      const place = byId("place");
      place.disabled = live.can.place !== true || !this.connected;
      place.title = live.can.place === true ? "Click in the picture; drag for the heading"
        : String(live.can.place);
      Panels.setText(place, this.placing === null ? "Place robot" : "Cancel placing");
    }

    // @param now  null: as fast as possible.
    showFactor(now) {
      const factor = byId("factor");
      const value = now === null ? "full" : String(now);
      if (factor.value === value) return;
      factor.value = value;
      if (factor.value === value) return;
      factor.appendChild(new Option(now + "×", value));
      factor.value = value;
    }

    pause() {
      this.send({pause: !this.state.live.paused});
    }

    needsRobot(what) {
      this.say("Select the robot to " + what + ": click it.");
      return false;
    }

    drive(ahead, left) {
      const robot = this.robot();
      if (!this.isOn()) return false;
      if (robot < 0) return this.needsRobot("drive");
      this.steering.drive(robot, ahead, left);
      return true;
    }

    driveByKeys() {
      const {ahead, left} = this.keys.direction();
      this.drive(ahead, left);
    }

    release() {
      this.keys.held.clear();
      this.pad.release();
      this.steering.release();
    }

    // Returns whether a key is used up.
    key(event) {
      if (event.key === "Escape" && this.placing !== null) {
        this.stopPlacing();
        return true;
      }
      if (!this.isOn()) return false;
      if (this.keys.down(event.key, event.shiftKey)) {
        this.driveByKeys();
        return true;
      }
      if (event.key !== " " || event.target.matches("button, summary, input")) return false;
      if (!event.repeat) this.pause();
      return true;
    }

    // The command to the block at a place of the world; null: there is none now.
    blockAt(place) {
      const {runs, clock, live} = this.state;
      if (!this.isOn() || this.placing !== null) return null;
      return blockAt(runs[0], live.can.blocks, place, clock.t);
    }

    // A click beside robots. Returns whether it was for a block.
    clicked(place) {
      const block = this.blockAt(place);
      if (block !== null) this.send({block});
      return block !== null;
    }

    startPlacing() {
      if (this.placing !== null) return this.stopPlacing();
      const robot = this.robot();
      if (robot < 0) return this.needsRobot("place");
      this.state.clock.follow(true);
      this.release();
      this.placing = {robot, pose: null, down: false};
      this.say("Click where " + this.state.runs[0].robots[robot].name +
        " shall stand; drag for its heading. Escape cancels.");
      return this.showPlacing();
    }
    stopPlacing() {
      this.placing = null;
      this.say("");
      this.showPlacing();
    }
    showPlacing() {
      this.state.options.placing = this.placing;
      document.body.classList.toggle("placing", this.placing !== null);
      this.show();
      this.changed();
    }

    // What pointers do in the picture instead of moving it; null: nothing. See Stage.listen().
    tool(view) {
      if (this.placing === null) return null;
      const {placing} = this;
      const robot = this.state.runs[0].robots[placing.robot];
      const put = ([x, y]) => {
        placing.pose = {x, y, a: robot.at(this.state.clock.t).a};
        this.changed();
      };
      return {
        hover: put,
        down: put,
        move: ([x, y]) => {
          const {pose} = placing;
          if (pose === null || Math.hypot(x - pose.x, y - pose.y) * view.scale < kTurned) return;
          pose.a = Math.atan2(y - pose.y, x - pose.x);
          this.changed();
        },
        up: () => {
          const {x, y, a} = placing.pose;
          this.send({place: {robot: placing.robot, x, y, a: Math.atan2(Math.sin(a), Math.cos(a))}});
          this.stopPlacing();
        },
      };
    }
  }

  return {blockAt, Desk};
})();
