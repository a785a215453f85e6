// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "libCCMorse/Drawing.h"

namespace CCMorse {

/// A layer of the grid-map: drawings that share a name, a colour, a transparency, a transparent
/// colour and a priority. WindowProxy owns it. This version has one layer, called "canvas".
///
/// The settings hold for what is drawn from then on, not for what is there.
class GridMapLayer : public Drawing {
 public:
  ~GridMapLayer() override;

  std::string GetName() const;
  /// Renames the layer; GetLayer() finds it under the new name only.
  void SetName(const std::string& aName);

  /// Colour of drawings that name none; opaque black at first.
  ImageColour_t GetColour() const;
  template <typename... Colour>
  void SetColour(const Colour&... aColour) {
    SetOwnColour(Make(aColour...));
  }

  /// How much of what lies below shines through: 0 (at first) nothing, 1 all. Multiplies the
  /// alpha of each drawing by 1 less this. Clamped. @throws PlayerError kBadArgument for NaN.
  void SetTransparency(double aTransparency);
  double GetTransparency() const;

  /// Drawings in this colour (alpha does not matter) draw nothing. There is none at first.
  template <typename... Colour>
  void SetTransparentColour(const Colour&... aColour) {
    SetSeeThrough(true, Make(aColour...));
  }
  /// Undoes SetTransparentColour().
  void ResetTransparentColour();
  bool HasTransparentColour() const;
  ImageColour_t GetTransparentColour() const;

  /// Place among layers: higher ones lie above lower ones; 0 at first. One layer alone looks the
  /// same with any.
  void SetPriority(int aPriority);
  int GetPriority() const;

  using Drawing::SetLine;
  using Drawing::SetPixel;
  /// In the layer's own colour.
  void SetPixel(int aX, int aY) { Drawing::SetPixel(aX, aY, GetColour()); }
  void SetPixel(const ImagePoint_t& aPoint) { SetPixel(aPoint.x, aPoint.y); }
  void SetLine(int aX0, int aY0, int aX1, int aY1) {
    Drawing::SetLine(aX0, aY0, aX1, aY1, GetColour());
  }
  void SetLine(const ImagePoint_t& aFrom, const ImagePoint_t& aTo) {
    SetLine(aFrom.x, aFrom.y, aTo.x, aTo.y);
  }

 protected:
  bool Shade(ImageColour_t& aColour) const override;

 private:
  friend class WindowProxy;
  explicit GridMapLayer(std::shared_ptr<playerlike::ClientCore> aCore);

  static ImageColour_t Make(const ImageColour_t& aColour) { return aColour; }
  template <typename Text, typename = detail::if_text<Text>>
  static ImageColour_t Make(const Text& aColour) {
    return detail::colour_of_text(aColour);
  }
  template <typename Text, typename A, typename = detail::if_text<Text>>
  static ImageColour_t Make(const Text& aColour, A aAlpha) {
    return detail::colour_of_text(aColour, aAlpha);
  }
  template <typename R, typename G, typename B>
  static ImageColour_t Make(R aRed, G aGreen, B aBlue) {
    return detail::colour(aRed, aGreen, aBlue);
  }
  template <typename R, typename G, typename B, typename A>
  static ImageColour_t Make(R aRed, G aGreen, B aBlue, A aAlpha) {
    return detail::colour(aRed, aGreen, aBlue, aAlpha);
  }
  void SetOwnColour(const ImageColour_t& aColour);
  void SetSeeThrough(bool aOn, const ImageColour_t& aColour);

  mutable std::mutex mMutex;
  std::string mLayerName;
  ImageColour_t mColour;
  double mTransparency;
  bool mHasTransparentColour;
  ImageColour_t mTransparentColour;
  int mPriority;
};

}  // namespace CCMorse
