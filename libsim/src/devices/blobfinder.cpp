// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/blobfinder.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "devices/column_view.h"
#include "devices/device_kind.h"
#include "sim/world/description.h"

namespace sim {
namespace {

// The colour of an object, made opaque; nullopt if it has none of its own.
std::optional<Colour> colour_of(const PhysicsWorld::Face& face, const WorldDescription& world) {
  using Kind = PhysicsWorld::Contact::Kind;
  std::optional<Colour> colour;
  const auto index = static_cast<std::size_t>(face.index);
  if (face.kind == Kind::kRobot) colour = world.robots[index].colour;
  if (face.kind == Kind::kObstacle) colour = world.arena.obstacles[index].colour;
  if (colour) colour->a = 255;
  return colour;
}

// A run of pixels of a wanted colour. `group` links to the piece that represents its blob; a
// representative links to itself.
struct Piece {
  const ColumnView::Run* run;
  Colour colour;
  std::size_t group;
};

std::size_t root_of(std::vector<Piece>& pieces, std::size_t i) {
  while (pieces[i].group != i) {
    pieces[i].group = pieces[pieces[i].group].group;
    i = pieces[i].group;
  }
  return i;
}

void unite(std::vector<Piece>& pieces, std::size_t i, std::size_t k) {
  const std::size_t a = root_of(pieces, i);
  const std::size_t b = root_of(pieces, k);
  pieces[std::max(a, b)].group = std::min(a, b);
}

// Whether pixels of the two runs share an edge.
bool touch(const ColumnView::Run& a, const ColumnView::Run& b) {
  if (a.column == b.column) return a.top == b.bottom || b.top == a.bottom;
  return a.top < b.bottom && b.top < a.bottom;
}

// Finds connected regions of runs by the method of Bruce, Balch, Veloso, Fast and Inexpensive Color
// Image Segmentation for Interactive Robots (IROS 2000), sec. 3.2 and 3.3, with columns instead of
// rows.
void group(std::vector<Piece>& pieces) {
  std::size_t begin = 0;  // of the previous column
  std::size_t middle = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const int column = pieces[i].run->column;
    if (i > 0 && pieces[i - 1].run->column != column) {
      begin = pieces[i - 1].run->column == column - 1 ? middle : i;
      middle = i;
    }
    for (std::size_t k = begin; k < i; ++k) {
      if (pieces[k].colour == pieces[i].colour && touch(*pieces[k].run, *pieces[i].run)) {
        unite(pieces, k, i);
      }
    }
  }
}

}  // namespace

Blobfinder::Blobfinder(std::string name, const BlobfinderParams& params, RandomStream noise)
    : SensorOf(std::move(name), "blobfinder", params.frequency_hz, params.latency_s),
      params_(params),
      noise_(std::move(noise)),
      view_(std::make_unique<ColumnView>(params)) {}

Blobfinder::~Blobfinder() = default;

std::optional<std::string> Blobfinder::connect(std::string_view robot,
                                               const DeviceDirectory& devices) {
  return view_->connect(robot, devices);
}

