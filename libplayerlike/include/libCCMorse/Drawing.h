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

/// void if all types are numbers; else the overload does not exist.
template <typename... Ts>
using if_numbers = typename std::enable_if<all_numbers<Ts...>::value>::type;

/// void if the type is a text (a literal, a std::string, ...); else the overload does not exist.
template <typename T>
using if_text = typename std::enable_if<std::is_convertible<const T&, std::string>::value>::type;

/// A channel in 0..1, clamped, as 8 bits. @throws PlayerError kBadArgument unless it is finite.
std::uint8_t channel_of_unusual_share(double share);
inline std::uint8_t channel_of_share(double share) {
  return share >= 0.0 && share <= 1.0 ? static_cast<std::uint8_t>(share * 255.0 + 0.5)
                                      : channel_of_unusual_share(share);
}
/// A channel in 0..255, clamped, from a whole number of any type.
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

/// A colour from numbers: if any is a floating point number, all are shares in 0..1, else all are
/// bytes in 0..255. What lies outside is clamped.
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
/// A colour from "#RGB", "#RRGGBB" or "#RRGGBBAA".
/// @throws PlayerError kBadArgument for any other text.
ImageColour_t colour_of_text(const std::string& text);
/// The same with an alpha of its own, instead of the text's.
template <typename A>
ImageColour_t colour_of_text(const std::string& text, A alpha) {
  ImageColour_t c = colour_of_text(text);
  c.a = channel<std::is_floating_point<A>::value>::of(alpha);
  return c;
}
/// "#rrggbb", or "#rrggbbaa" where alpha is not 255.
std::string text_of_colour(const ImageColour_t& c);

/// A colour from whatever describes one; opaque unless it says otherwise.
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

/// A layer of the grid-map of a world, to draw on and to read: what WindowProxy, GridMapLayer and
/// MorsePen have in common.
///
/// Cells are named by column (from the left) and row (from the top, so row 0 is the highest y);
/// functions whose names end in Metres take positions in the world W [m] instead. What lies outside
/// the grid-map is clipped. Colours are given in one of three ways, each with or without alpha:
/// whole numbers in 0..255; numbers in 0..1, if at least one of them is a floating point number; or
/// a text "#34AAFF" (also "#3AF", and "#34AAFF80" with alpha). Numbers outside are clamped. Without
/// alpha a colour is opaque and replaces what is there, else it is blended over it.
///
/// Drawings are executed in order: this client sees them at once, others from the next step on
/// at the latest. Errors: PlayerError kBadArgument for what is not finite and for texts that are no
/// colours, kDisconnected when the client is gone. Threads: all members may be called from any
/// thread. Cost: about 20 ns a cell; a buffer holds thousands of drawings before they are executed.
class Drawing {
 public:
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;
  virtual ~Drawing();

  int GetWidth() const;        ///< columns; like all that follow, as they are now
  int GetHeight() const;       ///< rows
  double GetCellSize() const;  ///< side of a cell [m]

  /// Column of an x coordinate in the world [m]; below 0 or not below GetWidth() outside.
  int GetX(double aX) const;
  /// Row of a y coordinate in the world [m]; below 0 or not below GetHeight() outside.
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

  /// @name A line between two cells, both drawn
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
  /// The colour is given as for SetPixel().
  /// @{
  /// The cell of a position.
  template <typename... Colour>
  void SetPixelMetres(double aX, double aY, const Colour&... aColour) {
    DrawPixel(GetX(aX), GetY(aY), detail::make_colour(aColour...));
  }
  /// A line between the cells of two positions.
  template <typename... Colour>
  void SetLineMetres(double aX0, double aY0, double aX1, double aY1, const Colour&... aColour) {
    DrawLine(GetX(aX0), GetY(aY0), GetX(aX1), GetY(aY1), detail::make_colour(aColour...));
  }
  /// Lines from each position to the next; a cell where two meet is drawn twice.
  template <typename... Colour>
  void SetPolylineMetres(const std::vector<player_point_2d_t>& aPoints, const Colour&... aColour) {
    DrawPolyline(aPoints.data(), aPoints.size(), detail::make_colour(aColour...));
  }
  /// A filled polygon: the cells whose middles lie inside (by the even-odd rule), each once.
  template <typename... Colour>
  void SetPolygonMetres(const std::vector<player_point_2d_t>& aPoints, const Colour&... aColour) {
    FillPolygon(aPoints.data(), aPoints.size(), detail::make_colour(aColour...));
  }
  /// A filled disc: the cells whose middles lie within aRadius [m] of the position, each once; at
  /// least the cell of the position. @throws PlayerError kBadArgument for a negative radius.
  template <typename... Colour>
  void SetDiscMetres(double aX, double aY, double aRadius, const Colour&... aColour) {
    FillDisc(aX, aY, aRadius, detail::make_colour(aColour...));
  }
  /// @}

  /// @name The whole grid-map
  /// @{
  /// Makes every cell transparent.
  void Clear() { Fill(ImageColour_t(0, 0, 0, 0)); }
  /// Gives every cell this colour, without blending.
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

  /// Gives every cell its colour from a picture, without blending: GetWidth() * GetHeight() cells,
  /// row by row from the top, 3 (RGB) or 4 (RGBA) bytes each.
  /// @throws PlayerError kBadArgument for any other number of bytes.
  void SetImage(const std::uint8_t* aImage, std::size_t aBytes);
  void SetImage(const std::vector<std::uint8_t>& aImage) { SetImage(aImage.data(), aImage.size()); }
  /// SetPixel() for each of a list.
  void UpdateImage(const std::vector<ImagePixel_t>& aPixels);
  /// @}

