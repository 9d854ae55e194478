// SPDX-License-Identifier: MIT
// Every case that Choreonoid was asked about: its values to the last bit, or a difference that
// docs/formats/choreonoid.md lists with its reason, row by row.

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>

#include "kinefile/kinefile.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

namespace fs = std::filesystem;

/// What Choreonoid read of one component.
struct Expected {
  std::string type;
  std::string content;
  std::size_t num_parts = 1;
  double frame_rate = 0;
  bool is_root_relative = false;
  std::vector<std::vector<double>> frames;
};

struct Answer {
  bool is_read = false;
  std::vector<Expected> components;
};

std::string value_of(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(" " + key + "=");
  if (at == std::string::npos) return {};
  const std::size_t start = at + key.size() + 2;
  return line.substr(start, line.find(' ', start) - start);
}

Answer answer_of(const std::string& path) {
  Answer answer;
  std::istringstream lines(bytes_of(path));
  for (std::string line; std::getline(lines, line);) {
    if (line == "RESULT OK") answer.is_read = true;
    if (line.starts_with("COMPONENT ")) {
      Expected& component = answer.components.emplace_back();
      std::istringstream words(line);
      std::string word;
      words >> word >> component.type >> component.content;
      if (const auto parts = value_of(line, "numParts"); !parts.empty()) {
        component.num_parts = std::stoul(parts);
      }
      component.frame_rate = std::strtod(value_of(line, "frameRate").c_str(), nullptr);
      component.is_root_relative = value_of(line, "isRootRelative") == "1";
    } else if (line.starts_with("F ") && !answer.components.empty()) {
      std::vector<double>& row = answer.components.back().frames.emplace_back();
      std::istringstream words(line.substr(2));
      std::string word;
      words >> word;  // the frame's number
      while (words >> word) {
        if (word != "|") row.push_back(std::strtod(word.c_str(), nullptr));
      }
    }
  }
  std::erase_if(answer.components, [](const Expected& component) {
    return component.frames.empty();  // what a failed reading leaves behind
  });
  return answer;
}

bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b); }

std::string type_of(ComponentKind kind) {
  constexpr const char* kTypes[] = {"MultiValueSeq", "MultiSE3Seq", "Vector3Seq", ""};
  return kTypes[static_cast<std::size_t>(kind)];
}

/// The frame of a component as Choreonoid shows it: poses with quaternions.
std::vector<double> shown_row(const Component& component, std::size_t frame) {
  const auto row = component.row(frame);
  if (component.kind != ComponentKind::Poses) return {row.begin(), row.end()};
  std::vector<double> shown;
  for (std::size_t p = 0; p < component.num_parts; ++p) {
    const auto part = row.subspan(p * component.width(), component.width());
    const auto q = quaternion_of_pose(component.pose_form, part);
    shown.insert(shown.end(), part.begin(), part.begin() + 3);
    shown.insert(shown.end(), q.begin(), q.end());
  }
  return shown;
}

/// How a component differs from what Choreonoid made of it; empty if it does not. Choreonoid gives
/// joints the length and rate of the links.
std::string difference(const BodyMotion& motion, const Component& ours, const Expected& theirs) {
  const Component& main = *main_component(motion);
  const bool is_assembled = ours.content == kJointDisplacement;
  const Component& timed = is_assembled ? main : ours;
  if (ours.num_parts != theirs.num_parts) return "number of parts";
  if (frame_rate(timed.timeline) != theirs.frame_rate) return "frame rate";
  if (ours.is_root_relative != theirs.is_root_relative) return "frame of reference";
  const std::size_t num_frames =
      is_assembled ? std::min(main.num_frames, ours.num_frames) : ours.num_frames;
  if (num_frames != theirs.frames.size()) return "number of frames";
  for (std::size_t f = 0; f < num_frames; ++f) {
    const std::vector<double> row = shown_row(ours, f);
    if (row.size() != theirs.frames[f].size()) return "size of a frame";
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!same(row[i], theirs.frames[f][i])) return "values of frame " + std::to_string(f);
    }
  }
  return {};
}

