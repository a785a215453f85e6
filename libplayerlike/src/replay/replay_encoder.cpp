// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/replay/replay_encoder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "playerlike/replay/columns.h"
#include "sim/core/math.h"
#include "sim/render/palette.h"
#include "sim/world/outline.h"

namespace playerlike::replay {
namespace {

using nlohmann::json;

json text_json(sim::Colour colour) { return to_string(colour); }

json polygon_json(const std::vector<sim::Vec2>& points) {
  json all = json::array();
  for (const sim::Vec2& p : points) {
    all.push_back({static_cast<double>(quantised(p.x(), kPlaceUnit_m)) * kPlaceUnit_m,
                   static_cast<double>(quantised(p.y(), kPlaceUnit_m)) * kPlaceUnit_m});
  }
  return all;
}

json polygons_json(const std::vector<std::vector<sim::Vec2>>& polygons) {
  json all = json::array();
  for (const auto& polygon : polygons) all.push_back(polygon_json(polygon));
  return all;
}

// Every n-th index below `count`; with the last one if asked for.
std::vector<std::size_t> kept_indices(std::size_t count, std::size_t stride, bool with_last) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; stride > 0 && i < count; i += stride) kept.push_back(i);
  if (with_last && count > 0 && (kept.empty() || kept.back() != count - 1)) {
    kept.push_back(count - 1);
  }
  return kept;
}

// A unit in which the numbers are whole or have about seven digits.
double unit_of(const std::vector<double>& values) {
  double greatest = 0.0;
  bool whole = true;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    greatest = std::max(greatest, std::abs(value));
    whole = whole && value == std::round(value);
  }
  if (whole && greatest < 2e9) return 1.0;
  const double digits = std::ceil(sim::math::log10(std::max(greatest, 1e-12)));
  return sim::math::pow(10.0, std::max(digits - 7.0, greatest >= 0.01 ? -4.0 : -12.0));
}

class RunEncoder {
 public:
  RunEncoder(const ReplayRun& run, const Thinning& thinning, Columns& columns)
      : run_(run),
        thinning_(thinning),
        columns_(columns),
        frames_(kept_indices(run.frames_ns.size(), thinning.samples, true)) {}

  json encode() {
    json out = {{"name", run_.name},
                {"world", run_.world},
                {"end", run_.end_ns / kMicrosecond_ns},
                {"arena", arena()},
                {"canvas", canvas()},
                {"frames", times(run_.frames_ns, frames_)},
                {"robots", json::array()},
                {"obstacles", obstacles()},
                {"tracks", json::array()},
                {"devices", json::array()},
                {"traps", json::array()},
                {"timers", run_.timers},
                {"notes", run_.notes}};
    for (const RobotLog& robot : run_.robots) out["robots"].push_back(of(robot));
    for (const sim::TrapMark& trap : run_.traps) {
      out["traps"].push_back({{"name", trap.name},
                              {"outline", polygon_json(trap.outline)},
                              {"center", {trap.center.x(), trap.center.y()}},
                              {"radius", trap.radius_m}});
    }
    for (const sim::ObstacleTrack& track : run_.tracks) {
      out["tracks"].push_back({{"obstacle", track.obstacle},
                               {"points", polygon_json(track.points)},
                               {"closed", track.closed}});
    }
    for (const DeviceLog& device : run_.devices) out["devices"].push_back(of(device));
    add_happenings(out);
    add_program(out);
    out["layers"] = layers();
    return out;
  }

