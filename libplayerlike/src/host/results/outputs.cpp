// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/outputs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "host/results/picture_sizes.h"
#include "host/results/recording_format.h"
#include "playerlike/host/results.h"
#include "playerlike/messages/messages.h"
#include "sim/canvas/layers.h"
#include "sim/core/replace_file.h"
#include "sim/io/map_file.h"
#include "sim/render/render.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLayerFolder = "layers";

// Pixels per cell: a whole number, so that cells have sharp edges.
int cell_scale(const sim::CanvasDescription& canvas) {
  return std::max(1, kCanvasMostSize_px / std::max(canvas.width, canvas.height));
}

// A file name for a layer. Other characters could form a path or cause problems.
std::string safe_name(const std::string& name) {
  std::string safe = name;
  for (char& c : safe) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_';
    if (!plain) c = '_';
  }
  return safe.empty() ? "_" : safe;
}

// The file names of layers, without endings. Names that would be equal, ignoring case, get their
// owner's port as a suffix, and a number if they are still equal.
std::vector<std::string> file_names(const std::vector<sim::LayerInfo>& layers) {
  const auto folded = [](std::string name) {
    for (char& c : name) {
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return name;
  };
  std::map<std::string, int> count;
  for (const sim::LayerInfo& layer : layers) ++count[folded(safe_name(layer.style.name))];
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const sim::LayerInfo& layer : layers) {
    const std::string plain = safe_name(layer.style.name);
    std::string name = plain;
    if (count[folded(plain)] > 1 && layer.id != sim::kBaseLayer) {
      name += "_";
      name += std::to_string(layer.owner);
    }
    const std::string base = name;
    for (int number = 2; !taken.insert(folded(name)).second; ++number) {
      name = base;
      name += "_";
      name += std::to_string(number);
    }
    names.push_back(name);
  }
  return names;
}

// Removes the files of a folder for which `is_ours` is true.
template <typename Predicate>
void remove_files(const fs::path& folder, Predicate is_ours) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  std::vector<fs::path> ours;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory() && is_ours(entry.path())) ours.push_back(entry.path());
  }
  for (const fs::path& file : ours) {
    fs::remove(file, error);
    if (error) {
      throw std::runtime_error("an earlier result, " + file.string() +
                               ", can't be removed: " + error.message());
    }
  }
}

void remove_if_empty(const fs::path& folder) {
  std::error_code ignored;
  fs::remove(folder, ignored);  // fails, as intended, unless the folder is empty
}

void remove_layers(const fs::path& folder) {
  remove_files(folder / kLayerFolder, [](const fs::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".png" || ending == ".pgm" || ending == ".yaml";
  });
  remove_if_empty(folder / kLayerFolder);
}

void write_layers(const fs::path& folder, const sim::LayerStack& stack,
                  sim::render::CanvasPngWriter& writer) {
  remove_layers(folder);
  const std::vector<sim::LayerInfo> layers = stack.layers();
  const std::vector<std::string> names = file_names(layers);
  const sim::CanvasDescription canvas = stack.description();
  fs::create_directories(folder / kLayerFolder);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const sim::LayerId id = layers[i].id;
    const std::string stem = (folder / kLayerFolder / names[i]).string();
    writer.write(canvas, stack.picture(id), cell_scale(canvas), stem + ".png");
    if (layers[i].kind != sim::LayerKind::kGrey) continue;
    sim::io::write_map(occupancy_map(canvas, stack.cells(id)), stem);
  }
}

// The path, without ending, of a client's "picture" or "map" in the output folder. The name may
// include the first ending.
std::string saved_stem(const std::string& folder, const std::string& what, const std::string& name,
                       std::initializer_list<std::string_view> endings) {
  const std::string_view first = *endings.begin();
  if (!is_plain_file_name(name)) {
    throw SessionError(
        SessionError::Code::kBadArgument,
        "a " + what + " is saved in the run's output folder, under a plain file name of 1 to " +
            std::to_string(kMaxFileName) + " characters such as \"map" + std::string(first) +
            "\", without folders and no dot in front; but the name is \"" +
            name.substr(0, kMaxFileName) + '"');
  }
  if (folder.empty()) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       "there is no folder to save " + what +
                           "s in: name one by `playpen run --out FOLDER` or PLAYPEN_OUT");
  }
  const std::string plain =
      name.ends_with(first) ? name.substr(0, name.size() - first.size()) : name;
  std::string stem = (fs::path(folder) / plain).string();
  for (const std::string_view ending : endings) {
    const std::string file = stem + std::string(ending);
    std::error_code ignored;  // if the file cannot be checked, writing it fails too
    if (fs::is_symlink(file, ignored)) {
      throw SessionError(SessionError::Code::kNotAvailable,
                         file + " is a link, which may lead out of the output folder");
    }
  }
  return stem;
}

}  // namespace