  /// @name What is there
  /// A cell outside the grid-map is refused with PlayerError kBadArgument. A cell nobody has drawn
  /// on is transparent black.
  /// @{
  ImageColour_t GetPixel(int aX, int aY) const;
  ImageColour_t GetPixel(const ImagePoint_t& aPoint) const { return GetPixel(aPoint.x, aPoint.y); }
  /// Into variables of one type: whole numbers get 0..255, floating point ones 0..1.
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
  /// As "#rrggbb", or "#rrggbbaa" unless it is opaque.
  void GetPixel(int aX, int aY, std::string& aColour) const {
    aColour = detail::text_of_colour(GetPixel(aX, aY));
  }
  /// All cells, row by row from the top, 4 (RGBA) or 3 (RGB) bytes each.
  /// @throws PlayerError kBadArgument for another number of channels.
  std::vector<std::uint8_t> GetImage(int aChannels = 4) const;
  /// The same into a buffer that is made as large as needed.
  void GetImage(std::vector<std::uint8_t>& aImage, int aChannels = 4) const {
    aImage = GetImage(aChannels);
  }
  /// @}

 protected:
  /// What the cells of a layer hold.
  enum CellKind { COLOUR_CELLS, BINARY_CELLS, GREY_CELLS };

  /// @param aName   class by whose name errors are thrown; a literal.
  /// @param aLayer  number of the layer; 0 is the canvas that all share.
  Drawing(std::shared_ptr<playerlike::ClientCore> aCore, const char* aName, int aLayer = 0,
          CellKind aKind = COLOUR_CELLS);

  // In cells, from values that are colours already.
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

  /// What a cell holds, as sim::CellValue does.
  void PutPixel(int aX, int aY, std::uint32_t aValue);
  void PutLine(int aX0, int aY0, int aX1, int aY1, std::uint32_t aValue);
  /// What a cell of this layer holds when it is drawn in a colour: the colour; set, unless alpha
  /// is 0; or how dark it is, from 0 (white) to 1 (black), 0.5 if alpha is 0.
  std::uint32_t ValueOf(const ImageColour_t& aColour) const {
    // In registers; copying the four bytes at once would wait for them to reach memory.
    const std::uint32_t r = aColour.r, g = aColour.g, b = aColour.b, a = aColour.a;
    return mKind == COLOUR_CELLS ? r | g << 8U | b << 16U | a << 24U : MarkOf(aColour);
  }

  /// Contents of a cell. @throws PlayerError kBadArgument outside the grid-map.
  std::uint32_t CellAt(int aX, int aY, const char* aFunction) const;

  /// Throws PlayerError if the client is gone or the layer removed.
  void RequireUsable(const char* aFunction) const;
  /// "Class::function", for errors.
  std::string Fun(const char* aFunction) const;
  int LayerNumber() const { return mLayer; }
  CellKind Cells() const { return mKind; }
  /// The colour of a binary layer's cells.
  ImageColour_t MarkColour() const;
  void SetMarkColour(const ImageColour_t& aColour);
  /// From now on all drawing and reading throws: the layer is gone.
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

  std::shared_ptr<playerlike::ClientCore> mCore;
  playerlike::DrawQueue* mQueue;  // of the core's session
  const char* mName;
  int mLayer;
  CellKind mKind;
  std::atomic<bool> mRetired;
  std::atomic<std::uint32_t> mMarkColour;
  // Size of the grid-map as of a count of resizes; the mutex serialises those who look it up.
  mutable std::mutex mSizeMutex;
  mutable std::atomic<std::uint64_t> mGeneration;
  mutable std::atomic<int> mWidth;
  mutable std::atomic<int> mHeight;
  double mCellSize;
  double mOriginX;
  double mOriginY;
};

/// The grid-map that all robots of a world share: drawing here is drawing on its lowest layer,
/// "canvas". What WindowProxy and MorsePen have in common.
class CanvasDrawing : public Drawing {
 public:
  ~CanvasDrawing() override;

  /// Gives the grid-map, with all layers of all clients, another size, at once. What is drawn stays
  /// where it is in the world: the bottom left corner stays; columns are added or cut off at the
  /// right, rows at the top. As rows count from the top, cells get other numbers: GetY() knows.
  /// @throws PlayerError kBadArgument for sides outside 1..8192, or if all layers together would
  ///         get too large.
  void Resize(int aWidth, int aHeight);

  /// Writes the grid-map, all visible layers over one another, as a PNG with aScale x aScale pixels
  /// a cell into the run's output folder (`playpen run --out FOLDER`, PLAYPEN_OUT).
  /// @param aName  of the file, without folders; ".png" is added unless it is there.
  /// @throws PlayerError kBadArgument for a name that is not a plain file name or a scale outside
  ///         1..64; kNotAvailable if the run has no output folder.
  void SaveImage(const std::string& aName, int aScale = 1) const;

  /// All visible layers of all clients over one another, row by row from the top, 4 (RGBA) or 3
  /// (RGB) bytes a cell.
  std::vector<std::uint8_t> GetComposedImage(int aChannels = 4) const;

  /// How pictures show the grid-map from now on.
  /// @throws PlayerError kNotAvailable if the world has locked another mode.
  void SetViewMode(ViewMode aMode);
  ViewMode GetViewMode() const;

 protected:
  CanvasDrawing(std::shared_ptr<playerlike::ClientCore> aCore, const char* aName);
};

}  // namespace CCMorse
