// SPDX-License-Identifier: MIT
// Our events of YAML are libyaml's, place by place: over real files, fixtures and documents that
// are made here. Where a text is no YAML for one, it is none for the other.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "support/support.hpp"
#include "support/yaml_events.hpp"
#include "text/decode.hpp"

namespace kinefile::test {
namespace {

namespace fs = std::filesystem;

using test::libyaml_events;
using test::yaml_events;

/// The lines of two lists that differ first.
std::string first_difference(const std::optional<std::string>& ours,
                             const std::optional<std::string>& theirs) {
  if (!ours || !theirs) return ours ? "libyaml finds a fault" : "we find a fault";
  const auto [a, b] = std::mismatch(ours->begin(), ours->end(), theirs->begin(), theirs->end());
  const auto at = static_cast<std::size_t>(a - ours->begin());
  const std::size_t start = at < 80 ? 0 : at - 80;
  return ours->substr(start, 160) + "\n-- libyaml --\n" + theirs->substr(start, 160);
}

/// Whether a text is the same for both, and with rows of numbers taken as a whole.
bool is_same(const std::string& bytes, std::string& difference) {
  Diagnostics diagnostics;
  const auto decoded = text::decode(bytes, "utf-8", {}, diagnostics);
  if (!decoded || !diagnostics.items().empty()) return true;  // no UTF-8
  const std::string text(decoded->view());
  bool is_refused = false;
  const auto ours = yaml_events(text, {}, &is_refused);
  if (is_refused) return true;  // YML003 and YML004: docs/errors.md says why
  const auto theirs = libyaml_events(text);
  if (ours != theirs) {
    difference = first_difference(ours, theirs);
    return false;
  }
  const auto with_rows = yaml_events(text, {.takes_rows = true, .has_numbers = true});
  const auto without = yaml_events(text, {.takes_rows = false, .has_numbers = true});
  if (with_rows != without) difference = "rows: " + first_difference(with_rows, without);
  return with_rows == without;
}

/// The start of a text, as far as a line's end.
std::string beginning(const std::string& text) {
  constexpr std::size_t kLong = 300'000;
  constexpr std::size_t kMost = 200'000;
  return text.size() <= kLong ? text : text.substr(0, text.rfind('\n', kMost) + 1);
}

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension == ".seq" || extension == ".body" || extension == ".yaml" ||
        extension == ".yml" || extension == ".json") {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

void expect_same_files(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    std::string difference;
    EXPECT_TRUE(is_same(beginning(bytes_of(path)), difference)) << path << ": " << difference;
  }
}

/// Makes documents, most of them good: blocks and flow in each other, with all kinds of scalars.
class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {}

  std::string document() {
    text_.clear();
    if (one_in(12)) text_ += "%YAML 1.1\n";
    if (!text_.empty() || one_in(6)) text_ += one_in(2) ? "---\n" : "--- # c\n";
    if (one_in(8)) {
      flow(0);
      text_ += '\n';
    } else {
      block(below(3), 0);
    }
    if (one_in(12)) text_ += one_in(2) ? "...\n" : "---\na: b\n";
    return text_;
  }

