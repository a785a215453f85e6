// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerc/client.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <list>
#include <string>
#include <thread>

#include "core/errors.h"
#include "playerc/device.h"
#include "playerc/guard.h"
#include "proxies/link.h"

namespace playerlike::clib {

using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using std::chrono::milliseconds;

namespace {

// kLong: the slice of a peek without time limit. kShort: how long one client of several is polled
// before the next; it is the step of most worlds.
constexpr milliseconds kLong(1000);
constexpr milliseconds kShort(10);

template <typename T>
void erase(std::vector<T*>& list, const T* item) noexcept {
  list.erase(std::remove(list.begin(), list.end(), item), list.end());
}

}  // namespace

Client::Client(const char* a_host, int a_port) : playerc_client_t() {
  id = static_cast<playerc_client_t*>(this);
  host = strdup(a_host == nullptr ? "localhost" : a_host);
  if (host == nullptr) throw std::bad_alloc();
  port = a_port;
  transport = PLAYERC_TRANSPORT_TCP;
  mode = PLAYERC_DATAMODE_PUSH;  // until connect()
  retry_time = 10.0;
  request_timeout = 10.0;
  sock = -1;
}

Client::~Client() {
  disconnect();
  for (Device* entry : devices_) entry->client_is_gone();
  for (playerc_mclient_t* group : groups_) {
    auto* const end = std::remove(group->client, group->client + group->client_count,
                                  static_cast<playerc_client_t*>(this));
    group->client_count = static_cast<int>(end - group->client);
  }
  std::free(host);
}

Client& Client::of(playerc_client_t* client) {
  if (client == nullptr) refuse("the client is a null pointer");
  return static_cast<Client&>(*client);
}

void Client::connect() {
  if (player_ != nullptr) return;
  if (port < 0) refuse("there is no port " + std::to_string(port));
  auto player = std::make_unique<PlayerClient>(host, static_cast<uint32_t>(port), transport);
  player->SetRequestTimeout(static_cast<uint32_t>(std::max(request_timeout, 0.0)));
  player->SetRetryTime(retry_time);
  player->SetRetryLimit(retry_limit);
  for (const ReplaceRule& rule : replace_rules_) {
    if (rule.index == -1) player->SetReplaceRule(rule.replace, -1, -1, rule.code);
  }
  player_ = std::move(player);
  connected = 1;
  mode = PLAYERC_DATAMODE_PULL;  // as Player's library, which asks the server for it
}

void Client::disconnect() noexcept {
  for (Device* entry : devices_) entry->unsubscribe();
  player_.reset();
  pending_.clear();
  qlen = 0;
  connected = 0;
}

PlayerClient& Client::player() const {
  if (player_ == nullptr) {
    throw PlayerError("", "the client is not connected (call playerc_client_connect() first)",
                      PlayerError::kDisconnected);
  }
  return *player_;
}

bool Client::poll() {
  if (!pending_.empty()) return true;
  const std::shared_ptr<ClientCore>& core = PlayerCc::detail::CoreAccess::get(player());
  if (translated("", [&] { return core->read_pending(); })) end_round();
  return !pending_.empty();
}

bool Client::peek(milliseconds timeout) {
  if (!pending_.empty()) return true;
  if (timeout.count() >= 0) return player().Peek(static_cast<uint32_t>(timeout.count()));
  while (!player().Peek(static_cast<uint32_t>(kLong.count()))) {
  }
  return true;
}

void Client::read_round() {
  player().Read();
  end_round();
}

void Client::end_round() {
  // Even a round without data is delivered (as the client's own struct): the client has no
  // subscriptions then.
  if (pending_.empty()) pending_.push_back(nullptr);
  overflow_count = player().GetOverflowCount();
  qlen = static_cast<int>(pending_.size());
}

void* Client::deliver() {
  if (mode == PLAYERC_DATAMODE_PUSH) return deliver_next();
  if (pending_.empty()) return nullptr;
  const std::weak_ptr<const char> exists = exists_;
  void* const own_id = id;
  while (!exists.expired() && deliver_next() != nullptr) {  // a callback may destroy the client
  }
  return own_id;
}

void* Client::deliver_next() {
  if (pending_.empty()) return nullptr;
  Device* const entry = pending_.front();
  pending_.pop_front();
  qlen = static_cast<int>(pending_.size());
  return entry == nullptr ? id : entry->deliver();
}

void Client::add(Device& entry) { devices_.push_back(&entry); }

void Client::remove(Device& entry) noexcept {
  erase(devices_, &entry);
  forget_arrival(entry);
}

void Client::note_arrival(Device& entry) { pending_.push_back(&entry); }

void Client::forget_arrival(const Device& entry) noexcept {
  pending_.erase(std::remove(pending_.begin(), pending_.end(), &entry), pending_.end());
  qlen = static_cast<int>(pending_.size());
}

Device* Client::find(const playerc_device_t* common) const noexcept {
  const auto it = std::find_if(devices_.begin(), devices_.end(),
                               [&](const Device* d) { return &d->common() == common; });
  return it == devices_.end() ? nullptr : *it;
}

Device* Client::find(int code, int index) const noexcept {
  const auto it = std::find_if(devices_.begin(), devices_.end(), [&](const Device* d) {
    return d->common().addr.interf == code && d->common().addr.index == index;
  });
  return it == devices_.end() ? nullptr : *it;
}

void Client::set_replace_rule(int code, int index, int type, bool replace) {
  if (type != -1 && type != PLAYER_MSGTYPE_DATA) return;
  if (code == -1) index = -1;
  if (player_ != nullptr && index == -1) player_->SetReplaceRule(replace, type, -1, code);
  replace_rules_.push_back({code, index, replace});
  for (Device* entry : devices_) {
    const player_devaddr_t& addr = entry->common().addr;
    if (index == addr.index && code == addr.interf) apply_replace_rules(*entry);
  }
}

void Client::apply_replace_rules(Device& entry) {
  const player_devaddr_t& addr = entry.common().addr;
  const auto fits = [&](const ReplaceRule& rule) {
    return (rule.code == -1 || rule.code == addr.interf) &&
           (rule.index == -1 || rule.index == addr.index);
  };
  // The latest matching rule wins.
  const auto it = std::find_if(replace_rules_.rbegin(), replace_rules_.rend(), fits);
  if (it != replace_rules_.rend() && entry.proxy() != nullptr) {
    entry.proxy()->SetReplaceRule(it->replace);
  }
}

void Client::leave(const playerc_mclient_t& group) noexcept { erase(groups_, &group); }

namespace {

// Waits until clients can be read. Returns each client that has data. If there is none, simulated
// time advances; returns one client whose run is over, or an empty list after the timeout.
std::vector<Client*> wait_for_any(const playerc_mclient_t& group, int timeout_ms) {
  std::vector<Client*> clients;
  for (int i = 0; i < group.client_count; ++i) {
    Client& client = Client::of(group.client[i]);
    if (client.connected != 0) clients.push_back(&client);
  }
  if (clients.empty()) refuse("there is no client that is connected");
  milliseconds left(timeout_ms);
  for (std::size_t turn = 0;; ++turn) {
    std::vector<Client*> ready;
    std::copy_if(clients.begin(), clients.end(), std::back_inserter(ready),
                 [](Client* client) { return client->poll(); });
    if (!ready.empty()) return ready;
    if (timeout_ms >= 0 && left.count() <= 0) return {};
    // When one client of a thread waits, all of its clients count as waiting, so peeking at any of
    // them is enough in one simulation. Clients may belong to different simulations, so the loop
    // takes turns.
    Client* const client = clients[turn % clients.size()];
    const milliseconds wait = timeout_ms < 0 ? kShort : std::min(kShort, left);
    if (client->peek(wait) && !client->poll()) return {client};  // the run is over
    left -= wait;
  }
}

}  // namespace
}  // namespace playerlike::clib

