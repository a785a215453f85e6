// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "render/layout.h"
#include "render/painter.h"
#include "render/text_box.h"
#include "sim/simulation/scene_snapshot.h"

/// Painting of what the arena controller does, and of moving obstacles.
namespace sim::render {

/// The outline of an obstacle in the picture.
[[nodiscard]] std::vector<Vec2> obstacle_outline(const ObstacleDescription& obstacle,
                                                 const Layout& layout);

/// Draws the shadows of rising and sinking blocks, which grow with the height. Must be called
/// before other solids are drawn.
void draw_moving_shadows(const SceneSnapshot& scene, const Layout& layout, Painter& painter);
/// Draws rising and sinking blocks, filled like a gauge up to their present height, and the marks
/// of blocks that wait.
void draw_moving_blocks(const SceneSnapshot& scene, const Layout& layout, Painter& painter);

/// Draws the paths of obstacles that follow one, faintly, on the floor.
void draw_tracks(const SceneSnapshot& scene, const Layout& layout, Painter& painter);
/// Draws the shadows of obstacles that move or can be pushed. Must be called before other solids
/// are drawn.
void draw_mover_shadows(const SceneSnapshot& scene, const Layout& layout, Painter& painter);
/// Draws obstacles that move or can be pushed.
void draw_movers(const SceneSnapshot& scene, const Layout& layout, Painter& painter);

/// Draws areas and outlines of traps on the floor.
void draw_traps(const SceneSnapshot& scene, const Layout& layout, Painter& painter);
/// Draws the outlines of traps again, faintly, above the blocks that cover them.
void draw_covered_traps(const SceneSnapshot& scene, const Layout& layout, Painter& painter);
/// The outline of a trap in the picture. Empty if it is not in the view or not drawable.
[[nodiscard]] std::vector<Vec2> trap_outline(const TrapMark& trap, const Layout& layout);

/// The age of an event relative to the longest time that events are shown, 0..1; > 1: not shown.
[[nodiscard]] double event_age(const SceneSnapshot& scene, const ArenaEvent& event);
/// Draws marks of the newest events at blocks and robots and, if `traps` are drawn, at them; they
/// fade and grow with their age.
void draw_events(const SceneSnapshot& scene, const Layout& layout, bool traps, Painter& painter);

/// Texts of the arena controller in a picture.
class Notices {
 public:
  /// Chooses the places of all texts.
  /// @param covered  a part of the picture with a mini-map; empty: none.
  /// @param floor    whether the picture shows the arena's floor, with traps.
  Notices(const SceneSnapshot& scene, const Layout& layout, const RenderOptions& options,
          const Rectangle& covered, bool floor);

  /// The places of all texts.
  [[nodiscard]] std::vector<Rectangle> places() const;

  /// Draws the names of traps.
  void draw_trap_names(Painter& painter) const;
  /// Draws texts on the scene, countdowns, the newest messages and points.
  void draw_panels(Painter& painter) const;

 private:
  /// The name of a trap, or points that a robot gets.
  struct Line {
    std::string text;
    TextStyle style;
    Rectangle place;
  };
  /// A row of the countdowns.
  struct Countdown {
    std::string name;
    std::string time;
    bool soon = false;
    double flash = 0.0;  ///< 1 when the timer acts, then falling to 0
  };

  void add_texts();
  void add_messages();
  void add_countdowns(const Rectangle& covered);
  void add_trap_names(const Rectangle& covered);
  void add_points(const Rectangle& covered);
  bool find_place(Line& name, const std::vector<Vec2>& outline, const std::vector<Rectangle>& taken,
                  const std::vector<Rectangle>& blocks) const;
  [[nodiscard]] Rectangle corner_for(const Vec2& size, const Rectangle& covered) const;
  void draw_text_box(const TextBox& box, Painter& painter) const;
  void draw_countdowns(Painter& painter) const;

  const SceneSnapshot& scene_;
  const Layout& layout_;
  std::vector<Line> trap_names_;
  std::vector<Line> points_;
  std::vector<TextBox> texts_;
  std::vector<TextBox> messages_;  ///< newest last
  std::vector<double> message_opacities_;
  std::vector<Countdown> countdowns_;
  std::string more_;  ///< how many countdowns are left out; may be empty
  TextStyle countdown_style_;
  Rectangle countdown_place_;
};

}  // namespace sim::render
