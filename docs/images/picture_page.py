#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Takes the picture of the live page. make_pictures.sh runs it.

usage: picture_page.py PLAYPEN WORLD OUTPUT_FOLDER PICTURE.png PROGRAM [--size WxH] [--phone] [--dark]

PROGRAM drives 13 robots in WORLD. In the picture, the last robot is selected and steered by hand, and
a block is raised.
"""

import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "page"))
from browser import Browser, missing_program  # noqa: E402
from page_of import PageOf  # noqa: E402


def take(browser, link, picture):
    browser.open(link)
    browser.choose("robot", "12")
    browser.run("Page.state.link.send({block: {name: 'd7', up: true}});")
    browser.wait("return Page.state.runs[0].end > 6.6")
    browser.press(*browser.place_in("pad", 0.47, 0.22))
    browser.wait("return Page.state.runs[0].end > 7.7")
    browser.screenshot(picture)
    browser.release()
    messages = browser.messages()
    assert not messages, messages


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("playpen")
    parser.add_argument("world")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("picture", type=pathlib.Path)
    parser.add_argument("program")
    parser.add_argument("--size", default="1200x760")
    parser.add_argument("--phone", action="store_true")
    parser.add_argument("--dark", action="store_true")
    arguments = parser.parse_args()
    if missing_program() is not None:
        sys.exit(f"{sys.argv[0]}: {missing_program()} is missing (packages chromium, chromium-driver)")
    arguments.folder.mkdir(parents=True, exist_ok=True)
    page = PageOf([arguments.playpen, "run", arguments.world, "--seed", "1"], arguments.folder,
                  [arguments.program])
    try:
        browser = Browser(1400, 900)
        try:
            width, height = map(int, arguments.size.split("x"))
            browser.look_like(width, height, phone=arguments.phone, dark=arguments.dark)
            take(browser, page.link, arguments.picture)
        finally:
            browser.close()
        page.end()
    finally:
        page.close()


if __name__ == "__main__":
    main()
