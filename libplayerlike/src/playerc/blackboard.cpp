// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "libplayerc++/blackboardproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::with_device;

// Player's numbers for the values of playerc_blackboard_set_string() and similar functions.
constexpr std::uint16_t kSimple = 1;
constexpr std::uint16_t kString = 1;
constexpr std::uint16_t kInt = 2;
constexpr std::uint16_t kDouble = 3;

// A change that was read, but not reported to the program yet.
struct Event {
  explicit Event(const player_blackboard_entry_t& from)
      : entry(from),
        key(from.key),
        group(from.group),
        data(from.data, from.data + from.data_count) {}
  // The entry with pointers into this object.
  [[nodiscard]] player_blackboard_entry_t shown() {
    entry.key = key.data();
    entry.group = group.data();
    entry.data = data.data();
    return entry;
  }

  player_blackboard_entry_t entry;
  std::string key;
  std::string group;
  std::vector<std::uint8_t> data;
};

class Blackboard final
    : public playerlike::clib::ProxyBacked<playerc_blackboard_t, PlayerCc::BlackBoardProxy> {
 public:
  Blackboard() = default;
  Blackboard(const Blackboard&) = delete;
  Blackboard& operator=(const Blackboard&) = delete;
  ~Blackboard() override { *exists_ = false; }

 protected:
  void attach(PlayerCc::PlayerClient& player) override {
    ProxyBacked::attach(player);
    proxy_or_throw().SetEventFunction(
        [this](const player_blackboard_entry_t& entry) { events_.emplace_back(entry); });
  }
  void detach() noexcept override {
    ProxyBacked::detach();
    events_.clear();
  }
  // The program's function may destroy the device, or its client.
  std::function<void()> take_events() override {
    return [this, exists = exists_, events = std::exchange(events_, {})]() mutable {
      for (Event& event : events) {
        if (!*exists || info.subscribed == 0 || on_blackboard_event == nullptr) return;
        on_blackboard_event(this, event.shown());
      }
    };
  }

 private:
  std::vector<Event> events_;
  std::shared_ptr<bool> exists_ = std::make_shared<bool>(true);
};

// Passes an entry to the caller; frees it if the caller passed a null pointer.
void hand_over(player_blackboard_entry_t* entry, player_blackboard_entry_t** where) {
  if (where != nullptr) {
    *where = entry;
    return;
  }
  for (void* part : {static_cast<void*>(entry->key), static_cast<void*>(entry->group),
                     static_cast<void*>(entry->data), static_cast<void*>(entry)}) {
    std::free(part);
  }
}

int set_value(const char* fun, playerc_blackboard_t* device, const char* key, const char* group,
              std::uint16_t subtype, const void* value, std::size_t size) {
  return with_device<Blackboard>(fun, device, [&](Blackboard& self) {
    std::vector<std::uint8_t> bytes(size);
    std::memcpy(bytes.data(), value, size);
    player_blackboard_entry_t entry = {};
    std::string key_text = key == nullptr ? "" : key;
    std::string group_text = group == nullptr ? "" : group;
    entry.key = key == nullptr ? nullptr : key_text.data();
    entry.group = group == nullptr ? nullptr : group_text.data();
    entry.type = kSimple;
    entry.subtype = subtype;
    entry.data = bytes.data();
    entry.data_count = static_cast<std::uint32_t>(size);
    self.proxy_or_throw().SetEntry(entry);
  });
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(blackboard, Blackboard, PLAYER_BLACKBOARD_CODE)

int playerc_blackboard_subscribe_to_key(playerc_blackboard_t* device, const char* key,
                                        const char* group, player_blackboard_entry_t** entry) {
  return with_device<Blackboard>(__func__, device, [&](Blackboard& self) {
    hand_over(self.proxy_or_throw().SubscribeToKey(key, group), entry);
  });
}

int playerc_blackboard_get_entry(playerc_blackboard_t* device, const char* key, const char* group,
                                 player_blackboard_entry_t** entry) {
  return with_device<Blackboard>(__func__, device, [&](Blackboard& self) {
    hand_over(self.proxy_or_throw().GetEntry(key, group), entry);
  });
}

int playerc_blackboard_unsubscribe_from_key(playerc_blackboard_t* device, const char* key,
                                            const char* group) {
  return with_device<Blackboard>(__func__, device, [&](Blackboard& self) {
    self.proxy_or_throw().UnsubscribeFromKey(key, group);
  });
}

int playerc_blackboard_subscribe_to_group(playerc_blackboard_t* device, const char* group) {
  return with_device<Blackboard>(
      __func__, device, [&](Blackboard& self) { self.proxy_or_throw().SubscribeToGroup(group); });
}

int playerc_blackboard_unsubscribe_from_group(playerc_blackboard_t* device, const char* group) {
  return with_device<Blackboard>(__func__, device, [&](Blackboard& self) {
    self.proxy_or_throw().UnsubscribeFromGroup(group);
  });
}

int playerc_blackboard_set_entry(playerc_blackboard_t* device, player_blackboard_entry_t* entry) {
  return with_device<Blackboard>(__func__, device, [&](Blackboard& self) {
    if (entry == nullptr) playerlike::clib::refuse("the entry is a null pointer");
    self.proxy_or_throw().SetEntry(*entry);
  });
}

int playerc_blackboard_set_string(playerc_blackboard_t* device, const char* key, const char* group,
                                  const char* value) {
  const char* const text = value == nullptr ? "" : value;
  return set_value(__func__, device, key, group, kString, text, std::strlen(text) + 1);
}

int playerc_blackboard_set_int(playerc_blackboard_t* device, const char* key, const char* group,
                               const int value) {
  return set_value(__func__, device, key, group, kInt, &value, sizeof value);
}

int playerc_blackboard_set_double(playerc_blackboard_t* device, const char* key, const char* group,
                                  const double value) {
  return set_value(__func__, device, key, group, kDouble, &value, sizeof value);
}
