// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ostream>
#include <string_view>
#include <utility>

#include "core/errors.h"
#include "libCCMorse/ArenaProxy.h"
#include "proxies/link.h"
#include "session/checks.h"

namespace CCMorse {

using playerlike::ArenaStatus;
using playerlike::ClientCore;
using playerlike::translated;

namespace {

std::string full_name(const char* function) { return std::string("ArenaProxy::") + function; }

// Calls action(session) and converts its errors. Also after the end of the run.
template <typename Action>
auto ask(const std::shared_ptr<ClientCore>& core, const char* function, Action action) {
  return translated(full_name(function).c_str(), [&] {
    if (core->closed()) core->require_usable();
    return action(core->session());
  });
}

const std::shared_ptr<ClientCore>& require_core(const PlayerClient* client) {
  if (client == nullptr) {
    playerlike::refuse("ArenaProxy::ArenaProxy",
                       "an arena needs a client, but it is a null pointer");
  }
  return PlayerCc::detail::CoreAccess::get(*client);
}

template <typename List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const auto& element : list) names.push_back(element.name);
  return names;
}

// The element of this name. @param what  e.g. "timer".
template <typename List>
const auto& require_named(const char* function, const char* what, const List& list,
                          const std::string& name) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& e) { return e.name == name; });
  if (found == list.end()) {
    playerlike::refuse(full_name(function), playerlike::unknown_name(what, name, names_of(list)));
  }
  return *found;
}

}  // namespace

ArenaProxy::ArenaProxy(PlayerClient* aClient)
    : mCore(require_core(aClient)), mNewest(0), mLost(0) {}

ArenaProxy::ArenaProxy(const MorseClient& aClient) : mCore(aClient.mCore), mNewest(0), mLost(0) {}

ArenaProxy::~ArenaProxy() = default;

ArenaStatus ArenaProxy::Status(const char* aFunction) const {
  return ask(mCore, aFunction, [](playerlike::Session& session) {
    return session.request(playerlike::ArenaRequest{});
  });
}

template <typename Request>
void ArenaProxy::Change(const char* aFunction, const Request& aRequest) {
  ask(mCore, aFunction, [&](playerlike::Session& session) { session.request(aRequest); });
}

// --- Configurations

uint32_t ArenaProxy::GetConfigurationCount() const {
  return static_cast<uint32_t>(Status("GetConfigurationCount").configurations.size());
}

std::string ArenaProxy::GetConfigurationName(uint32_t aIndex) const {
  std::vector<std::string> names = Status("GetConfigurationName").configurations;
  if (aIndex >= names.size()) {
    playerlike::refuse("ArenaProxy::GetConfigurationName",
                       "there is no configuration " + std::to_string(aIndex) + "; this world has " +
                           std::to_string(names.size()));
  }
  return std::move(names[aIndex]);
}

std::vector<std::string> ArenaProxy::GetConfigurationNames() const {
  return Status("GetConfigurationNames").configurations;
}

std::string ArenaProxy::GetConfiguration() const {
  return Status("GetConfiguration").configuration;
}

void ArenaProxy::SetConfiguration(const std::string& aName) {
  Change("SetConfiguration", playerlike::SetConfigurationRequest{aName});
}

// --- Blocks

std::vector<std::string> ArenaProxy::GetBlockNames() const {
  return names_of(Status("GetBlockNames").blocks);
}

void ArenaProxy::ExtendBlock(const std::string& aName) {
  Change("ExtendBlock", playerlike::SetBlockRequest{aName, true});
}

void ArenaProxy::RetractBlock(const std::string& aName) {
  Change("RetractBlock", playerlike::SetBlockRequest{aName, false});
}

std::string ArenaProxy::GetBlockState(const std::string& aName) const {
  const char* fun = "GetBlockState";
  const ArenaStatus status = Status(fun);
  return require_named(fun, "dynamic block", status.blocks, aName).state;
}

double ArenaProxy::GetBlockHeight(const std::string& aName) const {
  const char* fun = "GetBlockHeight";
  const ArenaStatus status = Status(fun);
  return require_named(fun, "dynamic block", status.blocks, aName).height_m;
}

// --- Timers and traps

std::vector<std::string> ArenaProxy::GetTimerNames() const {
  return names_of(Status("GetTimerNames").timers);
}

std::vector<std::string> ArenaProxy::GetTrapNames() const {
  return names_of(Status("GetTrapNames").traps);
}

void ArenaProxy::EnableTimer(const std::string& aName) {
  Change("EnableTimer", playerlike::SetTimerRequest{aName, true});
}

