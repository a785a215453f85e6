// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "render/modules/module_interface.h"

namespace sim::render::modules {

/// The functions of the text module, which is loaded by the first call.
/// Where modules are looked for: load_module().
/// @throws std::runtime_error naming the module and the places where it was looked for.
/// Safe from many threads.
[[nodiscard]] const TextFunctions& text_functions();

/// The functions of the film module, which is loaded by the first call.
/// @throws std::runtime_error as text_functions().
/// Safe from many threads.
[[nodiscard]] const FilmFunctions& film_functions();

/// Loads a module, for as long as the process runs, and finds the function `entry` in it.
///
/// It is looked for as `file` in these places, one after the other:
/// 1. folder `playpen` beside the shared library or the program that this code is part of, and
///    `../lib/playpen` and `../LIBDIR/playpen` from there: so an installed tree can be moved;
/// 2. wherever the dynamic loader looks: the RUNPATH that programs linked with the static library
///    get from playpen's CMake package, and LD_LIBRARY_PATH;
/// 3. the folder that the environment variable PLAYPEN_LIBRARIES names, which `playpen run` sets.
/// @throws std::runtime_error "FILE ... is missing; looked for in ..." or with the reason why it
///     cannot be loaded.
[[nodiscard]] void* load_module(const std::string& file, const char* entry);

}  // namespace sim::render::modules
