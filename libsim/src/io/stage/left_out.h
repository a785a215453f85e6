// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

/// What a translation leaves out by its name.
namespace sim::io::stage {

/// Whether a property only changes the look of Stage's window.
[[nodiscard]] bool is_look(std::string_view property);
/// Whether a property has no effect on what programs see.
[[nodiscard]] bool is_without_effect(std::string_view property);
/// Whether a type of model is a device of Stage 2 that later versions do not have.
[[nodiscard]] bool is_old_device(std::string_view type);
/// Whether a type of model is one that only Stage 1 had.
[[nodiscard]] bool is_of_stage_1(std::string_view type);

}  // namespace sim::io::stage
