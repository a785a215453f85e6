// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "io/document.h"
#include "sim/io/world_io.h"

namespace sim::io {

/// Reads the text of a world. Issues are added to `document`; the world is valid only if there are
/// none. Files in document.files take the place of files of the world's folder.
[[nodiscard]] WorldDescription read_world_document(std::string_view text,
                                                   const std::vector<DeviceType>& types,
                                                   Reader::Document& document);

}  // namespace sim::io
