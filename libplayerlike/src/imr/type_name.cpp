// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "type_name.h"

#include <cxxabi.h>

#include <cstdlib>
#include <memory>

namespace imr::detail {

std::string type_name(const std::type_info& type) {
  int status = 0;
  // __cxa_demangle() allocates its result with malloc().
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), &std::free);
  return status == 0 && name != nullptr ? name.get() : type.name();
}

}  // namespace imr::detail
