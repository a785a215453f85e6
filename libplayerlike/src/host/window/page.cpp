// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/window/page.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/requests/arena.h"
#include "host/requests/object_properties.h"
#include "playerlike/replay/replay_encoder.h"
#include "sim/core/number_text.h"
#include "sim/core/utf8.h"

namespace playerlike {
namespace {

using nlohmann::json;

// How long a robot is steered by a command that is not repeated.
constexpr std::chrono::seconds kSteeringTime{1};
// Nobody watches if a part is not taken for so long; then the run is looked at with the period.
constexpr std::chrono::seconds kUntakenLimit{1};
constexpr std::chrono::milliseconds kLookPeriod{200};
constexpr double kLeastSpeed = 1.0 / 16.0;
constexpr double kGreatestSpeed = 64.0;

// A message with this thread's own words for the client.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A member of a command. @throws Refusal if it is missing or of another type.
const json& member(const json& what, const char* name) {
  if (!what.is_object() || !what.contains(name)) {
    throw Refusal(std::string("\"") + name + "\" is missing");
  }
  return what.at(name);
}

double number(const json& what, const char* name) {
  const json& value = member(what, name);
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw Refusal(std::string("\"") + name + "\" must be a finite number");
  }
  return value.get<double>();
}

double share(const json& what, const char* name) {
  const double value = number(what, name);
  if (!(std::abs(value) <= 1.0)) {
    throw Refusal(std::string("\"") + name + "\" must be in [-1, 1]");
  }
  return value;
}

bool flag(const json& value, const char* name) {
  if (!value.is_boolean()) throw Refusal(std::string("\"") + name + "\" must be true or false");
  return value.get<bool>();
}

std::string message(page::HostKind kind, std::uint32_t client, const std::string& contents) {
  return page::header_bytes({.kind = static_cast<std::uint32_t>(kind),
                             .client = client,
                             .length = static_cast<std::uint32_t>(contents.size())}) +
         contents;
}

}  // namespace

Host::Core::Page::Page(Core& core, int socket) : FrameLink(socket, "the page"), core_(core) {
  for (const RobotInfo& robot : core_.robots_) commands_.emplace_back(robot.devices.size());
  core_.inputs_.on_command = [this](DeviceId device, const sim::Command& command) {
    NewestCommand& newest =
        commands_[static_cast<std::size_t>(device.robot)][static_cast<std::size_t>(device.device)];
    newest.command = command;
    newest.is_new = true;
  };
  start();
}

Host::Core::Page::~Page() {
  stop();
  const Lock lock = core_.lock_with_priority();
  core_.inputs_.on_command = {};
}

bool Host::Core::Page::handle_messages(std::string& received, bool& garbage) {
  while (const auto message = page::take_page_message(received, garbage)) {
    switch (message->kind) {
      case page::PageKind::kReady:
        ready_ = true;
        break;
      case page::PageKind::kTaken:
        under_way_ = false;
        break;
      case page::PageKind::kWantWhole:
        want_whole_ = true;
        break;
      case page::PageKind::kCommand:
        execute(message->client, message->contents);
        break;
      case page::PageKind::kGone:
        for (auto it = steered_.begin(); it != steered_.end();) {
          const auto [robot, steering] = *it++;
          if (steering.client == message->client) end_steering(robot);
        }
        break;
    }
  }
  return true;
}

std::string Host::Core::Page::make_frame() {
  return frame(core_.locked([&] { return core_.over(); }));
}

std::string Host::Core::Page::last_frame() { return ready_ && builder_ ? frame(true) : ""; }

std::string Host::Core::Page::frame(bool ends) {
  replay::ReplayRun part;
  std::optional<replay::ReplayRun> whole;
  std::string now_live;
  {
    const Lock lock = core_.lock_with_priority();
    look();
    part = builder_->take();
    if (std::exchange(want_whole_, false) || anew_) whole = builder_->whole();
    now_live = live(ends).dump();
  }
  std::string bytes;
  // For those who begin anew, the part has no meaning.
  if (!anew_ && (replay::has_news(part) || now_live != sent_live_)) {
    bytes = message(page::HostKind::kPart, 0, replay::encoded_part(part, now_live));
    under_way_ = true;
    sent_live_ = now_live;
  }
  if (whole) {
    const page::HostKind kind =
        std::exchange(anew_, false) ? page::HostKind::kAnew : page::HostKind::kWhole;
    bytes += message(kind, 0, replay::encoded_whole(*whole, now_live));
  }
  next_look_ = Clock::now() + kUntakenLimit;
  return bytes;
}

