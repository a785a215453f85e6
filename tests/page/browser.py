# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Chromium without a screen, for tests and pictures of the pages: plain WebDriver (W3C)."""

import base64
import json
import shutil
import subprocess
import time
import urllib.error
import urllib.request


def missing_program():
    """The name of a program that Browser needs and this machine lacks, or None."""
    return next((name for name in ("chromedriver", "chromium") if shutil.which(name) is None), None)


class Browser:
    """A session of chromedriver."""

    def __init__(self, width, height):
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, text=True)
        port = None
        for line in self.driver.stdout:
            if "started successfully on port" in line:
                port = int(line.rsplit(" ", 1)[1].rstrip(".\n"))
                break
        if port is None:
            raise RuntimeError("chromedriver did not start")
        self.base = f"http://127.0.0.1:{port}/session"
        arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                     f"--window-size={width},{height}", "--disable-background-networking"]
        made = self.call("POST", "", {"capabilities": {"alwaysMatch": {
            "goog:chromeOptions": {"args": arguments}, "goog:loggingPrefs": {"browser": "ALL"}}}})
        self.base += "/" + made["sessionId"]

    def call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.base + path, data=data, method=method,
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from error

    def go(self, address):
        """Loads a page, also if it is the present one with another fragment."""
        self.call("POST", "/url", {"url": "about:blank"})
        self.call("POST", "/url", {"url": address})

    def open(self, address):
        """Loads a page of the viewer, and waits until it shows a run."""
        self.go(address)
        self.wait("return document.body.classList.contains('ready') && "
                  "Page.state.stages.every((stage) => stage.view.width > 1)")  # and drawn

    def wait(self, condition, *arguments):
        """Waits until a script returns true."""
        deadline = time.monotonic() + 60
        while not self.run(condition, *arguments):
            if time.monotonic() > deadline:
                raise AssertionError(f"never true: {condition}; the page says: " +
                                     self.run("return document.body.innerText"))
            time.sleep(0.05)

    def run(self, script, *arguments):
        return self.call("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def keys(self, text):
        """Types into the page, whatever has the focus."""
        actions = [{"type": kind, "value": key} for key in text for kind in ("keyDown", "keyUp")]
        self.call("POST", "/actions", {"actions": [{"type": "key", "id": "k", "actions": actions}]})

    def hold(self, key):
        self.call("POST", "/actions", {"actions": [
            {"type": "key", "id": "k", "actions": [{"type": "keyDown", "value": key}]}]})

    def press(self, x, y):
        """Presses the pointer's button, and holds it."""
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "p", "actions": [
            {"type": "pointerMove", "x": x, "y": y}, {"type": "pointerDown", "button": 0}]}]})

    def release(self):
        """Releases all keys and buttons that are held."""
        self.call("DELETE", "/actions")

    def click(self, x, y):
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "p", "actions": [
            {"type": "pointerMove", "x": x, "y": y}, {"type": "pointerDown", "button": 0},
            {"type": "pointerUp", "button": 0}]}]})

    def place_in(self, node, right=0.5, down=0.5):
        """Where a share of the width and the height of an element is [px]."""
        return self.run("""const box = document.getElementById(arguments[0]).getBoundingClientRect();
            return [box.left + arguments[1] * box.width, box.top + arguments[2] * box.height]
              .map(Math.round);""", node, right, down)

    def choose(self, node, value):
        """Chooses an option of a select element."""
        self.run("""const node = document.getElementById(arguments[0]);
            node.value = arguments[1];
            node.dispatchEvent(new Event("change"));""", node, value)

    def devtools(self, command, **parameters):
        """A command of Chromium's DevTools protocol."""
        return self.call("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def work_s(self):
        """Processor time of the page's main thread so far, which does not count waiting [s]."""
        self.devtools("Performance.enable", timeDomain="threadTicks")  # again: no effect
        metrics = self.devtools("Performance.getMetrics")["metrics"]
        return next(one["value"] for one in metrics if one["name"] == "TaskDuration")

    def look_like(self, width, height, phone=False, dark=False):
        """Shows the page as on a screen of this size [px of CSS]."""
        self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height,
                      deviceScaleFactor=1, mobile=phone)
        self.devtools("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def messages(self):
        """Errors on the console since the last call, with what the page's policy refused."""
        return [entry["message"] for entry in self.call("POST", "/se/log", {"type": "browser"})
                if entry["level"] == "SEVERE"]

    def screenshot(self, path):
        path.write_bytes(base64.b64decode(self.call("GET", "/screenshot")))

    def close(self):
        try:
            self.call("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait(30)
