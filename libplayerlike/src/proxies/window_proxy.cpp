// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <mutex>
#include <ostream>
#include <utility>

#include "core/errors.h"
#include "libCCMorse/WindowProxy.h"
#include "proxies/link.h"
#include "sim/canvas/layers.h"

namespace CCMorse {

using PlayerCc::PlayerError;
using playerlike::ClientCore;
using playerlike::translated;

namespace {

// The windows of this process in order of creation.
struct Windows {
  struct Entry {
    const ClientCore* core;  // its window exists, so it is valid
    WindowProxy* window;
  };
  std::mutex mutex;
  std::vector<Entry> entries;

  // Never destroyed: programs may delete windows during static destruction.
  static Windows& instance() {
    static auto* windows = new Windows;
    return *windows;
  }
};

GridMapLayer::Kind kind_of(sim::LayerKind kind) {
  return kind == sim::LayerKind::kBinary ? GridMapLayer::BINARY
         : kind == sim::LayerKind::kGrey ? GridMapLayer::GREY
                                         : GridMapLayer::RGBA;
}

sim::LayerKind sim_kind_of(GridMapLayer::Kind kind) {
  return kind == GridMapLayer::BINARY ? sim::LayerKind::kBinary
         : kind == GridMapLayer::GREY ? sim::LayerKind::kGrey
                                      : sim::LayerKind::kColour;
}

PlayerError no_such_layer(const char* fun, const std::string& name,
                          const std::vector<std::string>& known) {
  std::string text = "there is no layer \"" + name + "\"; layers:";
  for (const std::string& other : known) text += (&other == &known.front() ? " " : ", ") + other;
  return PlayerError(fun, text, PlayerError::kBadArgument);
}

}  // namespace

WindowProxy& WindowProxy::GetInstance(PlayerClient* aClient, int aWidth, int aHeight) {
  const char* fun = "WindowProxy::GetInstance";
  if (aClient == nullptr) {
    playerlike::refuse(fun, "a window needs a client, but it is a null pointer");
  }
  const std::shared_ptr<ClientCore>& core = PlayerCc::detail::CoreAccess::get(*aClient);
  if (aWidth <= 0 || aHeight <= 0) {
    playerlike::refuse(fun, "a window has at least one column and one row, but " +
                                std::to_string(aWidth) + " x " + std::to_string(aHeight) +
                                " were asked for");
  }
  Windows& windows = Windows::instance();
  const std::lock_guard lock(windows.mutex);
  for (const Windows::Entry& entry : windows.entries) {
    if (entry.core == core.get()) return *entry.window;
  }
  windows.entries.reserve(windows.entries.size() + 1);
  auto* window = new WindowProxy(core);  // owned by the program
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
    : CanvasDrawing(std::move(aCore), "WindowProxy") {}

WindowProxy::~WindowProxy() {
  Windows& windows = Windows::instance();
  const std::lock_guard lock(windows.mutex);
  std::erase_if(windows.entries, [this](const Windows::Entry& e) { return e.window == this; });
}

// Handle() and Find() need mLayersMutex.
GridMapLayer& WindowProxy::Handle(int aLayer, GridMapLayer::Kind aKind) {
  for (const auto& handle : mHandles) {
    if (handle->LayerNumber() == aLayer) return *handle;
  }
  mHandles.push_back(std::unique_ptr<GridMapLayer>(new GridMapLayer(Core(), aLayer, aKind)));
  return *mHandles.back();
}

// Looks among the handles first, so that repeated calls with a layer's name are cheap. Other layers
// belong to an earlier window or to another proxy of the client.
GridMapLayer* WindowProxy::Find(const std::string& aName) {
  for (const auto& handle : mHandles) {
    if (!handle->Retired() && handle->GetName() == aName) return handle.get();
  }
  const auto layers = translated("WindowProxy::FindLayer", [&] {
    return Core()->session().request(playerlike::LayersRequest{});
  });
  for (const sim::LayerInfo& layer : layers) {
    if (layer.style.name == aName) return &Handle(layer.id, kind_of(layer.kind));
  }
  return nullptr;
}

GridMapLayer& WindowProxy::CreateLayer(const std::string& aName, GridMapLayer::Kind aKind,
                                       int aPriority) {
  const char* fun = "WindowProxy::CreateLayer";
  RequireUsable("CreateLayer");
  if (aKind != GridMapLayer::RGBA && aKind != GridMapLayer::BINARY && aKind != GridMapLayer::GREY) {
    playerlike::refuse(fun, "there is no kind of layer " + std::to_string(static_cast<int>(aKind)));
  }
  const std::lock_guard lock(mLayersMutex);
  sim::LayerStyle style;
  style.name = aName;
  style.priority = aPriority;
  const sim::LayerId layer = translated(fun, [&] {
    return Core()->session().request(
        playerlike::CreateLayerRequest{sim_kind_of(aKind), std::move(style)});
  });
  return Handle(layer, aKind);
}

GridMapLayer* WindowProxy::FindLayer(const std::string& aName) {
  RequireUsable("FindLayer");
  const std::lock_guard lock(mLayersMutex);
  return Find(aName);
}

GridMapLayer& WindowProxy::GetLayer(const std::string& aName) {
  if (GridMapLayer* const layer = FindLayer(aName)) return *layer;
  throw no_such_layer("WindowProxy::GetLayer", aName, GetLayerNames());
}

void WindowProxy::RemoveLayer(const std::string& aName) {
  const char* fun = "WindowProxy::RemoveLayer";
  RequireUsable("RemoveLayer");
  const std::lock_guard lock(mLayersMutex);
  GridMapLayer* const layer = Find(aName);
  if (layer == nullptr) throw no_such_layer(fun, aName, GetLayerNames());
  translated(fun, [&] {
    Core()->session().request(playerlike::RemoveLayerRequest{layer->LayerNumber()});
  });
  layer->Retire();
}

std::vector<std::string> WindowProxy::GetLayerNames() const {
  RequireUsable("GetLayerNames");
  const auto layers = translated("WindowProxy::GetLayerNames", [&] {
    return Core()->session().request(playerlike::LayersRequest{});
  });
  std::vector<std::string> names;
  names.reserve(layers.size());
  for (const sim::LayerInfo& layer : layers) names.push_back(layer.style.name);
  return names;
}

}  // namespace CCMorse

namespace std {

std::ostream& operator<<(std::ostream& os, const CCMorse::WindowProxy& w) {
  os << "#window\n#columns\trows\tcell [m]\n"
     << w.GetWidth() << '\t' << w.GetHeight() << '\t' << w.GetCellSize() << "\n#layer\n";
  for (const std::string& name : w.GetLayerNames()) os << name << '\n';
  return os;
}

}  // namespace std
