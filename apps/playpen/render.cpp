// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/render/render.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "parsed_option.h"
#include "run_options.h"
#include "shipped.h"
#include "sim/io/map_file.h"
#include "sim/simulation/simulation.h"
#include "sim/world/occupancy_map.h"

namespace playpen {
namespace {

bool is_map_file(const std::string& name) {
  return name.ends_with(".yaml") || name.ends_with(".yml");
}

void draw_cells(const RenderRequest& request, int width, int height,
                const std::vector<std::uint8_t>& rgba) {
  sim::CanvasDescription cells;
  cells.width = width;
  cells.height = height;
  const int scale = std::max(1, request.size_px / std::max(width, height));
  sim::render::write_canvas_png(cells, rgba, scale, request.file);
}

/// White is free, black is occupied, grey is between.
void draw_map(const RenderRequest& request, const sim::OccupancyMap& map) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * map.cells.size());
  for (const float occupancy : map.cells) {
    const auto shade = static_cast<std::uint8_t>(std::lround(255.0F * (1.0F - occupancy)));
    rgba.insert(rgba.end(), {shade, shade, shade, 255});
  }
  draw_cells(request, map.width, map.height, rgba);
}

void give_map(const RenderRequest& request, const sim::OccupancyMap& map) {
  if (!is_map_file(request.file)) return draw_map(request, map);
  sim::io::write_map(map, std::filesystem::path(request.file).replace_extension().string());
}

}  // namespace

int render(const RenderRequest& request) {
  if (is_map_file(request.file) && !request.map) {
    throw std::runtime_error("a .yaml file holds a map: say --map as well, or name a .png file");
  }
  if (is_map_file(request.world)) {
    if (request.canvas || request.view_mode) {
      throw std::runtime_error("'" + request.world +
                               "' is a map; --canvas and --view-mode are for worlds");
    }
    give_map(request, sim::io::read_map(request.world));
    return kOk;
  }
  sim::WorldDescription world = load_found_world(find_world(request.world));
  playerlike::RunSettings settings;
  settings.view_mode = request.view_mode;
  settings.pictures = request.pictures;
  settings.apply_to(world);
  const sim::Simulation simulation(std::move(world));
  const sim::SceneSnapshot scene = simulation.snapshot();
  if (request.map) {
    give_map(request, sim::true_map(scene.arena, scene.canvas_description));
  } else if (request.canvas) {
    draw_cells(request, scene.canvas_description.width, scene.canvas_description.height,
               scene.canvas);
  } else {
    sim::render::RenderOptions options = request.pictures;
    options.size_px = request.size_px;
    sim::render::write_png(sim::render::draw_view(scene, options), request.file);
  }
  return kOk;
}

void add_render(CommandLine& line) {
  const auto request = std::make_shared<RenderRequest>();
  CLI::App& command = line.add_command("render", "Draw a world as it is at its start");
  CLI::Option* const world = command.add_option(
      "world", request->world,
      "World file or name of a shipped world, or a map (a map_server file, .yaml)");
  line.takes(world->required()->type_name(""), ValueKind::Kind::kWorld);
  CLI::Option* const out =
      add_parsed(command, "--out", "Picture, or with --map also the map's .yaml", "FILE.png",
                 "a file ending in .png (or .yaml)", [request](const std::string& text) {
                   request->file = text;
                   return text.size() > 4 && (text.ends_with(".png") || text.ends_with(".yaml"));
                 });
  line.takes(out->required(), ValueKind::Kind::kFile);
  add_parsed(command, "--size", "Pixels along the longer side [1000]", "PX",
             "a whole number from 64 to 8192", [request](const std::string& text) {
               int& size_px = request->size_px;
               return parse_number(text, size_px) && size_px >= 64 && size_px <= 8192;
             });
  add_view_mode(line, command, request->view_mode);
  add_picture_options(line, command, request->pictures);
  CLI::Option* const canvas = command.add_flag(
      "--canvas", request->canvas, "Only the canvas, with a whole number of pixels per cell");
  command
      .add_flag("--map", request->map,
                "The true map with the cells of the canvas, as a picture or as a map_server pair")
      ->excludes(canvas);
  command.footer("For example: playpen render cave --out cave.png");
  command.callback([request, &line] { line.status = render(*request); });
}

}  // namespace playpen