// --- Several clients

using playerlike::clib::Client;
using playerlike::clib::Device;
using playerlike::clib::guarded;
using playerlike::clib::refuse;
using playerlike::clib::reported;
using std::chrono::milliseconds;

namespace {

// A list that this thread is reading. A callback may destroy the list and its clients.
class Reading {
 public:
  explicit Reading(playerc_mclient_t& group) : group_(&group), outer_(innermost) {
    innermost = this;
  }
  ~Reading() { innermost = outer_; }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  /// Whether the list still exists and contains the client.
  [[nodiscard]] bool has(const Client* client) const {
    if (group_ == nullptr) return false;
    auto** const end = group_->client + group_->client_count;
    return std::find(group_->client, end, static_cast<const playerc_client_t*>(client)) != end;
  }
  static void note_destroyed(const playerc_mclient_t* group) {
    for (Reading* reading = innermost; reading != nullptr; reading = reading->outer_) {
      if (reading->group_ == group) reading->group_ = nullptr;
    }
  }

 private:
  static thread_local Reading* innermost;
  playerc_mclient_t* group_;
  Reading* outer_;
};
thread_local Reading* Reading::innermost = nullptr;

playerc_mclient_t& require(playerc_mclient_t* mclient) {
  if (mclient == nullptr) refuse("the list of clients is a null pointer");
  return *mclient;
}

}  // namespace

