// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <mutex>
#include <ostream>
#include <utility>

#include "devices/errors.h"
#include "libCCMorse/WindowProxy.h"
#include "proxies/link.h"

namespace CCMorse {

using PlayerCc::PlayerError;
using playerlike::ClientCore;

namespace {

// The windows of this process, in the order in which they were made.
struct Windows {
  struct Entry {
    const ClientCore* core;  // of a window that lives, so it lives too
    WindowProxy* window;
  };
  std::mutex mutex;
  std::vector<Entry> entries;

  // Never destroyed: programs may delete windows while static objects are destroyed.
  static Windows& instance() {
    static auto* windows = new Windows;
    return *windows;
  }
};

}  // namespace

WindowProxy& WindowProxy::GetInstance(PlayerClient* aClient, int aWidth, int aHeight) {
  const char* fun = "WindowProxy::GetInstance";
  if (aClient == nullptr) {
    throw PlayerError(fun, "a window needs a client, but it is a null pointer",
                      PlayerError::kBadArgument);
  }
  const std::shared_ptr<ClientCore>& core = PlayerCc::detail::CoreAccess::get(*aClient);
  if (aWidth <= 0 || aHeight <= 0) {
    throw PlayerError(fun,
                      "a window has at least one column and one row, but " +
                          std::to_string(aWidth) + " x " + std::to_string(aHeight) +
                          " were asked for",
                      PlayerError::kBadArgument);
  }
  Windows& windows = Windows::instance();
  const std::lock_guard lock(windows.mutex);
  for (const Windows::Entry& entry : windows.entries) {
    if (entry.core == core.get()) return *entry.window;
  }
  windows.entries.reserve(windows.entries.size() + 1);
  auto* window = new WindowProxy(core);  // the program deletes it
  windows.entries.push_back({core.get(), window});
  return *window;
}

WindowProxy& WindowProxy::GetInstance() {
  Windows& windows = Windows::instance();
  const std::lock_guard lock(windows.mutex);
  const auto& entries = windows.entries;
  if (entries.empty()) {
    throw PlayerError("WindowProxy::GetInstance",
                      "there is no window yet: make one by GetInstance(client, width, height)",
                      PlayerError::kNotAvailable);
  }
  const auto alive = std::find_if(entries.rbegin(), entries.rend(),
                                  [](const Windows::Entry& e) { return !e.core->closed(); });
  return alive != entries.rend() ? *alive->window : *entries.back().window;
}

WindowProxy::WindowProxy(std::shared_ptr<ClientCore> aCore)
    : Drawing(aCore, "WindowProxy"), mLayer(new GridMapLayer(std::move(aCore))) {}

WindowProxy::~WindowProxy() {
  Windows& windows = Windows::instance();
  const std::lock_guard lock(windows.mutex);
  std::erase_if(windows.entries, [this](const Windows::Entry& e) { return e.window == this; });
}

bool WindowProxy::Shade(ImageColour_t& aColour) const { return mLayer->Shade(aColour); }

GridMapLayer& WindowProxy::GetLayer(const std::string& aName) {
  if (mLayer->GetName() == aName) return *mLayer;
  throw PlayerError("WindowProxy::GetLayer",
                    "there is no layer \"" + aName + "\"; layers: " + mLayer->GetName(),
                    PlayerError::kBadArgument);
}

std::vector<std::string> WindowProxy::GetLayerNames() const { return {mLayer->GetName()}; }

}  // namespace CCMorse

namespace std {

std::ostream& operator<<(std::ostream& os, const CCMorse::WindowProxy& w) {
  os << "#window\n#columns\trows\tcell [m]\n"
     << w.GetWidth() << '\t' << w.GetHeight() << '\t' << w.GetCellSize() << "\n#layer\n";
  for (const std::string& name : w.GetLayerNames()) os << name << '\n';
  return os;
}

}  // namespace std
