// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The requests of programs that decide by numbers, step by step: `select` and `step`, see
// docs/protocol.md.
#include <algorithm>
#include <numeric>
#include <utility>

#include "protocol/codec.h"
#include "protocol/field_codec.h"
#include "server/native_handler.h"
#include "session/checks.h"

namespace playerlike::server {
namespace {

using protocol::json;
using protocol::ProtocolError;

// Limits of one message.
constexpr std::size_t kMostDevices = 4096;
constexpr std::size_t kMostKeys = 64;
constexpr std::size_t kMostPicks = std::size_t{1} << 15U;  ///< keys of all devices together
// Numbers of one answer: 2 MiB in CBOR, less than 7 MiB in JSON.
constexpr std::size_t kMostNumbers = std::size_t{1} << 18U;
// Rounds of readings that a step waits for before other connections get a turn.
constexpr int kRoundsATurn = 32;

constexpr std::size_t kBytesANumber = 25;  // at most, in JSON

constexpr const char* kDevices = "a list of up to 4096 objects with \"device\" and \"keys\"";
constexpr const char* kMotions = "a list of up to 4096 motion devices, each [robot, device]";

bool is_before(DeviceId a, DeviceId b) {
  return a.robot != b.robot ? a.robot < b.robot : a.device < b.device;
}

/// Keeps the newest reading of each selected device.
class NewestReadings final : public ReadingSink {
 public:
  explicit NewestReadings(StepSelection& selection) : selection_(selection) {}
  void on_reading(DeviceId device, const sim::SharedReading& reading) override {
    const std::vector<std::size_t>& by_id = selection_.by_id;
    auto at = std::lower_bound(by_id.begin(), by_id.end(), device,
                               [this](std::size_t index, DeviceId id) {
                                 return is_before(selection_.devices[index].id, id);
                               });
    for (; at != by_id.end() && selection_.devices[*at].id == device; ++at) {
      selection_.devices[*at].newest = reading;
    }
  }

