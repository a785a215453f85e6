// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/Drawing.h"
#include "libCCMorse/MorseActuator.h"

namespace CCMorse {

/// The pen with which a robot draws on the grid-map that all robots share. See Drawing for cells
/// and colours, and CanvasDrawing for operations on the whole grid-map.
class MorsePen : public MorseActuator, public CanvasDrawing {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "pen".
  explicit MorsePen(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorsePen() override;

  /// Colour of drawings without a colour argument; initially the robot's colour.
  ImageColour_t GetColour() const { return MarkColour(); }
  template <typename... Colour>
  void SetColour(const Colour&... aColour) {
    SetMarkColour(detail::make_colour(aColour...));
  }

  using Drawing::SetLine;
  using Drawing::SetLineMetres;
  using Drawing::SetPixel;
  using Drawing::SetPixelMetres;
  /// Draws in the pen's own colour, like the following overloads.
  void SetPixel(int aX, int aY) { Drawing::SetPixel(aX, aY, GetColour()); }
  void SetPixel(const ImagePoint_t& aPoint) { SetPixel(aPoint.x, aPoint.y); }
  void SetLine(int aX0, int aY0, int aX1, int aY1) {
    Drawing::SetLine(aX0, aY0, aX1, aY1, GetColour());
  }
  void SetLine(const ImagePoint_t& aFrom, const ImagePoint_t& aTo) {
    SetLine(aFrom.x, aFrom.y, aTo.x, aTo.y);
  }
  void SetPixelMetres(double aX, double aY) { SetPixel(GetX(aX), GetY(aY)); }
  void SetLineMetres(double aX0, double aY0, double aX1, double aY1) {
    SetLine(GetX(aX0), GetY(aY0), GetX(aX1), GetY(aY1));
  }

 private:
  using MorseDevice::Core;
  using MorseDevice::Fun;
};

}  // namespace CCMorse
