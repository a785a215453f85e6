// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <type_traits>

#include "libCCMorse/ImagePoint.h"
#include "libCCMorse/MorseError.h"

namespace playerlike {
class ClientCore;
}

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

/// A channel in 0..1, clamped, as 8 bits. @throws PlayerError kBadArgument for NaN.
std::uint8_t channel_of_share(double share);
/// A channel in 0..255, clamped.
template <typename T>
std::uint8_t channel_of_byte(T value) {
  const double number = static_cast<double>(value);
  return number <= 0.0     ? std::uint8_t(0)
         : number >= 255.0 ? std::uint8_t(255)
                           : static_cast<std::uint8_t>(value);
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

template <typename T>
T channel_value(std::uint8_t value, std::true_type) {
  return static_cast<T>(value / 255.0);
}
template <typename T>
T channel_value(std::uint8_t value, std::false_type) {
  return static_cast<T>(value);
}

}  // namespace detail

/// The grid-map (canvas) of a world, to draw on and to read: what WindowProxy, GridMapLayer
/// and MorsePen have in common.
///
/// Cells are named by column (from the left) and row (from the top, so row 0 is the highest y).
/// What lies outside the grid-map is clipped. Colours are given in one of three ways, each
/// with or without alpha: whole numbers in 0..255; numbers in 0..1, if at least one of them is a
/// floating point number; or a text "#34AAFF" (also "#3AF", and "#34AAFF80" with alpha). Numbers
/// outside are clamped. Without alpha a colour is opaque and replaces what is there, else it is
/// blended over it.
///
/// Drawings are carried out in order: this client sees them at once, others from the next step on.
/// Errors: PlayerError kBadArgument for NaN and for texts that are no colours, kDisconnected
/// when the client is gone. Threads: all members may be called from any thread.
class Drawing {
 public:
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;
  virtual ~Drawing();

  int GetWidth() const;        ///< columns
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
  /// @}

 protected:
  /// @param aName  class by whose name errors are thrown; a literal.
  Drawing(std::shared_ptr<playerlike::ClientCore> aCore, const char* aName);

  /// What a colour becomes before it is drawn.
  /// @return false if it is not to be drawn at all.
  virtual bool Shade(ImageColour_t& aColour) const;

  const std::shared_ptr<playerlike::ClientCore>& Core() const { return mCore; }

 private:
  void DrawPixel(int aX, int aY, ImageColour_t aColour);
  void DrawLine(int aX0, int aY0, int aX1, int aY1, ImageColour_t aColour);
  void Fill(const ImageColour_t& aColour);

  std::shared_ptr<playerlike::ClientCore> mCore;
  const char* mName;
  int mWidth;
  int mHeight;
  double mCellSize;
  double mOriginX;
  double mOriginY;
};

}  // namespace CCMorse
