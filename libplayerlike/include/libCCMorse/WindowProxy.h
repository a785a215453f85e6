// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "libCCMorse/GridMapLayer.h"
#include "libCCMorse/ImagePoint.h"
#include "libCCMorse/PlayerClient.h"

namespace CCMorse {

/// The grid-map of the world that a client is connected to, as a window to draw in: a shared canvas
/// and, over or under it, a multitude of layers.
///
/// A program has one, made by GetInstance(client, width, height) and found again by GetInstance();
/// it may be deleted ("delete &WindowProxy::GetInstance()") and made anew. A program with several
/// clients may make one for each; GetInstance() then returns the one made last whose client is
/// still there. Destroying the client before the window is fine: the window's calls throw then.
///
/// What is drawn on the window itself is drawn on the layer "canvas", which all clients of the
/// world share. Layers belong to their client. They stay in the world when window and client go, so
/// that the run's pictures show them; a later client on the same port that makes a layer of the
/// same name gets a fresh one in its place.
class WindowProxy : public CanvasDrawing {
 public:
  /// Makes the client's window, or returns it if the client has one.
  /// @param aClient  not null.
  /// @param aWidth, aHeight  cells, > 0. The window shows the world's whole grid-map, whatever its
  ///                 size ("canvas": {"size": [width, height]} in the world file, 172 x 186 in the
  ///                 SyRoTek arena), so that one program serves worlds of all sizes: GetWidth()
  ///                 and GetHeight() tell the true size, GetX() and GetY() find the cells.
  /// @throws PlayerError kBadArgument for a null client or a size that is not positive.
  static WindowProxy& GetInstance(PlayerClient* aClient, int aWidth, int aHeight);
  /// The window.
  /// @throws PlayerError kNotAvailable if there is none.
  static WindowProxy& GetInstance();

  /// GetInstance() forgets it. Handles of layers end here, the layers do not.
  ~WindowProxy() override;

  /// Makes a layer.
  /// @param aName  1 to 64 printable characters, none that a layer of this client has.
  /// @throws PlayerError kBadArgument for another name; kNotAvailable if the client has 64 layers,
  ///         or all clients' together would get too large.
  /// @return the layer; valid until the window goes, also if it is removed.
  GridMapLayer& CreateLayer(const std::string& aName, GridMapLayer::Kind aKind = GridMapLayer::RGBA,
                            int aPriority = 0);
  /// The layer of that name.
  /// @throws PlayerError kBadArgument if there is none; the text names those there are.
  GridMapLayer& GetLayer(const std::string& aName = "canvas");
  /// The same; null if there is none.
  GridMapLayer* FindLayer(const std::string& aName);
  bool HasLayer(const std::string& aName) { return FindLayer(aName) != nullptr; }
  /// Takes a layer out of the world; references to it stay safe, see GridMapLayer.
  /// @throws PlayerError kBadArgument if there is none of that name; kNotAvailable for "canvas".
  void RemoveLayer(const std::string& aName);
  /// "canvas" and this client's layers, lowest first.
  std::vector<std::string> GetLayerNames() const;

 private:
  explicit WindowProxy(std::shared_ptr<playerlike::ClientCore> aCore);
  GridMapLayer* Find(const std::string& aName);
  GridMapLayer& Handle(int aLayer, GridMapLayer::Kind aKind);

  mutable std::mutex mLayersMutex;
  // Also those of layers that were removed: somebody may hold a reference.
  std::vector<std::unique_ptr<GridMapLayer>> mHandles;
};

}  // namespace CCMorse

namespace PlayerCc {

/// The one class under both names.
using CCMorse::WindowProxy;

}  // namespace PlayerCc

namespace std {
/// Prints size, size of a cell and the layers, lowest first.
std::ostream& operator<<(std::ostream& os, const CCMorse::WindowProxy& w);
}  // namespace std