void remove_snapshots(const std::string& folder) {
  remove_files(fs::path(folder) / kSnapshotFolder, [](const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with("scene_") && name.ends_with("s.png");
  });
  remove_if_empty(fs::path(folder) / kSnapshotFolder);
}

void remove_results(const std::string& folder) {
  constexpr std::array<std::string_view, 8> kFiles = {
      "report.json", "report.part.json", "scene.png",      "scene.part.png",
      "canvas.png",  "canvas.part.png",  "trajectory.csv", kRecordingFile};
  for (const std::string_view name : kFiles) {
    std::error_code error;
    const fs::path file = fs::path(folder) / name;
    fs::remove(file, error);
    if (error) {
      throw std::runtime_error("an earlier result, " + file.string() +
                               ", can't be removed: " + error.message());
    }
  }
  remove_layers(folder);
  remove_snapshots(folder);
  // Pictures that a user saved from the live window.
  remove_files(folder, [](const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with("view_") && name.ends_with(".png");
  });
}

void write_report(const std::string& folder, const std::string& text) {
  const std::string file = (fs::path(folder) / "report.json").string();
  if (const int error = sim::replace_file(file, text)) {
    throw std::runtime_error("cannot write " + file + ": " + std::strerror(error));
  }
}

void write_pictures(const std::string& folder, const sim::LayerStack& layers,
                    const sim::SceneSnapshot& scene, const sim::render::RenderOptions& options) {
  const fs::path out(folder);
  sim::render::CanvasPngWriter writer;  // often, one layer has all that the canvas shows
  // A failure must not prevent the other writes.
  std::exception_ptr failure;
  const auto attempt = [&failure](const auto& write) {
    try {
      write();
    } catch (const std::exception&) {
      if (!failure) failure = std::current_exception();
    }
  };
  attempt([&] {
    const bool mini_map = scene.view_mode == sim::ViewMode::kMiniMap;
    const sim::ViewMode mode = mini_map ? sim::ViewMode::kMiniMap : sim::ViewMode::kGround;
    sim::render::write_png(sim::render::draw_view(scene, mode, scene_options(options)),
                           (out / "scene.png").string());
  });
  attempt([&] {
    writer.write(scene.canvas_description, scene.canvas, cell_scale(scene.canvas_description),
                 (out / "canvas.png").string());
  });
  attempt([&] { write_layers(out, layers, writer); });
  if (failure) std::rethrow_exception(failure);
}

bool is_plain_file_name(const std::string& name) {
  return !name.empty() && name.size() <= kMaxFileName && name.front() != '.' &&
         std::none_of(name.begin(), name.end(), [](char c) {
           const auto byte = static_cast<unsigned char>(c);
           return c == '/' || c == '\\' || byte < 0x20 || byte == 0x7f;
         });
}

sim::OccupancyMap occupancy_map(const sim::CanvasDescription& canvas,
                                const std::vector<sim::CellValue>& cells) {
  sim::OccupancyMap map;
  map.width = canvas.width;
  map.height = canvas.height;
  map.cell_size_m = canvas.cell_size_m;
  map.origin = canvas.origin;
  map.cells.reserve(cells.size());
  for (const sim::CellValue& cell : cells) map.cells.push_back(cell.occupancy());
  return map;
}

std::string picture_file(const std::string& folder, const std::string& name, int scale) {
  constexpr int kMaxScale = 64;
  const std::string stem = saved_stem(folder, "picture", name, {".png"});
  if (scale < 1 || scale > kMaxScale) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "a picture has 1 to " + std::to_string(kMaxScale) +
                           " pixels along a cell's side, but " + std::to_string(scale) +
                           " were asked for");
  }
  return stem + ".png";
}

std::string map_stem(const std::string& folder, const std::string& name) {
  return saved_stem(folder, "map", name, {".yaml", ".pgm"});
}

void write_picture(const sim::CanvasDescription& canvas, const std::vector<std::uint8_t>& rgba,
                   int scale, const std::string& file) {
  try {
    sim::render::write_canvas_png(canvas, rgba, scale, file);
  } catch (const std::exception& e) {
    throw SessionError(SessionError::Code::kNotAvailable, e.what());
  }
}

void write_map_files(const sim::OccupancyMap& map, const std::string& stem, sim::io::MapMode mode) {
  try {
    sim::io::write_map(map, stem, mode);
  } catch (const std::exception& e) {
    throw SessionError(SessionError::Code::kNotAvailable, e.what());
  }
}

}  // namespace playerlike
