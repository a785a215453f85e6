// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "playerlike/messages/requests.h"
#include "sim/core/fields.h"

/// Tables of fields of requests, their answers, and descriptions for clients.
namespace sim {
template <>
const FieldTable& fields_of<playerlike::RobotInfo>();
template <>
const FieldTable& fields_of<playerlike::CanvasInfo>();
template <>
const FieldTable& fields_of<playerlike::TimeStatistics>();
template <>
const FieldTable& fields_of<LayerStyle>();
template <>
const FieldTable& fields_of<LayerInfo>();
}  // namespace sim

namespace playerlike::protocol {

/// A type of request, and its answer.
struct RequestKind {
  std::string_view name;  ///< empty: never sent, and has no other members
  const sim::FieldTable& (*fields)() = nullptr;
  const sim::FieldTable& (*answer)() = nullptr;  ///< fields of its result
  Request (*make)() = nullptr;
  Answer (*make_answer)() = nullptr;
};

/// All types of requests, in the order of Request.
[[nodiscard]] const std::array<RequestKind, std::variant_size_v<Request>>& request_kinds();

}  // namespace playerlike::protocol
