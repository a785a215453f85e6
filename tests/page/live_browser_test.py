#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Opens the live page of a server in Chromium, watches, commands and steers.

usage: live_browser_test.py PLAYPEN WORLD [--keep FOLDER]

The world has robots and dynamic blocks. Needs chromium and chromedriver. Checks: who may watch, who
may command, and that a page of another origin gets nothing; keys, the joystick, a click on a block,
a placed robot, a pause; that every part of the run is drawn while all robots drive, in less than
LIMIT_MS of processor time each; and that the page can be scrubbed after the end of the run. The
frames per second are printed only, because they depend on the machine's load.
"""

import argparse
import contextlib
import functools
import http.server
import pathlib
import secrets
import sys
import tempfile
import threading

from browser import Browser, missing_program
from page_of import PageOf

# Of the main thread's processor time per picture, with all else that the page does: 25 a second.
LIMIT_MS = 40
PARTS = 150  # of the run, for which the pictures are counted: about 5 s
ARROW_UP, HOME = "\ue013", "\ue011"

# What the test uses in the page. A robot is named by its index.
SCRIPTS = """
    const run = () => Page.state.runs[0];
    window.test = {
      pose: (robot) => {
        const {x, y, a} = run().robots[robot].at(run().end);
        return {x, y, a};
      },
      poses: () => run().robots.map((robot, i) => test.pose(i)),
      // Where a place of the world is in the window [px].
      pixel: ({x, y}) => {
        const {canvas, view} = Page.state.stages[0];
        const box = canvas.getBoundingClientRect();
        return [box.left + view.px(x), box.top + view.py(y)].map(Math.round);
      },
      block: (name) => run().obstacles.find((obstacle) => obstacle.name === name).at(run().end),
      isHidden: (id) => document.getElementById(id).getClientRects().length === 0,
      text: (id) => document.getElementById(id).textContent,
    };"""

# Counts parts and pictures. A picture is behind if it does not show the newest part. A part is
# missed if a whole animation frame passes without its picture.
COUNT = """
    const counts = window.counts = {parts: 0, together: 0, drawn: 0, behind: 0, missed: 0, ms: 0,
      begin: performance.now()};
    let pending = 0; // animation frames since the oldest part that is not drawn, from 1
    const {on} = Page.state.link;
    const {part} = on;
    on.part = (file) => {
      part(file);
      ++counts.parts;
      if (pending > 0) ++counts.together;
      else pending = 1;
    };
    const [stage] = Page.state.stages;
    const {draw} = stage;
    stage.draw = (t, options) => {
      const begin = performance.now();
      draw.call(stage, t, options);
      // Reading a pixel waits until the canvas is drawn.
      stage.canvas.getContext("2d").getImageData(0, 0, 1, 1);
      counts.ms += performance.now() - begin;
      ++counts.drawn;
      if (t !== Page.state.runs[0].end) ++counts.behind;
      pending = 0;
    };
    const frame = () => {
      if (pending > 0 && ++pending > 3) {
        ++counts.missed;
        pending = 0;
      }
      if (counts.parts < arguments[0]) return requestAnimationFrame(frame);
      counts.seconds = (performance.now() - counts.begin) / 1000;
      on.part = part;
      delete stage.draw;
    };
    requestAnimationFrame(frame);"""

# Steers all robots at once, as 13 people would. Each drives in a small circle, so that none stops at
# an obstacle.
STEER_ALL = """
    window.steering = setInterval(() => Page.state.runs[0].robots.forEach((none, robot) =>
      Page.state.link.send({steer: {robot, ahead: 0.2, left: robot % 2 ? 1 : -1}})), 300);"""

# Of another origin. It even knows the token.
STRANGER = """<!doctype html><title>stranger</title><link rel="icon" href="data:,"><script>
    window.heard = [];
    const socket = new WebSocket("ws://127.0.0.1:PORT/live");
    socket.onopen = () => { heard.push("open"); socket.send(JSON.stringify({token: "TOKEN"})); };
    socket.onmessage = ({data}) => heard.push(data);
    socket.onclose = () => { window.hasEnded = true; };
    </script>"""


def open_live(browser, address):
    browser.open(address)
    browser.run(SCRIPTS)


def check_no_messages(browser):
    messages = browser.messages()
    assert not messages, f"errors on the console: {messages}"


def distance(one, other):
    return ((one["x"] - other["x"])**2 + (one["y"] - other["y"])**2)**0.5


@contextlib.contextmanager
def http_page(text, folder):
    """The address of a web server of its own with this page."""
    (folder / "stranger").mkdir()
    (folder / "stranger" / "index.html").write_text(text)

    class Handler(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *arguments):
            pass

    handler = functools.partial(Handler, directory=folder / "stranger")
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/"
        finally:
            server.shutdown()
            thread.join()


def check_stranger(browser, server, folder):
    text = STRANGER.replace("PORT", str(server.port)).replace("TOKEN", server.token)
    with http_page(text, folder) as address:
        browser.go(address)
        browser.wait("return window.hasEnded === true")
        assert browser.run("return heard") == []
        messages = browser.messages()
        assert len(messages) == 1 and "/live" in messages[0] and "403" in messages[0], messages


def check_watcher(browser, server):
    browser.go(server.address + "#token=" + secrets.token_hex(16))
    browser.wait("return document.getElementById('status').textContent === 'the token is wrong'")
    assert not browser.run("return document.body.classList.contains('ready')")
    open_live(browser, server.address)
    browser.wait("return test.text('link') === 'live · watching'")
    assert browser.run("return test.isHidden('live-bar') && test.isHidden('pad')")
    before = browser.run("return test.poses()")
    browser.run("""Page.state.link.socket.send(JSON.stringify(
        {place: {robot: 12, x: test.pose(12).x, y: test.pose(12).y, a: 1}}));""")
    browser.wait("return test.text('live') === 'commands need the token of the link that playpen printed'")
    # Not even later.
    end = browser.run("return Page.state.runs[0].end")
    browser.wait("return Page.state.runs[0].end > arguments[0] + 0.5", end)
    assert browser.run("return test.poses()") == before
    check_no_messages(browser)


def check_driving(browser, robot):
    """Arrow up drives the robot that a click has selected, and the joystick drives it back."""
    assert browser.run("return test.isHidden('pad')"), "which robot would it drive?"
    browser.click(*browser.run("return test.pixel(test.pose(arguments[0]))", robot))
    assert browser.run("return Page.state.options.selected") == robot
    browser.wait("return !test.isHidden('pad')")
    ahead_m = """
        const [robot, from] = arguments;
        const now = test.pose(robot);
        const ahead = (now.x - from.x) * Math.cos(from.a) + (now.y - from.y) * Math.sin(from.a);"""
    stands = """const {live, runs: [run]} = Page.state;
        return live.steered.length === 0 && run.robots[arguments[0]].at(run.end).v === 0;"""
    begin = browser.run("return test.pose(arguments[0])", robot)
    browser.hold(ARROW_UP)
    browser.wait("return Page.state.live.steered.includes(arguments[0])", robot)
    browser.wait(ahead_m + "return ahead > 0.4;", robot, begin)
    browser.release()
    browser.wait(stands, robot)
    there = browser.run("return test.pose(arguments[0])", robot)
    browser.press(*browser.place_in("pad", 0.5, 0.95))
    browser.wait(ahead_m + "return ahead < -0.1;", robot, there)
    browser.release()
    browser.wait(stands, robot)


def check_block(browser):
    """A click on the retracted block that is farthest from robots raises it."""
    name, place = browser.run("""
        const away = ({x, y}) => Math.min(...test.poses().map((X) => Math.hypot(X.x - x, X.y - y)));
        const blocks = Page.state.live.can.blocks.map((name) => [name, test.block(name)])
          .filter(([name, now]) => now.state === "retracted" && away(now) > 0.3)
          .sort(([, a], [, b]) => away(b) - away(a));
        return [blocks[0][0], test.pixel(blocks[0][1])];""")
    browser.click(*place)
    browser.wait("return test.block(arguments[0]).state === 'standing'", name)
    browser.click(*place)
    browser.wait("return test.block(arguments[0]).state === 'retracted'", name)
    browser.click(*place)
    browser.wait("return test.block(arguments[0]).state === 'standing'", name)


def check_placing(browser, robot, begin):
    """Places the robot in the free corridor in which it has been driven: far from where it is now."""
    now = browser.run("return test.pose(arguments[0])", robot)
    target = max(begin, {"x": begin["x"] - 1.0, "y": begin["y"]}, key=lambda place: distance(now, place))
    browser.click(*browser.place_in("place"))
    browser.click(*browser.run("return test.pixel(arguments[0])", target))
    # A pixel is about 6 mm.
    browser.wait("""const [robot, {x, y}] = arguments;
        return Math.hypot(test.pose(robot).x - x, test.pose(robot).y - y) < 0.01;""", robot, target)


def check_pause(browser, robot):
    browser.click(*browser.place_in("pause"))
    browser.wait("return Page.state.live.paused && test.text('link') === 'paused · commanding'")
    end = browser.run("return Page.state.runs[0].end")
    browser.keys(ARROW_UP)
    browser.wait("return test.text('live').startsWith('paused: the robot moves when')")
    assert browser.run("return Page.state.runs[0].end") == end
    browser.click(*browser.place_in("pause"))
    browser.wait("return !Page.state.live.paused && Page.state.runs[0].end > arguments[0]", end)


def check_pictures(browser):
    before = browser.run("return test.poses()")
    assert len(before) == 13 and browser.run("return Page.state.options.scans")
    browser.run(STEER_ALL)
    browser.wait("return Page.state.live.steered.length === 13")
    browser.run(COUNT, PARTS)
    work_s = browser.work_s()
    browser.wait("return window.counts.seconds !== undefined")
    counts = browser.run("return window.counts")
    work_ms = 1000 * (browser.work_s() - work_s) / counts["drawn"]
    browser.wait("""const before = arguments[0];
        return test.poses().every((X, i) => Math.hypot(X.x - before[i].x, X.y - before[i].y) +
          Math.abs(X.a - before[i].a) > 0.1);""", before)
    browser.run("clearInterval(window.steering)")
    print(f"13 robots drive: {counts['drawn'] / counts['seconds']:.1f} frames/s, "
          f"{counts['ms'] / counts['drawn']:.1f} ms each, {work_ms:.1f} ms of the processor; "
          f"{counts['parts']} parts, {counts['together']} of them drawn with the one before")
    assert counts["behind"] == 0 and counts["missed"] == 0, counts
    assert counts["drawn"] >= counts["parts"] - counts["together"] - 1, counts  # the last is under way
    assert work_ms < LIMIT_MS, f"a picture takes {work_ms:.1f} ms of the processor"
    browser.wait("return Page.state.live.steered.length === 0")


def check_end(browser, server):
    assert server.end() == 0
    browser.wait("return test.text('link') === 'the run is over'")
    assert browser.run("return test.isHidden('live-bar') && test.isHidden('pad') && test.isHidden('to-live')")
    browser.keys(HOME)
    assert browser.run("return Page.state.clock.t === Page.state.clock.begin")
    browser.run("""const scrubber = document.getElementById("scrubber");
        scrubber.value = "2";
        scrubber.dispatchEvent(new Event("input"));""")
    assert browser.run("return Page.state.clock.t") == 2
    browser.wait("return test.text('time') === '2.00 s'")
    browser.keys(" ")
    browser.wait("return Page.state.clock.playing && Page.state.clock.t > 2.1")


def look_at(playpen, world, folder):
    robot = 12  # stands in the open
    server = PageOf([playpen, "serve", world, "--tcp-port", "0"], folder)
    try:
        browser = Browser(1400, 900)
        try:
            check_stranger(browser, server, folder)
            check_watcher(browser, server)
            open_live(browser, server.link)
            assert server.token not in browser.run("return location.href")
            browser.wait("return test.text('link') === 'live · commanding'")
            begin = browser.run("return test.pose(arguments[0])", robot)
            check_driving(browser, robot)
            check_block(browser)
            check_placing(browser, robot, begin)
            check_pause(browser, robot)
            check_pictures(browser)
            browser.screenshot(folder / "live.png")
            check_end(browser, server)
            browser.screenshot(folder / "over.png")
            check_no_messages(browser)
        finally:
            browser.close()
    finally:
        server.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("playpen")
    parser.add_argument("world")
    parser.add_argument("--keep", type=pathlib.Path, help="write the pictures here")
    arguments = parser.parse_args()
    if missing_program() is not None:
        print(f"skipped: there is no {missing_program()}")
        return 77
    with tempfile.TemporaryDirectory() as temporary:
        look_at(arguments.playpen, arguments.world, arguments.keep or pathlib.Path(temporary))
    print("passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
