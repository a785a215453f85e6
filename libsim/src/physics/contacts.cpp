// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts.h"

namespace sim::physics {
namespace {

Vec2 in_metres(const b2Vec2& p) { return {metres(p.x), metres(p.y)}; }

// Returns the mean of a contact's points.
std::optional<Vec2> middle_of(const b2Contact& contact) {
  const int32 count = contact.GetManifold()->pointCount;
  if (count == 0) return std::nullopt;
  b2WorldManifold points;
  contact.GetWorldManifold(&points);
  return 0.5 * (in_metres(points.points[0]) + in_metres(points.points[count - 1]));
}

// Adds the line between a contact's points to the touches of one of its robots.
void add_touch(const b2Contact& contact, int robot, std::vector<Touch>& into) {
  const int32 count = contact.GetManifold()->pointCount;
  if (count == 0) return;
  b2WorldManifold points;
  contact.GetWorldManifold(&points);
  into.push_back({robot, in_metres(points.points[0]), in_metres(points.points[count - 1])});
}

}  // namespace

Contacts::Contacts(Bodies& bodies) : bodies_(bodies) { bodies_.world().SetContactListener(this); }

void Contacts::begin_step() {
  fresh_.clear();
  new_touches_.clear();
}

// One slot per partner: obstacles, separators, border, wall, robots.
std::size_t Contacts::slot(const FixtureInfo& info) const {
  const std::size_t obstacles = bodies_.obstacles().size();
  switch (info.kind) {
    case Contact::Kind::kObstacle:
      return static_cast<std::size_t>(info.index);
    case Contact::Kind::kSeparator:
      return obstacles + 2 + static_cast<std::size_t>(info.index);
    case Contact::Kind::kBorder:
      return obstacles;
    case Contact::Kind::kWall:
      return obstacles + 1;
    case Contact::Kind::kRobot:
      break;
  }
  return obstacles + 2 + bodies_.separator_count() + static_cast<std::size_t>(info.index);
}

void Contacts::count_contact(const b2Contact& contact, const b2Fixture* robot_fixture,
                             const b2Fixture* other, int change) {
  const FixtureInfo& mine = info_of(robot_fixture);
  if (mine.kind != Contact::Kind::kRobot) return;  // of moving obstacles none are noted
  const FixtureInfo& theirs = info_of(other);
  std::vector<int>& touching = bodies_.at(mine.index).details->touching;
  const std::size_t where = slot(theirs);
  if (touching.size() <= where) touching.resize(where + 1, 0);
  touching[where] += change;
  if (change > 0 && touching[where] == 1) {
    fresh_.push_back({mine.index, theirs.kind, theirs.index, middle_of(contact)});
  }
}

void Contacts::BeginContact(b2Contact* contact) {
  count_contact(*contact, contact->GetFixtureA(), contact->GetFixtureB(), 1);
  count_contact(*contact, contact->GetFixtureB(), contact->GetFixtureA(), 1);
  for (const b2Fixture* fixture : {contact->GetFixtureA(), contact->GetFixtureB()}) {
    const FixtureInfo& info = info_of(fixture);
    if (info.kind == Contact::Kind::kRobot) add_touch(*contact, info.index, new_touches_);
  }
}

void Contacts::EndContact(b2Contact* contact) {
  count_contact(*contact, contact->GetFixtureA(), contact->GetFixtureB(), -1);
  count_contact(*contact, contact->GetFixtureB(), contact->GetFixtureA(), -1);
}

void Contacts::PreSolve(b2Contact* contact, const b2Manifold*) {
  if (!bodies_.has_parts()) return;
  b2WorldManifold points;
  contact->GetWorldManifold(&points);
  // The normal points from fixture A to B.
  const auto is_inside = [&](const b2Fixture* fixture, float sign, const b2Vec2& point) {
    const FixtureInfo& info = info_of(fixture);
    if (info.kind != Contact::Kind::kRobot) return false;
    const b2Transform& xf = fixture->GetBody()->GetTransform();
    return is_between_parts(*bodies_.at(info.index).details, info.part, b2MulT(xf, point),
                            sign * b2MulT(xf.q, points.normal));
  };
  for (int32 i = 0; i < contact->GetManifold()->pointCount; ++i) {
    if (!is_inside(contact->GetFixtureA(), 1.0F, points.points[i]) &&
        !is_inside(contact->GetFixtureB(), -1.0F, points.points[i])) {
      return;
    }
  }
  contact->SetEnabled(false);
}

std::vector<Contact> Contacts::of(int robot) const {
  std::vector<Contact> contacts;
  const b2Body* body = bodies_.at(robot).body;
  for (const b2ContactEdge* e = contact_list(body); e != nullptr; e = e->next) {
    if (!e->contact->IsTouching()) continue;
    const b2Fixture* a = e->contact->GetFixtureA();
    const b2Fixture* other = a->GetBody() == body ? e->contact->GetFixtureB() : a;
    const FixtureInfo& info = info_of(other);
    contacts.push_back({robot, info.kind, info.index});
  }
  return contacts;
}

std::vector<Touch> Contacts::touches_of(int robot) const {
  std::vector<Touch> touches;
  const b2Body* body = bodies_.at(robot).body;
  for (const b2ContactEdge* e = contact_list(body); e != nullptr; e = e->next) {
    if (e->contact->IsTouching()) add_touch(*e->contact, robot, touches);
  }
  // A step may have several substeps: a contact that began in one may have ended in another.
  for (const Touch& touch : new_touches_) {
    if (touch.robot == robot) touches.push_back(touch);
  }
  return touches;
}

}  // namespace sim::physics