playerc_mclient_t* playerc_mclient_create(void) {
  return guarded(__func__, [] { return std::make_unique<playerc_mclient_t>().release(); });
}

void playerc_mclient_destroy(playerc_mclient_t* mclient) {
  if (mclient == nullptr) return;
  for (int i = 0; i < mclient->client_count; ++i) Client::of(mclient->client[i]).leave(*mclient);
  Reading::note_destroyed(mclient);
  delete mclient;
}

int playerc_mclient_addclient(playerc_mclient_t* mclient, struct _playerc_client_t* client) {
  return guarded(__func__, [&] {
    playerc_mclient_t& group = require(mclient);
    Client& added = Client::of(client);
    if (group.client_count >= static_cast<int>(std::size(group.client))) {
      refuse("the list holds " + std::to_string(group.client_count) + " clients already");
    }
    added.join(group);
    group.client[group.client_count++] = client;
  });
}

int playerc_mclient_peek(playerc_mclient_t* mclient, int timeout) {
  return guarded(__func__, [&] {
    return playerlike::clib::wait_for_any(require(mclient), timeout).empty() ? 0 : 1;
  });
}

int playerc_mclient_read(playerc_mclient_t* mclient, int timeout) {
  return guarded(__func__, [&] {
    playerc_mclient_t& group = require(mclient);
    const Reading reading(group);
    int count = 0;
    for (Client* client : playerlike::clib::wait_for_any(group, timeout)) {
      // A callback of one client may have destroyed the next client, its own client or the list.
      if (!reading.has(client)) continue;
      if (client->poll()) {
        client->deliver();
      } else {
        client->read_round();  // throws the reason why there is no more data
      }
      if (reading.has(client)) group.time = std::max(group.time, client->datatime);
      ++count;
    }
    return count;
  });
}

// --- One client

playerc_client_t* playerc_client_create(playerc_mclient_t* mclient, const char* host, int port) {
  return guarded(__func__, [&]() -> playerc_client_t* {
    auto client = std::make_unique<Client>(host, port);
    if (mclient != nullptr) playerc_mclient_addclient(mclient, client.get());
    return client.release();
  });
}

void playerc_client_destroy(playerc_client_t* client) {
  if (client != nullptr) delete &Client::of(client);
}

