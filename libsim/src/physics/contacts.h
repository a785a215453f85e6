// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/box2d.h>

#include <cstddef>
#include <vector>

#include "physics/bodies.h"

namespace sim::physics {

using Touch = PhysicsWorld::Touch;

/// The contacts of robots that Box2D reports.
class Contacts final : public b2ContactListener {
 public:
  explicit Contacts(Bodies& bodies);

  void begin_step();
  /// Writes or reads the state. When reading, Box2D's contacts must have been read before.
  void archive(StateArchive& archive);
  /// The contacts that began in this step.
  [[nodiscard]] const std::vector<Contact>& fresh() const noexcept { return fresh_; }
  /// See PhysicsWorld::contacts_of() and touches_of().
  [[nodiscard]] std::vector<Contact> of(int robot) const;
  [[nodiscard]] std::vector<Touch> touches_of(int robot) const;

  void BeginContact(b2Contact* contact) override;
  void EndContact(b2Contact* contact) override;
  /// Disables contacts between two parts of a body, see is_between_parts().
  void PreSolve(b2Contact* contact, const b2Manifold* before) override;

 private:
  [[nodiscard]] std::size_t slot(const FixtureInfo& info) const;
  void count_contact(const b2Contact& contact, const b2Fixture* robot_fixture,
                     const b2Fixture* other, int change);

  Bodies& bodies_;
  std::vector<Contact> fresh_;
  std::vector<Touch> new_touches_;
};

}  // namespace sim::physics
