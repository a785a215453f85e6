// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Keeps a program's own functions out of the libraries.
//
// If a program defines a function or variable with a name such as read or time, the dynamic linker
// gives it to all shared libraries, also to the C++ library, whose streams call read(). When
// Playpen's library is loaded, it redirects such calls, of Playpen's libraries and of all libraries
// that they need, to the functions that these libraries were linked with.
//
// The program's own calls do not change, nor do those of its other libraries. Functions that
// allocate memory stay the program's: a block must be freed by the allocator that made it. Names
// that begin with an underscore are reserved for the compiler's libraries. Nothing is redirected in
// programs that contain Playpen (static libraries), in sanitizers' programs, and on systems other
// than Linux on x86-64 and AArch64. See docs/decisions/player_names.md.
#pragma once

namespace sim {

/// While it exists, the dynamic linker does not find those names in the program: loading a module
/// also calls functions of the libraries that the module needs.
class HiddenProgramNames {
 public:
  HiddenProgramNames();
  HiddenProgramNames(const HiddenProgramNames&) = delete;
  HiddenProgramNames& operator=(const HiddenProgramNames&) = delete;
  ~HiddenProgramNames();
};

}  // namespace sim
