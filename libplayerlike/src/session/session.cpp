// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/session/session.h"

#include <string>

namespace playerlike {

void Session::draw(std::span<const sim::DrawOperation> operations) {
  DrawQueue& queue = draw_queue();
  for (const sim::DrawOperation& operation : operations) {
    while (!queue.push(operation)) flush_drawings();
  }
}

namespace {

[[noreturn]] void refuse(const char* what) {
  throw SessionError(SessionError::Code::kNotAvailable,
                     std::string("this kind of session has no ") + what);
}

}  // namespace

ObjectPose Session::object_pose(const std::string& name) {
  static_cast<void>(name);
  refuse("objects by name");
}

void Session::place_object(const std::string& name, const sim::Pose& pose) {
  static_cast<void>(name);
  static_cast<void>(pose);
  refuse("objects by name");
}

PropertyValue Session::object_property(const std::string& name, const std::string& property) {
  static_cast<void>(name);
  static_cast<void>(property);
  refuse("objects by name");
}

void Session::set_object_property(const std::string& name, const std::string& property,
                                  const PropertyValue& value) {
  static_cast<void>(name);
  static_cast<void>(property);
  static_cast<void>(value);
  refuse("objects by name");
}

LogStatus Session::control_log(const LogControl& changes) {
  static_cast<void>(changes);
  refuse("log");
}

}  // namespace playerlike
