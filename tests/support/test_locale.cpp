// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Linked into every test program: makes its C functions follow the user's locale, as in programs
// with Qt or GTK. tests/run.sh chooses a locale with a decimal comma.
#include <clocale>
#include <cstdlib>
#include <iostream>

namespace {

[[maybe_unused]] const bool kIsSet = [] {
  if (std::setlocale(LC_ALL, "") != nullptr) return true;
  const char* const wanted = std::getenv("LC_NUMERIC");
  std::cerr << "WARNING: the locale " << (wanted == nullptr ? "of the environment" : wanted)
            << " is not installed, so these tests run with a decimal point\n";
  return false;
}();

}  // namespace

// For LeakSanitizer: glibc never frees the path that setlocale() makes of LOCPATH.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:argz_add_sep\n"; }
