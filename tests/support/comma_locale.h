// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <clocale>
#include <cstdlib>
#include <iostream>
#include <locale>
#include <string>

#include "temporary_folder.h"

namespace test_support {

/// While this object exists, the process has a locale with a decimal comma and separated thousands,
/// as in a program that calls setlocale() or std::locale::global(). For one thread at a time.
class CommaLocale {
 public:
  CommaLocale()
      : c_before_(std::setlocale(LC_ALL, nullptr)),
        cpp_before_(std::locale::global(std::locale(std::locale::classic(), new Punctuation))) {
    for (const char* name : {"de_DE.UTF-8", "cs_CZ.UTF-8", "fr_FR.UTF-8"}) {
      if (std::setlocale(LC_ALL, name) != nullptr) return;
    }
    // No such locale is installed: create one for this test, if the locale sources are installed.
    const std::string make =
        "localedef -i de_DE -f UTF-8 '" + folder_.path().string() + "/de_DE.UTF-8' >/dev/null 2>&1";
    static_cast<void>(!std::system(make.c_str()));
    const char* const path = std::getenv("LOCPATH");
    const std::string path_before = path == nullptr ? "" : path;
    setenv("LOCPATH", folder_.path().c_str(), 1);
    is_whole_ = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    if (path_before.empty()) {
      unsetenv("LOCPATH");
    } else {
      setenv("LOCPATH", path_before.c_str(), 1);
    }
    if (!is_whole_) {
      std::cerr << "WARNING: there is no locale with a decimal comma, so only that of C++ streams "
                   "is tried, not that of printf(); apps/install_dependencies.sh test installs "
                   "what is missing\n";
    }
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;
  ~CommaLocale() {
    std::locale::global(cpp_before_);
    std::setlocale(LC_ALL, c_before_.c_str());
  }

  /// Whether the C functions use the comma, too: only if such a locale is available.
  [[nodiscard]] bool is_whole() const noexcept { return is_whole_; }

 private:
  struct Punctuation final : std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\3"; }
  };

  TemporaryFolder folder_;
  std::string c_before_;
  std::locale cpp_before_;
  bool is_whole_ = true;
};

}  // namespace test_support
