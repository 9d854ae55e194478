// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "base/words.hpp"
#include "formats/acclaim/format.hpp"
#include "formats/body/format.hpp"
#include "formats/bvh/format.hpp"
#include "formats/choreonoid/format.hpp"
#include "formats/csv/format.hpp"
#include "formats/hrpsys/format.hpp"
#include "formats/json/format.hpp"
#ifndef __EMSCRIPTEN__  // a page makes no tables for NumPy
#include "formats/npz/format.hpp"
#endif
#include "formats/robovie/format.hpp"
#include "formats/urdf/format.hpp"
#include "formats/wrl/format.hpp"
#include "kinefile/format.hpp"
#include "text/scanner.hpp"

namespace kinefile {

namespace {

/// The extension of a file name, with the dot, in lower case; empty if it has none.
std::string extension_of(std::string_view name) {
  const std::string_view file = name.substr(name.find_last_of("/\\") + 1);
  const std::size_t dot = file.rfind('.');
  return dot == std::string_view::npos || dot == 0 ? std::string() : lowered(file.substr(dot));
}

std::vector<Format> all_formats() {
  return {
      bvh::format(),     acclaim::asf_format(), acclaim::amc_format(), choreonoid::format(),
      robovie::format(), body::format(),        wrl::format(),         urdf::format(),
      hrpsys::format(),  csv::format(),         json::format(),
#ifndef __EMSCRIPTEN__
      npz::format(),
#endif
  };
}

}  // namespace

std::span<const Format> formats() {
  static const std::vector<Format> kFormats = all_formats();
  return kFormats;
}

const Format* find_format(std::string_view name) {
  const auto all = formats();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [name](const Format& format) { return format.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<Fact> facts_of(const Document& document) {
  const Format* const format = find_format(document.format);
  const bool tells = format != nullptr && format->facts != nullptr;
  return tells ? format->facts(document) : std::vector<Fact>();
}

std::string component_type(const Document& document, const Component& component) {
  const Format* const format = find_format(document.format);
  const bool tells = format != nullptr && format->component_type != nullptr;
  return tells ? format->component_type(component) : std::string();
}

const Format* format_of_name(std::string_view file_name) {
  const std::string lower = lowered(file_name);
  for (const Format& format : formats()) {
    for (const std::string_view extension : format.extensions) {
      if (lower.ends_with(extension)) return &format;
    }
  }
  return nullptr;
}

const ForeignFormat* find_foreign(std::string_view head, std::string_view file_name,
                                  const Format* detected) {
  if (detected != nullptr && detected->probe != nullptr && detected->probe(head)) return nullptr;
  const std::string lower = lowered(file_name);
  const ForeignFormat* by_name = nullptr;
  for (const Format& format : formats()) {
    for (const ForeignFormat& foreign : format.foreign) {
      if (foreign.probe != nullptr && foreign.probe(head)) return &foreign;
      if (lower.ends_with(foreign.extension)) by_name = &foreign;
    }
  }
  return detected == nullptr ? by_name : nullptr;
}

const Format* format_of_output(std::string_view file_name, std::string_view input_name,
                               const Format* input) {
  const std::string extension = extension_of(file_name);
  const bool is_same = !extension.empty() && extension == extension_of(input_name);
  return is_same && input != nullptr && is_written(*input) ? input : format_of_name(file_name);
}

const Format* detect_format(std::string_view head, std::string_view file_name) {
  for (const Format& format : formats()) {
    if (format.probe != nullptr && format.probe(head)) return &format;
  }
  return format_of_name(file_name);
}

}  // namespace kinefile
