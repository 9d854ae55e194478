// SPDX-License-Identifier: MIT
#include "kinefile/joint_map.hpp"

#include "text/decode.hpp"
#include "text/source.hpp"
#include "text/yaml/tree.hpp"

namespace kinefile {

Result<JointMap> parse_joint_map(std::string_view text, const std::string& source_name,
                                 Diagnostics& diagnostics) {
  const auto decoded = text::decode(text, {}, source_name, diagnostics);
  if (!decoded) return fail(decoded.error());
  const text::Source source(source_name, decoded->view());
  const auto tree = text::yaml::read_tree(source, diagnostics);
  if (tree == nullptr) return fail(diagnostics.first_error());
  const text::yaml::Node& root = tree->root();
  const auto refuse = [&](const char* at) {
    text::report(source, diagnostics, Severity::Error, "MAP001",
                 "expected names of the robot's links or joints, each with the name of the joint "
                 "that it follows, as 'HEAD_P: Head'",
                 at);
    return fail(diagnostics.first_error());
  };
  if (root.kind != text::yaml::NodeKind::Mapping) return refuse(root.at);
  JointMap map;
  for (std::size_t i = 0; i + 1 < root.children.size(); i += 2) {
    for (const text::yaml::Node* node : {root.children[i], root.children[i + 1]}) {
      if (node->kind != text::yaml::NodeKind::Scalar) return refuse(node->at);
    }
    map[std::string(root.children[i]->text)] = std::string(root.children[i + 1]->text);
  }
  return map;
}

}  // namespace kinefile