// Observes the simulation. The mutex is held.
void Host::Core::Page::look() {
  const sim::Simulation& simulation = core_.simulation_;
  // After a reset all viewers begin anew.
  if (builder_ && simulation.now_ns() < builder_->observed_ns()) {
    builder_.reset();
    anew_ = true;
  }
  if (!builder_) builder_.emplace(simulation, replay::ReplayOptions{.live = true});
  for (std::size_t robot = 0; robot < commands_.size(); ++robot) {
    for (std::size_t device = 0; device < commands_[robot].size(); ++device) {
      NewestCommand& newest = commands_[robot][device];
      if (!std::exchange(newest.is_new, false)) continue;
      builder_->note_command(simulation.now_ns(),
                             {static_cast<int>(robot), static_cast<int>(device)}, newest.command);
    }
  }
  builder_->observe(simulation);
}

// The state of the run beside the simulation. The mutex is held.
json Host::Core::Page::live(bool ends) const {
  const sim::WorldDescription& world = core_.simulation_.world();
  const bool has_speed = core_.paced() || core_.pace_.watched(core_.simulation_.now_ns());
  json steered = json::array();
  for (std::size_t robot = 0; robot < core_.robots_.size(); ++robot) {
    if (core_.inputs_.hand->active(static_cast<int>(robot))) steered.push_back(robot);
  }
  const bool locked = world.simulation.objects_locked;
  json blocks = json::array();
  for (const ArenaBlock& block : arena_blocks(core_.simulation_)) {
    if (!locked) blocks.push_back(sim::escape_invalid_utf8(block.name));
  }
  json can = {{"speed", core_.mirror_ == nullptr}, {"place", true}, {"blocks", std::move(blocks)}};
  if (locked) can["place"] = "this world locks its robots and obstacles (\"lock_objects\")";
  const int clients = world.simulation.start_gate_clients;
  const bool waits = !core_.progress_.first_step() && !core_.stands_still();
  return {{"paused", core_.pace_.paused()},
          {"waiting_for", waits ? std::max(clients, 1) : 0},
          {"factor", has_speed ? json(core_.pace_.factor()) : json()},
          {"paced", core_.paced()},
          {"steered", std::move(steered)},
          {"over", ends},
          {"can", std::move(can)}};
}

void Host::Core::Page::execute(std::uint32_t client, const std::string& text) {
  std::string refusal;
  try {
    refusal = execute(client, json::parse(text));
  } catch (const std::exception& error) {  // also of JSON
    refusal = error.what();
  }
  if (refusal.empty()) return;
  const json answer = {{"refused", refusal}};
  append(message(page::HostKind::kAnswer, client,
                 answer.dump(-1, ' ', false, json::error_handler_t::replace)));
}

std::string Host::Core::Page::execute(std::uint32_t client, const json& command) {
  if (!command.is_object() || command.size() != 1) {
    return "a command is an object with one member: steer, pause, speed, block or place";
  }
  const std::string& name = command.begin().key();
  const json& what = command.begin().value();
  const Lock lock = core_.lock_with_priority();
  if (core_.stands_still()) return "the run is over";
  if (name == "steer") return steer(client, what);
  if (name == "pause") return pause(flag(what, "pause"));
  if (name == "speed") return change_speed(number(command, "speed"));
  if (name != "block" && name != "place") return "there is no command \"" + name + '"';
  if (core_.simulation_.world().simulation.objects_locked) {
    return "this world locks its robots and obstacles (\"lock_objects\")";
  }
  core_.acted_on_page_ = true;
  return name == "block" ? set_block(what) : place(what);
}

