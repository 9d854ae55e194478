// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/acclaim/kept.hpp"

namespace kinefile::acclaim {
namespace {

void add(std::vector<Fact>& facts, const char* key, const std::string& value) {
  if (!value.empty()) facts.push_back({key, value, {}});
}

void add(std::vector<Fact>& facts, const char* key, const std::optional<double>& value) {
  if (value) facts.push_back({key, fmt::format("{}", *value), {}});
}

void add_motion(std::vector<Fact>& facts, const KeptMotion& motion) {
  const std::string& skeleton = motion.skeleton_name;
  facts.push_back({"skeleton", skeleton, skeleton.empty() ? "" : "skeleton " + skeleton});
  facts.push_back({"amc_order", fmt::format("{}", fmt::join(motion.bone_order, " ")), {}});
  add(facts, "amc_header", motion.other_lines);
  if (motion.forces_3dof) add(facts, "force_3dof", std::string("yes"));
  constexpr std::array<const char*, 3> kSources = {"asked", "file", "assumed"};
  add(facts, "rate", std::string(kSources[static_cast<std::size_t>(motion.rate)]));
}

}  // namespace

std::vector<Fact> facts(const Document& document) {
  const KeptFile* const kept = document.kept.get<KeptFile>();
  if (kept == nullptr) return {};
  std::vector<Fact> all = facts_of(kept->text);
  if (kept->motion) add_motion(all, *kept->motion);
  const AsfFile& asf = kept->asf;
  add(all, "asf_comments", asf.comments);
  add(all, "asf_version", asf.version);
  add(all, "unit_mass", asf.mass);
  add(all, "unit_length", asf.length);
  add(all, "unit_angle", std::string(asf.angle == AngleUnit::Radians ? "rad" : "deg"));
  add(all, "documentation", asf.documentation);
  add(all, "skin", asf.skin);
  add(all, "other_sections", asf.other_sections);
  return all;
}

}  // namespace kinefile::acclaim
