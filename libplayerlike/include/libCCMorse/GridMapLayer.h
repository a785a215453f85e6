// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#include "libCCMorse/Drawing.h"

namespace CCMorse {

/// A layer of the grid-map: a grid of cells with a name, a colour, a transparency, a transparent
/// colour and a priority, drawn over the layers below it. Made by WindowProxy::CreateLayer() and
/// owned by the window; other clients see it in pictures, but cannot draw on it. The layer "canvas"
/// is there from the start, is shared by all clients, and can neither be removed nor renamed.
///
/// The settings act when layers are put over one another: they may be changed at any time, and hold
/// for all of the layer, whenever it was drawn.
///
/// After WindowProxy::RemoveLayer() a layer throws PlayerError kNotAvailable, until the window goes
/// and it with it.
class GridMapLayer : public Drawing {
 public:
  /// What a cell holds.
  enum Kind {
    RGBA,    ///< a colour with alpha; at first transparent
    BINARY,  ///< set, and so drawn in the layer's colour, or not (as at first)
    GREY,    ///< occupancy: from 0, free and white, over 0.5, unknown and grey (at first), to 1,
             ///< occupied and black
  };

  ~GridMapLayer() override;

  Kind GetKind() const { return static_cast<Kind>(Cells()); }
  std::string GetName() const;
  /// Renames the layer; WindowProxy finds it under the new name only.
  /// @throws PlayerError kBadArgument for a name that another layer of this client has, that is
  ///         empty, longer than 64 bytes or not printable; kNotAvailable for the layer "canvas".
  void SetName(const std::string& aName);

  /// Of a binary layer's cells; and of drawings that name no colour, opaque black at first. Also
  /// the colour by which legends show the layer.
  ImageColour_t GetColour() const;
  template <typename... Colour>
  void SetColour(const Colour&... aColour) {
    SetOwnColour(detail::make_colour(aColour...));
  }

  /// How much of what lies below shines through: 0 (at first) nothing, 1 all. Clamped.
  /// @throws PlayerError kBadArgument for NaN.
  void SetTransparency(double aTransparency);
  double GetTransparency() const;

  /// Cells that look so (alpha does not matter) are left out. There is none at first. For a grey
  /// layer, e.g., white lets what is under free cells shine through.
  template <typename... Colour>
  void SetTransparentColour(const Colour&... aColour) {
    SetSeeThrough(true, detail::make_colour(aColour...));
  }
  /// Undoes SetTransparentColour().
  void ResetTransparentColour();
  bool HasTransparentColour() const;
  /// Opaque black if there is none.
  ImageColour_t GetTransparentColour() const;

  /// Place among layers: higher ones lie above lower ones; the layer "canvas" has 0 at first. Among
  /// equals, "canvas" is the lowest, then come those of clients on lower ports, then older ones.
  void SetPriority(int aPriority);
  int GetPriority() const;

  void Show();  ///< Pictures show it (at first they do).
  void Hide();  ///< Pictures leave it out; it may still be drawn on.
  bool IsVisible() const;

  using Drawing::SetLine;
  using Drawing::SetLineMetres;
  using Drawing::SetPixel;
  using Drawing::SetPixelMetres;
  /// In the layer's own colour; in a grey layer: occupied.
  void SetPixel(int aX, int aY) { PutPixel(aX, aY, OwnValue()); }
  void SetPixel(const ImagePoint_t& aPoint) { SetPixel(aPoint.x, aPoint.y); }
  void SetLine(int aX0, int aY0, int aX1, int aY1) { PutLine(aX0, aY0, aX1, aY1, OwnValue()); }
  void SetLine(const ImagePoint_t& aFrom, const ImagePoint_t& aTo) {
    SetLine(aFrom.x, aFrom.y, aTo.x, aTo.y);
  }
  void SetPixelMetres(double aX, double aY) { SetPixel(GetX(aX), GetY(aY)); }
  void SetLineMetres(double aX0, double aY0, double aX1, double aY1) {
    SetLine(GetX(aX0), GetY(aY0), GetX(aX1), GetY(aY1));
  }