  // What a part of a run adds, see encoded_part().
  json encode_part() {
    json out = {{"end", run_.end_ns / kMicrosecond_ns},
                {"frames", times(run_.frames_ns, frames_)},
                {"robots", json::array()},
                {"obstacles", json::array()},
                {"devices", json::array()},
                {"layers", json::array()},
                {"notes", run_.notes}};
    for (const RobotLog& robot : run_.robots) out["robots"].push_back(motion_of(robot));
    const auto add = [](json& list, std::size_t index, json entry) {
      entry["i"] = index;
      list.push_back(std::move(entry));
    };
    for (std::size_t i = 0; i < run_.obstacles.size(); ++i) {
      if (run_.obstacles[i].times_ns().empty()) continue;
      add(out["obstacles"], i, {{"log", of(run_.obstacles[i])}});
    }
    for (std::size_t i = 0; i < run_.devices.size(); ++i) {
      if (!run_.devices[i].times_ns.empty()) add(out["devices"], i, readings_of(run_.devices[i]));
    }
    for (std::size_t i = 0; i < run_.layers.size(); ++i) {
      const LayerLog& layer = run_.layers[i];
      if (layer.is_known && layer.changes.empty()) continue;
      add(out["layers"], i, layer.is_known ? changes_of(layer) : of(layer));
    }
    add_happenings(out);
    add_program(out);
    return out;
  }

 private:
  static constexpr sim::SimTime kMicrosecond_ns = 1000;

  std::size_t times(const std::vector<sim::SimTime>& all, const std::vector<std::size_t>& kept) {
    std::vector<std::int64_t> values;
    for (const std::size_t i : kept) values.push_back(all[i] / kMicrosecond_ns);
    return columns_.add(values);
  }

  template <typename List, typename Value>
  std::size_t column(const List& list, const std::vector<std::size_t>& kept, Value value) {
    std::vector<std::int64_t> values;
    for (const std::size_t i : kept) values.push_back(value(list[i]));
    return columns_.add(values);
  }

  // Headings without jumps, so that their differences are small.
  std::size_t headings(const std::vector<sim::Pose>& poses, const std::vector<std::size_t>& kept) {
    std::vector<std::int64_t> values;
    double turned_rad = 0.0;
    for (const std::size_t i : kept) {
      turned_rad += std::remainder(poses[i].yaw_rad - turned_rad, 2.0 * std::numbers::pi);
      values.push_back(quantised(turned_rad, kAngleUnit_rad));
    }
    return columns_.add(values);
  }

  json poses(const std::vector<sim::Pose>& all, const std::vector<std::size_t>& kept) {
    const auto place = [](double metres) { return quantised(metres, kPlaceUnit_m); };
    return {{"x", column(all, kept, [&](const sim::Pose& p) { return place(p.x_m); })},
            {"y", column(all, kept, [&](const sim::Pose& p) { return place(p.y_m); })},
            {"a", headings(all, kept)}};
  }

  json of(const ChangeLog& log) {
    std::vector<std::int64_t> at;
    for (const sim::SimTime time_ns : log.times_ns()) at.push_back(time_ns / kMicrosecond_ns);
    const std::optional<std::size_t> length = log.common_length();
    const std::size_t lag = std::max<std::size_t>(length.value_or(1), 1);
    return {{"t", columns_.add(at)},
            {"n", columns_.add(log.lengths())},
            {"v", columns_.add(log.values(), lag)}};
  }

  json arena() {
    const sim::ArenaDescription& arena = run_.arena;
    json out = {{"origin", {arena.origin.x(), arena.origin.y()}},
                {"size", {arena.size.x(), arena.size.y()}},
                {"border", arena.border},
                {"docks", json::array()},
                {"separators", json::array()}};
    for (const sim::DockDescription& dock : arena.docks) {
      out["docks"].push_back(
          {{"name", dock.name}, {"corners", polygon_json(sim::box_corners(dock.pose, dock.size))}});
    }
    for (const sim::ObstacleDescription& box : arena.dock_separators) {
      out["separators"].push_back(polygon_json(sim::box_corners(box)));
    }
    std::vector<std::int64_t> lengths;
    std::vector<std::int64_t> solid;
    std::vector<std::int64_t> points;
    for (const sim::WallLoop& loop : arena.walls) {
      lengths.push_back(static_cast<std::int64_t>(loop.vertices.size()));
      solid.push_back(loop.solid ? 1 : 0);
      for (const sim::Vec2& p : loop.vertices) {
        points.push_back(quantised(p.x(), kPlaceUnit_m));
        points.push_back(quantised(p.y(), kPlaceUnit_m));
      }
    }
    out["walls"] = {{"n", columns_.add(lengths)},
                    {"solid", columns_.add(solid)},
                    {"xy", columns_.add(points, 2)}};
    return out;
  }

