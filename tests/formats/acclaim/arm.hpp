// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "support/support.hpp"

namespace kinefile::test {

/// A skeleton of a root and one bone `b` that hangs on it: direction (0, 1, 0), length 2.
/// \param bone   lines that stand before `end`: axis, dof
/// \param root   lines of :root
/// \param units  lines of :units
inline std::string asf_with(const std::string& bone,
                            const std::string& root = "order TX TY TZ RX RY RZ\naxis XYZ\n",
                            const std::string& units = "length 0.45\nangle deg\n") {
  return ":version 1.10\n:name t\n:units\n" + units + ":root\n" + root +
         ":bonedata\nbegin\nid 1\nname b\ndirection 0 1 0\nlength 2\n" + bone +
         "end\n:hierarchy\nbegin\nroot b\nend\n";
}

/// Files that lie beside the one that is read, by name.
inline Resolver beside(std::vector<std::pair<std::string, std::string>> files) {
  Resolver resolver;
  resolver.open = [files](const std::string& name) -> std::optional<CompanionFile> {
    for (const auto& [known, text] : files) {
      if (known != name) continue;
      const auto owner = std::make_shared<const std::string>(text);
      return CompanionFile{name, *owner, owner};
    }
    return std::nullopt;
  };
  resolver.list = [files](std::string_view extension) {
    std::vector<std::string> names;
    for (const auto& file : files) {
      if (file.first.ends_with(extension)) names.push_back(file.first);
    }
    return names;
  };
  return resolver;
}

/// Reads an ASF or AMC text; an AMC text finds its skeleton beside it, as "t.asf".
inline ReadText read_acclaim(const std::string& format, const std::string& text,
                             const std::string& skeleton = {}, ReadOptions options = {}) {
  if (options.source_name == "<memory>") options.source_name = "t." + format;
  if (!options.companions.open) options.companions = beside({{"t.asf", skeleton}});
  ReadText read;
  auto document = find_format(format)->read(text, options, read.diagnostics);
  if (document) read.document = std::move(*document);
  return read;
}

/// Reads a motion that must be without errors.
inline Motion amc_motion(const std::string& text, const std::string& skeleton,
                         const ReadOptions& options = {}) {
  const ReadText read = read_acclaim("amc", text, skeleton, options);
  EXPECT_TRUE(read.document) << text_of(read.diagnostics);
  return read.document ? std::get<Motion>(read.document->content) : Motion{};
}

}  // namespace kinefile::test
