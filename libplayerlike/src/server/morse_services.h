// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  std::string_view name;
  std::string_view arguments;  ///< as docs/morse.md has them: "x, y, z, tolerance=0.5"
  std::size_t least;           ///< number of arguments
  std::size_t most;
  Right right;
  bool later;  ///< answered later: `run` has seen to that, its result does not count
  nlohmann::json (*run)(MorseCall& call);
  /// What `run` does, if it may take long: for the server's workshop, on a large canvas.
  nlohmann::json (*work)(const PenCall& call) = nullptr;
};

/// The services of `simulation` or `time`, or of a kind of component, in the order of
/// docs/morse.md.
/// @param kind  "simulation", "time", "motion", "waypoint", "teleport", "pen", "sensor" (what every
///              sensor has) or "component" (what all components have).
[[nodiscard]] std::span<const MorseService> morse_services(std::string_view kind);

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
