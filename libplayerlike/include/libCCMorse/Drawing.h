// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#include "libCCMorse/ImagePoint.h"
#include "libCCMorse/MorseError.h"
#include "libCCMorse/ViewMode.h"
#include "libplayerc++/playerstructs.h"

namespace playerlike {
class ClientCore;
struct CanvasInfo;
class DrawQueue;
}  // namespace playerlike

namespace CCMorse {

namespace detail {

template <typename... Ts>
struct all_numbers : std::true_type {};
template <typename T, typename... Ts>
struct all_numbers<T, Ts...>
    : std::integral_constant<bool, std::is_arithmetic<T>::value && all_numbers<Ts...>::value> {};

template <typename... Ts>
struct any_floating : std::false_type {};
template <typename T, typename... Ts>
struct any_floating<T, Ts...>
    : std::integral_constant<bool, std::is_floating_point<T>::value || any_floating<Ts...>::value> {
};

/// void if all types are numbers; otherwise the overload is disabled.
template <typename... Ts>
using if_numbers = typename std::enable_if<all_numbers<Ts...>::value>::type;

/// void if the type converts to std::string (a literal, a std::string, ...); otherwise the overload
/// is disabled.
template <typename T>
using if_text = typename std::enable_if<std::is_convertible<const T&, std::string>::value>::type;

/// Converts a channel value in 0..1 to 8 bits; values outside are clamped.
/// @throws PlayerError kBadArgument if the value is not finite.
std::uint8_t channel_of_unusual_share(double share);
inline std::uint8_t channel_of_share(double share) {
  return share >= 0.0 && share <= 1.0 ? static_cast<std::uint8_t>(share * 255.0 + 0.5)
                                      : channel_of_unusual_share(share);
}
/// Converts an integer of any type to a channel value in 0..255; values outside are clamped.
template <typename T>
std::uint8_t channel_of_byte(T value) {
  if (!(value > T(0))) return 0;
  return static_cast<unsigned long long>(value) < 255ULL ? static_cast<std::uint8_t>(value)
                                                         : std::uint8_t(255);
}

template <bool kShares>
struct channel {
  template <typename T>
  static std::uint8_t of(T value) {
    return channel_of_byte(value);
  }
};
template <>
struct channel<true> {
  template <typename T>
  static std::uint8_t of(T value) {
    return channel_of_share(static_cast<double>(value));
  }
};

/// Makes a colour of numbers. If at least one is a floating-point number, all are shares in 0..1;
/// otherwise all are bytes in 0..255. Values outside the range are clamped.
template <typename R, typename G, typename B>
ImageColour_t colour(R r, G g, B b) {
  typedef channel<any_floating<R, G, B>::value> as;
  return ImageColour_t(as::of(r), as::of(g), as::of(b));
}
template <typename R, typename G, typename B, typename A>
ImageColour_t colour(R r, G g, B b, A a) {
  typedef channel<any_floating<R, G, B, A>::value> as;
  return ImageColour_t(as::of(r), as::of(g), as::of(b), as::of(a));
}
/// Parses a colour "#RGB", "#RRGGBB" or "#RRGGBBAA".
/// @throws PlayerError kBadArgument for any other text.
ImageColour_t colour_of_text(const std::string& text);
/// Parses a colour and replaces its alpha by the given one.
template <typename A>
ImageColour_t colour_of_text(const std::string& text, A alpha) {
  ImageColour_t c = colour_of_text(text);
  c.a = channel<std::is_floating_point<A>::value>::of(alpha);
  return c;
}
/// Returns "#rrggbb", or "#rrggbbaa" if alpha is not 255.
std::string text_of_colour(const ImageColour_t& c);

/// Makes a colour from any of its descriptions; opaque unless an alpha is given.
inline ImageColour_t make_colour(const ImageColour_t& c) { return c; }
template <typename Text, typename = if_text<Text>>
ImageColour_t make_colour(const Text& text) {
  return colour_of_text(text);
}
template <typename Text, typename A, typename = if_text<Text>>
ImageColour_t make_colour(const Text& text, A alpha) {
  return colour_of_text(text, alpha);
}
template <typename R, typename G, typename B, typename = if_numbers<R, G, B>>
ImageColour_t make_colour(R r, G g, B b) {
  return colour(r, g, b);
}
template <typename R, typename G, typename B, typename A, typename = if_numbers<R, G, B, A>>
ImageColour_t make_colour(R r, G g, B b, A a) {
  return colour(r, g, b, a);
}

template <typename T>
T channel_value(std::uint8_t value, std::true_type) {
  return static_cast<T>(value / 255.0);
}
template <typename T>
T channel_value(std::uint8_t value, std::false_type) {
  return static_cast<T>(value);
}

}  // namespace detail

/// Common base of WindowProxy, GridMapLayer and MorsePen: draws on a layer of the world's grid-map
/// and reads its cells.
///
/// A cell is addressed by column (from the left) and row (from the top, so row 0 has the highest
/// y). Functions whose names end in Metres take positions in the world frame W [m] instead.
/// Drawings are clipped to the grid-map.
///
/// A colour is given in one of three forms, each with or without alpha: integers in 0..255; numbers
/// in 0..1, if at least one of them is a floating-point number; or a text such as "#34AAFF" (also
/// "#3AF", and "#34AAFF80" with alpha). Numbers outside the range are clamped. A colour without
/// alpha is opaque and replaces the cell's colour; a colour with alpha is blended over it.
///
/// Drawings are executed in order. This client sees them immediately; other clients see them at the
/// next step at the latest.
///
/// Errors: PlayerError kBadArgument for numbers that are not finite and for texts that are not
/// colours; kDisconnected when the client is gone.
///
/// Threads: all members may be called from any thread.
///
/// Cost: about 20 ns per cell. A buffer collects thousands of drawings before they are executed.
class Drawing {
 public:
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;
  virtual ~Drawing();

