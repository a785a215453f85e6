// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "imr-h/imr_assert.h"
#include "imr-h/imr_exceptions.h"

namespace imr {

exception::exception() : std::runtime_error("unspecified error") {}

exception::exception(const std::string& message) : std::runtime_error(message) {}

// Out of line, so that the class has its type information in one place only.
exception::~exception() = default;

namespace detail {

void throw_invalid_argument(const char* message) {
  const bool has_message = message != nullptr && *message != '\0';
  throw argument_error(has_message ? message : "invalid argument");
}

void throw_failed_check(const char* file, int line, Check check, const char* condition,
                        const std::string& message) {
  const char* const kind = check == Check::kArgument ? "argument check"
                           : check == Check::kIo     ? "i/o check"
                                                     : "assertion";
  std::string text =
      std::string(file) + ":" + std::to_string(line) + ": " + kind + " '" + condition + "' failed";
  if (!message.empty()) {
    text += ": " + message;
  }
  if (check == Check::kArgument) throw argument_error(text);
  if (check == Check::kIo) throw io_error(text);
  throw exception(text);
}

}  // namespace detail
}  // namespace imr
