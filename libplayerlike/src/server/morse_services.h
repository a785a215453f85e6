// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "server/morse_state.h"

namespace playerlike::server {

struct MorseService;

/// The arguments of a request, checked on access. All accessors throw MorseRefusal, which names the
/// argument, the expected value and the value found.
class MorseArguments {
 public:
  MorseArguments(const MorseService& service, const nlohmann::json& list)
      : service_(service), list_(list) {}

  [[nodiscard]] std::size_t count() const noexcept { return list_.size(); }
  [[nodiscard]] bool has(std::size_t index) const noexcept { return index < list_.size(); }
  /// A finite number in [least, most]; `otherwise` if the argument is missing or null.
  [[nodiscard]] double number(std::size_t index, double least, double most,
                              std::optional<double> otherwise = {}) const;
  [[nodiscard]] int integer(std::size_t index, int least, int most,
                            std::optional<int> otherwise = {}) const;
  [[nodiscard]] std::string text(std::size_t index) const;
  [[nodiscard]] bool boolean(std::size_t index) const;
  [[nodiscard]] const nlohmann::json& list(std::size_t index) const;
  [[nodiscard]] const nlohmann::json& any(std::size_t index) const { return list_.at(index); }
  /// Throws MorseRefusal for an argument.
  [[noreturn]] void refuse(std::size_t index, const std::string& expected) const;

 private:
  const MorseService& service_;
  const nlohmann::json& list_;
};

/// A request, passed to the function that answers it.
struct MorseCall {
  MorseState& state;
  MorseConnection& from;
  const std::string& id;
  const MorseComponent* component;  ///< null: `simulation`, `time` or `arena`
  MorseArguments arguments;
};

/// The device of a request to a component that is one.
[[nodiscard]] inline DeviceId id_of(const MorseCall& call) {
  return call.component->device.value();
}
/// Asks the device of a request, between two steps.
/// @param question  a function of `const Kind&`, such as a getter, or of that and
///                  `const sim::Simulation&`. It must not command devices or wait.
/// @return its result, as a value.
template <typename Kind, typename Question>
[[nodiscard]] auto ask(const MorseCall& call, const Question& question) {
  return call.state.host().with_simulation([&](const sim::Simulation& simulation) {
    const DeviceId id = id_of(call);
    const auto& device = dynamic_cast<const Kind&>(simulation.device(id.robot, id.device));
    if constexpr (std::is_invocable_v<const Question&, const Kind&>) {
      return std::invoke(question, device);
    } else {
      return question(device, simulation);
    }
  });
}

/// Sends a command to the device of a request; see MorseState::command().
void command(const MorseCall& call, const sim::Command& what);
/// The same, and answers without a result when done(device) is true; see MorseState::answer_when().
void answer_when(const MorseCall& call, const sim::Command& what,
                 std::function<bool(const sim::Device&)> done);
/// All objects of the scene, see sim::Simulation::scene_objects().
[[nodiscard]] std::vector<sim::SceneObject> scene_of(const MorseCall& call);

/// A request about the canvas, on the server's thread or in the worker thread.
struct PenCall {
  EventClient& client;
  const MorseArguments& arguments;
};

/// A row of the table of services.
struct MorseService {
  /// The right that a client needs.
  enum class Right {
    kConnect,  ///< to use the server
    kRobot,    ///< to command the component's robot
    kAll,      ///< to command all robots
  };
  using Run = nlohmann::json (*)(MorseCall& call);
  using Work = nlohmann::json (*)(const PenCall& call);

  std::string_view name;
  std::string_view arguments;  ///< in the syntax of docs/morse.md: "x, y, z, tolerance=0.5"
  Right right;
  Run run;
  /// Does the same as `run` for requests that may take long: the server's worker thread calls it if
  /// the canvas is large.
  Work work = nullptr;
  bool later = false;     ///< `run` arranges for a later answer; its result is ignored
  bool is_heavy = false;  ///< `work` takes long on any canvas

  /// The number of arguments; least() excludes those with a default.
  [[nodiscard]] constexpr std::size_t most() const {
    return arguments.empty() ? 0 : count_of(',') + 1;
  }
  [[nodiscard]] constexpr std::size_t least() const { return most() - count_of('='); }
  [[nodiscard]] constexpr std::size_t count_of(char sign) const {
    return static_cast<std::size_t>(std::count(arguments.begin(), arguments.end(), sign));
  }
};

/// The services of `simulation`, `time` or `arena`, or of a kind of component, in the order of
/// docs/morse.md.
/// @param kind  "simulation", "time", "arena", "motion", "waypoint", "teleport", "pen", "sensor"
/// (services
///              of all sensors) or "component" (services of all components).
[[nodiscard]] std::span<const MorseService> morse_services(std::string_view kind);

[[nodiscard]] std::span<const MorseService> simulation_services();
[[nodiscard]] std::span<const MorseService> time_services();
[[nodiscard]] std::span<const MorseService> arena_services();
[[nodiscard]] std::span<const MorseService> pen_services();
[[nodiscard]] std::span<const MorseService> communication_services();
[[nodiscard]] std::span<const MorseService> arm_services();  ///< of actarray devices
/// The services of ptz, actarray, posture, proximity, hand, blinkenlight and camera devices; empty
/// for others.
[[nodiscard]] std::span<const MorseService> device_services(std::string_view type);

/// Whether this is a component that belongs to no robot: `simulation`, `time` or `arena`.
[[nodiscard]] bool is_world_component(std::string_view component) noexcept;

/// A client's value, shortened for error texts.
[[nodiscard]] std::string shown(const nlohmann::json& value);
/// Throws MorseRefusal unless the connection may command one robot, or all robots.
void require_command(const MorseCall& call, int robot);
void require_command_all(const MorseCall& call);
/// Throws MorseRefusal in a private world unless the connection may know where all robots are.
void require_truth(const MorseCall& call);

/// The services of a component.
[[nodiscard]] std::vector<const MorseService*> services_of(const MorseComponent& component);

/// Executes a request.
/// @param list  its arguments.
/// @return the result; nullopt if the answer comes later.
/// @throws MorseRefusal; SessionError and ProtocolError of the functions that it calls.
[[nodiscard]] std::optional<nlohmann::json> call_service(MorseState& state, MorseConnection& from,
                                                         const std::string& id,
                                                         std::string_view component,
                                                         std::string_view service,
                                                         const nlohmann::json& list);

}  // namespace playerlike::server