void ArenaProxy::DisableTimer(const std::string& aName) {
  Change("DisableTimer", playerlike::SetTimerRequest{aName, false});
}

bool ArenaProxy::IsTimerEnabled(const std::string& aName) const {
  const char* fun = "IsTimerEnabled";
  const ArenaStatus status = Status(fun);
  return require_named(fun, "timer", status.timers, aName).enabled;
}

double ArenaProxy::GetTimeLeft(const std::string& aTimer) const {
  const char* fun = "GetTimeLeft";
  const ArenaStatus status = Status(fun);
  return require_named(fun, "timer", status.timers, aTimer).time_left_s.value_or(-1.0);
}

void ArenaProxy::EnableTrap(const std::string& aName) {
  Change("EnableTrap", playerlike::SetTrapRequest{aName, true});
}

void ArenaProxy::DisableTrap(const std::string& aName) {
  Change("DisableTrap", playerlike::SetTrapRequest{aName, false});
}

bool ArenaProxy::IsTrapEnabled(const std::string& aName) const {
  const char* fun = "IsTrapEnabled";
  const ArenaStatus status = Status(fun);
  return require_named(fun, "trap", status.traps, aName).enabled;
}

uint64_t ArenaProxy::GetActCount(const std::string& aName) const {
  const char* fun = "GetActCount";
  const ArenaStatus status = Status(fun);
  std::vector<sim::ArenaTrigger> all = status.timers;
  all.insert(all.end(), status.traps.begin(), status.traps.end());
  return require_named(fun, "timer or trap", all, aName).count;
}

// --- Events and results

std::vector<ArenaEvent> ArenaProxy::GetEvents() {
  const std::lock_guard<std::mutex> lock(mMutex);
  playerlike::ArenaEventList list = ask(mCore, "GetEvents", [&](playerlike::Session& session) {
    return session.request(playerlike::ArenaEventsRequest{mNewest});
  });
  std::vector<ArenaEvent> events;
  events.reserve(list.events.size());
  for (sim::ArenaEvent& event : list.events) {
    events.push_back({event.number, sim::to_seconds(event.time_ns),
                      std::string(to_string(event.kind)), std::move(event.what),
                      std::move(event.who), std::move(event.text), event.value});
  }
  mNewest = list.newest;
  mLost += list.lost;
  return events;
}

uint64_t ArenaProxy::GetLostEventCount() const {
  const std::lock_guard<std::mutex> lock(mMutex);
  return mLost;
}

double ArenaProxy::GetScore(const std::string& aRobot) const {
  const char* fun = "GetScore";
  const ArenaStatus status = Status(fun);
  std::vector<std::string> names;
  for (const playerlike::ArenaScore& score : status.scores) {
    if (score.robot == aRobot) return score.points;
    names.push_back(score.robot);
  }
  playerlike::refuse(full_name(fun), playerlike::unknown_name("robot", aRobot, names));
}

bool ArenaProxy::HasVerdict() const { return Status("HasVerdict").verdict.has_value(); }

ArenaVerdict ArenaProxy::GetVerdict() const {
  const ArenaStatus status = Status("GetVerdict");
  if (!status.verdict) {
    throw MorseError("ArenaProxy::GetVerdict", "no action of the arena has ended the run",
                     MorseError::kNotAvailable);
  }
  return {status.verdict->passed, status.verdict->reason, sim::to_seconds(status.verdict->time_ns)};
}

}  // namespace CCMorse

namespace std {

std::ostream& operator<<(std::ostream& os, const CCMorse::ArenaEvent& e) {
  return os << e.number << '\t' << e.time << '\t' << e.kind << '\t' << e.what << '\t' << e.who
            << '\t' << e.text << '\t' << e.value;
}

std::ostream& operator<<(std::ostream& os, const CCMorse::ArenaProxy& a) {
  os << "#arena " << a.GetConfiguration() << "\n#block\tstate\theight [m]\n";
  for (const std::string& name : a.GetBlockNames()) {
    os << name << '\t' << a.GetBlockState(name) << '\t' << a.GetBlockHeight(name) << '\n';
  }
  os << "#timer\ton\tacted\n";
  for (const std::string& name : a.GetTimerNames()) {
    os << name << '\t' << a.IsTimerEnabled(name) << '\t' << a.GetActCount(name) << '\n';
  }
  os << "#trap\ton\tacted\n";
  for (const std::string& name : a.GetTrapNames()) {
    os << name << '\t' << a.IsTrapEnabled(name) << '\t' << a.GetActCount(name) << '\n';
  }
  return os;
}

}  // namespace std
