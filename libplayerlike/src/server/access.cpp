// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "playerlike/server/token_equal.h"
#include "server/peer.h"
#include "sim/core/error.h"

namespace playerlike::server {
namespace {

bool presented(const std::string& token, const std::vector<std::string>& tokens,
               std::size_t count) {
  bool found = false;
  for (std::size_t i = 0; i < count; ++i) {
    const bool same = equal_tokens(token, tokens[i]);
    found = found || same;
  }
  return found;
}

}  // namespace

bool Rights::command_all() const {
  return connect && std::all_of(command.begin(), command.end(), [](bool may) { return may; });
}

bool Rights::change_shared() const {
  return connect && (command.empty() ||
                     std::any_of(command.begin(), command.end(), [](bool may) { return may; }));
}

Access::Access(const AccessSettings& settings, const std::vector<RobotInfo>& robots, bool own_only)
    : server_token_(settings.server_token),
      robot_tokens_(robots.size()),
      open_watching_(settings.open_watching),
      own_only_(own_only) {
  for (const RobotInfo& robot : robots) ports_.push_back(robot.port);
  std::vector<std::string> names;
  names.reserve(robots.size());
  for (const RobotInfo& robot : robots) names.push_back(robot.name);
  std::vector<sim::ConfigIssue> issues;
  for (const auto& [name, token] : settings.robot_tokens) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) {
      robot_tokens_[static_cast<std::size_t>(found - names.begin())] = token;
      continue;
    }
    std::string list;
    for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
    const std::string near = sim::nearest_word(name, names);
    issues.push_back({"access/unknown-robot", settings.file, "/robots/" + name,
                      list.empty() ? "no name, since the world has no robot"
                                   : "the name of a robot of the world (" + list + ')',
                      '"' + name + '"', near.empty() ? "" : "did you mean \"" + near + "\"?"});
  }
  if (!issues.empty()) throw sim::ConfigError(std::move(issues));
}

Rights Access::rights(const std::vector<std::string>& tokens, int port) const {
  // Limits the work for a long list.
  const std::size_t count = std::min(tokens.size(), robot_tokens_.size() + 16);
  const bool may_connect = server_token_.empty() || presented(server_token_, tokens, count);
  Rights rights;
  rights.connect = may_connect;
  rights.command.reserve(robot_tokens_.size());
  for (const std::string& token : robot_tokens_) {
    const bool may_command = token.empty() ? may_connect : presented(token, tokens, count);
    rights.command.push_back(may_command);
    rights.connect = rights.connect || may_command;
  }
  rights.truth = true;
  for (std::size_t i = 0; i < robot_tokens_.size(); ++i) {
    const bool has_token = !robot_tokens_[i].empty();
    const bool own = has_token || ports_[i] == port || ports_.size() == 1;
    rights.read.push_back(own_only_ ? rights.command[i] && own : rights.connect);
    rights.truth = rights.truth && (!own_only_ || (has_token && rights.command[i]));
  }
  rights.watch = (rights.connect || open_watching_) && rights.truth;
  return rights;
}

bool Access::has_wrong(const std::vector<std::string>& tokens) const {
  bool has_tokens = !server_token_.empty();
  for (const std::string& own : robot_tokens_) has_tokens = has_tokens || !own.empty();
  if (!has_tokens) return false;
  bool wrong = false;
  for (const std::string& token : tokens) {
    bool known = !server_token_.empty() && equal_tokens(server_token_, token);
    for (const std::string& own : robot_tokens_) {
      const bool same = !own.empty() && equal_tokens(own, token);
      known = known || same;
    }
    wrong = wrong || !known;
  }
  return wrong;
}

Hub::TokenVerdict Hub::check_tokens(const Peer& peer, const std::vector<std::string>& tokens) {
  const TokenThrottle::Clock::time_point now = TokenThrottle::Clock::now();
  if (tokens.empty()) return {};
  if (!access().has_wrong(tokens)) return {false, throttle_.delay_of_right(peer.name(), now)};
  const TokenThrottle::Cost cost = throttle_.note_wrong(peer.name(), now);
  if (cost.tell) {
    log(sim::LogLevel::kWarning,
        peer.name() + ": a wrong token, " + std::to_string(cost.count) +
            (cost.count == 1 ? " from this address" : " from this address in the last minute"));
  }
  return {true, cost.delay};
}

void Hub::answer_after(std::chrono::milliseconds delay, Peer& peer, std::weak_ptr<void> handler,
                       std::function<void()> action) {
  if (delay <= delay.zero()) return action();
  peer.set_busy(true);
  after(delay, [&peer, handler = std::move(handler), action = std::move(action)] {
    if (handler.expired()) return;
    peer.set_busy(false);  // messages in the read buffer are handled after the action
    action();
  });
}

}  // namespace playerlike::server
