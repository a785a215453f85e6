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
  Vec2 low = Vec2::Zero();  ///< bottom left corner [m]
  Vec2 size = {1.0, 1.0};   ///< [m], each > 0
  bool fills_room = false;  ///< shows more of the world if the picture has space for it

  friend bool operator==(const ScenePart&, const ScenePart&) = default;
};

/// Source of the colours of robots, trails and fans.
enum class ColourBy {
  kWorld,  ///< the colours in the world
  kRobot,  ///< a different colour for each robot, by its index in the world
  kNone,   ///< one dark grey for all
};

/// Which parts of a scene to draw.
struct RenderOptions {
  int size_px = 1000;  ///< longer side of the picture, 64..8192; no text below 200
  int width_px = 0;    ///< with height_px: exact size of the picture, each 64..8192, with the arena
                       ///< in its centre; 0: `size_px` and the arena define the size
  int height_px = 0;
  bool canvas = true;  ///< the grid-map
  bool trails = true;  ///< of robots; and the paths of moving obstacles
  bool scans = true;   ///< laser fans, sonar cones, infrared rays, lines to fiducials
  bool names = true;
  bool legend = true;  ///< scale bar, world name, simulated time, and the visible layers' names
  bool goals = true;
  bool collisions = true;
  bool traps = true;   ///< of the arena controller, with their names
  bool timers = true;  ///< countdowns of the arena controller
  bool texts = true;   ///< texts and messages of the arena controller
  bool scores = true;  ///< points beside the robots, once a robot has some
  ColourBy colour_by = ColourBy::kWorld;
  /// Shows only this part; ignored in the view mode full-screen.
  std::optional<ScenePart> part = {};
  /// Shows the surroundings of the robot with this name instead of `part`; ignored in the view mode
  /// full-screen. "" or an unknown name: the whole arena.
  std::string follow = {};
  /// Width of these surroundings [m]; 0: 20 radii of the robot's footprint.
  double follow_width_m = 0.0;

  friend bool operator==(const RenderOptions&, const RenderOptions&) = default;
};

/// Draws scenes one after another, as for a film or a window. Keeps what does not change from one
/// picture to the next: floor, blocks, borders, texts, cells without drawings.
///
/// All view modes give a picture of the same size, which depends only on the arena and the options:
/// - ground: floor, canvas on it, docks, obstacles, borders, trails, laser fans, sonar cones with
///   an arc at the echo's distance, infrared rays, lines to fiducials in view, robots with their
///   bumpers, pressed segments in red. The W axes point right and up. The arena is as large as
///   margins and footer allow; a very narrow arena gets wider margins, so that the footer fits. A
///   disc of its colour marks a robot that is too small to be seen, a red ring a stalled robot, a
///   dark ring a marked one. Lights are drawn on the robots; texts that robots say appear beside
///   them in bubbles of at most two lines. Laser fans and trails end at the edge of the floor.
///   Coordinates that are not finite or too far away (1e9 pixels) are not drawn.
///   Of an arena controller: rising and sinking blocks, filled like a gauge up to their present
///   height, with an arrow; blocks that wait, with an hourglass; traps, dashed and in violet, paler
///   when switched off, and with a full line while a robot is inside; texts; at most six countdowns
///   in the corner that hides the least; marks of the events of the last simulated second.
/// - mini-map: like ground, but with a bare floor; the canvas, framed, with a dot for each robot,
///   is in the corner of the floor where it covers the least of obstacles and docks.
/// - full-screen: the canvas on white, centred, with each cell the same whole number of pixels
///   wide. A canvas with more cells than the picture has pixels is shrunk, so that each pixel shows
///   the mean of its cells. Robots are drawn on it at its scale and clipped at its edge, with their
///   lights, bumpers, rings, names, scores and bubbles as in the ground mode, and so are texts,
///   messages and countdowns; nothing else of the arena is drawn.
///
/// The legend names the visible layers except the base: a swatch of a layer's colour, for a grey
/// layer the shades of free, unknown and occupied. If space runs out, first the words for the
/// shades are left out, then the topmost layers, whose number is shown instead. It also shows the
/// verdict of an arena controller that has ended the run.
///
/// The same scene gives a bit-identical picture, whatever was drawn before. Not thread-safe, but
/// several renderers are independent. Deterministic; uses only the calling thread. Cost: a few
/// milliseconds at 800 px; tens of milliseconds for the first picture, and after an obstacle or the
/// size of the arena or picture has changed.
class SceneRenderer {
 public:
  /// @throws std::invalid_argument if size_px is out of range.
  explicit SceneRenderer(const RenderOptions& options = {});
  ~SceneRenderer();
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;

