// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/pose.h"
#include "sim/simulation/scene_snapshot.h"

namespace sim::render {

/// A picture: RGB bytes, row-major from the top left.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// A part of the world: a rectangle in W.
struct ScenePart {
  Vec2 low = Vec2::Zero();  ///< its bottom left corner [m]
  Vec2 size = {1.0, 1.0};   ///< [m], each > 0
  bool fills_room = false;  ///< shows more of the world where the picture has room to

  friend bool operator==(const ScenePart&, const ScenePart&) = default;
};

/// Where the colours of robots, trails and fans come from.
enum class ColourBy {
  kWorld,  ///< the world gives each robot its colour
  kRobot,  ///< each robot gets a colour of its own, by its place in the world
  kNone,   ///< one dark grey for all
};

/// What to draw of a scene.
struct RenderOptions {
  int size_px = 1000;  ///< the longer side of the picture, 64..8192; below 200 there is no text
  int width_px = 0;    ///< with height_px: the picture's exact size instead, each 64..8192, and the
                       ///< arena in the middle of it; 0: as high and wide as the arena needs
  int height_px = 0;
  bool canvas = true;  ///< the grid-map
  bool trails = true;
  bool scans = true;  ///< laser fans, sonar cones, infrared rays, lines to fiducials
  bool names = true;
  bool legend = true;  ///< scale bar, world name, simulated time, and the visible layers' names
  bool goals = true;
  bool collisions = true;
  ColourBy colour_by = ColourBy::kWorld;
  std::optional<ScenePart> part = {};  ///< shows this alone, not in the view mode full-screen
  std::string follow = {};  ///< shows what is round the robot of that name, instead of `part`, not
                            ///< in the view mode full-screen; "" or no such robot: all
  double follow_width_m = 0.0;  ///< of what is shown round it; 0: twenty radii of its footprint

  friend bool operator==(const RenderOptions&, const RenderOptions&) = default;
};

/// Draws scenes one after another, as for a film or a window: what does not change from one
/// picture to the next (floor, blocks, borders, texts, cells that nobody drew on) is kept.
///
/// The view modes, all in a picture of one size, which depends on the arena and the options alone:
/// - ground: floor, canvas on it, docks, obstacles, borders, trails, laser fans, sonar cones with
///   an arc where the echo came from, infrared rays, lines to fiducials in view, robots with their
///   bumpers, pressed segments in red. The W axes
///   point right and up. The arena is as large as margins and footer let it; a very narrow one gets
///   wider margins, so that the footer has room. A robot too small to be seen is marked by a disc
///   of its colour, one that is stalled by a red ring, one that is marked by a dark one. Lights lie
///   on the robots; what robots say stands beside them in bubbles of two lines at most. Laser fans
///   and trails end at the edge of the floor. Coordinates that are not finite or absurdly far away
///   (1e9 pixels) are left out.
/// - mini-map: the same with a bare floor; the canvas, framed, with a dot for each robot, in that
///   corner of the floor where it covers least of obstacles and docks.
/// - full-screen: the canvas on white, each cell the same whole number of pixels wide, in the
///   middle of the picture. One with more cells than the picture has pixels is shrunk, each pixel
///   showing the mean of the cells under it. The robots stand on it, at its scale and cut off at
///   its edge, with their lights, bumpers, rings, names and bubbles as on the ground; nothing else
///   of the arena is drawn.
///
/// The legend names the visible layers but the base: a swatch of a layer's colour, for a grey layer
/// the shades of free, unknown and occupied. What has no room is left out: first the words for
/// the shades, then the topmost layers, whose number is told instead.
///
/// The same scene gives the same picture to the bit, whatever was drawn before.
/// Not thread-safe; several renderers are independent of one another. Deterministic, on the calling
/// thread. Cost: a few milliseconds at 800 px; tens for the first picture and when an obstacle, the
/// arena's or the picture's size has changed.
class SceneRenderer {
 public:
  /// @throws std::invalid_argument if size_px is out of range.
  explicit SceneRenderer(const RenderOptions& options = {});
  ~SceneRenderer();
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;

