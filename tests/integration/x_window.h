// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_support {

/// The content of a window: RGB, row-major from the top.
struct Screenshot {
  struct Pixel {
    int r = 0;
    int g = 0;
    int b = 0;
    friend bool operator==(const Pixel&, const Pixel&) = default;
  };
  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;

  [[nodiscard]] const Pixel& at(int x, int y) const {
    return pixels.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x));
  }
  /// The rows from `first` up to, but not including, `last`.
  [[nodiscard]] Screenshot rows(int first, int last) const {
    Screenshot part{width, last - first, {}};
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < width; ++x) part.pixels.push_back(at(x, y));
    }
    return part;
  }
  /// Share of the pixels for which `such` is true.
  [[nodiscard]] double share(const std::function<bool(const Pixel&)>& such) const {
    std::size_t count = 0;
    for (const Pixel& pixel : pixels) count += such(pixel) ? 1U : 0U;
    return static_cast<double>(count) / static_cast<double>(pixels.size());
  }
  friend bool operator==(const Screenshot&, const Screenshot&) = default;
};

/// A connection to an X display, for inspecting and closing windows.
class XDisplay {
 public:
  explicit XDisplay(const std::string& name) : display_(XOpenDisplay(name.c_str())) {
    if (display_ == nullptr) throw std::runtime_error("no X display " + name);
    // A window that disappears during the inspection is not an error.
    XSetErrorHandler([](Display* /*display*/, XErrorEvent* /*error*/) { return 0; });
  }
  XDisplay(const XDisplay&) = delete;
  XDisplay& operator=(const XDisplay&) = delete;
  ~XDisplay() { XCloseDisplay(display_); }

  /// The visible window with that title.
  [[nodiscard]] std::optional<Window> find(const std::string& title) const {
    return find_below(DefaultRootWindow(display_), title);
  }

  /// The content of a window; nullopt if the window does not exist.
  [[nodiscard]] std::optional<Screenshot> capture(Window window) const {
    XWindowAttributes attributes;
    XImage* image = nullptr;
    // Lock the window's size: reading beyond the window fails.
    XGrabServer(display_);
    if (XGetWindowAttributes(display_, window, &attributes) != 0 &&
        attributes.map_state == IsViewable) {
      image = XGetImage(display_, window, 0, 0, static_cast<unsigned>(attributes.width),
                        static_cast<unsigned>(attributes.height), AllPlanes, ZPixmap);
    }
    XUngrabServer(display_);
    XSync(display_, False);
    if (image == nullptr) return std::nullopt;
    Screenshot shot{attributes.width, attributes.height, {}};
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        const unsigned long value = XGetPixel(image, x, y);  // 24 bits, 0xRRGGBB
        shot.pixels.push_back({static_cast<int>(value >> 16U & 0xffU),
                               static_cast<int>(value >> 8U & 0xffU),
                               static_cast<int>(value & 0xffU)});
      }
    }
    XDestroyImage(image);
    return shot;
  }

  /// Gives a window the keyboard focus, independently of the pointer.
  void focus(Window window) const {
    XSetInputFocus(display_, window, RevertToPointerRoot, CurrentTime);
    XSync(display_, False);
  }
  [[nodiscard]] bool has_focus(Window window) const {
    Window focused = None;
    int revert_to = 0;
    XGetInputFocus(display_, &focused, &revert_to);
    return focused == window;
  }

  /// Asks a window to close, like the button in its frame.
  void ask_to_close(Window window) const {
    XEvent event = {};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = XInternAtom(display_, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(XInternAtom(display_, "WM_DELETE_WINDOW", False));
    XSendEvent(display_, window, False, NoEventMask, &event);
    XSync(display_, False);
  }

 private:
  [[nodiscard]] std::optional<Window> find_below(Window window, const std::string& title) const {
    char* name = nullptr;
    const bool named = XFetchName(display_, window, &name) != 0 && name != nullptr;
    const bool same = named && title == name;
    if (named) XFree(name);
    XWindowAttributes attributes;
    if (same && XGetWindowAttributes(display_, window, &attributes) != 0 &&
        attributes.map_state == IsViewable) {
      return window;
    }
    Window root = None;
    Window parent = None;
    Window* children = nullptr;
    unsigned count = 0;
    if (XQueryTree(display_, window, &root, &parent, &children, &count) == 0) return std::nullopt;
    std::optional<Window> found;
    for (unsigned i = 0; i < count && !found; ++i) found = find_below(children[i], title);
    if (children != nullptr) XFree(children);
    return found;
  }

  Display* display_;
};

}  // namespace test_support
