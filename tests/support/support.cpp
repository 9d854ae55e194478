// SPDX-License-Identifier: MIT
#include "support/support.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace kinefile::test {

const Motion& ReadText::motion() const {
  static const Motion kNone;
  const Motion* motion = document ? std::get_if<Motion>(&document->content) : nullptr;
  EXPECT_NE(motion, nullptr) << text_of(diagnostics);
  return motion != nullptr ? *motion : kNone;
}

ReadText read_bvh(std::string_view bytes, ReadOptions options) {
  if (options.source_name == "<memory>") options.source_name = "t.bvh";
  ReadText result;
  auto document = find_format("bvh")->read(bytes, options, result.diagnostics);
  if (document) {
    result.document = std::move(*document);
  } else {
    EXPECT_TRUE(result.diagnostics.has_errors() || document.error().kind == ErrorKind::Usage);
  }
  return result;
}

Motion motion_of(std::string_view bytes) {
  const ReadText result = read_bvh(bytes);
  EXPECT_EQ(text_of(result.diagnostics), "");
  return result.motion();
}

std::string write_to_string(const Document& document, std::string_view format,
                            const WriteOptions& options) {
  std::string text;
  Diagnostics diagnostics;
  const Sink sink = [&text](std::string_view piece) {
    text += piece;
    return true;
  };
  const auto written = find_format(format)->write(document, options, sink, diagnostics);
  EXPECT_TRUE(written) << to_string(written.error());
  return text;
}

std::string text_of(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic* item : diagnostics.by_place()) text += to_string(*item) + "\n";
  return text;
}

std::string fact_of(const Document& document, std::string_view key) {
  for (const Fact& fact : facts_of(document)) {
    if (fact.key == key) return fact.value;
  }
  return "none";
}

Diagnostics& ignored() {
  static Diagnostics diagnostics;
  return diagnostics;
}

std::vector<std::string> codes_of(const Diagnostics& diagnostics) {
  std::vector<std::string> codes;
  for (const Diagnostic& item : diagnostics.items()) codes.push_back(item.code);
  return codes;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string fixture(const std::string& name) {
  return bytes_of(std::string(KINEFILE_FIXTURES) + "/" + name);
}

std::vector<std::string> fixtures(const std::string& folder, const std::string& extension) {
  std::vector<std::string> names;
  const std::filesystem::path root(KINEFILE_FIXTURES);
  for (const auto& entry : std::filesystem::directory_iterator(root / folder)) {
    if (entry.path().extension() == extension) {
      names.push_back(folder + "/" + entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

ByteSource source_of(const std::string& bytes) {
  ByteSource source;
  source.size = bytes.size();
  source.read = [&bytes](std::size_t offset, std::span<char> out) {
    if (offset + out.size() > bytes.size()) return false;
    std::copy_n(bytes.data() + offset, out.size(), out.data());
    return true;
  };
  return source;
}

std::string base_name(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string data_folder() {
  const char* folder = std::getenv("KINEFILE_TEST_DATA");
  return folder != nullptr && std::filesystem::is_directory(folder) ? folder : "";
}

std::string bvh_with_rows(const std::vector<std::string>& rows) {
  std::string text =
      "HIERARCHY\n"
      "ROOT Hips\n"
      "{\n"
      "  OFFSET 0 0 0\n"
      "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
      "  JOINT A\n"
      "  {\n"
      "    OFFSET 1 2 3\n"
      "    CHANNELS 3 Zrotation Xrotation Yrotation\n"
      "    End Site\n"
      "    {\n"
      "      OFFSET 0 4 0\n"
      "    }\n"
      "  }\n"
      "}\n"
      "MOTION\n";
  text += "Frames: " + std::to_string(rows.size()) + "\nFrame Time: 0.04\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

}  // namespace kinefile::test
