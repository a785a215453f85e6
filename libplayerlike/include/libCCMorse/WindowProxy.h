// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "libCCMorse/GridMapLayer.h"
#include "libCCMorse/ImagePoint.h"
#include "libCCMorse/PlayerClient.h"

namespace CCMorse {

/// The grid-map of the world that a client is connected to, as a window to draw in.
///
/// A program has one, made by GetInstance(client, width, height) and found again by GetInstance();
/// it may be deleted ("delete &WindowProxy::GetInstance()") and made anew. A program with several
/// clients may make one for each; GetInstance() then returns the one made last whose client is
/// still there. Destroying the client before the window is fine: the window's calls throw then.
///
/// What is drawn here goes through the layer "canvas" and obeys its settings.
class WindowProxy : public Drawing {
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

  /// GetInstance() forgets it.
  ~WindowProxy() override;

  /// The layer of that name.
  /// @throws PlayerError kBadArgument if there is none; the text names those there are.
  GridMapLayer& GetLayer(const std::string& aName = "canvas");
  std::vector<std::string> GetLayerNames() const;

 protected:
  bool Shade(ImageColour_t& aColour) const override;

 private:
  explicit WindowProxy(std::shared_ptr<playerlike::ClientCore> aCore);

  std::unique_ptr<GridMapLayer> mLayer;
};

}  // namespace CCMorse

namespace PlayerCc {

/// The one class under both names.
using CCMorse::WindowProxy;

}  // namespace PlayerCc

namespace std {
/// Prints size, size of a cell and the layers.
std::ostream& operator<<(std::ostream& os, const CCMorse::WindowProxy& w);
}  // namespace std
