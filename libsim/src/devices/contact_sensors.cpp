// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/contact_sensors.h"

#include <algorithm>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"

namespace sim {

CollisionSensor::CollisionSensor(std::string name, const CollisionParams& params)
    : SensorOf(std::move(name), "collision", params.frequency_hz) {}

void CollisionSensor::integrate(const StepContext& context) {
  const auto note = [&](const PhysicsWorld::Contact& contact) {
    std::string name = partner_name(contact, context.world);
    const auto place = std::lower_bound(touched_.begin(), touched_.end(), name);
    if (place == touched_.end() || *place != name) touched_.insert(place, std::move(name));
  };
  for (const PhysicsWorld::Contact& contact : context.physics.contacts_of(context.robot)) {
    note(contact);
  }
  // A step may have several substeps: a contact that began in one may have ended in another.
  for (const PhysicsWorld::Contact& contact : context.physics.new_contacts()) {
    if (contact.robot == context.robot) note(contact);
  }
}

void CollisionSensor::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.objects.swap(touched_);
  reading.collision = !reading.objects.empty();
  touched_.clear();
}

void CollisionSensor::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(touched_);
}

constexpr Field kCollisionSettings[] = {
    frequency_field<&CollisionParams::frequency_hz>(),
};
SIM_FIELDS(CollisionParams, kCollisionSettings)

constexpr Field kCollisionReading[] = {
    field<&CollisionReading::collision>("collision", "",
                                        "whether anything was touched since the last reading"),
    field<&CollisionReading::objects>("objects", "", "names of what was touched"),
};
SIM_FIELDS(CollisionReading, kCollisionReading)

DeviceKind collision_kind() {
  return device_kind<CollisionSensor, CollisionParams, CollisionReading>("collision", {});
}

}  // namespace sim
