// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/box2d_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "physics/fixtures.h"

namespace sim::physics {
namespace {

// Most of this state is private in Box2D. An explicit instantiation may name any member
// ([temp.spec.general]/6), so the compiler checks these against Box2D's headers.
template <typename Tag, typename Tag::Member kMember>
struct Opening {
  friend constexpr typename Tag::Member member_of(Tag) { return kMember; }
};
#define SIM_OPEN(Tag, Class, Type, member)  \
  struct Tag {                              \
    using Member = Type Class::*;           \
    friend constexpr Member member_of(Tag); \
  };                                        \
  template struct Opening<Tag, &Class::member>;

SIM_OPEN(BodyFlags, b2Body, uint16, m_flags)
SIM_OPEN(BodyTransform, b2Body, b2Transform, m_xf)
SIM_OPEN(BodySweep, b2Body, b2Sweep, m_sweep)
SIM_OPEN(BodyVelocity, b2Body, b2Vec2, m_linearVelocity)
SIM_OPEN(BodyTurnRate, b2Body, float, m_angularVelocity)
SIM_OPEN(BodySleepTime, b2Body, float, m_sleepTime)
SIM_OPEN(ContactFlags, b2Contact, uint32, m_flags)
SIM_OPEN(FixtureProxies, b2Fixture, b2FixtureProxy*, m_proxies)
SIM_OPEN(FixtureProxyCount, b2Fixture, int32, m_proxyCount)
SIM_OPEN(JointImpulse, b2FrictionJoint, b2Vec2, m_linearImpulse)
SIM_OPEN(JointTurnImpulse, b2FrictionJoint, float, m_angularImpulse)
SIM_OPEN(WorldInverseStep, b2World, float, m_inv_dt0)
SIM_OPEN(WorldNewContacts, b2World, bool, m_newContacts)
SIM_OPEN(WorldContacts, b2World, b2ContactManager, m_contactManager)
SIM_OPEN(BroadTree, b2BroadPhase, b2DynamicTree, m_tree)
SIM_OPEN(BroadMoves, b2BroadPhase, int32*, m_moveBuffer)
SIM_OPEN(BroadMoveCapacity, b2BroadPhase, int32, m_moveCapacity)
SIM_OPEN(BroadMoveCount, b2BroadPhase, int32, m_moveCount)
SIM_OPEN(TreeRoot, b2DynamicTree, int32, m_root)
SIM_OPEN(TreeNodes, b2DynamicTree, b2TreeNode*, m_nodes)
SIM_OPEN(TreeNodeCount, b2DynamicTree, int32, m_nodeCount)
SIM_OPEN(TreeCapacity, b2DynamicTree, int32, m_nodeCapacity)
SIM_OPEN(TreeFree, b2DynamicTree, int32, m_freeList)
SIM_OPEN(TreeInsertions, b2DynamicTree, int32, m_insertionCount)
#undef SIM_OPEN

// Flags that Box2D sets and clears within a step.
constexpr unsigned kBodyStepFlags = 0x0001;                   // b2Body::e_islandFlag
constexpr unsigned kContactFlags = 0x0002 | 0x0004 | 0x0008;  // touching, enabled, to be filtered
constexpr unsigned kTouching = 0x0002;

b2FixtureProxy* proxy_of(b2Fixture* fixture) {
  if (fixture == nullptr || fixture->*member_of(FixtureProxyCount{}) == 0) return nullptr;
  return &(fixture->*member_of(FixtureProxies{}))[0];
}

void archive_body(StateArchive& archive, b2Body& body) {
  auto flags = static_cast<uint16>(body.*member_of(BodyFlags{}) & ~kBodyStepFlags);
  const bool enabled = body.IsEnabled();
  archive(flags);
  body.*member_of(BodyFlags{}) = flags;
  archive.expect(body.IsEnabled() == enabled, "a body that is on");
  b2Transform& xf = body.*member_of(BodyTransform{});
  b2Sweep& sweep = body.*member_of(BodySweep{});
  for (b2Vec2* p :
       {&xf.p, &sweep.localCenter, &sweep.c0, &sweep.c, &(body.*member_of(BodyVelocity{}))}) {
    archive_vector(archive, *p);
  }
  archive(xf.q.s, xf.q.c, sweep.a0, sweep.a, sweep.alpha0, body.*member_of(BodyTurnRate{}),
          body.*member_of(BodySleepTime{}));
}

void archive_manifold(StateArchive& archive, b2Manifold& manifold) {
  archive.index(manifold.pointCount, b2_maxManifoldPoints + 1);
  if (manifold.pointCount == 0) return;
  archive.choice(manifold.type, b2Manifold::e_faceB);
  archive_vector(archive, manifold.localNormal);
  archive_vector(archive, manifold.localPoint);
  for (int32 i = 0; i < manifold.pointCount; ++i) {
    b2ManifoldPoint& point = manifold.points[i];
    archive_vector(archive, point.localPoint);
    archive(point.normalImpulse, point.tangentImpulse, point.id.key);
  }
}

// Contacts from the oldest to the newest: Box2D inserts each new one at the head of all its lists.
void archive_contacts(StateArchive& archive, b2World& world,
                      const std::vector<b2Fixture*>& fixtures) {
  b2ContactManager& manager = world.*member_of(WorldContacts{});
  std::vector<b2Contact*> contacts;
  for (b2Contact* c = manager.m_contactList; c != nullptr; c = c->GetNext()) contacts.push_back(c);
  std::reverse(contacts.begin(), contacts.end());
  archive.expect(contacts.empty(), "a world without contacts to read into");
  archive.list(contacts, [&](b2Contact*& contact) {
    std::array<std::uint32_t, 2> ids{};
    if (!archive.reading()) {
      ids = {static_cast<std::uint32_t>(info_of(contact->GetFixtureA()).id),
             static_cast<std::uint32_t>(info_of(contact->GetFixtureB()).id)};
    }
    for (std::uint32_t& id : ids) archive.index(id, fixtures.size());
    if (archive.reading()) {
      b2FixtureProxy* const a = proxy_of(fixtures[ids[0]]);
      b2FixtureProxy* const b = proxy_of(fixtures[ids[1]]);
      archive.expect(a != nullptr && b != nullptr, "a contact of two things");
      manager.AddPair(a, b);
      contact = manager.m_contactList;
      archive.expect(manager.m_contactCount == static_cast<int32>(contacts.size()) &&
                         contact->GetFixtureA() == a->fixture &&
                         contact->GetFixtureB() == b->fixture,
                     "contacts that can be, each once");
    }
    std::uint32_t flags = contact->*member_of(ContactFlags{}) & kContactFlags;
    archive(flags);
    contact->*member_of(ContactFlags{}) = flags & kContactFlags;
    archive_manifold(archive, *contact->GetManifold());
    archive.expect((flags & kTouching) == 0 || contact->GetManifold()->pointCount > 0,
                   "points where bodies touch");
  });
}

// A node as written; for a free node, `parent` is the next free node.
struct NodeState {
  std::array<float, 4> box;
  std::int32_t parent, child1, child2, height, moved;
};
static_assert(sizeof(NodeState) == 9 * 4);

NodeState state_of(const b2TreeNode& node) {
  if (node.height < 0) return {{}, node.next, b2_nullNode, b2_nullNode, node.height, 0};
  const b2AABB& box = node.aabb;
  return {{box.lowerBound.x, box.lowerBound.y, box.upperBound.x, box.upperBound.y},
          node.parent,
          node.child1,
          node.child2,
          node.height,
          node.moved ? 1 : 0};
}

void set_node(b2TreeNode& node, const NodeState& state) {
  node.aabb.lowerBound = {state.box[0], state.box[1]};
  node.aabb.upperBound = {state.box[2], state.box[3]};
  node.userData = nullptr;
  node.parent = state.parent;
  node.child1 = state.child1;
  node.child2 = state.child2;
  node.height = state.height;
  node.moved = state.moved != 0;
}

// Whether links and heights form a tree of `used` nodes with `leaves` leaves, and all other nodes
// are free.
bool is_tree(const std::vector<NodeState>& nodes, int32 root, int32 free, std::size_t used,
             std::size_t leaves) {
  const auto there = [&](int32 i) { return i >= 0 && static_cast<std::size_t>(i) < nodes.size(); };
  std::vector<int32> open_nodes;
  std::size_t seen = 0;
  std::size_t leaves_seen = 0;
  if (root != b2_nullNode) {
    if (!there(root) || nodes[static_cast<std::size_t>(root)].parent != b2_nullNode) return false;
    open_nodes.push_back(root);
  }
  while (!open_nodes.empty()) {
    const int32 index = open_nodes.back();
    const NodeState& node = nodes[static_cast<std::size_t>(index)];
    open_nodes.pop_back();
    if (++seen > used) return false;
    if (!std::ranges::all_of(node.box, [](float x) { return std::isfinite(x); })) return false;
    if (node.child1 == b2_nullNode) {
      if (node.child2 != b2_nullNode || node.height != 0) return false;
      ++leaves_seen;
      continue;
    }
    int32 highest = -1;
    for (const int32 child : {node.child1, node.child2}) {
      if (!there(child) || nodes[static_cast<std::size_t>(child)].parent != index) return false;
      highest = std::max(highest, nodes[static_cast<std::size_t>(child)].height);
      open_nodes.push_back(child);
    }
    if (node.child1 == node.child2 || highest < 0 || node.height != highest + 1) return false;
  }
  std::size_t unused = 0;
  for (int32 i = free; i != b2_nullNode; i = nodes[static_cast<std::size_t>(i)].parent) {
    if (!there(i) || nodes[static_cast<std::size_t>(i)].height != -1) return false;
    if (++unused > nodes.size()) return false;
  }
  return seen == used && unused + used == nodes.size() && leaves_seen == leaves;
}

void archive_tree(StateArchive& archive, b2DynamicTree& tree,
                  const std::vector<b2FixtureProxy*>& proxies) {
  int32& root = tree.*member_of(TreeRoot{});
  int32& count = tree.*member_of(TreeNodeCount{});
  int32& free = tree.*member_of(TreeFree{});
  b2TreeNode*& nodes = tree.*member_of(TreeNodes{});
  int32& capacity = tree.*member_of(TreeCapacity{});
  std::vector<NodeState> states;
  if (!archive.reading())
    std::transform(nodes, nodes + capacity, std::back_inserter(states), state_of);
  archive(root, count, free, tree.*member_of(TreeInsertions{}));
  std::uint64_t size = states.size();
  archive(size);
  archive.expect(size > 0 && size <= archive.left() / sizeof(NodeState), "a tree that ends");
  states.resize(size);
  archive.raw(states.data(), size * sizeof(NodeState));
  if (archive.reading()) {
    archive.expect(
        count >= 0 && is_tree(states, root, free, static_cast<std::size_t>(count), proxies.size()),
        "a tree");
    b2Free(nodes);
    capacity = static_cast<int32>(size);
    nodes = static_cast<b2TreeNode*>(b2Alloc(capacity * static_cast<int32>(sizeof(b2TreeNode))));
    std::memset(static_cast<void*>(nodes), 0, size * sizeof(b2TreeNode));
    for (std::size_t i = 0; i < size; ++i) set_node(nodes[i], states[i]);
  }
  for (b2FixtureProxy* proxy : proxies) {
    archive.index(proxy->proxyId, size);
    if (!archive.reading()) continue;
    b2TreeNode& node = nodes[proxy->proxyId];
    archive.expect(node.height == 0 && node.userData == nullptr, "a leaf of its own");
    node.userData = proxy;
  }
}

}  // namespace

void archive_joint(StateArchive& archive, b2FrictionJoint& joint) {
  archive_vector(archive, joint.*member_of(JointImpulse{}));
  archive(joint.*member_of(JointTurnImpulse{}));
  float most_force = joint.GetMaxForce();
  float most_torque = joint.GetMaxTorque();
  archive(most_force, most_torque);
  archive.expect(most_force >= 0.0F && most_torque >= 0.0F, "friction of obstacles");
  if (!archive.reading()) return;
  joint.SetMaxForce(most_force);
  joint.SetMaxTorque(most_torque);
}

void archive_box2d(StateArchive& archive, b2World& world, const std::vector<b2Fixture*>& fixtures) {
  archive_contacts(archive, world, fixtures);
  for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext()) {
    if (body->GetType() == b2_dynamicBody) archive_body(archive, *body);
  }
  archive(world.*member_of(WorldInverseStep{}), world.*member_of(WorldNewContacts{}));
  std::vector<b2FixtureProxy*> proxies;
  for (b2Fixture* fixture : fixtures) {
    if (b2FixtureProxy* proxy = proxy_of(fixture)) proxies.push_back(proxy);
  }
  b2BroadPhase& broad = (world.*member_of(WorldContacts{})).m_broadPhase;
  archive.expect(broad.GetProxyCount() == static_cast<int32>(proxies.size()), "all things in it");
  b2DynamicTree& tree = broad.*member_of(BroadTree{});
  archive_tree(archive, tree, proxies);

  int32*& moves = broad.*member_of(BroadMoves{});
  std::vector<int32> moved(moves, moves + broad.*member_of(BroadMoveCount{}));
  archive(moved);
  if (!archive.reading()) return;
  for (const int32 leaf : moved) {
    const bool is_one =
        leaf >= 0 && leaf < tree.*member_of(TreeCapacity{}) && tree.GetUserData(leaf) != nullptr;
    archive.expect(is_one || leaf == b2BroadPhase::e_nullProxy, "things that moved");
  }
  broad.*member_of(BroadMoveCount{}) = static_cast<int32>(moved.size());
  int32& capacity = broad.*member_of(BroadMoveCapacity{});
  if (capacity < static_cast<int32>(moved.size())) {
    capacity = static_cast<int32>(moved.size());
    b2Free(moves);
    moves = static_cast<int32*>(b2Alloc(capacity * static_cast<int32>(sizeof(int32))));
  }
  std::copy(moved.begin(), moved.end(), moves);
}

}  // namespace sim::physics
