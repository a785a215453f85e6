// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

/// The interface of the picture modules to libsim, which loads them when a picture or a film is
/// needed (see modules/module_file.h). Only the modules link OpenCV and FFmpeg: they load up to 250
/// other libraries, which takes a tenth of a second.
///
/// Each module exports one function, whose name is given here. It returns a table of functions that
/// is valid for the lifetime of the process. No exception leaves a module. A module and the libsim
/// that loads it must come from the same build; the interface is identified only by Playpen's
/// version.
namespace sim::render::modules {

/// Callbacks that receive the outline of a character as closed contours. Each contour has a start
/// and consecutive parts. The unit is the height of a capital letter; x right, y up, (0, 0) on the
/// base line. The solid area is on the right of a contour.
struct OutlineSink {
  void* context;  ///< passed to each callback
  void (*start)(void* context, double x, double y);
  void (*line)(void* context, double x, double y);
  /// Adds a parabola, defined by its control point and its end.
  void (*curve)(void* context, double control_x, double control_y, double x, double y);
};

/// The functions of `libplaypen_text.so`: text in the Hershey font "simplex" (OpenCV's putText),
/// and outlines of the other characters in the system's font DejaVu Sans (FreeType).
struct TextFunctions {
  /// Playpen's version that the module was built with.
  const char* version;

  /// Width of a text [pixels].
  /// @param scale   font scale; capital letters are 21 pixels high at 1.
  /// @param stroke  width of the strokes [pixels], at least 1.
  int (*width)(const char* text, double scale, int stroke);

  /// Draws an anti-aliased text in white into a grey raster.
  /// @param x, y    left end of the base line [pixels], from the top left corner.
  /// @param raster  row-major, width * height bytes.
  /// @return whether drawing succeeded.
  bool (*draw)(const char* text, int x, int y, double scale, int stroke, std::uint8_t* raster,
               int width, int height);

  /// Passes the outline of a character to the sink. Thread-safe.
  /// @param advance  output: distance to the next character [heights of a capital letter].
  /// @return false if the font does not contain the character, if there is no font, or if the
  ///         module was built without FreeType.
  bool (*outline)(std::uint32_t code_point, const OutlineSink& sink, double* advance);
};

/// Name and type of the function that the text module exports.
inline constexpr const char* kTextEntry = "playpen_text_functions";
using TextEntry = const TextFunctions* (*)();

/// A film in progress.
struct FilmEncoder;

/// The functions of `libplaypen_film.so`: FFmpeg's encoders and files.
struct FilmFunctions {
  /// Playpen's version that the module was built with.
  const char* version;

  /// Starts a film in a file.
  /// @param motion_jpeg    true: Motion JPEG in an AVI; false: H.264 or MPEG-4 Part 2 in an MP4.
  /// @param width, height  of its frames [pixels], even.
  /// @param problem        receives the reason of a failure as a null-terminated text, truncated to
  ///     `problem_size` bytes.
  /// @return the film, which close() must end; null on failure.
  FilmEncoder* (*open)(const char* path, bool motion_jpeg, double frames_per_second, int width,
                       int height, char* problem, std::size_t problem_size);

  /// Adds a frame.
  /// @param rgb     RGB bytes, row-major from the top left, of at least the film's size.
  /// @param stride  bytes from one row to the next.
  /// @return whether the frame was added; if not, `problem` receives the reason.
  bool (*add)(FilmEncoder* film, const std::uint8_t* rgb, std::size_t stride, char* problem,
              std::size_t problem_size);

  /// Completes the film, and destroys the encoder.
  /// @return whether all of it is in the file; if not, `problem` receives the reason.
  bool (*close)(FilmEncoder* film, char* problem, std::size_t problem_size);
};

/// Name and type of the function that the film module exports.
inline constexpr const char* kFilmEntry = "playpen_film_functions";
using FilmEntry = const FilmFunctions* (*)();

}  // namespace sim::render::modules
