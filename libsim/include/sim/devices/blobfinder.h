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
  double frequency_hz = 10.0;   ///< (0, 1000]
  std::vector<Colour> colours;  ///< that it sees, at most kMaxColours; none: all
  double noise_m = 0.0;         ///< standard deviation of a blob's range [m], >= 0

  static constexpr std::size_t kMaxColours = 256;
};

/// Blobs of colour in view, from right to left (as Stage tells them).
struct BlobfinderReading final : Reading {
  /// Pixels of one colour that hang together, edge to edge.
  struct Blob {
    Colour colour;         ///< opaque
    int area = 0;          ///< how many pixels
    int x = 0;             ///< column that their middle lies in
    int y = 0;             ///< row that their middle lies in; row 0 is the top one
    int left = 0;          ///< first column
    int right = 0;         ///< last column
    int top = 0;           ///< first row
    int bottom = 0;        ///< last row
    double range_m = 0.0;  ///< level distance, the mean over its columns
  };
  int width = 0;   ///< of the picture [pixels]
  int height = 0;  ///< [pixels]
  std::vector<Blob> blobs;
};

/// Sees other robots, and those extended obstacles to which the world gave a colour, as blobs in a
/// picture (PinholeView): Stage's model of that name, with true heights. Of two things in a line
/// the nearer one hides the other as far as it is high. Colours are told apart exactly.
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
