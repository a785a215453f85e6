// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "libplayerc++/logproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::with_device;

class Log final : public playerlike::clib::ProxyBacked<playerc_log_t, PlayerCc::LogProxy> {
 public:
  void refresh_state() {
    type = proxy_or_throw().GetType();
    state = proxy_or_throw().GetState();
  }
};

// Changes the log, then refreshes the struct's state.
template <typename Action>
int change(const char* fun, playerc_log_t* device, Action action) {
  return with_device<Log>(fun, device, [&](Log& self) {
    action(self.proxy_or_throw());
    self.refresh_state();
  });
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(log, Log, PLAYER_LOG_CODE)

int playerc_log_set_write_state(playerc_log_t* device, int state) {
  return change(__func__, device, [&](PlayerCc::LogProxy& proxy) { proxy.SetWriteState(state); });
}

int playerc_log_set_read_state(playerc_log_t* device, int state) {
  return change(__func__, device, [&](PlayerCc::LogProxy& proxy) { proxy.SetReadState(state); });
}

int playerc_log_set_read_rewind(playerc_log_t* device) {
  return change(__func__, device, [](PlayerCc::LogProxy& proxy) { proxy.Rewind(); });
}

int playerc_log_get_state(playerc_log_t* device) {
  return change(__func__, device, [](PlayerCc::LogProxy& proxy) { proxy.QueryState(); });
}

int playerc_log_set_filename(playerc_log_t* device, const char* fname) {
  return change(__func__, device, [&](PlayerCc::LogProxy& proxy) {
    if (fname == nullptr) playerlike::clib::refuse("the name of the file is a null pointer");
    proxy.SetFilename(fname);
  });
}