  int GetWidth() const;        ///< current number of columns
  int GetHeight() const;       ///< current number of rows
  double GetCellSize() const;  ///< side length of a cell [m]

  /// Column of an x coordinate in the world [m]. Outside the grid-map it is negative or at least
  /// GetWidth().
  int GetX(double aX) const;
  /// Row of a y coordinate in the world [m]. Outside the grid-map it is negative or at least
  /// GetHeight().
  int GetY(double aY) const;
  /// Cell of a position in the world [m].
  ImagePoint_t GetPoint(double aX, double aY) const { return ImagePoint_t(GetX(aX), GetY(aY)); }

  /// @name One cell
  /// @{
  template <typename R, typename G, typename B>
  detail::if_numbers<R, G, B> SetPixel(int aX, int aY, R aRed, G aGreen, B aBlue) {
    DrawPixel(aX, aY, detail::colour(aRed, aGreen, aBlue));
  }
  template <typename R, typename G, typename B, typename A>
  detail::if_numbers<R, G, B, A> SetPixel(int aX, int aY, R aRed, G aGreen, B aBlue, A aAlpha) {
    DrawPixel(aX, aY, detail::colour(aRed, aGreen, aBlue, aAlpha));
  }
  template <typename Text>
  detail::if_text<Text> SetPixel(int aX, int aY, const Text& aColour) {
    DrawPixel(aX, aY, detail::colour_of_text(aColour));
  }
  template <typename Text, typename A, typename = detail::if_numbers<A>>
  detail::if_text<Text> SetPixel(int aX, int aY, const Text& aColour, A aAlpha) {
    DrawPixel(aX, aY, detail::colour_of_text(aColour, aAlpha));
  }
  void SetPixel(int aX, int aY, const ImageColour_t& aColour) { DrawPixel(aX, aY, aColour); }
  template <typename... Colour>
  void SetPixel(const ImagePoint_t& aPoint, const Colour&... aColour) {
    SetPixel(aPoint.x, aPoint.y, aColour...);
  }
  /// @}

