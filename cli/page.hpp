// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinefile/result.hpp"

namespace kinefile::cli {

/// A file inside a page.
struct PageFile {
  std::string path;        ///< relative, with forward slashes, unique within the page
  std::string_view bytes;  ///< must stay valid
};

/// What a page opens at its start, and how it reads that. Paths are those of files of the page;
/// empty: none.
struct PageOpening {
  std::string path;
  std::string skeleton;
  std::string project;
  std::string servo_map;
  /// Options of reading by their names, with their words; an empty word is that of a flag.
  std::vector<std::pair<std::string, std::string>> options;
};

/// The files of a page and what it opens, in the order in which they are shown.
struct PageContent {
  std::vector<PageFile> files;
  std::vector<PageOpening> open;
};

/// The files and what is opened as one run of bytes: the length of a JSON text in four bytes, the
/// least significant first; the text {"files": [{"path", "size"}], "open": [{"path", "skeleton",
/// "project", "servo_map", "options"}]}; the files one after another.
std::string payload_of(const PageContent& content);

/// Bytes compressed as gzip. The same bytes always give the same result.
std::string gzip_of(std::string_view bytes);

/// A page with its content: base64 of gzip of the payload, in the element that the page has for it.
/// \param page  the HTML of the viewer; empty: this program has none
/// \errors PAG001 (Usage) if there is no page, or if it has no such element
Result<std::string> page_with(std::string_view page, const PageContent& content);

/// The deepest folder that contains all of these files, as an absolute path.
std::string common_folder(const std::vector<std::string>& paths);

/// The path of a file or a folder within a folder of `common_folder`, with forward slashes. "." for
/// that folder and for what is outside of it; <stdin>, the name of standard input, stays as it is.
std::string path_within(const std::string& folder, const std::string& path);

}  // namespace kinefile::cli