void playerc_client_set_transport(playerc_client_t* client, unsigned int transport) {
  guarded(__func__, [&] { Client::of(client).transport = static_cast<int>(transport); });
}

int playerc_client_connect(playerc_client_t* client) {
  return reported(__func__, [&] { Client::of(client).connect(); });
}

int playerc_client_disconnect(playerc_client_t* client) {
  return guarded(__func__, [&] { Client::of(client).disconnect(); });
}

int playerc_client_disconnect_retry(playerc_client_t* client) {
  return guarded(__func__, [&] {
    Client& self = Client::of(client);
    std::vector<Device*> subscribed;
    std::copy_if(self.all().begin(), self.all().end(), std::back_inserter(subscribed),
                 [](const Device* device) { return device->common().subscribed != 0; });
    self.disconnect();
    if (self.retry_limit == 0) {
      refuse("no tries are allowed (call playerc_client_set_retry_limit() first)");
    }
    for (int tried = 1;; ++tried) {
      try {
        self.connect();
        break;
      } catch (const PlayerCc::PlayerError&) {
        if (self.retry_limit > 0 && tried >= self.retry_limit) throw;
      }
      std::this_thread::sleep_for(std::chrono::duration<double>(self.retry_time));
    }
    for (Device* device : subscribed) device->subscribe(PLAYERC_OPEN_MODE);
  });
}

int playerc_client_datamode(playerc_client_t* client, uint8_t mode) {
  return guarded(__func__, [&] {
    Client& self = Client::of(client);
    self.player().SetDataMode(mode);
    self.mode = mode;
  });
}

int playerc_client_requestdata(playerc_client_t* client) {
  return guarded(__func__, [&] { static_cast<void>(Client::of(client).player()); });
}

int playerc_client_set_replace_rule(playerc_client_t* client, int interf, int index, int type,
                                    int /*subtype*/, int replace) {
  return guarded(__func__,
                 [&] { Client::of(client).set_replace_rule(interf, index, type, replace != 0); });
}

int playerc_client_adddevice(playerc_client_t* client, struct _playerc_device_t* device) {
  return guarded(__func__, [&] {
    Client& self = Client::of(client);
    if (device == nullptr) refuse("the device is a null pointer");
    if (self.device_count >= PLAYER_MAX_DEVICES) {
      refuse("the client has " + std::to_string(self.device_count) + " devices already");
    }
    device->fresh = 0;
    self.device[self.device_count++] = device;
  });
}

int playerc_client_deldevice(playerc_client_t* client, struct _playerc_device_t* device) {
  return guarded(__func__, [&] {
    Client& self = Client::of(client);
    auto** const end = self.device + self.device_count;
    auto** const at = std::find(self.device, end, device);
    if (at == end) refuse("the client has no such device");
    std::copy(at + 1, end, at);
    --self.device_count;
  });
}

int playerc_client_addcallback(playerc_client_t* /*client*/, struct _playerc_device_t* device,
                               playerc_callback_fn_t callback, void* data) {
  return guarded(__func__, [&] {
    if (device == nullptr || callback == nullptr) refuse("device or callback is a null pointer");
    if (device->callback_count >= static_cast<int>(std::size(device->callback))) {
      refuse("the device has " + std::to_string(device->callback_count) + " callbacks already");
    }
    device->callback[device->callback_count] = callback;
    device->callback_data[device->callback_count] = data;
    ++device->callback_count;
  });
}

int playerc_client_delcallback(playerc_client_t* /*client*/, struct _playerc_device_t* device,
                               playerc_callback_fn_t callback, void* data) {
  return guarded(__func__, [&] {
    if (device == nullptr) refuse("the device is a null pointer");
    int kept = 0;
    for (int i = 0; i < device->callback_count; ++i) {
      if (device->callback[i] == callback && device->callback_data[i] == data) continue;
      device->callback[kept] = device->callback[i];
      device->callback_data[kept] = device->callback_data[i];
      ++kept;
    }
    device->callback_count = kept;
  });
}