  /// Draws a scene in its view mode. The picture may be read until the next call.
  /// @throws std::invalid_argument if the canvas has not as many bytes as its description says.
  [[nodiscard]] const Image& draw(const SceneSnapshot& scene) {
    return draw(scene, scene.view_mode);
  }
  /// As above, in another view mode than its own.
  [[nodiscard]] const Image& draw(const SceneSnapshot& scene, ViewMode mode);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One picture of a scene in its view mode: SceneRenderer(options).draw(scene).
/// @throws std::invalid_argument as SceneRenderer.
[[nodiscard]] Image draw_view(const SceneSnapshot& scene, const RenderOptions& options = {});

/// One picture of a scene in the view mode ground, whatever its own is.
/// @throws std::invalid_argument as SceneRenderer.
[[nodiscard]] Image draw_scene(const SceneSnapshot& scene, const RenderOptions& options = {});

/// Draws the canvas alone, each cell `scale` pixels a side, transparent cells as white.
/// @throws std::invalid_argument if scale < 1, a side of the picture were over 32768 pixels, or
///     `rgba` has not 4 bytes a cell.
[[nodiscard]] Image draw_canvas(const CanvasDescription& description,
                                const std::vector<std::uint8_t>& rgba, int scale);

/// How much work goes into making a PNG small.
enum class PngEffort {
  kQuick,  ///< a few times faster, the file a third larger or so
  kSmall,
};

/// Writes a PNG; equal pictures give equal bytes. @throws std::runtime_error naming the file and
/// the reason.
void write_png(const Image& image, const std::string& path, PngEffort effort = PngEffort::kSmall);

/// Loads what draws letters: OpenCV, in a module of its own, which otherwise the first picture
/// loads. Call it before std::atexit() with a handler that draws pictures: handlers run in reverse
/// order, so what the module keeps then outlives the handler. Not needed otherwise. Where the
/// module is missing, this does nothing, and the first picture tells why.
void prepare_pictures() noexcept;

/// Loads what encodes films, as prepare_pictures() does for pictures.
void prepare_films() noexcept;

/// Writes a film, frame by frame: ".mp4" (H.264, or MPEG-4 Part 2 where FFmpeg lacks that) or
/// ".avi" (Motion JPEG) by the file's ending, or a folder of pictures frame_000001.png,
/// frame_000002.png, ... if the name has no ending, ends in a slash or is that of a folder. A
/// folder that is not there is made; frames of an earlier film in it are removed. A film is
/// complete after finish(), or when the writer is destroyed; without a frame no file and no new
/// folder remains. Equal pictures give equal films on one machine; FFmpeg's encoder of H.264 uses
/// threads of its own, as many as suit the processors, and its bytes depend on how many.
class FilmWriter {
 public:
  /// @param frames_per_second  1..1000; a folder of pictures does not keep it.
  /// @throws std::runtime_error naming the file and the reason: the file or folder cannot be made,
  ///     the ending is unknown, or the rate is out of range.
  FilmWriter(const std::string& path, double frames_per_second);
  ~FilmWriter();
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) noexcept;

  /// Whether `path` is the name of a film that can be written, by its ending.
  [[nodiscard]] static bool is_film_name(const std::string& path);

  /// All frames must have the size of the first (the film's sides are cut to even numbers).
  /// @throws std::runtime_error naming the file and the reason: another size, or no encoder.
  void add(const Image& frame);

  /// Bytes that it has on the disk by now.
  [[nodiscard]] std::uint64_t size() const;
  /// Completes the film. add() must not be called afterwards.
  /// @throws std::runtime_error naming the file if it is not whole, as when the disk was full.
  void finish();

  struct Impl;  ///< what writes one kind of film

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace sim::render
