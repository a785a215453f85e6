// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// How a person says where a robot shall drive: a round pad for pointers, and the arrow keys.
// Directions: ahead and left, shares of the top speeds in [-1, 1].
"use strict";

const Joystick = (function () {
  const kIdle = 0.12; // around the middle, as a share of the radius
  const kGentle = 0.6; // of the top speeds, with keys; with Shift all

  // The direction of a place on the pad. @param dx, dy  from the middle, in radii; y down.
  function directionOf(dx, dy) {
    const away = Math.hypot(dx, dy);
    if (away < kIdle) return {ahead: 0, left: 0};
    const share = (Math.min(away, 1) - kIdle) / (1 - kIdle) / away;
    const round = (number) => Math.round(number * 100) / 100 || 0;
    return {ahead: round(-dy * share), left: round(-dx * share)};
  }

  class Pad {
    // @param node  the pad; its first child is the knob.
    // @param drive  (ahead, left), called after each change; may refuse with false.
    constructor(node, drive) {
      this.node = node;
      this.knob = node.firstElementChild;
      this.pointer = null;
      const move = (event) => {
        const box = node.getBoundingClientRect();
        const radius = box.width / 2;
        const [dx, dy] = [(event.clientX - box.left) / radius - 1, (event.clientY - box.top) / radius - 1];
        const {ahead, left} = directionOf(dx, dy);
        if (drive(ahead, left) === false) return this.show(0, 0);
        const share = 1 / Math.max(Math.hypot(dx, dy), 1);
        return this.show(dx * share, dy * share);
      };
      const end = (event) => {
        if (event.pointerId !== this.pointer) return;
        this.pointer = null;
        this.show(0, 0);
        drive(0, 0);
      };
      node.addEventListener("pointerdown", (event) => {
        if (this.pointer !== null) return;
        this.pointer = event.pointerId;
        node.setPointerCapture(event.pointerId);
        event.preventDefault();
        move(event);
      });
      node.addEventListener("pointermove", (event) => {
        if (event.pointerId === this.pointer) move(event);
      });
      for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) {
        node.addEventListener(name, end);
      }
    }

    // Lets go without a pointer's doing.
    release() {
      this.pointer = null;
      this.show(0, 0);
    }

    // @param x, y  of the knob, in radii from the middle.
    show(x, y) {
      this.knob.style.transform = "translate(" + x * 75 + "%," + y * 75 + "%)";
    }
  }

  // The arrow keys that are held.
  class Keys {
    constructor() {
      this.held = new Set();
      this.fast = false;
    }

    // Each returns whether it is about an arrow key.
    down(key, fast) {
      if (!/^Arrow/.test(key)) return false;
      this.held.add(key);
      this.fast = fast;
      return true;
    }
    up(key) {
      return this.held.delete(key);
    }

    direction() {
      const on = (key) => (this.held.has("Arrow" + key) ? 1 : 0);
      const share = this.fast ? 1 : kGentle;
      return {ahead: share * (on("Up") - on("Down")), left: share * (on("Left") - on("Right"))};
    }
  }

  return {directionOf, Pad, Keys};
})();