  /// @name A line between two cells, including both
  /// @{
  template <typename R, typename G, typename B>
  detail::if_numbers<R, G, B> SetLine(int aX0, int aY0, int aX1, int aY1, R aRed, G aGreen,
                                      B aBlue) {
    DrawLine(aX0, aY0, aX1, aY1, detail::colour(aRed, aGreen, aBlue));
  }
  template <typename R, typename G, typename B, typename A>
  detail::if_numbers<R, G, B, A> SetLine(int aX0, int aY0, int aX1, int aY1, R aRed, G aGreen,
                                         B aBlue, A aAlpha) {
    DrawLine(aX0, aY0, aX1, aY1, detail::colour(aRed, aGreen, aBlue, aAlpha));
  }
  template <typename Text>
  detail::if_text<Text> SetLine(int aX0, int aY0, int aX1, int aY1, const Text& aColour) {
    DrawLine(aX0, aY0, aX1, aY1, detail::colour_of_text(aColour));
  }
  template <typename Text, typename A, typename = detail::if_numbers<A>>
  detail::if_text<Text> SetLine(int aX0, int aY0, int aX1, int aY1, const Text& aColour, A aAlpha) {
    DrawLine(aX0, aY0, aX1, aY1, detail::colour_of_text(aColour, aAlpha));
  }
  void SetLine(int aX0, int aY0, int aX1, int aY1, const ImageColour_t& aColour) {
    DrawLine(aX0, aY0, aX1, aY1, aColour);
  }
  template <typename... Colour>
  void SetLine(const ImagePoint_t& aFrom, const ImagePoint_t& aTo, const Colour&... aColour) {
    SetLine(aFrom.x, aFrom.y, aTo.x, aTo.y, aColour...);
  }
  /// @}

  /// @name In metres
  /// The colour has one of the forms that SetPixel() accepts.
  /// @{
  /// Draws the cell that contains a position.
  template <typename... Colour>
  void SetPixelMetres(double aX, double aY, const Colour&... aColour) {
    DrawPixel(GetX(aX), GetY(aY), detail::make_colour(aColour...));
  }
  /// Draws a line between the cells of two positions.
  template <typename... Colour>
  void SetLineMetres(double aX0, double aY0, double aX1, double aY1, const Colour&... aColour) {
    DrawLine(GetX(aX0), GetY(aY0), GetX(aX1), GetY(aY1), detail::make_colour(aColour...));
  }
  /// Draws lines from each position to the next. A cell where two lines meet is drawn twice.
  template <typename... Colour>
  void SetPolylineMetres(const std::vector<player_point_2d_t>& aPoints, const Colour&... aColour) {
    DrawPolyline(aPoints.data(), aPoints.size(), detail::make_colour(aColour...));
  }
  /// Draws a filled polygon: each cell whose centre lies inside (even-odd rule) is drawn once.
  template <typename... Colour>
  void SetPolygonMetres(const std::vector<player_point_2d_t>& aPoints, const Colour&... aColour) {
    FillPolygon(aPoints.data(), aPoints.size(), detail::make_colour(aColour...));
  }
  /// Draws a filled disc: each cell whose centre lies within aRadius [m] of the position is drawn
  /// once. The cell that contains the position is always drawn.
  /// @throws PlayerError kBadArgument for a negative radius.
  template <typename... Colour>
  void SetDiscMetres(double aX, double aY, double aRadius, const Colour&... aColour) {
    FillDisc(aX, aY, aRadius, detail::make_colour(aColour...));
  }
  /// @}

  /// @name The whole grid-map
  /// @{
  /// Makes every cell transparent.
  void Clear() { Fill(ImageColour_t(0, 0, 0, 0)); }
  /// Sets every cell to this colour, without blending.
  template <typename R, typename G, typename B>
  detail::if_numbers<R, G, B> Clear(R aRed, G aGreen, B aBlue) {
    Fill(detail::colour(aRed, aGreen, aBlue));
  }
  template <typename R, typename G, typename B, typename A>
  detail::if_numbers<R, G, B, A> Clear(R aRed, G aGreen, B aBlue, A aAlpha) {
    Fill(detail::colour(aRed, aGreen, aBlue, aAlpha));
  }
  template <typename Text>
  detail::if_text<Text> Clear(const Text& aColour) {
    Fill(detail::colour_of_text(aColour));
  }
  template <typename Text, typename A, typename = detail::if_numbers<A>>
  detail::if_text<Text> Clear(const Text& aColour, A aAlpha) {
    Fill(detail::colour_of_text(aColour, aAlpha));
  }
  void Clear(const ImageColour_t& aColour) { Fill(aColour); }