  json canvas() const {
    return {{"cell", run_.canvas.cell_size_m},
            {"origin", {run_.canvas.origin.x(), run_.canvas.origin.y()}}};
  }

  json of(const RobotLog& robot) {
    const sim::RobotSnapshot& start = robot.start;
    const std::vector<sim::Polygon> parts =
        start.parts.empty() ? std::vector<sim::Polygon>{start.footprint} : start.parts;
    // The part with wheels and a nose: the largest one around the axle's centre.
    std::size_t core = parts.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (!sim::is_inside(parts[i], sim::Vec2::Zero())) continue;
      if (core == parts.size() || sim::area_m2(parts[i]) > sim::area_m2(parts[core])) core = i;
    }
    json bumpers = json::array();
    for (const sim::BumperSnapshot& bumper : start.bumpers) {
      bumpers.push_back(polygon_json(bumper.line));
    }
    json lights = json::array();
    for (const sim::LightSnapshot& light : start.lights) {
      lights.push_back(
          {{"place", {light.p_BL.x(), light.p_BL.y()}}, {"colour", text_json(light.colour)}});
    }
    json out = {{"name", start.name},
                {"colour", text_json(start.colour)},
                {"parts", polygons_json(parts)},
                {"core", polygon_json(core < parts.size() ? parts[core] : start.footprint)},
                {"superstructures", polygons_json(start.superstructures)},
                {"bumpers", bumpers},
                {"lights", lights}};
    out.update(motion_of(robot));
    return out;
  }

  json motion_of(const RobotLog& robot) {
    return {
        {"poses", poses(robot.X_WB, frames_)},
        {"v", column(robot.twists, frames_,
                     [](const sim::Twist& t) { return quantised(t.v_mps, kPlaceUnit_m); })},
        {"side",
         column(robot.twists, frames_,
                [](const sim::Twist& t) { return quantised(t.lateral_mps, kPlaceUnit_m); })},
        {"w", column(robot.twists, frames_,
                     [](const sim::Twist& t) { return quantised(t.omega_radps, kAngleUnit_rad); })},
        {"stalled", column(robot.stalled, frames_, [](std::int64_t s) { return s; })},
        {"looks", of(robot.looks)}};
  }

  json obstacles() {
    constexpr const char* kShapes[] = {"box", "circle", "polygon"};
    json all = json::array();
    for (std::size_t i = 0; i < run_.obstacles.size(); ++i) {
      const sim::ObstacleDescription& one = run_.arena.obstacles[i];
      all.push_back({{"name", one.name},
                     {"shape", kShapes[static_cast<std::size_t>(one.shape)]},
                     {"outline", polygon_json(one.outline)},
                     {"size", {one.size.x(), one.size.y()}},
                     {"height", quantised(one.height_m, kRangeUnit)},
                     {"dynamic", one.type == sim::ObstacleType::kDynamic},
                     {"solid", one.solid},
                     {"movable", sim::is_movable(one)},
                     {"pushable", sim::is_pushable(one)},
                     {"faces", one.motion && one.motion->faces_way},
                     {"log", of(run_.obstacles[i])}});
    }
    return all;
  }

  json of(const DeviceLog& device) {
    json out = {{"robot", device.robot}, {"name", device.name}, {"type", device.type}};
    out.update(readings_of(device));
    return out;
  }

  json readings_of(const DeviceLog& device) {
    const std::size_t stride = device.beams ? thinning_.scans : thinning_.samples;
    const std::vector<std::size_t> kept = kept_indices(device.times_ns.size(), stride, false);
    json out = {
        {"t", times(device.times_ns, kept)}, {"series", json::array()}, {"lists", json::array()}};
    for (const Series& series : device.series) {
      const double unit = unit_of(series.values);
      json one = {
          {"scale", unit},
          {"v", column(series.values, kept, [unit](double v) { return quantised(v, unit); })}};
      if (out["series"].size() >= device.known_series) {
        one.update({{"name", series.name}, {"unit", series.unit}, {"words", series.words}});
      }
      out["series"].push_back(std::move(one));
    }
    const bool is_laser = device.beams && device.beams->resolution_rad > 0.0;
    const std::size_t beams = is_laser ? thinning_.beams : 1;
    for (const ListSeries& list : device.lists) {
      json one = of(list, kept, beams);
      if (out["lists"].size() >= device.known_lists) {
        one.update({{"name", list.name}, {"unit", list.unit}});
      }
      out["lists"].push_back(std::move(one));
    }
    if (!device.beams) return out;
    json mounts = json::array();
    for (const sim::Pose& X_BS : device.beams->X_BS) {
      mounts.push_back({X_BS.x_m, X_BS.y_m, X_BS.yaw_rad});
    }
    out["beams"] = {{"mounts", mounts},
                    {"first", device.beams->angle_min_rad},
                    {"step", device.beams->resolution_rad * static_cast<double>(beams)},
                    {"cone", device.beams->field_of_view_rad},
                    {"most", device.beams->range_max_m},
                    {"poses", poses(device.X_WB, kept)}};
    return out;
  }

  json of(const ListSeries& list, const std::vector<std::size_t>& kept, std::size_t stride) {
    std::vector<std::size_t> begins;
    std::size_t begin = 0;
    for (const std::int64_t count : list.counts) {
      begins.push_back(begin);
      begin += static_cast<std::size_t>(count);
    }
    std::vector<std::int64_t> counts;
    std::vector<std::int64_t> values;
    for (const std::size_t i : kept) {
      const std::size_t before = values.size();
      for (std::size_t k = 0; k < static_cast<std::size_t>(list.counts[i]); k += stride) {
        values.push_back(list.values[begins[i] + k]);
      }
      counts.push_back(static_cast<std::int64_t>(values.size() - before));
    }
    return {{"scale", kRangeUnit},
            {"n", columns_.add(counts)},
            {"v", columns_.add(values, better_lag(counts, values))}};
  }

  // Neighbouring beams are alike, and so are the same beams of successive scans: which more?
  static std::size_t better_lag(const std::vector<std::int64_t>& counts,
                                const std::vector<std::int64_t>& values) {
    if (counts.empty() || counts.front() < 2 ||
        std::ranges::any_of(counts, [&](std::int64_t n) { return n != counts.front(); })) {
      return 1;
    }
    const auto length = static_cast<std::size_t>(counts.front());
    double in_scan = 0.0;
    double between_scans = 0.0;
    for (std::size_t i = length; i < values.size(); ++i) {
      const auto digits = [](std::int64_t difference) {
        return sim::math::log2(1.0 + std::abs(static_cast<double>(difference)));
      };
      in_scan += digits(values[i] - values[i - 1]);
      between_scans += digits(values[i] - values[i - length]);
    }
    return between_scans < in_scan ? length : 1;
  }

  void add_happenings(json& out) {
    out["collisions"] = json::array();
    for (const sim::Collision& collision : run_.collisions) {
      out["collisions"].push_back({{"t", collision.time_ns / kMicrosecond_ns},
                                   {"robot", collision.robot},
                                   {"partner", collision.partner},
                                   {"place", {collision.place.x(), collision.place.y()}}});
    }
    out["events"] = json::array();
    for (const sim::ArenaEvent& event : run_.events) {
      out["events"].push_back({{"t", event.time_ns / kMicrosecond_ns},
                               {"kind", to_string(event.kind)},
                               {"what", event.what},
                               {"who", event.who},
                               {"text", description(event)}});
    }
    out["spoken"] = json::array();
    for (const sim::SpokenText& spoken : run_.spoken) {
      out["spoken"].push_back({{"t", spoken.time_ns / kMicrosecond_ns},
                               {"robot", spoken.robot},
                               {"text", spoken.text}});
    }
    out["goals_from"] = run_.first_goal;
    out["texts_from"] = run_.first_text;
    out["goals"] = json::array();
    for (const GoalNote& goal : run_.goals) {
      out["goals"].push_back(
          {{"robot", goal.robot},
           {"place", {goal.place.x(), goal.place.y()}},
           {"t", goal.given_ns / kMicrosecond_ns},
           {"reached", goal.reached_ns ? json(*goal.reached_ns / kMicrosecond_ns) : json()}});
    }
    out["texts"] = json::array();
    for (const TextNote& note : run_.texts) {
      out["texts"].push_back(
          {{"text", note.text.text},
           {"place", {note.text.place.x(), note.text.place.y()}},
           {"colour", text_json(note.text.colour)},
           {"t", note.shown_ns / kMicrosecond_ns},
           {"gone", note.gone_ns ? json(*note.gone_ns / kMicrosecond_ns) : json()}});
    }
    out["trap_states"] = of(run_.trap_states);
    out["timer_dues"] = of(run_.timer_dues);
    out["scores"] = of(run_.scores);
    if (run_.verdict) {
      out["verdict"] = {{"passed", run_.verdict->passed},
                        {"reason", run_.verdict->reason},
                        {"t", run_.verdict->time_ns / kMicrosecond_ns}};
    }
  }

  void add_program(json& out) {
    std::vector<std::int64_t> at;
    std::vector<std::int64_t> device;
    std::vector<std::int64_t> text;
    std::vector<std::int64_t> first;  // of each robot: index of its first device
    for (std::size_t i = 0; i < run_.devices.size(); ++i) {
      while (first.size() <= static_cast<std::size_t>(run_.devices[i].robot)) {
        first.push_back(static_cast<std::int64_t>(i));
      }
    }
    for (const CommandNote& command : run_.commands) {
      at.push_back(command.time_ns / kMicrosecond_ns);
      device.push_back(first[static_cast<std::size_t>(command.robot)] + command.device);
      text.push_back(static_cast<std::int64_t>(command.text));
    }
    out["commands"] = {{"t", columns_.add(at)},
                       {"device", columns_.add(device)},
                       {"text", columns_.add(text)},
                       {"texts", run_.command_texts}};
    out["output"] = json::array();
    for (const OutputLine& line : run_.output) {
      out["output"].push_back({line.time_ns / kMicrosecond_ns, line.text, line.is_error ? 1 : 0});
    }
  }

  json layers() {
    json all = json::array();
    for (const LayerLog& layer : run_.layers) all.push_back(of(layer));
    return all;
  }

  json of(const LayerLog& layer) {
    json out = {{"name", layer.name},       {"colour", text_json(layer.colour)},
                {"visible", layer.visible}, {"priority", layer.priority},
                {"grey", layer.is_grey},    {"width", layer.width},
                {"height", layer.height}};
    out.update(changes_of(layer));
    return out;
  }

  json changes_of(const LayerLog& layer) {
    std::vector<std::int64_t> at;
    std::vector<std::int64_t> runs;
    std::vector<std::int64_t> first;
    std::vector<std::int64_t> count;
    std::vector<std::int64_t> colour;
    std::unordered_map<std::uint32_t, std::int64_t> known;
    json palette = json::array();
    for (const LayerChange& change : layer.changes) {
      if (!thinning_.layers) break;
      at.push_back(change.time_ns / kMicrosecond_ns);
      runs.push_back(static_cast<std::int64_t>(change.runs.size()));
      for (const CellRun& run : change.runs) {
        const std::uint32_t rgba = (std::uint32_t{run.colour.r} << 24) |
                                   (std::uint32_t{run.colour.g} << 16) |
                                   (std::uint32_t{run.colour.b} << 8) | run.colour.a;
        const auto [found, is_new] =
            known.try_emplace(rgba, static_cast<std::int64_t>(known.size()));
        if (is_new) palette.push_back(rgba);
        first.push_back(run.first);
        count.push_back(run.count);
        colour.push_back(found->second);
      }
    }
    return {{"t", columns_.add(at)},           {"runs", columns_.add(runs)},
            {"first", columns_.add(first)},    {"count", columns_.add(count)},
            {"colours", columns_.add(colour)}, {"palette", palette}};
  }

  const ReplayRun& run_;
  const Thinning& thinning_;
  Columns& columns_;
  std::vector<std::size_t> frames_;
};

