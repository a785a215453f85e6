// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "render/modules/module_interface.h"

namespace sim::render::modules {

/// The functions of the text module. The first call loads the module; load_module() documents where
/// it is searched.
/// @throws std::runtime_error naming the module and the searched places.
/// Thread-safe.
[[nodiscard]] const TextFunctions& text_functions();

/// The functions of the film module. The first call loads the module.
/// @throws std::runtime_error like text_functions().
/// Thread-safe.
[[nodiscard]] const FilmFunctions& film_functions();

/// Loads a module for the lifetime of the process, and returns its function `entry`.
///
/// `file` is searched in these places, in this order:
/// 1. the folder `playpen` next to the shared library or program that contains this code, and
///    `../lib/playpen` and `../LIBDIR/playpen` from there, so that an installed tree can be moved;
/// 2. the dynamic loader's search path: LD_LIBRARY_PATH, and the RUNPATH that playpen's CMake
///    package adds to programs linked with the static library;
/// 3. the folder in the environment variable PLAYPEN_LIBRARIES, which `playpen run` sets.
/// @throws std::runtime_error "FILE ... is missing; looked for in ..." or with the reason why it
///     cannot be loaded.
[[nodiscard]] void* load_module(const std::string& file, const char* entry);

}  // namespace sim::render::modules