 private:
  StepSelection& selection_;
};

void sort_by_id(StepSelection& selection) {
  selection.by_id.resize(selection.devices.size());
  std::iota(selection.by_id.begin(), selection.by_id.end(), std::size_t{0});
  std::sort(selection.by_id.begin(), selection.by_id.end(), [&](std::size_t a, std::size_t b) {
    return is_before(selection.devices[a].id, selection.devices[b].id);
  });
}

std::size_t count_numbers(const StepSelection::Device& device, const sim::Reading& reading) {
  std::size_t count = 0;
  for (const protocol::NumberPick& pick : device.picks) count += pick.count(reading);
  return count;
}

void require_few_numbers(std::size_t numbers) {
  if (numbers <= kMostNumbers) return;
  throw ProtocolError("protocol/bad-value",
                      "numbers: expected at most " + std::to_string(kMostNumbers) +
                          " numbers in an answer to step, found " + std::to_string(numbers));
}

}  // namespace

json NativeHandler::select(const json& request) {
  if (waiting_) throw ProtocolError("protocol/busy", "a read or step of this session waits");
  const std::vector<RobotInfo>& robots = hub_.host().robots();
  auto selection = std::make_unique<StepSelection>();
  std::size_t picks = 0;
  const json& numbers = protocol::require(request, "numbers");
  if (protocol::require_list(numbers, "numbers", kDevices).size() > kMostDevices) {
    protocol::refuse_value("numbers", kDevices, numbers);
  }
  for (const json& item : numbers) {
    protocol::refuse_unknown_keys(item, {"device", "keys"}, "an item of numbers");
    const DeviceId device = protocol::require_device_id(item, "device");
    guard_.check(SubscribeRequest{device});
    const std::string& type = require_device(robots, device).type;
    const std::vector<std::string> keys = protocol::require_texts(item, "keys", "a list of keys");
    if (keys.empty() || keys.size() > kMostKeys) {
      protocol::refuse_value("keys", "1 to 64 keys of readings", item["keys"]);
    }
    picks += keys.size();
    if (picks > kMostPicks) {
      throw ProtocolError("protocol/bad-value", "numbers: expected at most " +
                                                    std::to_string(kMostPicks) +
                                                    " keys of all devices together, found more");
    }
    StepSelection::Device& added = selection->devices.emplace_back();
    added.id = device;
    for (const std::string& key : keys) added.picks.emplace_back(type, key);
    selection->numbers += expected_numbers(added);
    require_few_numbers(selection->numbers);
  }
  sort_by_id(*selection);
  if (request.contains("motions")) {
    const json& motions = request["motions"];
    if (protocol::require_list(motions, "motions", kMotions).size() > kMostDevices) {
      protocol::refuse_value("motions", kMotions, motions);
    }
    for (const json& motion : motions) {
      const DeviceId device = protocol::require_device_id({{"motions", motion}}, "motions");
      guard_.check_command(device);
      if (require_device(robots, device).type != "motion") {
        protocol::refuse_value("motions", kMotions, motion);
      }
      selection->motions.push_back(device);
    }
  }
  subscribe_all(*selection);
  if (selection_) unsubscribe_all(*selection_);
  selection_ = std::move(selection);
  return json::object();
}

std::size_t NativeHandler::expected_numbers(const StepSelection::Device& device) {
  const sim::SharedReading reading =
      hub_.host().with_simulation([&](const sim::Simulation& simulation) {
        const sim::Sensor* const sensor =
            simulation.device(device.id.robot, device.id.device).sensor();
        return sensor == nullptr ? nullptr : sensor->share();
      });
  return reading == nullptr ? 0 : count_numbers(device, *reading);
}

void NativeHandler::subscribe_all(const StepSelection& selection) {
  std::size_t done = 0;
  try {
    for (; done < selection.devices.size(); ++done) {
      session().request(SubscribeRequest{selection.devices[done].id});
    }
  } catch (...) {
    while (done > 0) session().request(UnsubscribeRequest{selection.devices[--done].id});
    throw;
  }
}

void NativeHandler::unsubscribe_all(const StepSelection& selection) {
  for (const StepSelection::Device& device : selection.devices) {
    session().request(UnsubscribeRequest{device.id});
  }
}

void NativeHandler::step(const json& request, const json& id) {
  if (!selection_ || selection_->devices.empty()) {
    throw ProtocolError("session/bad-argument",
                        "step: expected a select with numbers before it, found none");
  }
  if (waiting_) {
    throw ProtocolError("protocol/busy", "a read or step of this session waits; one can at a time");
  }
  const ThreadId thread = thread_id(request);
  const bool is_large = selection_->numbers * kBytesANumber > kSmallAnswer;
  // Only checks that there is room: the answer is made at once when the wait is over.
  if (is_large) static_cast<void>(hub_.claim_room(selection_->numbers * kBytesANumber));
  if (request.contains("twists")) {
    const std::vector<double> twists =
        protocol::require_doubles(request, "twists", terms_.encoding);
    if (twists.size() != 2 * selection_->motions.size()) {
      throw ProtocolError("protocol/bad-value",
                          "twists: expected " + std::to_string(2 * selection_->motions.size()) +
                              " numbers, speed and turn rate of each selected motion, found " +
                              std::to_string(twists.size()));
    }
    for (const DeviceId motion : selection_->motions) guard_.check_command(motion);
    const double* next = twists.data();
    for (const DeviceId motion : selection_->motions) {
      sim::TwistCommand command;
      command.twist.v_mps = *next++;
      command.twist.omega_radps = *next++;
      session().send(motion, command);
    }
  }
  wait_for_step(id, thread);
}

// Usually lockstep time can advance at once, and all readings come in the same step.
void NativeHandler::wait_for_step(const json& id, ThreadId thread) {
  Waiting waiting{id, Wait::kStep};
  waiting.thread = thread;
  waiting_ = std::move(waiting);
  try {
    for (int i = 0; i < kRoundsATurn; ++i) {
      const Outcome outcome = wait_->begin([&] { return wait_->client()->begin_wait(thread); });
      if (outcome == Outcome::kWaiting) return peer_.set_in_flight(1);
      if (!step_is_over(outcome)) continue;
      waiting_.reset();
      peer_.set_in_flight(0);
      return answer(id, round_of_step());
    }
  } catch (...) {
    waiting_.reset();
    peer_.set_in_flight(0);
    throw;
  }
  waiting_->rests = true;
  peer_.set_in_flight(1);
  hub_.post([weak = std::weak_ptr<NativeHandler*>(self_)] {
    if (const auto self = weak.lock()) (*self)->go_on_with_step();
  });
}

bool NativeHandler::step_is_over(Outcome outcome) {
  if (outcome == Outcome::kFinished) {
    throw SessionError(SessionError::Code::kFinished, "the simulated run is over");
  }
  if (outcome != Outcome::kData) {
    throw SessionError(SessionError::Code::kDisconnected, "the session is closed");
  }
  light_drawings_.note_step();
  NewestReadings sink(*selection_);
  session().take(sink);
  return std::all_of(selection_->devices.begin(), selection_->devices.end(),
                     [](const auto& device) { return device.newest != nullptr; });
}

json NativeHandler::round_of_step() {
  std::size_t count = 0;
  for (const auto& device : selection_->devices) count += count_numbers(device, *device.newest);
  selection_->numbers = count;
  require_few_numbers(count);
  std::vector<double> numbers;
  numbers.reserve(count);
  for (StepSelection::Device& device : selection_->devices) {
    for (const protocol::NumberPick& pick : device.picks) pick.append(*device.newest, numbers);
    device.newest = nullptr;
  }
  const TimeStatistics time = hub_.host().time();
  json answer = json::object();
  answer["numbers"] = protocol::doubles(numbers, terms_.encoding);
  answer["t"] = time.sim_time_ns;
  answer["finished"] = time.finished;
  return answer;
}

}  // namespace playerlike::server