  /// Sets every cell from an image, without blending. The image has GetWidth() * GetHeight() cells,
  /// row by row from the top, with 3 (RGB) or 4 (RGBA) bytes each.
  /// @throws PlayerError kBadArgument for any other number of bytes.
  void SetImage(const std::uint8_t* aImage, std::size_t aBytes);
  void SetImage(const std::vector<std::uint8_t>& aImage) { SetImage(aImage.data(), aImage.size()); }
  /// Calls SetPixel() for each element of a list.
  void UpdateImage(const std::vector<ImagePixel_t>& aPixels);
  /// @}

  /// @name Reading cells
  /// A cell outside the grid-map throws PlayerError kBadArgument. A cell that has not been drawn is
  /// transparent black.
  /// @{
  ImageColour_t GetPixel(int aX, int aY) const;
  ImageColour_t GetPixel(const ImagePoint_t& aPoint) const { return GetPixel(aPoint.x, aPoint.y); }
  /// Writes the channels to variables of one type: integers get 0..255, floating-point numbers
  /// 0..1.
  template <typename T>
  detail::if_numbers<T> GetPixel(int aX, int aY, T& aRed, T& aGreen, T& aBlue) const {
    T alpha;
    GetPixel(aX, aY, aRed, aGreen, aBlue, alpha);
  }
  template <typename T>
  detail::if_numbers<T> GetPixel(int aX, int aY, T& aRed, T& aGreen, T& aBlue, T& aAlpha) const {
    typedef typename std::is_floating_point<T>::type shares;
    const ImageColour_t c = GetPixel(aX, aY);
    aRed = detail::channel_value<T>(c.r, shares());
    aGreen = detail::channel_value<T>(c.g, shares());
    aBlue = detail::channel_value<T>(c.b, shares());
    aAlpha = detail::channel_value<T>(c.a, shares());
  }
  /// Returns the colour as "#rrggbb", or as "#rrggbbaa" if it is not opaque.
  void GetPixel(int aX, int aY, std::string& aColour) const {
    aColour = detail::text_of_colour(GetPixel(aX, aY));
  }
  /// Returns all cells, row by row from the top, with 4 (RGBA) or 3 (RGB) bytes each.
  /// @throws PlayerError kBadArgument for any other number of channels.
  std::vector<std::uint8_t> GetImage(int aChannels = 4) const;
  /// Writes all cells to a buffer, which is resized as needed.
  void GetImage(std::vector<std::uint8_t>& aImage, int aChannels = 4) const {
    aImage = GetImage(aChannels);
  }
  /// @}

 protected:
  /// Type of a layer's cells.
  enum CellKind { COLOUR_CELLS, BINARY_CELLS, GREY_CELLS };

  /// @param aName   class name for error texts; a string literal.
  /// @param aLayer  number of the layer; 0 is the canvas that all clients share.
  Drawing(std::shared_ptr<playerlike::ClientCore> aCore, const char* aName, int aLayer = 0,
          CellKind aKind = COLOUR_CELLS);

  // These take cell coordinates and an ImageColour_t.
  void DrawPixel(int aX, int aY, const ImageColour_t& aColour) {
    PutPixel(aX, aY, ValueOf(aColour));
  }
  void DrawLine(int aX0, int aY0, int aX1, int aY1, const ImageColour_t& aColour) {
    PutLine(aX0, aY0, aX1, aY1, ValueOf(aColour));
  }
  void Fill(const ImageColour_t& aColour);
  void DrawPolyline(const player_point_2d_t* aPoints, std::size_t aCount,
                    const ImageColour_t& aColour);
  void FillPolygon(const player_point_2d_t* aPoints, std::size_t aCount,
                   const ImageColour_t& aColour);
  void FillDisc(double aX, double aY, double aRadius, const ImageColour_t& aColour);

  /// Writes a cell's content, encoded as in sim::CellValue.
  void PutPixel(int aX, int aY, std::uint32_t aValue);
  void PutLine(int aX0, int aY0, int aX1, int aY1, std::uint32_t aValue);
  /// Content of a cell of this layer that is drawn in a colour. In a colour layer it is the colour.
  /// In a binary layer the cell is set, unless alpha is 0. In a grey layer it is the darkness, from
  /// 0 (white) to 1 (black), or 0.5 if alpha is 0.
  std::uint32_t ValueOf(const ImageColour_t& aColour) const {
    // Shifts keep the channels in registers; copying the four bytes at once would stall on the
    // store to memory.
    const std::uint32_t r = aColour.r, g = aColour.g, b = aColour.b, a = aColour.a;
    return mKind == COLOUR_CELLS ? r | g << 8U | b << 16U | a << 24U : MarkOf(aColour);
  }

