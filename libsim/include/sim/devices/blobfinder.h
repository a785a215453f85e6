// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/devices/device.h"
#include "sim/devices/view.h"

namespace sim {

class ColumnView;

/// Settings of a blobfinder.
struct BlobfinderParams : ViewParams {
  double frequency_hz = 10.0;   ///< [Hz]
  std::vector<Colour> colours;  ///< colours that it detects, at most kMaxColours; empty: all
  double noise_m = 0.0;         ///< standard deviation of a blob's range [m]
  double latency_s = 0.0;       ///< [s]

  static constexpr std::size_t kMaxColours = 256;
};

/// Colour blobs in view, from right to left (Stage's order).
struct BlobfinderReading final : Reading {
  /// An edge-connected area of pixels of one colour.
  struct Blob {
    Colour colour;         ///< opaque
    int area = 0;          ///< number of pixels
    int x = 0;             ///< column of the centroid
    int y = 0;             ///< row of the centroid; row 0 is at the top
    int left = 0;          ///< first column
    int right = 0;         ///< last column
    int top = 0;           ///< first row
    int bottom = 0;        ///< last row
    double range_m = 0.0;  ///< horizontal distance, averaged over its columns
  };
  int width = 0;   ///< of the picture [pixels]
  int height = 0;  ///< [pixels]
  std::vector<Blob> blobs;
};

/// Detects other robots, and extended obstacles that have a colour in the world, as blobs in a
/// picture (PinholeView). This is Stage's model of that name with true heights: a nearer object
/// hides a farther one only up to its own height. Colours are compared exactly.
class Blobfinder final : public SensorOf<BlobfinderReading> {
 public:
  Blobfinder(std::string name, const BlobfinderParams& params, RandomStream noise);
  ~Blobfinder() override;

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  [[nodiscard]] bool measures_after_others() const noexcept override { return true; }
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  BlobfinderParams params_;
  RandomStream noise_;
  std::unique_ptr<ColumnView> view_;
};

}  // namespace sim