  /// @name Cells as numbers
  /// In a binary layer 0 is not set, anything else is; in a grey layer floating point numbers,
  /// and all numbers given to SetCell(), are occupancies in 0..1, but std::uint8_t in 0..255
  /// counts 255ths; both are clamped. In an RGBA layer a cell has 3 (RGB) or 4 (RGBA) numbers,
  /// std::uint8_t in 0..255 or floating point in 0..1. NaN is refused with PlayerError
  /// kBadArgument.
  /// @{
  /// One cell of a binary or grey layer; outside nothing happens.
  /// @throws PlayerError kNotAvailable for an RGBA layer: it has SetPixel().
  template <typename T>
  detail::if_numbers<T> SetCell(int aX, int aY, T aValue) {
    PutCell(aX, aY,
            std::is_same<T, std::uint8_t>::value && Cells() == GREY_CELLS
                ? static_cast<double>(aValue) / 255.0
                : static_cast<double>(aValue));
  }
  /// A cell of a binary (0 or 1) or grey (0..1) layer.
  /// @throws PlayerError kBadArgument outside; kNotAvailable for an RGBA layer: it has GetPixel().
  double GetCell(int aX, int aY) const;

  /// All cells, row by row from the top, without blending.
  /// @tparam T  std::uint8_t, float or double.
  /// @param aCount  of numbers: as many as cells, or 3 or 4 times as many for an RGBA layer; else
  ///                PlayerError kBadArgument.
  template <typename T>
  void SetCells(const T* aCells, std::size_t aCount) {
    PutCells(aCells, aCount);
  }
  template <typename T>
  void SetCells(const std::vector<T>& aCells) {
    PutCells(aCells.data(), aCells.size());
  }
  /// The reverse; 4 numbers a cell for an RGBA layer, else one. A binary layer gives 0 and 1.
  template <typename T>
  void GetCells(std::vector<T>& aCells) const {
    TakeCells(aCells);
  }
  /// @}

  /// @name Files
  /// What is saved goes into the run's output folder (`playpen run --out FOLDER`, PLAYPEN_OUT), on
  /// a server into that of the server; names are plain file names, with or without the ending.
  /// @{
  /// Writes this layer alone, also if it is hidden, as a PNG with aScale x aScale pixels a cell;
  /// with its transparency, and white where nothing is drawn.
  /// @throws PlayerError kBadArgument for a name that is not a plain file name or a scale outside
  ///         1..64; kNotAvailable if the run has no output folder.
  void SaveImage(const std::string& aName, int aScale = 1) const;

  /// What a map file tells of a cell: see sim::io::MapMode.
  enum MapMode {
    TRINARY,  ///< occupied (over 0.65), free (below 0.196) or unknown
    SCALE     ///< the occupancy, to within 1/500
  };
  /// Writes a grey layer as a map of ROS's map_server: NAME.yaml and the picture NAME.pgm.
  /// @throws PlayerError as SaveImage(); kNotAvailable too if the layer is not grey.
  void SaveMap(const std::string& aName, MapMode aMode = TRINARY) const;
  /// Reads a map of map_server into a grey layer: each cell whose middle the map covers gets the
  /// occupancy that the map has there, wherever in the world and of whatever size the map and its
  /// cells are; all other cells stay as they are.
  /// @param aFile  the YAML file, a path on the machine of the program.
  /// @return how many cells the map covers.
  /// @throws PlayerError kBadArgument for files that are not there or not right, saying where and
  ///         what; kNotAvailable if the layer is not grey.
  int LoadMap(const std::string& aFile);
  /// @}

 private:
  friend class WindowProxy;
  struct Style;
  GridMapLayer(std::shared_ptr<playerlike::ClientCore> aCore, int aLayer, Kind aKind);

  std::uint32_t OwnValue() const;
  void SetOwnColour(const ImageColour_t& aColour);
  void SetSeeThrough(bool aOn, const ImageColour_t& aColour);
  Style GetStyle(const char* aFunction) const;
  template <typename Change>
  void ChangeStyle(const char* aFunction, Change aChange);

  void RequireNumbers(const char* aFunction, const char* aInstead) const;
  void RequireGrey(const char* aFunction) const;
  template <typename T>
  void PutAll(const T* aCells, std::size_t aCount);
  template <typename T>
  void TakeAll(std::vector<T>& aCells) const;
  void PutCell(int aX, int aY, double aValue);
  void PutCells(const std::uint8_t* aCells, std::size_t aCount);
  void PutCells(const float* aCells, std::size_t aCount);
  void PutCells(const double* aCells, std::size_t aCount);
  void TakeCells(std::vector<std::uint8_t>& aCells) const;
  void TakeCells(std::vector<float>& aCells) const;
  void TakeCells(std::vector<double>& aCells) const;

  mutable std::mutex mStyleMutex;  // so that no change of a setting undoes another
  std::string mLastName;           // under it
};

}  // namespace CCMorse