json palette_json() {
  json all = json::object();
  for (const sim::render::palette::NamedColour& one : sim::render::palette::kAll) {
    all[one.name] = text_json(one.colour);
  }
  return all;
}

// A head, and its columns after it.
std::string joined(json head, const Columns& columns) {
  head["format"] = 1;
  head["columns"] = json::array();
  for (const Columns::Entry& entry : columns.entries()) {
    head["columns"].push_back({entry.offset, entry.count, entry.lag, entry.wide ? 1 : 0});
  }
  const std::string text = head.dump(-1, ' ', false, json::error_handler_t::replace);
  std::string bytes;
  for (int i = 0; i < 4; ++i) {
    bytes += static_cast<char>((text.size() >> (8 * i)) & 0xff);
  }
  return bytes + text + columns.bytes();
}

}  // namespace

std::string Thinning::text() const {
  const auto every = [](std::size_t stride) {
    return "every " + (stride == 2 ? "second" : std::to_string(stride) + "th") + ' ';
  };
  std::string kept;
  const auto add = [&](const std::string& words) { kept += (kept.empty() ? "" : "; ") + words; };
  if (scans == 0) {
    add("no readings of range sensors");
  } else {
    if (beams > 1) add(every(beams) + "laser beam");
    if (scans > 1) add(every(scans) + "reading of range sensors");
  }
  if (samples > 1) add(every(samples) + "pose, and reading of other sensors");
  if (!layers) add("no drawings");
  return kept.empty() ? ""
                      : "To keep the file small, it holds only a part of the run: " + kept + '.';
}

