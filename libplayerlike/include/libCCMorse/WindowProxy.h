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

/// A drawing window on the grid-map of the client's world: a shared canvas and up to 64 layers per
/// client above or below it.
///
/// GetInstance(client, width, height) creates the program's window, and GetInstance() returns it.
/// The program may delete it ("delete &WindowProxy::GetInstance()") and create a new one. A program
/// with several clients may create one window per client; GetInstance() then returns the newest
/// window whose client still exists. The client may be destroyed before the window; the window's
/// members then throw.
///
/// Members of the window draw on the layer "canvas", which all clients of the world share. Other
/// layers belong to their client. They stay in the world after the window and the client are
/// destroyed, so that the run's pictures show them. If a later client on the same port creates a
/// layer of the same name, an empty layer replaces the old one.
class WindowProxy : public CanvasDrawing {
 public:
  /// Creates the client's window, or returns it if it already exists.
  /// @param aClient  the client; must not be null.
  /// @param aWidth, aHeight  size in cells, > 0; otherwise ignored. The window always shows the
  ///                 world's whole grid-map ("canvas": {"size": [width, height]} in the world file,
  ///                 172 x 186 in the SyRoTek arena), so that one program works in worlds of all
  ///                 sizes. GetWidth() and GetHeight() return the actual size; GetX() and GetY()
  ///                 convert positions to cells.
  /// @throws PlayerError kBadArgument for a null client or a size that is not positive.
  static WindowProxy& GetInstance(PlayerClient* aClient, int aWidth, int aHeight);
  /// Returns the window.
  /// @throws PlayerError kNotAvailable if there is none.
  static WindowProxy& GetInstance();

  /// Deletes the window and its GridMapLayer objects. The layers stay in the world.
  ~WindowProxy() override;

  /// Creates a layer.
  /// @param aName  1 to 64 printable characters; no other layer of this client may have this name.
  /// @throws PlayerError kBadArgument for an invalid name; kNotAvailable if the client has 64
  ///         layers, or if all clients' layers together would be too large.
  /// @return the layer; the reference is valid until the window is deleted, even if the layer is
  ///         removed.
  GridMapLayer& CreateLayer(const std::string& aName, GridMapLayer::Kind aKind = GridMapLayer::RGBA,
                            int aPriority = 0);
  /// Returns the layer of this name.
  /// @throws PlayerError kBadArgument if there is no such layer; the text names the existing ones.
  GridMapLayer& GetLayer(const std::string& aName = "canvas");
  /// Returns the layer of this name, or null if there is none.
  GridMapLayer* FindLayer(const std::string& aName);
  bool HasLayer(const std::string& aName) { return FindLayer(aName) != nullptr; }
  /// Removes a layer from the world. References to it remain valid; see GridMapLayer.
  /// @throws PlayerError kBadArgument if there is no such layer; kNotAvailable for "canvas".
  void RemoveLayer(const std::string& aName);
  /// Returns the names of "canvas" and of this client's layers, lowest first.
  std::vector<std::string> GetLayerNames() const;

 private:
  explicit WindowProxy(std::shared_ptr<playerlike::ClientCore> aCore);
  GridMapLayer* Find(const std::string& aName);
  GridMapLayer& Handle(int aLayer, GridMapLayer::Kind aKind);

  mutable std::mutex mLayersMutex;
  // Includes removed layers, because the program may still hold references to them.
  std::vector<std::unique_ptr<GridMapLayer>> mHandles;
};

}  // namespace CCMorse

namespace PlayerCc {

/// The same class in both namespaces.
using CCMorse::WindowProxy;

}  // namespace PlayerCc

namespace std {
/// Prints the size, the cell size and the layers, lowest first.
std::ostream& operator<<(std::ostream& os, const CCMorse::WindowProxy& w);
}  // namespace std
