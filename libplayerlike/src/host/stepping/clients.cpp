// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/clients.h"

#include <algorithm>

namespace playerlike {
namespace {

constexpr std::size_t kQueueLimit = 1000;
constexpr sim::SimTime kEmptyRound_ns = sim::kNanosecondsPerSecond / 10;

// Inputs of lower groups come first.
int group_of(const Client& client) {
  if (client.onlooker) return 2;
  return client.follower ? 0 : 1;
}

bool subscribed_before(const Client::Subscription& s, DeviceId id) {
  return std::pair(s.device.robot, s.device.device) < std::pair(id.robot, id.device);
}

}  // namespace

Clients::Clients(const sim::Simulation& simulation, const std::vector<RobotInfo>& robots,
                 bool by_creator, const Mirror* mirror)
    : simulation_(simulation), by_creator_(by_creator), mirror_(mirror) {
  for (const RobotInfo& robot : robots) feeds_.emplace_back(robot.devices.size());
}

bool Clients::any_but_onlookers() const {
  return std::any_of(begin(), end(), [](const auto& client) { return !client->onlooker; });
}

std::shared_ptr<Client> Clients::add(int port, EventRole role, std::function<void()> notify,
                                     const CreationOrder& order) {
  auto client = std::make_shared<Client>();
  client->notify = std::move(notify);
  client->number = next_number_++;
  client->port = port;
  client->follower = role == EventRole::kFollower;
  client->onlooker = role == EventRole::kOnlooker;
  client->process = order.process;
  client->creator = order.process == 0 ? this_thread_id() : order.thread;
  client->touch();
  begin_round(*client);
  // The place is usually the last, so the search begins there. In virtual time several threads may
  // begin at the same moment: the order is that of their start, not of their arrival here.
  auto place = clients_.end();
  while (place != clients_.begin()) {
    const Client& before = **std::prev(place);
    const int group = group_of(before);
    const bool by_thread = by_creator_ || (order.process != 0 && before.process == order.process);
    const bool after_it = group == group_of(*client)
                              ? !by_thread || before.creator <= client->creator
                              : group < group_of(*client);
    if (after_it) break;
    --place;
  }
  clients_.insert(place, client);
  ++unsubscribed_;
  return client;
}

void Clients::remove(Client& client) noexcept {
  for (const Client::Subscription& s : client.subscriptions) forget_subscriber(client, s.device);
  if (client.subscriptions.empty()) --unsubscribed_;
  client.subscriptions.clear();
  std::erase_if(clients_, [&](const auto& c) { return c.get() == &client; });
}

void Clients::subscribe(Client& client, DeviceId device) {
  auto& all = client.subscriptions;
  auto it = std::lower_bound(all.begin(), all.end(), device, subscribed_before);
  if (it == all.end() || !(it->device == device)) {
    if (all.empty()) --unsubscribed_;
    it = all.emplace(it);
    it->device = device;
    it->replace = client.replace_by_default;
    feed(device).subscribers.push_back(&client);
  }
  ++it->count;
}

void Clients::unsubscribe(Client& client, DeviceId device) {
  Client::Subscription* const gone = find(client, device);
  if (gone == nullptr || --gone->count > 0) return;
  auto& all = client.subscriptions;
  all.erase(all.begin() + (gone - all.data()));
  if (all.empty()) ++unsubscribed_;
  forget_subscriber(client, device);
  client.has_data =
      std::any_of(all.begin(), all.end(), [](const auto& s) { return !s.unread.empty(); });
  begin_round(client);
}

void Clients::set_replace(Client& client, std::optional<DeviceId> device, bool replace) {
  if (!device) client.replace_by_default = replace;
  for (Client::Subscription& s : client.subscriptions) {
    if (device && !(s.device == *device)) continue;
    s.replace = replace;
    if (replace && !s.unread.empty()) s.unread.erase(s.unread.begin(), s.unread.end() - 1);
  }
}

void Clients::distribute(const std::map<int, RunLog>& logs) {
  if (unsubscribed_ > 0) {
    for (const auto& client : clients_) {
      if (client->subscriptions.empty() && simulation_.now_ns() >= client->empty_round_ns) {
        client->has_data = true;
      }
    }
  }
  std::vector<int> replayed;  // ports whose readings come from a file
  for (const auto& [port, log] : logs) {
    if (!log.replaying()) continue;
    replayed.push_back(port);
    const auto is_its = [number = port](const Client& client) { return client.port == number; };
    for (const RunLog::Entry* entry : log.due()) {
      give(feed(entry->device), entry->device, entry->reading, is_its);
    }
  }
  const auto is_live = [&](const Client& client) {
    return std::find(replayed.begin(), replayed.end(), client.port) == replayed.end();
  };
  if (mirror_ != nullptr) {
    for (const auto& [device, reading] : mirror_->readings()) {
      feed(device).count();
      give(feed(device), device, reading, is_live);
    }
  }
  for (const DeviceId& updated : simulation_.updated()) {
    if (mirror_ != nullptr && mirror_->replaces(updated)) continue;
    Feed& to = feed(updated);
    to.count();
    if (to.subscribers.empty()) continue;
    give(to, updated, simulation_.device(updated.robot, updated.device).sensor()->share(), is_live);
  }
}

void Clients::note_loss(const Mirror::Loss& loss) {
  for (const auto& client : clients_) {
    const auto& all = client->subscriptions;
    if (std::any_of(all.begin(), all.end(), [&](const Client::Subscription& s) {
          return s.device.robot == loss.robot && mirror_->replaces(s.device);
        })) {
      client->lost_robot = loss.text;
    }
  }
}

std::string Clients::reason_not_to_wait(const Client& client) const {
  if (mirror_ == nullptr || client.has_data) return "";
  std::string reason;
  for (const Client::Subscription& s : client.subscriptions) {
    const std::string& loss = mirror_->loss_of(s.device);
    if (loss.empty()) return "";
    reason = loss;
  }
  return reason;
}

std::vector<std::pair<DeviceId, sim::SharedReading>> Clients::take(Client& client) {
  std::vector<std::pair<DeviceId, sim::SharedReading>> taken;
  client.zero_peeks = 0;
  if (!client.has_data) return taken;
  client.has_data = false;
  begin_round(client);
  taken.reserve(client.subscriptions.size());
  for (Client::Subscription& s : client.subscriptions) {
    for (sim::SharedReading& reading : s.unread) taken.emplace_back(s.device, std::move(reading));
    s.unread.clear();
  }
  return taken;
}

sim::SharedReading Clients::newest(DeviceId device) const {
  if (mirror_ != nullptr && mirror_->replaces(device)) return mirror_->newest(device);
  sim::SharedReading reading = simulation_.device(device.robot, device.device).sensor()->share();
  return reading->sequence > 0 ? reading : nullptr;
}

Client::Subscription* Clients::find(Client& client, DeviceId device) {
  const auto it = std::lower_bound(client.subscriptions.begin(), client.subscriptions.end(), device,
                                   subscribed_before);
  return it != client.subscriptions.end() && it->device == device ? &*it : nullptr;
}

void Clients::forget_subscriber(const Client& client, DeviceId device) noexcept {
  std::erase(feed(device).subscribers, &client);
}

void Clients::begin_round(Client& client) const {
  client.empty_round_ns = simulation_.now_ns() + kEmptyRound_ns;
}

template <typename IsFor>
void Clients::give(const Feed& feed, DeviceId device, const sim::SharedReading& reading,
                   IsFor is_for) {
  for (Client* const client : feed.subscribers) {
    if (!is_for(*client)) continue;
    Client::Subscription& s = *find(*client, device);
    client->has_data = true;
    if (s.replace) {
      s.unread.clear();
    } else if (s.unread.size() == kQueueLimit) {
      s.unread.erase(s.unread.begin());
      ++client->overflow;
    }
    s.unread.push_back(reading);
  }
}

}  // namespace playerlike