  /// Draws a scene in its view mode. The picture is valid until the next call.
  /// @throws std::invalid_argument if the number of the canvas's bytes does not match its
  ///     description.
  [[nodiscard]] const Image& draw(const SceneSnapshot& scene) {
    return draw(scene, scene.view_mode);
  }
  /// Draws a scene in another view mode than its own.
  [[nodiscard]] const Image& draw(const SceneSnapshot& scene, ViewMode mode);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Draws one picture of a scene: the same as SceneRenderer(options).draw(scene, mode), with less
/// memory.
/// @throws std::invalid_argument like SceneRenderer.
[[nodiscard]] Image draw_view(const SceneSnapshot& scene, ViewMode mode,
                              const RenderOptions& options);

/// Draws one picture of a scene in its view mode.
/// @throws std::invalid_argument like SceneRenderer.
[[nodiscard]] Image draw_view(const SceneSnapshot& scene, const RenderOptions& options = {});

/// Draws one picture of a scene in the view mode ground, whatever its own mode is.
/// @throws std::invalid_argument like SceneRenderer.
[[nodiscard]] Image draw_scene(const SceneSnapshot& scene, const RenderOptions& options = {});

/// Returns where draw_scene() draws a point: pixels from the top left corner of the picture, x
/// right, y down. The point may be outside the picture.
/// @param p_W  in W [m].
/// @throws std::invalid_argument if a size in the options is out of range.
[[nodiscard]] Vec2 place_in_picture(const SceneSnapshot& scene, const RenderOptions& options,
                                    const Vec2& p_W);

/// Draws the canvas alone, with `scale` x `scale` pixels per cell and transparent cells in white.
/// @throws std::invalid_argument if scale < 1, if a side of the picture would exceed 32768 pixels,
///     or if `rgba` does not have 4 bytes per cell.
[[nodiscard]] Image draw_canvas(const CanvasDescription& description,
                                const std::vector<std::uint8_t>& rgba, int scale);

/// Writes pictures of canvases as PNG, each the same as write_png(draw_canvas(...), path), without
/// the memory for the whole picture. If several have the same cells, one after the other, only the
/// first one is encoded. Not thread-safe, but several writers are independent.
class CanvasPngWriter {
 public:
  /// @throws std::invalid_argument like draw_canvas().
  /// @throws std::runtime_error like write_png().
  void write(const CanvasDescription& description, const std::vector<std::uint8_t>& rgba, int scale,
             const std::string& path);

 private:
  int width_ = 0;  ///< of the last canvas [cells]
  int scale_ = 0;
  std::vector<std::uint8_t> rgba_;
  std::vector<std::uint8_t> png_;
};

/// Writes one picture of a canvas, like CanvasPngWriter.
inline void write_canvas_png(const CanvasDescription& description,
                             const std::vector<std::uint8_t>& rgba, int scale,
                             const std::string& path) {
  CanvasPngWriter().write(description, rgba, scale, path);
}

/// Writes a PNG; equal pictures give equal bytes.
/// @throws std::runtime_error naming the file and the reason.
void write_png(const Image& image, const std::string& path);

/// Loads the module that draws text with OpenCV; otherwise the first picture loads it. Call this
/// before std::atexit() if the handler draws pictures: handlers run in reverse order, so the
/// module's own data then outlives the handler. Not needed otherwise. If the module is missing,
/// this function does nothing, and drawing the first picture reports the reason.
void prepare_pictures() noexcept;

/// Loads the module that encodes films, like prepare_pictures() for pictures.
void prepare_films() noexcept;

/// Writes a film, frame by frame. The file's extension selects the format: ".mp4" (H.264, or MPEG-4
/// Part 2 if FFmpeg lacks H.264) or ".avi" (Motion JPEG). A name without an extension, with a slash
/// at its end, or of an existing folder stands for a folder of pictures frame_000001.png,
/// frame_000002.png, ... A missing folder is created; frames of an earlier film in it are removed.
/// A film is complete after finish(), or when the writer is destroyed; without any frame, no file
/// and no new folder remains. Equal pictures give equal films on one machine. FFmpeg's H.264
/// encoder uses its own threads; their number depends on the processor and affects the encoded
/// bytes.
class FilmWriter {
 public:
  /// @param frames_per_second  1..1000; a folder of pictures does not store it.
  /// @throws std::runtime_error naming the file and the reason: the file or folder cannot be
  ///     created, the extension is unknown, or the rate is out of range.
  FilmWriter(const std::string& path, double frames_per_second);
  ~FilmWriter();
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) noexcept;

  /// Whether `path` has the name of a film that can be written, judged by its extension.
  [[nodiscard]] static bool is_film_name(const std::string& path);

  /// Adds a frame. All frames must have the size of the first one. Odd sides of a film are cut to
  /// even numbers.
  /// @throws std::runtime_error naming the file and the reason: another size, or no encoder.
  void add(const Image& frame);

  /// Number of bytes written to the disk so far.
  [[nodiscard]] std::uint64_t size() const;
  /// Completes the film. add() must not be called afterwards.
  /// @throws std::runtime_error naming the file if it is incomplete, e.g. because the disk is full.
  void finish();

  struct Impl;  ///< writer of one format of film

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace sim::render