  /// Content of a cell.
  /// @throws PlayerError kBadArgument outside the grid-map.
  std::uint32_t CellAt(int aX, int aY, const char* aFunction) const;

  /// Throws PlayerError if the client is gone or the layer has been removed.
  void RequireUsable(const char* aFunction) const;
  /// Returns "Class::function", for error texts.
  std::string Fun(const char* aFunction) const;
  int LayerNumber() const { return mLayer; }
  CellKind Cells() const { return mKind; }
  /// The colour of a binary layer's cells.
  ImageColour_t MarkColour() const;
  void SetMarkColour(const ImageColour_t& aColour);
  /// Marks the layer as removed: all drawing and reading throws from now on.
  void Retire() { mRetired.store(true, std::memory_order_release); }
  bool Retired() const { return mRetired.load(std::memory_order_acquire); }

  const std::shared_ptr<playerlike::ClientCore>& Core() const { return mCore; }

 private:
  std::uint32_t MarkOf(const ImageColour_t& aColour) const;
  ImageColour_t ColourOf(std::uint32_t aValue) const;
  void PutSpan(double aFirst, double aLast, int aY, std::uint32_t aValue);
  template <typename Write>
  void Put(Write aWrite);
  void MakeRoom();
  void Refresh() const;
  playerlike::CanvasInfo Canvas() const;  // of the last Refresh()

  std::shared_ptr<playerlike::ClientCore> mCore;
  playerlike::DrawQueue* mQueue;  // owned by the core's session
  const char* mName;
  int mLayer;
  CellKind mKind;
  std::atomic<bool> mRetired;
  std::atomic<std::uint32_t> mMarkColour;
  // Cached size of the grid-map; mGeneration is the count of resizes for which it is valid. The
  // mutex serialises threads that update the cache.
  mutable std::mutex mSizeMutex;
  mutable std::atomic<std::uint64_t> mGeneration;
  mutable std::atomic<int> mWidth;
  mutable std::atomic<int> mHeight;
  double mCellSize;
  double mOriginX;
  double mOriginY;
};

/// Common base of WindowProxy and MorsePen: draws on "canvas", the lowest layer of the grid-map,
/// which all robots of a world share.
class CanvasDrawing : public Drawing {
 public:
  ~CanvasDrawing() override;

  /// Resizes the grid-map immediately, with all layers of all clients. Drawings keep their
  /// positions in the world: the bottom left corner is fixed, columns are added or removed at the
  /// right, and rows at the top. Since rows are counted from the top, the row numbers of cells
  /// change; GetY() returns the new ones.
  /// @throws PlayerError kBadArgument for a width or height outside 1..8192, or if all layers
  ///         together would be too large.
  void Resize(int aWidth, int aHeight);

  /// Writes the composition of all visible layers as a PNG file to the run's output folder
  /// (`playpen run --out FOLDER`, PLAYPEN_OUT), with aScale x aScale pixels per cell.
  /// @param aName  file name without folders; ".png" is appended if it is missing.
  /// @throws PlayerError kBadArgument for a name that is not a plain file name or a scale outside
  ///         1..64; kNotAvailable if the run has no output folder.
  void SaveImage(const std::string& aName, int aScale = 1) const;

  /// Returns the composition of all visible layers of all clients, row by row from the top, with 4
  /// (RGBA) or 3 (RGB) bytes per cell.
  std::vector<std::uint8_t> GetComposedImage(int aChannels = 4) const;

  /// Sets how pictures show the grid-map from now on.
  /// @throws PlayerError kNotAvailable if the world file has locked another mode.
  void SetViewMode(ViewMode aMode);
  ViewMode GetViewMode() const;

 protected:
  CanvasDrawing(std::shared_ptr<playerlike::ClientCore> aCore, const char* aName);
};

}  // namespace CCMorse
