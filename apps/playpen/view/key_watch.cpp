// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "key_watch.h"

#include <X11/XKBlib.h>
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <unistd.h>

#include <array>
#include <map>
#include <stdexcept>

namespace {

/// Windows come and go during the search: a missing window is not an error.
int ignore_error(Display* /*display*/, XErrorEvent* /*error*/) { return 0; }

}  // namespace

struct KeyWatch::Impl {
  Display* display = nullptr;
  Window window = None;
  std::map<unsigned, KeySym> down;  ///< keys that are down, by keycode

  [[nodiscard]] bool is_ours(Window candidate, const std::string& title) const {
    char* name = nullptr;
    if (XFetchName(display, candidate, &name) == 0 || name == nullptr) return false;
    const bool same = title == name;
    XFree(name);
    return same && process_of(candidate) == getpid();
  }

  /// The process id that a window reports; -1 if it reports none.
  [[nodiscard]] long process_of(Window candidate) const {
    Atom type = None;
    int format = 0;
    unsigned long count = 0;
    unsigned long left = 0;
    unsigned char* data = nullptr;
    long process = -1;
    if (XGetWindowProperty(display, candidate, XInternAtom(display, "_NET_WM_PID", False), 0, 1,
                           False, XA_CARDINAL, &type, &format, &count, &left, &data) == Success &&
        data != nullptr) {
      // Xlib returns 32-bit properties as longs, whatever the size of a long.
      if (count == 1 && format == 32) process = *reinterpret_cast<const long*>(data);
      XFree(data);
    }
    return process;
  }

  [[nodiscard]] Window find(Window below, const std::string& title) const {
    if (is_ours(below, title)) return below;
    Window root = None;
    Window parent = None;
    Window* children = nullptr;
    unsigned count = 0;
    Window found = None;
    if (XQueryTree(display, below, &root, &parent, &children, &count) == 0) return None;
    for (unsigned i = 0; i < count && found == None; ++i) found = find(children[i], title);
    if (children != nullptr) XFree(children);
    return found;
  }
};

KeyWatch::KeyWatch() : impl_(std::make_unique<Impl>()) {
  impl_->display = XOpenDisplay(nullptr);
  if (impl_->display == nullptr) throw std::runtime_error("no X display");
  XSetErrorHandler(ignore_error);
  // A held key then repeats only its press, without releases in between.
  XkbSetDetectableAutoRepeat(impl_->display, True, nullptr);
}

KeyWatch::~KeyWatch() { XCloseDisplay(impl_->display); }

int KeyWatch::screen_width_px() const {
  return DisplayWidth(impl_->display, DefaultScreen(impl_->display));
}

int KeyWatch::screen_height_px() const {
  return DisplayHeight(impl_->display, DefaultScreen(impl_->display));
}

int KeyWatch::descriptor() const { return ConnectionNumber(impl_->display); }

bool KeyWatch::attach(const std::string& title) {
  impl_->window = impl_->find(DefaultRootWindow(impl_->display), title);
  if (impl_->window == None) return false;
  XSelectInput(impl_->display, impl_->window, KeyPressMask | KeyReleaseMask | FocusChangeMask);
  XSync(impl_->display, False);
  return true;
}

void KeyWatch::poll(const KeySink& key, const std::function<void()>& released) {
  while (XPending(impl_->display) > 0) {
    XEvent event;
    XNextEvent(impl_->display, &event);
    if (event.type == FocusOut && event.xfocus.mode != NotifyGrab) {
      impl_->down.clear();
      released();
    }
    if (event.type != KeyPress && event.type != KeyRelease) continue;
    const unsigned code = event.xkey.keycode;
    const bool control = (event.xkey.state & ControlMask) != 0;
    if (event.type == KeyPress) {
      std::array<char, 32> text{};
      KeySym symbol = NoSymbol;
      XLookupString(&event.xkey, text.data(), static_cast<int>(text.size()), &symbol, nullptr);
      if (!impl_->down.emplace(code, symbol).second) continue;
      key(static_cast<std::uint32_t>(symbol), true, control);
    } else if (const auto held = impl_->down.find(code); held != impl_->down.end()) {
      // Report the keysym of the press: Shift may have changed in between.
      key(static_cast<std::uint32_t>(held->second), false, control);
      impl_->down.erase(held);
    }
  }
}
