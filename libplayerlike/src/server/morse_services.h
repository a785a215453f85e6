// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/morse_state.h"

namespace playerlike::server {

struct MorseService;

/// The arguments of a request, checked as they are read. All of it throws MorseRefusal, which names
/// the argument, what was expected and what was found.
class MorseArguments {
 public:
  MorseArguments(const MorseService& service, const nlohmann::json& list)
      : service_(service), list_(list) {}

  [[nodiscard]] std::size_t count() const noexcept { return list_.size(); }
  [[nodiscard]] bool has(std::size_t index) const noexcept { return index < list_.size(); }
  /// A finite number within limits; those that are left out (or null) have their default.
  [[nodiscard]] double number(std::size_t index, double least, double most,
                              std::optional<double> otherwise = {}) const;
  [[nodiscard]] int integer(std::size_t index, int least, int most,
                            std::optional<int> otherwise = {}) const;
  [[nodiscard]] std::string text(std::size_t index) const;
  [[nodiscard]] bool boolean(std::size_t index) const;
  [[nodiscard]] const nlohmann::json& list(std::size_t index) const;
  [[nodiscard]] const nlohmann::json& any(std::size_t index) const { return list_.at(index); }
  /// Says what is wrong with an argument.
  [[noreturn]] void refuse(std::size_t index, const std::string& expected) const;

 private:
  const MorseService& service_;
  const nlohmann::json& list_;
};

/// A request on its way to the function that answers it.
struct MorseCall {
  MorseState& state;
  MorseConnection& from;
  const std::string& id;
  const MorseComponent* component;  ///< null: `simulation` or `time`
  MorseArguments arguments;
};

/// A request about the canvas, whichever thread carries it out.
struct PenCall {
  EventClient& client;
  const MorseArguments& arguments;
};

/// A row of the table of services.
struct MorseService {
  /// Whose right a client needs.
  enum class Right {
    kConnect,  ///< whoever may use the server
    kRobot,    ///< who may command the component's robot
    kAll,      ///< who may command all robots
  };
  using Run = nlohmann::json (*)(MorseCall& call);
  using Work = nlohmann::json (*)(const PenCall& call);

  std::string_view name;
  std::string_view arguments;  ///< as docs/morse.md has them: "x, y, z, tolerance=0.5"
  Right right;
  Run run;
  /// What `run` does, if it may take long: for the server's workshop, on a large canvas.
  Work work = nullptr;
  bool later = false;     ///< answered later: `run` has seen to that, its result does not count
  bool is_heavy = false;  ///< `work` takes long on any canvas

  /// The number of arguments, and of those that have no default.
  [[nodiscard]] constexpr std::size_t most() const {
    return arguments.empty() ? 0 : count_of(',') + 1;
  }
  [[nodiscard]] constexpr std::size_t least() const { return most() - count_of('='); }
  [[nodiscard]] constexpr std::size_t count_of(char sign) const {
    return static_cast<std::size_t>(std::count(arguments.begin(), arguments.end(), sign));
  }
};

/// The services of `simulation` or `time`, or of a kind of component, in the order of
/// docs/morse.md.
/// @param kind  "simulation", "time", "motion", "waypoint", "teleport", "pen", "sensor" (what every
///              sensor has) or "component" (what all components have).
[[nodiscard]] std::span<const MorseService> morse_services(std::string_view kind);

[[nodiscard]] std::span<const MorseService> simulation_services();
[[nodiscard]] std::span<const MorseService> time_services();
[[nodiscard]] std::span<const MorseService> pen_services();

/// What is shown of a value that a client has sent.
[[nodiscard]] std::string shown(const nlohmann::json& value);
/// Throws MorseRefusal unless the connection may command a robot, or all of them.
void require_command(const MorseCall& call, int robot);
void require_command_all(const MorseCall& call);

/// The services that a component has.
[[nodiscard]] std::vector<const MorseService*> services_of(const MorseComponent& component);

/// Carries a request out.
/// @param list  its arguments.
/// @return the result; nullopt if it is answered later.
/// @throws MorseRefusal; SessionError and ProtocolError of what it calls.
[[nodiscard]] std::optional<nlohmann::json> call_service(MorseState& state, MorseConnection& from,
                                                         const std::string& id,
                                                         std::string_view component,
                                                         std::string_view service,
                                                         const nlohmann::json& list);

}  // namespace playerlike::server