std::string Host::Core::Page::steer(std::uint32_t client, const json& what) {
  const double robot = number(what, "robot");
  const HandDrive::Stick stick{.ahead = share(what, "ahead"), .left = share(what, "left")};
  const auto index = static_cast<int>(std::clamp(robot, -1.0, 1e6));
  if (!core_.inputs_.hand->can_drive(index) || static_cast<double>(index) != robot) {
    return "there is no robot " + sim::shortest_text(robot) + " with motors";
  }
  core_.driven_by_hand_ = true;
  if (stick.at_rest()) {
    steered_.erase(index);
  } else {
    steered_[index] = {client, Clock::now() + kSteeringTime};
  }
  core_.inputs_.hand->steer(index, stick);
  return !stick.at_rest() && core_.pace_.paused() ? "paused: the robot moves when the run continues"
                                                  : "";
}

std::string Host::Core::Page::pause(bool paused) {
  core_.pace_.set_paused(paused);
  core_.changed_.notify_all();
  return "";
}

std::string Host::Core::Page::change_speed(double factor) {
  if (core_.mirror_) return "speed fixed: a robot mirrors a real one";
  if (!(factor >= kLeastSpeed && factor <= kGreatestSpeed)) {
    return "the speed must be in [" + sim::shortest_text(kLeastSpeed) + ", " +
           sim::shortest_text(kGreatestSpeed) + "]";
  }
  if (!core_.paced() && !core_.pace_.watched(core_.simulation_.now_ns())) {
    core_.pace_.watch_from(core_.simulation_.now_ns());
    core_.pace_.begin_at(Clock::now());
  }
  core_.pace_.set_factor(factor);
  core_.changed_.notify_all();
  return "";
}

std::string Host::Core::Page::set_block(const json& what) {
  const json& name = member(what, "name");
  if (!name.is_string()) return "\"name\" must be a text";
  playerlike::set_block(core_.simulation_, name.get<std::string>(), flag(member(what, "up"), "up"));
  return "";
}

std::string Host::Core::Page::place(const json& what) {
  const double robot = number(what, "robot");
  const auto index = static_cast<std::size_t>(std::clamp(robot, 0.0, 1e6));
  if (index >= core_.robots_.size() || static_cast<double>(index) != robot) {
    return "there is no robot " + sim::shortest_text(robot);
  }
  place_object(core_.simulation_, core_.robots_[index].name,
               {number(what, "x"), number(what, "y"), number(what, "a")});
  return "";
}

void Host::Core::Page::end_steering(int robot) {
  steered_.erase(robot);
  const Lock lock = core_.lock_with_priority();
  core_.inputs_.hand->steer(robot, {});
}

void Host::Core::Page::tick() {
  const auto now = Clock::now();
  // Whoever comes later wants to see the trails and events from before.
  if (ready_ && under_way_ && now >= next_look_) {
    next_look_ = now + kLookPeriod;
    const Lock lock = core_.lock_with_priority();
    look();
    static_cast<void>(builder_->take());
    anew_ = true;  // also for viewers that have merely not got the last part yet
  }
  for (auto it = steered_.begin(); it != steered_.end();) {
    const auto [robot, steering] = *it++;
    if (steering.until <= now) end_steering(robot);
  }
}

FrameLink::Clock::time_point Host::Core::Page::awake_until() const {
  Clock::time_point last = ready_ && under_way_ ? next_look_ + kUntakenLimit : Clock::time_point{};
  for (const auto& [robot, steering] : steered_) {
    last = std::max(last, steering.until + std::chrono::seconds(1));
  }
  return last;
}

void Host::Core::Page::on_lost(const std::string& reason) {
  for (const auto& [robot, steering] : steered_) {
    const Lock lock = core_.lock_with_priority();
    core_.inputs_.hand->steer(robot, {});
  }
  steered_.clear();
  const Lock lock = core_.lock_with_priority();
  if (core_.pace_.paused()) {
    core_.pace_.set_paused(false);
    core_.changed_.notify_all();
  }
  if (!core_.over()) {
    core_.warn_("the live page is lost (" + reason + "); the run continues without it");
  }
}

}  // namespace playerlike
