// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

/// What the modules of pictures offer to libsim, which loads them when a picture or a film is
/// wanted (see modules/module_file.h). OpenCV is linked by the modules only: its libraries bring
/// up to 250 others along, which take a tenth of a second to load.
///
/// Each module exports one function, whose name is given here. It returns a table of functions
/// that stays valid for as long as the process runs. No exception leaves a module. A module and the
/// libsim that loads it come from one build: the interface is told apart by Playpen's version only.
namespace sim::render::modules {

/// Who is told the outline of a character: closed contours, each of a start and parts that follow
/// one another. Unit: the height of a capital letter; x right, y up, (0, 0) on the base line. What
/// is solid lies on the right of a contour.
struct OutlineSink {
  void* context;  ///< given back in each call
  void (*start)(void* context, double x, double y);
  void (*line)(void* context, double x, double y);
  /// A parabola: its control point, then its end.
  void (*curve)(void* context, double control_x, double control_y, double x, double y);
};

/// The table of `libplaypen_text.so`: letters of the Hershey font "simplex" (OpenCV's putText), and
/// outlines of the characters that it lacks, of the font DejaVu Sans of the system (FreeType).
struct TextFunctions {
  /// The version of Playpen that the module belongs to.
  const char* version;

  /// Width of a text [pixels].
  /// @param scale   size of the letters; capitals are 21 pixels high at 1.
  /// @param stroke  width of the strokes [pixels], at least 1.
  int (*width)(const char* text, double scale, int stroke);

  /// Draws a text in white, with smooth edges, into a grey raster.
  /// @param x, y    left end of the base line [pixels], from the top left corner.
  /// @param raster  row-major, width * height bytes.
  /// @return whether it could be drawn.
  bool (*draw)(const char* text, int x, int y, double scale, int stroke, std::uint8_t* raster,
               int width, int height);

  /// Tells the outline of a character. Safe from many threads.
  /// @param advance  gets the distance to the next character, in heights of a capital letter.
  /// @return false if there is no such character, no font, or the module was built without
  /// FreeType.
  bool (*outline)(std::uint32_t code_point, const OutlineSink& sink, double* advance);
};

/// Name and type of the function that the text module exports.
inline constexpr const char* kTextEntry = "playpen_text_functions";
using TextEntry = const TextFunctions* (*)();

/// A film that is being written.
struct FilmEncoder;

/// The table of `libplaypen_film.so`: OpenCV's VideoWriter.
struct FilmFunctions {
  /// The version of Playpen that the module belongs to.
  const char* version;

  /// Begins a film in a file.
  /// @param motion_jpeg    Motion JPEG in an AVI, else H.264, or MPEG-4 Part 2, in an MP4.
  /// @param width, height  of its frames [pixels], even.
  /// @param problem        gets the reason if there is no film: text that ends with 0, cut to
  ///                       `problem_size` bytes.
  /// @return the film, to be given to close(); null if there is none.
  FilmEncoder* (*open)(const char* path, bool motion_jpeg, double frames_per_second, int width,
                       int height, char* problem, std::size_t problem_size);

  /// Adds a frame.
  /// @param rgb     RGB bytes, row-major from the top left, of at least the film's size.
  /// @param stride  bytes from one row to the next.
  /// @return whether it could be added; if not, `problem` gets the reason.
  bool (*add)(FilmEncoder* film, const std::uint8_t* rgb, std::size_t stride, char* problem,
              std::size_t problem_size);

  /// Completes the film.
  void (*close)(FilmEncoder* film);
};

/// Name and type of the function that the film module exports.
inline constexpr const char* kFilmEntry = "playpen_film_functions";
using FilmEntry = const FilmFunctions* (*)();

}  // namespace sim::render::modules
