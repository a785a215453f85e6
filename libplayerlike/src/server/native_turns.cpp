// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The waits of programs in virtual time; see docs/protocol.md.
#include <algorithm>
#include <string>
#include <vector>

#include "protocol/codec.h"
#include "server/native_handler.h"
#include "session/checks.h"

namespace playerlike::server {
namespace {

using protocol::json;
using protocol::ProtocolError;

// Limits of one message.
constexpr std::size_t kMostSessions = 256;
constexpr std::size_t kMostReasons = 32;
constexpr std::size_t kLongestReason = 300;  // bytes

/// The list under a key, of elements with a property; empty without the key.
template <typename IsElement>
json list_of(const json& request, const char* key, std::size_t most, const char* elements,
             IsElement is_element) {
  const auto list = request.find(key);
  if (list == request.end()) return json::array();
  if (!list->is_array() || list->size() > most ||
      !std::all_of(list->begin(), list->end(), is_element)) {
    protocol::refuse_value(key, "a list of up to " + std::to_string(most) + ' ' + elements, *list);
  }
  return *list;
}

}  // namespace

EventClient::TurnsWait NativeHandler::turns_wait(const json& request) const {
  constexpr std::int64_t kLatest_ns = std::int64_t{1} << 62U;
  EventClient::TurnsWait wait;
  wait.wants_data = protocol::require_bool(request, "data");
  wait.until_ns = protocol::require_integer(request, "until", 0, kLatest_ns);
  static_cast<void>(protocol::require_bool(request, "take"));
  const auto sessions = [&](const char* key) {
    std::vector<const EventClient*> clients;
    const json numbers = list_of(request, key, kMostSessions, "numbers of sessions",
                                 [](const json& number) { return number.is_number_unsigned(); });
    // One that is unknown may just have been closed.
    for (const auto& [secret, open] : state_->open) {
      if (open.process != terms_.process) continue;
      if (std::find(numbers.begin(), numbers.end(), json(open.number)) != numbers.end()) {
        clients.push_back(open.client);
      }
    }
    return clients;
  };
  wait.others = sessions("others");
  wait.joined = sessions("joined");
  return wait;
}

void NativeHandler::note_unrepeatable(const json& request) {
  const json reasons = list_of(
      request, "unrepeatable", kMostReasons, "texts of up to 300 printable bytes",
      [](const json& text) {
        return text.is_string() && text.get_ref<const std::string&>().size() <= kLongestReason &&
               is_printable(text.get_ref<const std::string&>());
      });
  for (const json& reason : reasons) hub_.host().note_unrepeatable(reason.get<std::string>());
}

// The new session has no part in anything but in the time of the program's other sessions.
json NativeHandler::leave(const json& /*request*/) {
  if (waiting_) throw ProtocolError("protocol/busy", "a read of this session waits");
  state_->open.erase(terms_.key);
  wait_.reset();
  selection_.reset();  // its subscriptions were those of the session
  open_session(EventRole::kFollower);
  hub_.pump();
  return json::object();
}

json NativeHandler::ready_sessions() const {
  json ready = json::array();
  for (const auto& [secret, open] : state_->open) {
    if (open.process == terms_.process && open.client->has_data()) ready.push_back(open.number);
  }
  return ready;
}

bool NativeHandler::is_only_program() const {
  return state_->open.size() == hub_.connections() &&
         std::all_of(state_->open.begin(), state_->open.end(),
                     [this](const auto& entry) { return entry.second.process == terms_.process; });
}

json NativeHandler::round_of_turns(bool take) {
  json answer = json::object();
  answer["readings"] = json::array();
  if (take) take_readings(answer);
  answer["data"] = take;
  answer["ready"] = ready_sessions();
  const bool alone = is_only_program();
  answer["alone"] = alone;
  if (alone) hub_.expect_soon();
  const TimeStatistics time = hub_.host().time();
  answer["t"] = time.sim_time_ns;
  answer["finished"] = time.finished;
  answer["overflow"] = session().request(OverflowRequest{});
  return answer;
}

}  // namespace playerlike::server
