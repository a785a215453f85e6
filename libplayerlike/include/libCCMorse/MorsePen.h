// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/Drawing.h"
#include "libCCMorse/MorseActuator.h"

namespace CCMorse {

/// The pen by which a robot draws on the grid-map. See Drawing for cells and colours.
class MorsePen : public MorseActuator, public Drawing {
 public:
  /// @param aName  device; "": the robot's first of type "pen".
  explicit MorsePen(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorsePen() override;

  /// Colour of drawings that name none; the robot's colour at first.
  ImageColour_t GetColour() const;
  void SetColour(const ImageColour_t& aColour);

  using Drawing::SetLine;
  using Drawing::SetPixel;
  /// In the pen's own colour.
  void SetPixel(int aX, int aY) { Drawing::SetPixel(aX, aY, GetColour()); }
  void SetPixel(const ImagePoint_t& aPoint) { SetPixel(aPoint.x, aPoint.y); }
  void SetLine(int aX0, int aY0, int aX1, int aY1) {
    Drawing::SetLine(aX0, aY0, aX1, aY1, GetColour());
  }
  void SetLine(const ImagePoint_t& aFrom, const ImagePoint_t& aTo) {
    SetLine(aFrom.x, aFrom.y, aTo.x, aTo.y);
  }

 private:
  ImageColour_t mColour;
};

}  // namespace CCMorse
