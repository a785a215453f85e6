// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/map_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "canvas/image_file.h"
#include "io/document.h"
#include "io/map_io.h"
#include "sim/core/assert.h"
#include "sim/core/error.h"
#include "sim/core/replace_file.h"

namespace sim::io {
namespace {

namespace fs = std::filesystem;

// The thresholds and shades of map_saver.
constexpr double kOccupiedThreshold = 0.65;
constexpr double kFreeThreshold = 0.196;
constexpr std::uint8_t kOccupiedShade = 0;
constexpr std::uint8_t kUnknownShade = 205;
constexpr std::uint8_t kFreeShade = 254;
// In scale mode, only black exceeds the first threshold and only white is below the second.
constexpr double kScaleOccupied = 0.998;
constexpr double kScaleFree = 0.002;

/// A map's description takes a few lines; this limits the input of the YAML parser.
constexpr std::size_t kMaxYamlBytes = std::size_t{64} << 10;

std::uint8_t trinary_shade(double p) {
  if (p > kOccupiedThreshold) return kOccupiedShade;
  return p < kFreeThreshold ? kFreeShade : kUnknownShade;
}

std::uint8_t scale_shade(double p) {
  if (std::isnan(p)) p = 0.5;
  if (p <= 0.0) return 255;
  if (p >= 1.0) return 0;
  const double share = kScaleFree + p * (kScaleOccupied - kScaleFree);
  return static_cast<std::uint8_t>(std::floor(255.0 * (1.0 - share) + 0.5));
}

void write_file(const std::string& path, const std::string& bytes) {
  if (const int error = replace_file(path, bytes)) {
    throw std::runtime_error(path + ": cannot write the map: " + std::strerror(error));
  }
}

/// A text as a YAML value. Does not use yaml-cpp, whose global objects may already be destroyed
/// when results are written at the program's exit.
std::string yaml_text(const std::string& text) {
  const bool plain = !text.empty() && text.front() != '-' && text.front() != '.' &&
                     std::all_of(text.begin(), text.end(), [](char c) {
                       return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
                              (c >= 'a' && c <= 'z') || c == '_' || c == '-' || c == '.';
                     });
  // Quoted texts have the same syntax in JSON and YAML.
  using nlohmann::json;
  return plain ? text : json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

/// map_server's modes of converting shades to occupancy.
enum class Reading { kTrinary, kScale, kRaw };

struct Description {
  std::string image;
  double resolution_m = 0.0;
  Vec2 origin = Vec2::Zero();
  bool negate = false;
  double occupied_threshold = 0.0;
  double free_threshold = 0.0;
  Reading reading = Reading::kTrinary;
};

/// Reads the description and records all errors in it.
class DescriptionReader {
 public:
  explicit DescriptionReader(std::string file) : file_(std::move(file)) {}

  Description read() {
    Reader::Document document;
    document.file = file_;
    std::string text;
    if (!read_file(file_, text, document, "the YAML file of a map", NamedBy::kFile)) {
      throw ConfigError(std::move(document.issues));
    }
    if (text.size() > kMaxYamlBytes) {
      add("file/too-large", YAML::Mark::null_mark(), "", "a description of at most 64 KiB",
          "a larger file", "name the YAML file of the pair, not the picture");
      throw ConfigError(std::move(issues_));
    }
    Description description;
    try {
      read(YAML::Load(text), description);
    } catch (const YAML::Exception& error) {
      add("map/syntax", error.mark, "", "YAML, lines as resolution: 0.05", error.msg);
    }
    if (!issues_.empty()) throw ConfigError(std::move(issues_));
    return description;
  }

  [[noreturn]] void refuse_image(const std::string& found) {
    add("map/image", image_mark_, "/image",
        "a picture (PNG or PGM) of at most " + std::to_string(kMaxMapSide) + " pixels a side",
        found, "its name is relative to the folder of the YAML file");
    throw ConfigError(std::move(issues_));
  }

 private:
  void add(const char* id, const YAML::Mark& mark, std::string pointer, std::string expected,
           std::string found, std::string hint = "") {
    const bool known = !mark.is_null();
    issues_.push_back({id, file_, std::move(pointer), std::move(expected), std::move(found),
                       std::move(hint), known ? mark.line + 1 : 0, known ? mark.column + 1 : 0});
  }

  static std::string described(const YAML::Node& node) {
    if (node.IsSequence()) return "a list of " + std::to_string(node.size());
    if (node.IsMap()) return "keys with values";
    if (node.IsNull()) return "nothing";
    return in_quotes(node.Scalar());
  }

  /// Reads a number in YAML's notation, whatever the program's locale.
  static bool parse_number(std::string_view text, double& value) {
    double sign = 1.0;
    if (!text.empty() && (text.front() == '+' || text.front() == '-')) {
      if (text.front() == '-') sign = -1.0;
      text.remove_prefix(1);
    }
    if (text == ".inf" || text == ".Inf" || text == ".INF") {
      value = sign * std::numeric_limits<double>::infinity();
      return true;
    }
    if (text == ".nan" || text == ".NaN" || text == ".NAN") {
      value = std::numeric_limits<double>::quiet_NaN();
      return true;
    }
    // A second sign and the words that from_chars() knows are not allowed.
    if (text.empty() || (text.front() != '.' && (text.front() < '0' || text.front() > '9'))) {
      return false;
    }
    const char* const end = text.data() + text.size();
    const auto [parsed, error] = std::from_chars(text.data(), end, value);
    value *= sign;
    return error == std::errc() && parsed == end;
  }

  /// A required key; records an issue if it is missing.
  std::optional<YAML::Node> required(const YAML::Node& root, const char* key) {
    YAML::Node node = root[key];
    if (node.IsDefined()) return node;
    add("map/missing-key", YAML::Mark::null_mark(), "",
        std::string("the keys image, resolution, origin, negate, occupied_thresh and free_thresh"),
        std::string("no key \"") + key + '"');
    return std::nullopt;
  }

  /// A number from `least` (or above it) to `most`; records an issue for anything else.
  std::optional<double> number(const YAML::Node& node, const std::string& pointer,
                               const char* expected, double least, double most,
                               bool above_least = false) {
    double value = 0.0;
    if (!node.IsScalar() || !parse_number(node.Scalar(), value)) {
      add("map/wrong-type", node.Mark(), pointer, expected, described(node));
      return std::nullopt;
    }
    // The form of this condition makes it refuse NaN.
    if (!((above_least ? value > least : value >= least) && value <= most)) {
      add("map/out-of-range", node.Mark(), pointer, expected, node.Scalar());
      return std::nullopt;
    }
    return value;
  }

  void read(const YAML::Node& root, Description& description) {
    if (!root.IsMap()) {
      add("map/wrong-type", YAML::Mark::null_mark(), "", "keys with values, as resolution: 0.05",
          described(root), "name the YAML file of the pair, not the picture");
      return;
    }
    if (const auto image = required(root, "image")) {
      image_mark_ = image->Mark();
      if (image->IsScalar() && !image->Scalar().empty()) {
        description.image = image->Scalar();
      } else {
        add("map/wrong-type", image->Mark(), "/image", "the name of a picture", described(*image));
      }
    }
    if (const auto resolution = required(root, "resolution")) {
      description.resolution_m =
          number(*resolution, "/resolution", "a side of a cell, over 0 and up to 1000 m", 0.0,
                 1000.0, true)
              .value_or(1.0);
    }
    if (const auto origin = required(root, "origin")) read_origin(*origin, description);
    if (const auto negate = required(root, "negate")) read_negate(*negate, description);
    read_thresholds(root, description);
    if (const YAML::Node mode = root["mode"]; mode.IsDefined()) read_mode(mode, description);
  }

  void read_origin(const YAML::Node& origin, Description& description) {
    if (!origin.IsSequence() || origin.size() != 3) {
      add("map/wrong-type", origin.Mark(), "/origin",
          "[x, y, yaw] of the bottom left corner, in m and rad", described(origin));
      return;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      description.origin[static_cast<Eigen::Index>(i)] =
          number(origin[i], "/origin/" + std::to_string(i), "a number from -1e6 to 1e6 m", -1e6,
                 1e6)
              .value_or(0.0);
    }
    if (number(origin[2], "/origin/2", "an angle from -1000 to 1000 rad", -1e3, 1e3)
            .value_or(0.0) != 0.0) {
      add("map/turned", origin[2].Mark(), "/origin/2", "a yaw of 0", origin[2].Scalar(),
          "turned maps are not supported: turn the picture");
    }
  }

  void read_negate(const YAML::Node& negate, Description& description) {
    const std::string text = negate.IsScalar() ? negate.Scalar() : "";
    description.negate = text == "1" || text == "true";
    if (!description.negate && text != "0" && text != "false") {
      add("map/wrong-type", negate.Mark(), "/negate", "0 or 1", described(negate));
    }
  }

  void read_thresholds(const YAML::Node& root, Description& description) {
    constexpr const char* kExpected = "a number from 0 to 1";
    const auto occupied = required(root, "occupied_thresh");
    const auto free = required(root, "free_thresh");
    if (!occupied || !free) return;
    const auto high = number(*occupied, "/occupied_thresh", kExpected, 0.0, 1.0);
    const auto low = number(*free, "/free_thresh", kExpected, 0.0, 1.0);
    if (!high || !low) return;
    if (*low >= *high) {
      add("map/thresholds", free->Mark(), "/free_thresh",
          "less than occupied_thresh, which is " + occupied->Scalar(), free->Scalar());
    }
    description.occupied_threshold = *high;
    description.free_threshold = *low;
  }

  void read_mode(const YAML::Node& mode, Description& description) {
    const std::string text = mode.IsScalar() ? mode.Scalar() : "";
    if (text == "trinary") {
      description.reading = Reading::kTrinary;
    } else if (text == "scale") {
      description.reading = Reading::kScale;
    } else if (text == "raw") {
      description.reading = Reading::kRaw;
    } else {
      const std::string near = nearest_word(text, {"trinary", "scale", "raw"});
      add("map/mode", mode.Mark(), "/mode", R"("trinary", "scale" or "raw")", described(mode),
          near.empty() ? "" : "did you mean " + in_quotes(near) + '?');
    }
  }

  std::string file_;
  YAML::Mark image_mark_ = YAML::Mark::null_mark();
  std::vector<ConfigIssue> issues_;
};

float occupancy(std::uint8_t shade, const Description& description) {
  const double dark = description.negate ? shade : 255 - shade;
  if (description.reading == Reading::kRaw) {
    const double percent = 255.0 - dark;
    return percent <= 100.0 ? static_cast<float>(percent / 100.0) : 0.5F;
  }
  const double p = dark / 255.0;
  if (p > description.occupied_threshold) return 1.0F;
  if (p < description.free_threshold) return 0.0F;
  if (description.reading == Reading::kTrinary) return 0.5F;
  return static_cast<float>((p - description.free_threshold) /
                            (description.occupied_threshold - description.free_threshold));
}

}  // namespace

std::optional<MapMode> parse_map_mode(std::string_view text) {
  for (const MapMode mode : {MapMode::kTrinary, MapMode::kScale}) {
    if (text == to_string(mode)) return mode;
  }
  return std::nullopt;
}

std::string_view to_string(MapMode mode) { return mode == MapMode::kScale ? "scale" : "trinary"; }

void write_map(const OccupancyMap& map, const std::string& stem, MapMode mode) {
  SIM_ASSERT(map.width >= 1 && map.height >= 1);
  SIM_ASSERT(map.cells.size() ==
             static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  const bool scale = mode == MapMode::kScale;
  std::string pgm =
      "P5\n" + std::to_string(map.width) + ' ' + std::to_string(map.height) + "\n255\n";
  pgm.reserve(pgm.size() + map.cells.size());
  for (const float cell : map.cells) {
    pgm += static_cast<char>(scale ? scale_shade(cell) : trinary_shade(cell));
  }
  const std::string image = stem + ".pgm";
  write_file(image, pgm);

  std::string yaml = "image: " + yaml_text(fs::path(image).filename().string());
  yaml += "\nmode: " + std::string(to_string(mode));
  yaml += "\nresolution: " + number_text(map.cell_size_m);
  yaml += "\norigin: [" + number_text(map.origin.x()) + ", " + number_text(map.origin.y()) + ", 0]";
  yaml += "\nnegate: 0";
  yaml += "\noccupied_thresh: " + number_text(scale ? kScaleOccupied : kOccupiedThreshold);
  yaml += "\nfree_thresh: " + number_text(scale ? kScaleFree : kFreeThreshold) + '\n';
  write_file(stem + ".yaml", yaml);
}

OccupancyMap read_map(const std::string& yaml_file) {
  DescriptionReader reader(yaml_file);
  const Description description = reader.read();
  GreyImage image;
  try {
    image = load_grey_image((fs::path(yaml_file).parent_path() / description.image).string());
  } catch (const std::runtime_error& error) {
    reader.refuse_image(error.what());
  }
  if (image.width > kMaxMapSide || image.height > kMaxMapSide) {
    reader.refuse_image(std::to_string(image.width) + " x " + std::to_string(image.height) +
                        " pixels");
  }
  OccupancyMap map{image.width, image.height, description.resolution_m, description.origin, {}};
  map.cells.reserve(image.pixels.size());
  for (const std::uint8_t shade : image.pixels) map.cells.push_back(occupancy(shade, description));
  return map;
}

}  // namespace sim::io
