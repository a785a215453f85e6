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
/// colour and a priority. It is drawn over the layers below it. WindowProxy::CreateLayer() creates
/// a layer, and the window owns it. Other clients see it in pictures but cannot draw on it. The
/// layer "canvas" always exists and is shared by all clients; it cannot be removed or renamed.
///
/// The settings are applied when the layers are composed. They can be changed at any time and apply
/// to the whole layer, including earlier drawings.
///
/// After WindowProxy::RemoveLayer(), the members of the layer throw PlayerError kNotAvailable. The
/// object itself lives as long as the window.
class GridMapLayer : public Drawing {
 public:
  /// Type of the cells.
  enum Kind {
    RGBA,    ///< a colour with alpha; initially transparent
    BINARY,  ///< set or not set (initially not set); set cells have the layer's colour
    GREY,    ///< occupancy in 0..1: 0 is free (white), 0.5 unknown (grey, the initial value), 1
             ///< occupied (black)
  };

  ~GridMapLayer() override;

  Kind GetKind() const { return static_cast<Kind>(Cells()); }
  std::string GetName() const;
  /// Renames the layer. WindowProxy then finds it only by the new name.
  /// @throws PlayerError kBadArgument if the name is empty, longer than 64 bytes, not printable, or
  ///         the name of another layer of this client; kNotAvailable for the layer "canvas".
  void SetName(const std::string& aName);

  /// Colour of a binary layer's set cells, of drawings without a colour, and of the layer in
  /// legends. Initially opaque black.
  ImageColour_t GetColour() const;
  template <typename... Colour>
  void SetColour(const Colour&... aColour) {
    SetOwnColour(detail::make_colour(aColour...));
  }

  /// Sets the transparency: 0 (initial value) is opaque, 1 is invisible. Values outside are
  /// clamped.
  /// @throws PlayerError kBadArgument for NaN.
  void SetTransparency(double aTransparency);
  double GetTransparency() const;

  /// Makes all cells of this colour transparent, whatever their alpha. Initially there is no
  /// transparent colour. Example: white makes the free cells of a grey layer transparent.
  template <typename... Colour>
  void SetTransparentColour(const Colour&... aColour) {
    SetSeeThrough(true, detail::make_colour(aColour...));
  }
  /// Undoes SetTransparentColour().
  void ResetTransparentColour();
  bool HasTransparentColour() const;
  /// Returns the transparent colour, or opaque black if there is none.
  ImageColour_t GetTransparentColour() const;

  /// Sets the priority: layers of higher priority lie above layers of lower priority. The initial
  /// priority of "canvas" is 0. For equal priorities the order is, from the bottom: "canvas", then
  /// the other layers sorted by their client's port, then by their order of creation.
  void SetPriority(int aPriority);
  int GetPriority() const;

  void Show();  ///< Shows the layer in pictures (initial state).
  void Hide();  ///< Hides the layer in pictures; drawing still works.
  bool IsVisible() const;

  using Drawing::SetLine;
  using Drawing::SetLineMetres;
  using Drawing::SetPixel;
  using Drawing::SetPixelMetres;
  /// Draws in the layer's own colour; in a grey layer, marks as occupied. This applies to all
  /// following overloads.
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
  /// Binary layer: 0 is a cell that is not set, any other number is a set cell.
  ///
  /// Grey layer: std::uint8_t is an occupancy in 0..255; any other type is an occupancy in 0..1.
  /// Numbers outside are clamped.
  ///
  /// RGBA layer: a cell has 3 (RGB) or 4 (RGBA) numbers, either std::uint8_t in 0..255 or
  /// floating-point in 0..1.
  ///
  /// NaN throws PlayerError kBadArgument.
  /// @{
  /// Sets one cell of a binary or grey layer. Outside the grid-map it does nothing.
  /// @throws PlayerError kNotAvailable for an RGBA layer; use SetPixel() there.
  template <typename T>
  detail::if_numbers<T> SetCell(int aX, int aY, T aValue) {
    PutCell(aX, aY,
            std::is_same<T, std::uint8_t>::value && Cells() == GREY_CELLS
                ? static_cast<double>(aValue) / 255.0
                : static_cast<double>(aValue));
  }
  /// Returns a cell of a binary (0 or 1) or grey (0..1) layer.
  /// @throws PlayerError kBadArgument outside the grid-map; kNotAvailable for an RGBA layer: use
  ///         GetPixel() there.
  double GetCell(int aX, int aY) const;

  /// Sets all cells, row by row from the top, without blending.
  /// @tparam T  std::uint8_t, float or double.
  /// @param aCount  number of elements: the number of cells, or 3 or 4 times that for an RGBA
  ///                layer.
  /// @throws PlayerError kBadArgument for any other count.
  template <typename T>
  void SetCells(const T* aCells, std::size_t aCount) {
    PutCells(aCells, aCount);
  }
  template <typename T>
  void SetCells(const std::vector<T>& aCells) {
    PutCells(aCells.data(), aCells.size());
  }
  /// Reads all cells, row by row from the top: 4 numbers per cell for an RGBA layer, otherwise one.
  /// Cells of a binary layer are 0 or 1.
  template <typename T>
  void GetCells(std::vector<T>& aCells) const {
    TakeCells(aCells);
  }
  /// @}

  /// @name Files
  /// Files are saved to the run's output folder (`playpen run --out FOLDER`, PLAYPEN_OUT); if the
  /// simulation runs on a server, to the server's output folder. Names are plain file names, with
  /// or without the extension.
  /// @{
  /// Writes only this layer, even if it is hidden, as a PNG file with aScale x aScale pixels per
  /// cell. Its transparency is applied over a white background.
  /// @throws PlayerError kBadArgument for a name that is not a plain file name or a scale outside
  ///         1..64; kNotAvailable if the run has no output folder.
  void SaveImage(const std::string& aName, int aScale = 1) const;

  /// Cell values in a map file; see sim::io::MapMode.
  enum MapMode {
    TRINARY,  ///< occupied (above 0.65), free (below 0.196) or unknown
    SCALE     ///< the occupancy, with an error of at most 1/500
  };
  /// Writes a grey layer as a map for ROS's map_server: NAME.yaml and the image NAME.pgm.
  /// @throws PlayerError for the same errors as SaveImage(); also kNotAvailable if the layer is not
  ///         grey.
  void SaveMap(const std::string& aName, MapMode aMode = TRINARY) const;
  /// Reads a map_server map into a grey layer. The map may have any origin, size and resolution.
  /// Each cell whose centre lies on the map gets the map's occupancy there; all other cells keep
  /// their values.
  /// @param aFile  path of the YAML file, on the machine where the program runs.
  /// @return the number of cells that the map covers.
  /// @throws PlayerError kBadArgument for a missing or invalid file, with the place and the fault
  ///         in the text; kNotAvailable if the layer is not grey.
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

  mutable std::mutex mStyleMutex;  // makes changes of settings atomic
  std::string mLastName;           // guarded by mStyleMutex
};

}  // namespace CCMorse