void Blobfinder::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.width = params_.width;
  reading.height = params_.height;
  reading.blobs.clear();
  view_->look(context);

  std::vector<Piece> pieces;
  for (const ColumnView::Run& run : view_->runs()) {
    const std::optional<Colour> colour = colour_of(view_->faces()[run.face], context.world);
    if (!colour) continue;
    const bool wanted =
        params_.colours.empty() ||
        std::any_of(params_.colours.begin(), params_.colours.end(), [&](const Colour& c) {
          return c.r == colour->r && c.g == colour->g && c.b == colour->b;
        });
    if (wanted) pieces.push_back({&run, *colour, pieces.size()});
  }
  group(pieces);

  for (std::size_t root = 0; root < pieces.size(); ++root) {
    if (pieces[root].group != root) continue;
    const ColumnView::Run& first = *pieces[root].run;
    BlobfinderReading::Blob blob;
    blob.colour = pieces[root].colour;
    blob.left = blob.right = first.column;
    blob.top = first.top;
    blob.bottom = first.bottom - 1;
    std::int64_t columns_twice = 0;  // sums over pixels of twice (column + 0.5)
    std::int64_t rows_twice = 0;
    double range_sum_m = 0.0;
    int columns = 0;
    for (std::size_t i = root; i < pieces.size(); ++i) {
      if (root_of(pieces, i) != root) continue;
      const ColumnView::Run& run = *pieces[i].run;
      const int rows = run.bottom - run.top;
      // The first piece in a column is its lowest, and therefore the nearest.
      if (columns == 0 || run.column != blob.right) {
        range_sum_m += run.range_m;
        ++columns;
      }
      blob.right = run.column;
      blob.top = std::min(blob.top, run.top);
      blob.bottom = std::max(blob.bottom, run.bottom - 1);
      blob.area += rows;
      columns_twice += std::int64_t{rows} * (2 * run.column + 1);
      rows_twice += std::int64_t{rows} * (run.top + run.bottom);
    }
    // The pixel that contains the centroid.
    blob.x = static_cast<int>(columns_twice / (2 * std::int64_t{blob.area}));
    blob.y = static_cast<int>(rows_twice / (2 * std::int64_t{blob.area}));
    blob.range_m = range_sum_m / columns;
    if (params_.noise_m > 0.0) {
      blob.range_m = std::max(0.0, blob.range_m + noise_.gaussian(params_.noise_m));
    }
    reading.blobs.push_back(blob);
  }
  std::stable_sort(reading.blobs.begin(), reading.blobs.end(),
                   [](const auto& a, const auto& b) { return a.right > b.right; });
}

void Blobfinder::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_);
}

namespace {

bool read_colour(const io::Reader& value, void* into) {
  const std::optional<Colour> colour =
      value.is_string() ? parse_colour(value.scalar_text().value_or("")) : std::nullopt;
  *static_cast<Colour*>(into) = colour.value_or(Colour{});
  return colour.has_value();
}

std::string colour_text(const void* colour) {
  return '"' + to_string(*static_cast<const Colour*>(colour)) + '"';
}

template <auto kMember>
constexpr Field pixels(const char* name) {
  return field<kMember>(name, "pixels").within(0, std::numeric_limits<int>::max());
}

}  // namespace

constexpr ElementType kColour{
    read_colour, colour_text,
    R"({"type": "string", "pattern": "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6}|[0-9A-Fa-f]{8})$"})"};

constexpr Field kBlobfinderSettings[] = {
    frequency_field<&BlobfinderParams::frequency_hz>(),
    include<BlobfinderParams, ViewParams>(),
    noise_field<&BlobfinderParams::noise_m>("standard deviation of a blob's range")
        .with_realism(0.0, 0.02),
    field<&BlobfinderParams::colours>(
        "colours", "", "list of the exact colours that it sees, like `\"#ff8800\"`; none: all")
        .of(kColour)
        .counting(0, BlobfinderParams::kMaxColours)
        .with_issue("world/bad-colour", "a colour like \"#ff8800\" or \"#f80\""),
    latency_field<&BlobfinderParams::latency_s>(),
};
SIM_FIELDS(BlobfinderParams, kBlobfinderSettings)

using Blob = BlobfinderReading::Blob;

constexpr Field kBlob[] = {
    field<&Blob::colour>("colour"),
    pixels<&Blob::area>("area"),
    pixels<&Blob::x>("x"),
    pixels<&Blob::y>("y"),
    pixels<&Blob::left>("left"),
    pixels<&Blob::right>("right"),
    pixels<&Blob::top>("top"),
    pixels<&Blob::bottom>("bottom"),
    field<&Blob::range_m>("range", "m"),
};
SIM_FIELDS(BlobfinderReading::Blob, kBlob)

constexpr Field kBlobfinderReading[] = {
    pixels<&BlobfinderReading::width>("width").with<&Field::meaning>("of the picture"),
    pixels<&BlobfinderReading::height>("height").with<&Field::meaning>("of the picture"),
    field<&BlobfinderReading::blobs>("blobs", "", "from right to left; `\"#rrggbb\"`, pixels, m"),
};
SIM_FIELDS(BlobfinderReading, kBlobfinderReading)

DeviceKind blobfinder_kind() {
  return device_kind<Blobfinder, BlobfinderParams, BlobfinderReading>("blobfinder",
                                                                      {{"blobfinder"}});
}

}  // namespace sim
