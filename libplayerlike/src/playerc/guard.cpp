// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerc/guard.h"

#include <mutex>
#include <set>

#include "core/errors.h"
#include "core/warnings.h"
#include "libplayerc/playerc.h"

namespace playerlike::clib {
namespace {

// One text for each thread, so that it does not change while its reader uses it.
std::string& last_error() {
  thread_local std::string text;
  return text;
}

}  // namespace

void set_error(const char* fun, const std::string& why) {
  last_error() = std::string(fun) + ": " + why;
}

void report_error(const char* fun, const std::string& why) {
  set_error(fun, why);
  constexpr std::size_t kMostTexts = 100;
  // Never destroyed: destructors of static objects may call this library.
  static auto* const mutex = new std::mutex;
  static auto* const told = new std::set<std::string>;
  {
    const std::lock_guard lock(*mutex);
    if (told->size() >= kMostTexts || !told->insert(last_error()).second) return;
  }
  warn(last_error());
}

void refuse(const std::string& why) { playerlike::refuse("", why); }

}  // namespace playerlike::clib

const char* playerc_error_str(void) { return playerlike::clib::last_error().c_str(); }

int playerc_add_xdr_ftable(playerxdr_function_t* /*flist*/, int /*replace*/) {
  return playerlike::clib::guarded(__func__, [] {
    playerlike::clib::refuse(
        "messages of new kinds cannot be added: nothing is packed into messages here");
  });
}