std::string difference(const BodyMotion& motion, const Answer& answer) {
  std::size_t num_known = 0;
  for (const Component& component : motion.components) {
    num_known += component.kind != ComponentKind::Other ? 1u : 0u;
  }
  if (num_known != answer.components.size()) return "number of components";
  for (const Expected& theirs : answer.components) {
    const bool is_zmp = theirs.content == "ZMPSeq" || theirs.content == "RelativeZMP";
    const std::string content = is_zmp ? "ZMP" : theirs.content;
    bool is_found = false;
    for (const Component& ours : motion.components) {
      if (type_of(ours.kind) != theirs.type || ours.content != content) continue;
      is_found = true;
      const std::string found = difference(motion, ours, theirs);
      if (!found.empty()) return found;
    }
    if (!is_found) return "no component " + content;
  }
  return {};
}

/// What kinefile makes of a case: "as Choreonoid", "other values", "read" (Choreonoid does not) or
/// "error[CODE]".
std::string outcome(const std::string& path, const Answer& answer, const std::string& with) {
  ReadOptions options;
  options.source_name = path;
  options.lenient = with.find("--lenient") != std::string::npos;
  if (with.find("floor") != std::string::npos) options.timed_rounding = TimedRounding::Floor;
  if (with.find("--fps 100") != std::string::npos) options.fps = 100;
  Diagnostics diagnostics;
  const auto document = find_format("choreonoid")->read(bytes_of(path), options, diagnostics);
  if (!document) {
    return answer.is_read ? "error[" + document.error().code + "]"
                          : "as Choreonoid: error[" + document.error().code + "]";
  }
  if (!answer.is_read) return "read";
  const BodyMotion& motion = std::get<BodyMotion>(document->content);
  const std::string found = difference(motion, answer);
  return found.empty() ? "as Choreonoid" : "other values: " + found;
}

/// A row of the table of differences.
struct Row {
  std::string outcome;
  std::string with;  ///< options under which Choreonoid's values come out; "-" for none
};

std::map<std::string, Row> documented() {
  std::map<std::string, Row> rows;
  std::istringstream lines(
      bytes_of(std::string(KINEFILE_FIXTURES) + "/../../docs/formats/choreonoid.md"));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| ")) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line.substr(2));
    for (std::string cell; std::getline(parts, cell, '|');) {
      const std::size_t end = cell.find_last_not_of(' ');
      const std::size_t begin = cell.find_first_not_of(' ');
      cells.push_back(end == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
    }
    if (cells.size() == 4 && cells[0].size() > 2 && std::isdigit(cells[0][0]) != 0) {
      rows[cells[0]] = {cells[1], cells[2]};
    }
  }
  return rows;
}

std::string unquoted(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    if (c != '`') plain += c;
  }
  return plain;
}

TEST(ChoreonoidCases, EachIsReadAsChoreonoidDoesOrListedWithItsReason) {
  SKIP_WITHOUT_DATA();
  const std::map<std::string, Row> rows = documented();
  EXPECT_FALSE(rows.empty());
  std::size_t num_cases = 0;
  for (const auto& entry : fs::directory_iterator(data_folder() + "/choreonoid/cases")) {
    const std::string name = entry.path().stem();
    const Answer answer = answer_of(data_folder() + "/choreonoid/expected/" + name + ".txt");
    const std::string found = outcome(entry.path(), answer, "");
    const auto row = rows.find(name);
    ++num_cases;
    // What Choreonoid makes of these is undefined; that nothing breaks is all.
    if (name == "15b_joint_shorter" || name == "15c_joint_shorter2" || name == "18h_time_huge" ||
        name == "18i_time_very_negative" || name == "18j_time_nan") {
      continue;
    }
    if (found.starts_with("as Choreonoid")) {
      EXPECT_EQ(row, rows.end()) << name << " is listed and does not differ";
      continue;
    }
    if (row == rows.end()) {
      ADD_FAILURE() << name << " differs and is not listed: " << found;
      continue;
    }
    EXPECT_EQ(found.substr(0, found.find(':')), unquoted(row->second.outcome)) << name << found;
    const std::string with = unquoted(row->second.with);
    if (with != "-") {
      const std::string again = outcome(entry.path(), answer, with);
      EXPECT_EQ(again, "as Choreonoid") << name << " with " << with;
    }
  }
  EXPECT_EQ(num_cases, 96u);
}

}  // namespace
}  // namespace kinefile::test