int playerc_client_get_devlist(playerc_client_t* client) {
  return guarded(__func__, [&] {
    Client& self = Client::of(client);
    self.player().RequestDeviceList();
    const std::list<playerc_device_info_t> found = self.player().GetDeviceList();
    const std::size_t count = std::min<std::size_t>(found.size(), PLAYER_MAX_DEVICES);
    std::copy_n(found.begin(), count, self.devinfos);
    self.devinfo_count = static_cast<int>(count);
  });
}

int playerc_client_subscribe(playerc_client_t* client, int code, int index, int access,
                             char* drivername, size_t len) {
  return reported(__func__, [&] {
    Client& self = Client::of(client);
    std::string name;
    if (Device* const device = self.find(code, index)) {
      device->subscribe(access);
      name = device->common().drivername;
    } else {
      name = playerlike::clib::driver_at(self.player(), code, index);
    }
    if (drivername == nullptr || len == 0) return;
    drivername[name.copy(drivername, len - 1)] = '\0';
  });
}

int playerc_client_unsubscribe(playerc_client_t* client, int code, int index) {
  return guarded(__func__, [&] {
    if (Device* const device = Client::of(client).find(code, index)) device->unsubscribe();
  });
}

int playerc_client_request(playerc_client_t* /*client*/, struct _playerc_device_t* /*device*/,
                           uint8_t /*reqtype*/, const void* /*req_data*/, void** /*rep_data*/) {
  return guarded(__func__, [] {
    refuse("this library has no generic requests: call the function of the device");
  });
}

int playerc_client_write(playerc_client_t* /*client*/, struct _playerc_device_t* /*device*/,
                         uint8_t /*subtype*/, void* /*cmd*/, double* /*timestamp*/) {
  return guarded(__func__, [] {
    refuse("this library has no generic commands: call the function of the device");
  });
}

int playerc_client_peek(playerc_client_t* client, int timeout) {
  return guarded(__func__, [&] { return Client::of(client).peek(milliseconds(timeout)) ? 1 : 0; });
}

int playerc_client_internal_peek(playerc_client_t* client, int timeout) {
  return playerc_client_peek(client, timeout);
}

void* playerc_client_read(playerc_client_t* client) {
  return guarded(__func__, [&] {
    Client& self = Client::of(client);
    if (void* const told = self.deliver()) return told;
    self.read_round();
    return self.deliver();
  });
}

int playerc_client_read_nonblock(playerc_client_t* client) {
  return playerc_client_read_nonblock_withproxy(client, nullptr);
}

int playerc_client_read_nonblock_withproxy(playerc_client_t* client, void** proxy) {
  return guarded(__func__, [&] {
    Client& self = Client::of(client);
    void* told = self.deliver();
    if (told == nullptr) {
      if (!self.peek(milliseconds(0))) return 0;
      self.read_round();
      told = self.deliver();
    }
    if (proxy != nullptr) *proxy = told;
    return 1;
  });
}

void playerc_client_set_request_timeout(playerc_client_t* client, uint32_t seconds) {
  guarded(__func__, [&] {
    Client& self = Client::of(client);
    self.request_timeout = seconds;
    if (self.connected != 0) self.player().SetRequestTimeout(seconds);
  });
}

void playerc_client_set_retry_limit(playerc_client_t* client, int limit) {
  guarded(__func__, [&] {
    Client& self = Client::of(client);
    self.retry_limit = limit;
    if (self.connected != 0) self.player().SetRetryLimit(limit);
  });
}

void playerc_client_set_retry_time(playerc_client_t* client, double time) {
  guarded(__func__, [&] {
    playerlike::require_finite("", {{"the time between retries", time}});
    Client& self = Client::of(client);
    self.retry_time = std::max(time, 0.0);
    if (self.connected != 0) self.player().SetRetryTime(time);
  });
}
