#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Opens replays in Chromium, from disk and without a network, and looks at them.

usage: browser_test.py REPLAY_SAMPLE WORLD [--keep FOLDER]

REPLAY_SAMPLE is the program of replay_sample.cpp. Needs chromium and chromedriver; speaks plain
WebDriver (W3C). Checks: no error on the console; 20 moments, each drawn in less than LIMIT_MS of the
main thread's processor time on average; keys, panel, fragment and live region; two runs in one page; and that the picture of the
end differs from the renderer's by at most MEAN_DIFFERENCE and MOST_DIFFERENT.
"""

import argparse
import base64
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

from browser import Browser, missing_program

LIMIT_MS = 100  # of processor time, which a loaded machine does not make longer
# The pictures have different fonts, anti-aliasing, and opacities where shapes overlap.
# The page does not smooth the edges of cells; with 13 robots that draw, this alone makes up 1.
MEAN_DIFFERENCE = 2  # mean of the absolute differences of channels, of 255
MOST_DIFFERENT = 0.01  # share of the pixels with a channel that differs by more than 64


def pixels_of(png):
    """(width, height, rows of RGB bytes) of a PNG with 8 bits per channel."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed, width, height, channels = 8, b"", 0, 0, 0
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
            assert bits == 8 and colour in (2, 6), "RGB or RGBA"
            channels = 3 if colour == 2 else 4
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    raw = zlib.decompress(packed)
    stride = width * channels
    rows, above = [], bytes(stride)
    for y in range(height):
        kind = raw[y * (stride + 1)]
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = line[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            if kind == 1:
                line[i] = (line[i] + left) & 255
            elif kind == 2:
                line[i] = (line[i] + above[i]) & 255
            elif kind == 3:
                line[i] = (line[i] + (left + above[i]) // 2) & 255
            elif kind == 4:
                guess = left + above[i] - corner
                best = min((left, above[i], corner), key=lambda value: abs(guess - value))
                line[i] = (line[i] + best) & 255
        above = bytes(line)
        rows.append(above if channels == 3 else
                    b"".join(above[i:i + 3] for i in range(0, stride, 4)))
    return width, height, rows


def difference_of(one, other):
    """(mean difference of channels, share of pixels that differ much) of two pictures."""
    (width, height, rows), (other_width, other_height, other_rows) = pixels_of(one), pixels_of(other)
    assert (width, height) == (other_width, other_height)
    total, many = 0, 0
    for a, b in zip(rows, other_rows):
        if a == b:
            continue
        for i in range(0, len(a), 3):
            parts = [abs(a[i + k] - b[i + k]) for k in range(3)]
            total += sum(parts)
            many += max(parts) > 64
    return total / (3 * width * height), many / (width * height)


def check_no_messages(browser, page):
    messages = browser.messages()
    assert not messages, f"{page}: errors on the console: {messages}"


def check_moments(browser, end):
    work_s = browser.work_s()
    times = browser.run("""
        const times = [];
        for (let i = 0; i < 20; ++i) {
          const t = arguments[0] * ((i * 7) % 20) / 19;
          const begin = performance.now();
          Page.state.clock.seek(t);
          for (const stage of Page.state.stages) stage.draw(t, Page.state.options);
          Page.state.panel.update(t);
          // Reading a pixel waits until the canvas is drawn.
          Page.state.stages[0].canvas.getContext("2d").getImageData(0, 0, 1, 1);
          times.push(performance.now() - begin);
        }
        return times;""", end)
    times.sort()
    work_ms = 1000 * (browser.work_s() - work_s) / len(times)
    print(f"20 moments: median {times[10]:.1f} ms, most {times[-1]:.1f} ms, "
          f"{work_ms:.1f} ms of the processor on average")
    assert work_ms < LIMIT_MS, f"a moment takes {work_ms:.1f} ms of the processor"


def check_controls(browser, end):
    state = lambda what: browser.run(f"return Page.state.{what}")
    browser.keys("\ue010")  # End
    assert abs(state("clock.t") - end) < 0.06
    browser.keys("\ue011")  # Home
    assert state("clock.t") == 0
    browser.keys("\ue014")  # right
    assert 0 < state("clock.t") < 0.2, state("clock.t")
    browser.keys("n")
    assert state("clock.t") > 0.2
    scale = state("stages[0].view.scale")
    browser.keys("++")
    assert state("stages[0].view.scale") > 1.9 * scale
    browser.keys("0")
    assert abs(state("stages[0].view.scale") - scale) < 1e-6
    assert state("options.scans")
    browser.keys("s")
    assert not state("options.scans")
    browser.keys("sw")
    assert "seconds." in browser.run("return document.getElementById('live').textContent")
    browser.keys("l")
    assert browser.run("return Page.state.options.hidden.has('visited')")
    browser.keys("l")
    assert not browser.run("return Page.state.options.hidden.has('visited')")
    browser.keys("?")
    assert browser.run("return document.getElementById('help').open")
    browser.keys("\ue00c")  # Escape
    # The browser gives the focus back with the next picture.
    browser.wait("return !document.getElementById('help').open && document.activeElement === document.body")
    browser.keys(" ")
    assert state("clock.playing")
    browser.keys(" ")
    assert not state("clock.playing")


def check_picture(browser, folder):
    place = json.loads((folder / "scene.json").read_text())
    url = browser.run("""
        const place = arguments[0];
        const options = Object.assign({}, Page.state.options, {selected: -1, frame: false, paper: null});
        return Page.state.stages[0].picture(place.size, place.size,
          {x: place.x, y: place.y, scale: place.scale}, place.end, options);""", place)
    png = base64.b64decode(url.split(",", 1)[1])
    (folder / "page.png").write_bytes(png)
    mean, share = difference_of(png, (folder / "scene.png").read_bytes())
    print(f"picture of the end: mean difference {mean:.2f} of 255, {100 * share:.2f} % of the pixels differ much")
    assert mean <= MEAN_DIFFERENCE, f"mean difference {mean:.2f}"
    assert share <= MOST_DIFFERENT, f"{100 * share:.2f} % of the pixels differ by more than 64"


def check_labels(browser):
    """Every control has a name for screen readers."""
    nameless = browser.run("""
        return [...document.querySelectorAll("button, select, input, canvas:not([aria-hidden])")]
          .filter((node) => !(node.getAttribute("aria-label") || node.textContent.trim() ||
            (node.labels && node.labels.length > 0 && node.labels[0].textContent.trim())))
          .map((node) => node.outerHTML);""")
    assert not nameless, f"controls without a name: {nameless}"


def look_at(sample, world, folder):
    subprocess.run([sample, world, "20", str(folder)], check=True, stdout=subprocess.DEVNULL)
    end = json.loads((folder / "scene.json").read_text())["end"]
    address = (folder / "replay.html").resolve().as_uri()
    browser = Browser(1400, 900)
    try:
        browser.open(address + "#t=12.5")
        assert browser.run("return Page.state.clock.t") == 12.5
        check_labels(browser)
        check_moments(browser, end)
        check_controls(browser, end)
        browser.choose("robot", "0")
        browser.wait("return document.querySelectorAll('#panel tr').length > 4")
        assert "<b>of</b>" in browser.run("return document.getElementById('output').textContent")
        assert browser.run("return document.querySelectorAll('#output b').length") == 0
        browser.screenshot(folder / "wide.png")
        check_picture(browser, folder)
        check_no_messages(browser, "replay.html")
        name = browser.run("return Page.state.runs[0].robots[0].name")
        browser.open(f"{address}#t=1&robot={name}")
        assert browser.run("return Page.state.options.selected") == 0
        browser.open((folder / "two.html").resolve().as_uri() + "#t=5")
        assert browser.run("return document.querySelectorAll('#stages canvas').length") == 2
        # A click on a robot of the second picture shows that robot.
        where = browser.run("""const {canvas, view, runs} = Page.state.stages[1];
            const X = runs[0].robots[0].at(Page.state.clock.t);
            const box = canvas.getBoundingClientRect();
            return [box.left + view.px(X.x), box.top + view.py(X.y)].map(Math.round);""")
        browser.click(*where)
        assert browser.run("return document.getElementById('of-run').textContent") == "in second run"
        browser.choose("mode", "over")
        assert browser.run("return document.querySelectorAll('#stages canvas').length") == 1
        check_moments(browser, end)
        check_no_messages(browser, "two.html")
        browser.call("POST", "/window/rect", {"width": 500, "height": 844})
        assert browser.run("return document.documentElement.scrollWidth <= window.innerWidth")
    finally:
        browser.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sample")
    parser.add_argument("world")
    parser.add_argument("--keep", type=pathlib.Path, help="write the pages and pictures here")
    arguments = parser.parse_args()
    if missing_program() is not None:
        print(f"skipped: there is no {missing_program()}")
        return 77
    with tempfile.TemporaryDirectory() as temporary:
        look_at(arguments.sample, arguments.world, arguments.keep or pathlib.Path(temporary))
    print("passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
