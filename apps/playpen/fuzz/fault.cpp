// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fault.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "fuzz/element.h"
#include "sim/core/number_text.h"

namespace playpen::fuzz {
namespace {

using nlohmann::ordered_json;

// The number of tenths is whole, but a sum of tenths is none.
double tenths(double value) { return std::round(value * 10.0) / 10.0; }
std::string seconds_text(double seconds) { return sim::shortest_text(tenths(seconds)) + " s"; }

const char* word_of(DeviceFault::Kind kind) {
  switch (kind) {
    case DeviceFault::Kind::kBlind:
      return "blind";
    case DeviceFault::Kind::kJump:
      return "jump";
    default:
      return "dead";
  }
}

}  // namespace

void add_timers(ordered_json& timers, const DeviceFault& fault, const std::string& robot,
                const std::string& name) {
  if (fault.kind == DeviceFault::Kind::kDrift) return;
  const auto add = [&](const std::string& timer, double at_s, const char* kind) -> ordered_json& {
    ordered_json action = {{"robot", robot}, {"device", fault.device}, {"kind", kind}};
    ordered_json actions = ordered_json::array({ordered_json{{"fault", std::move(action)}}});
    timers.push_back({{"name", timer}, {"at", tenths(at_s)}, {"do", std::move(actions)}});
    return timers.back()["do"][0]["fault"];
  };
  ordered_json& action = add(name, fault.at_s, word_of(fault.kind));
  if (fault.kind == DeviceFault::Kind::kJump) {
    action["by"] = {{"x", centimetres(fault.x_m)}, {"yaw_deg", fault.yaw_deg}};
  }
  if (fault.kind == DeviceFault::Kind::kGap) add(name + "_end", fault.at_s + fault.for_s, "none");
}

std::string text_of(const DeviceFault& fault) {
  const std::string at = seconds_text(fault.at_s);
  const std::string device = "the device " + fault.device;
  switch (fault.kind) {
    case DeviceFault::Kind::kDead:
      return device + " dead from " + at + " on";
    case DeviceFault::Kind::kGap:
      return device + " without readings for " + seconds_text(fault.for_s) + " from " + at + " on";
    case DeviceFault::Kind::kBlind:
      return device + " blind from " + at + " on";
    case DeviceFault::Kind::kJump:
      return device + " that jumps by " + sim::shortest_text(centimetres(fault.x_m)) + " m and " +
             std::to_string(fault.yaw_deg) + " degrees at " + at;
    case DeviceFault::Kind::kDrift:
      break;
  }
  return device + " that measures " + sim::shortest_text(fault.scale) + " times the distance";
}

}  // namespace playpen::fuzz
