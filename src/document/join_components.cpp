// SPDX-License-Identifier: MIT
#include "document/join_components.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "document/conventions.hpp"
#include "kinefile/robot.hpp"

namespace kinefile {
namespace {

tl::unexpected<Error> cannot_join(std::string_view difference) {
  return fail(ErrorKind::Usage, "EDT005", fmt::format("the components differ: {}", difference));
}

/// The known components of a body motion, in its order.
template <class Body>
auto known_components(Body& body) {
  std::vector<decltype(body.components.data())> known;
  for (auto& component : body.components) {
    if (component.kind != ComponentKind::Other) known.push_back(&component);
  }
  return known;
}

bool is_alike(const Component& a, const Component& b) {
  return a.kind == b.kind && a.content == b.content && a.is_root_relative == b.is_root_relative;
}

/// The component among others that is like one of `known`: of several, the one with its number.
/// Null if there is none.
const Component* partner_of(const std::vector<Component*>& known, std::size_t index,
                            const std::vector<const Component*>& others) {
  const auto is_like = [&](const Component* other) { return is_alike(*known[index], *other); };
  auto number =
      std::count_if(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(index), is_like);
  for (const Component* other : others) {
    if (is_like(other) && number-- == 0) return other;
  }
  return nullptr;
}

/// Components that are joined as one motion, and those that follow them, if any.
struct JoinedGroup {
  std::vector<Component*> components;
  std::vector<const Component*> next;
  bool is_in_world = false;
};

/// Adds a component to the group of its own, or to that of the world; the first link leads it.
void add_to_groups(Component* component, const Component* next, std::vector<JoinedGroup>& groups) {
  if (!robot::is_in_world(*component)) {
    groups.push_back({{component}, {next}, false});
    return;
  }
  JoinedGroup& world = groups.front();
  const bool leads = component->kind == ComponentKind::Poses;
  world.components.insert(leads ? world.components.begin() : world.components.end(), component);
  world.next.insert(leads ? world.next.begin() : world.next.end(), next);
}

/// The difference between two components that prevents joining them, or an empty text.
std::string obstacle_between(const Component& a, const Component* b) {
  if (b == nullptr) return fmt::format("there is no '{}' in the motion that follows", a.content);
  if (a.num_parts != b->num_parts) {
    return fmt::format("'{}' has {} parts, and {} in the motion that follows", a.content,
                       a.num_parts, b->num_parts);
  }
  if (a.width() == b->width()) return {};
  return fmt::format("the poses of '{}' have another form in the motion that follows", a.content);
}

/// \param next  null: nothing follows
Result<std::vector<JoinedGroup>> groups_of(BodyMotion& body, const BodyMotion* next) {
  std::vector<JoinedGroup> groups(1);
  groups.front().is_in_world = true;
  const auto known = known_components(body);
  const auto others = next != nullptr ? known_components(*next) : std::vector<const Component*>();
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Component* partner = partner_of(known, i, others);
    const std::string obstacle =
        next != nullptr ? obstacle_between(*known[i], partner) : std::string();
    if (!obstacle.empty()) return cannot_join(obstacle);
    add_to_groups(known[i], partner, groups);
  }
  if (next != nullptr && others.size() > known.size()) {
    return cannot_join("the motion that follows has more of them");
  }
  return groups;
}

/// Components as one motion whose parts have no names of their own: not every file names them.
Motion joined_parts(std::span<const Component* const> components) {
  Motion motion = robot::side_by_side(components);
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
    motion.skeleton.joints[j].name = fmt::format("part{}", j);
  }
  return motion;
}

}  // namespace

Result<void> join_components(BodyMotion& body, const BodyMotion* next, const JoinMotions& join) {
  for (const BodyMotion* one : {static_cast<const BodyMotion*>(&body), next}) {
    if (one == nullptr) continue;
    if (auto agreed = expect_agreement(*one); !agreed) return agreed;
  }
  auto groups = groups_of(body, next);
  if (!groups) return fail(std::move(groups.error()));
  for (const JoinedGroup& group : *groups) {
    if (group.components.empty()) continue;
    const std::vector<const Component*> parts(group.components.begin(), group.components.end());
    std::optional<Motion> second;
    if (next != nullptr) second = joined_parts(group.next);
    auto joined = join(joined_parts(parts), second ? &*second : nullptr, group.is_in_world);
    if (!joined) return fail(std::move(joined.error()));
    robot::put_side_by_side(*joined, group.components);
  }
  return {};
}

}  // namespace kinefile