  /// A text with some characters taken out, put in, or doubled.
  std::string changed(std::string text) {
    for (std::size_t n = 1 + below(3); n > 0 && !text.empty(); --n) {
      const std::size_t at = below(text.size());
      constexpr std::string_view kSigns = " \n\t-:,?[]{}#&*!|>'\"%@\\.a1\r";
      switch (below(4)) {
        case 0:
          text.erase(at, 1 + below(3));
          break;
        case 1:
          text.insert(at, 1, kSigns[below(kSigns.size())]);
          break;
        case 2:
          text[at] = kSigns[below(kSigns.size())];
          break;
        default:
          text.insert(below(text.size()), text.substr(at, 1 + below(12)));
          break;
      }
    }
    return text;
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  bool one_in(std::size_t count) { return below(count) == 0; }
  template <std::size_t Size>
  void add(const char* const (&words)[Size]) {
    text_ += words[below(Size)];
  }

  void end_line() {
    if (one_in(8)) text_ += one_in(2) ? " # said" : "  ";
    text_ += one_in(30) ? "\r\n" : "\n";
    if (one_in(12)) text_ += one_in(2) ? "\n" : "   # alone\n";
  }

  void number() {
    add({"0", "1", "-1.5", "2.50", "1e-5", "+3", ".5", "5.", "0x1F", "nan", "-inf", "1e400", "-0",
         "123456789.123456789", "1_0", "-"});
  }

  void scalar(bool is_in_flow) {
    switch (below(8)) {
      case 0:
      case 1:
      case 2:
        number();
        break;
      case 3:
        add({"'it''s'", "'a: b # c'", "\"x\\ty\"", "\"\"", "''", "\"\\u00e9 \\\"q\\\"\""});
        break;
      case 4:
        add({"a b", "a#b", "true", "~", "null", "a:b", "-x", "a-b", "w o r d"});
        break;
      case 5:
        if (is_in_flow) {
          add({"two\n   lines", "\"two\n   lines\"", "'two\n\n   lines'"});
        } else {
          add({"word", "\xC3\xA9\xE6\xAD\xA9", "<<", "a,b", "a]b"});
        }
        break;
      default:
        add({"a", "b", "Joint", "x1"});
        break;
    }
  }

  void properties() {
    if (one_in(12)) {
      const std::size_t anchor = below(5);
      text_ += "&a" + std::to_string(anchor) + " ";
    }
    if (one_in(25)) add({"!!str ", "!t ", "!<a:b> ", "! "});
  }

  void row(bool has_groups) {
    text_ += one_in(2) ? "[" : "[ ";
    for (std::size_t n = below(4); n > 0; --n) {
      if (has_groups && one_in(2)) {
        row(false);
      } else if (one_in(30)) {
        scalar(true);
      } else {
        number();
      }
      if (n > 1 || one_in(15)) add({", ", ",", " , ", ",\n    ", ",\t"});
    }
    text_ += one_in(2) ? "]" : " ]";
  }

  void flow(std::size_t depth) {
    if (depth > 3 || one_in(3)) {
      row(true);
      return;
    }
    const bool is_list = one_in(2);
    text_ += is_list ? "[ " : "{ ";
    for (std::size_t n = below(4); n > 0; --n) {
      if (!is_list || one_in(8)) {
        if (one_in(15)) text_ += "? ";
        one_in(10) ? flow(depth + 1) : scalar(true);
        text_ += one_in(8) ? " : " : ": ";
      }
      properties();
      if (one_in(10)) {
        text_ += "*a" + std::to_string(below(5));
      } else {
        one_in(3) ? flow(depth + 1) : scalar(true);
      }
      if (n > 1 || one_in(10)) add({", ", " ,", ",\n  ", ", # c\n  "});
    }
    text_ += is_list ? " ]" : " }";
  }

  void text_block(std::size_t indent) {
    add({"|", ">", "|-", ">+", "|2", "> # c", ">-1"});
    text_ += '\n';
    for (std::size_t n = below(4); n > 0; --n) {
      if (one_in(5)) text_ += '\n';
      text_.append(indent + 2 + (one_in(4) ? below(3) : 0), ' ');
      add({"a line", "# no comment", "- x", "k: v", "\ttab"});
      text_ += '\n';
    }
  }

  /// What stands behind "-" or ":", with the end of its line.
  void value(std::size_t indent, std::size_t depth) {
    if (one_in(15)) {
      end_line();
      return;
    }
    text_ += ' ';
    properties();
    switch (depth > 4 ? 3 + below(3) : below(8)) {
      case 0:
      case 1:
      case 2:
        end_line();
        block(indent + 1 + below(3), depth + 1);
        break;
      case 3:
        flow(depth);
        end_line();
        break;
      case 4:
        text_block(indent);
        break;
      case 5:
        row(true);
        end_line();
        break;
      default:
        if (one_in(8)) {
          text_ += "*a" + std::to_string(below(5));
        } else {
          scalar(false);
        }
        end_line();
        break;
    }
  }

  void block(std::size_t indent, std::size_t depth) {
    const bool is_list = one_in(2);
    bool stands_there = false;  // the first entry of a list in a list
    for (std::size_t n = 1 + below(4); n > 0; --n) {
      if (!stands_there) text_.append(indent, ' ');
      stands_there = false;
      if (is_list) {
        text_ += '-';
        if (one_in(10) && depth < 5) {
          text_ += ' ';
          const std::size_t start = text_.size();
          block(indent + 2, depth + 1);
          text_.erase(start, std::min<std::size_t>(indent + 2, text_.size() - start));
          continue;
        }
      } else {
        if (one_in(25)) text_ += "? ";
        if (one_in(25)) {
          row(true);
          text_ += ' ';
        } else {
          scalar(false);
        }
        text_ += ':';
      }
      value(indent, depth);
    }
  }

  std::mt19937 random_;
  std::string text_;
};

TEST(YamlDifferential, RealFilesGiveTheEventsOfLibyaml) {
  SKIP_WITHOUT_DATA();
  const auto paths = files_in(data_folder() + "/choreonoid");
  ASSERT_GT(paths.size(), 100u);
  expect_same_files(paths);
}

TEST(YamlDifferential, FixturesGiveTheEventsOfLibyaml) {
  const auto paths = files_in(KINEFILE_FIXTURES);
  ASSERT_GT(paths.size(), 50u);
  expect_same_files(paths);
}

TEST(YamlDifferential, MadeDocumentsGiveTheEventsOfLibyaml) {
  Generator generator(20261125);
  std::size_t num_good = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::string text = generator.document();
    std::string difference;
    ASSERT_TRUE(is_same(text, difference)) << text << "\n-- differs --\n" << difference;
    num_good += libyaml_events(text) ? 1u : 0u;
  }
  EXPECT_GT(num_good, 2000u);
}

TEST(YamlDifferential, SoDoTheyWhenTheyAreDamaged) {
  Generator generator(4);
  std::size_t num_good = 0;
  for (int i = 0; i < 6000; ++i) {
    const std::string text = generator.changed(generator.document());
    std::string difference;
    ASSERT_TRUE(is_same(text, difference)) << text << "\n-- differs --\n" << difference;
    num_good += libyaml_events(text) ? 1u : 0u;
  }
  EXPECT_GT(num_good, 1000u);
}

}  // namespace
}  // namespace kinefile::test