const std::vector<Thinning>& thinning_steps() {
  static const std::vector<Thinning> kSteps = {
      {1, 1, 1, true}, {2, 1, 1, true}, {2, 2, 1, true},  {4, 2, 1, true}, {4, 4, 1, true},
      {4, 4, 2, true}, {8, 8, 4, true}, {8, 16, 8, true}, {1, 0, 8, true}, {1, 0, 16, false}};
  return kSteps;
}

std::string encoded(const std::vector<ReplayRun>& runs, const Thinning& thinning,
                    const std::string& note) {
  Columns columns;
  std::string thinned = thinning.text();
  if (!note.empty()) thinned += (thinned.empty() ? "" : " ") + note;
  json head = {{"thinned", thinned}, {"palette", palette_json()}, {"runs", json::array()}};
  for (const ReplayRun& run : runs) {
    head["runs"].push_back(RunEncoder(run, thinning, columns).encode());
  }
  return joined(std::move(head), columns);
}

std::string encoded_whole(const ReplayRun& run, const std::string& live) {
  Columns columns;
  const Thinning all;
  json head = {{"thinned", ""}, {"palette", palette_json()}, {"live", json::parse(live)}};
  head["runs"] = json::array({RunEncoder(run, all, columns).encode()});
  return joined(std::move(head), columns);
}

std::string encoded_part(const ReplayRun& part, const std::string& live) {
  Columns columns;
  const Thinning all;
  json head = {{"part", true}, {"live", json::parse(live)}};
  head["runs"] = json::array({RunEncoder(part, all, columns).encode_part()});
  return joined(std::move(head), columns);
}

}  // namespace playerlike::replay
