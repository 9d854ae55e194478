// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>

#include "base64.hpp"

namespace kinefile::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kElement = R"(<script id="motion" type="text/plain"></script>)";
constexpr std::string_view kEndOfElement = "</script>";
constexpr std::string_view kStandardInput = "<stdin>";

using PageJson = nlohmann::ordered_json;

PageJson json_of_opening(const PageOpening& opening) {
  PageJson json = {{"path", opening.path}};
  if (!opening.skeleton.empty()) json["skeleton"] = opening.skeleton;
  if (!opening.project.empty()) json["project"] = opening.project;
  if (!opening.servo_map.empty()) json["servo_map"] = opening.servo_map;
  json["options"] = PageJson::object();
  for (const auto& [name, word] : opening.options) {
    json["options"][name] = word.empty() ? PageJson(true) : PageJson(word);
  }
  return json;
}

PageJson json_of_content(const PageContent& content) {
  PageJson json = {{"files", PageJson::array()}, {"open", PageJson::array()}};
  for (const PageFile& file : content.files) {
    json["files"].push_back({{"path", file.path}, {"size", file.bytes.size()}});
  }
  for (const PageOpening& opening : content.open) {
    json["open"].push_back(json_of_opening(opening));
  }
  return json;
}

/// An absolute path without "." and "..", as a reader of names sees it: links are not followed.
fs::path absolute(const std::string& path) {
  std::error_code fault;
  const fs::path whole = fs::absolute(path, fault);
  const fs::path plain = (fault ? fs::path("/") / path : whole).lexically_normal();
  return plain.has_filename() ? plain : plain.parent_path();  // without a slash at the end
}

}  // namespace

std::string payload_of(const PageContent& content) {
  // Names of files may be any bytes; those that are not UTF-8 become U+FFFD.
  const std::string text =
      json_of_content(content).dump(-1, ' ', false, PageJson::error_handler_t::replace);
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string payload;
  for (const unsigned shift : {0u, 8u, 16u, 24u}) {
    payload += static_cast<char>(length >> shift & 255);
  }
  payload += text;
  for (const PageFile& file : content.files) payload += file.bytes;
  return payload;
}

std::string gzip_of(std::string_view bytes) {
  constexpr int kGzip = 16 + MAX_WBITS;
  constexpr int kMemory = 8;
  constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;  // zlib counts in 32 bits
  z_stream stream{};
  // The header's time stays 0.
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();  // the only fault that these constants leave
  }
  std::string compressed;
  std::array<Bytef, std::size_t{1} << 16> block;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    if (stream.avail_in == 0 && !bytes.empty()) {
      const std::string_view piece = bytes.substr(0, kMostAtOnce);
      bytes.remove_prefix(piece.size());
      stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(piece.data()));
      stream.avail_in = static_cast<uInt>(piece.size());
    }
    stream.next_out = block.data();
    stream.avail_out = static_cast<uInt>(block.size());
    state = deflate(&stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
    compressed.append(reinterpret_cast<const char*>(block.data()), block.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  return compressed;
}

Result<std::string> page_with(std::string_view page, const PageContent& content) {
  if (page.empty()) {
    return fail(ErrorKind::Usage, "PAG001",
                "this kinefile was built without its page; 'make web' builds it, then build again");
  }
  const std::size_t at = page.find(kElement);
  if (at == std::string_view::npos || page.find(kElement, at + 1) != std::string_view::npos) {
    return fail(ErrorKind::Usage, "PAG001",
                fmt::format("expected a page that has {} once, found another in this kinefile; "
                            "'make web' builds it, then build again",
                            kElement));
  }
  const std::size_t start = at + kElement.size() - kEndOfElement.size();
  std::string whole(page.substr(0, start));
  whole += base64_of(gzip_of(payload_of(content)));
  whole += page.substr(start);
  return whole;
}

std::string common_folder(const std::vector<std::string>& paths) {
  fs::path common;
  for (const std::string& path : paths) {
    if (path == kStandardInput) continue;
    const fs::path folder = absolute(path).parent_path();
    if (common.empty()) common = folder;
    fs::path shared;
    const auto differ = std::mismatch(common.begin(), common.end(), folder.begin(), folder.end());
    for (auto part = common.begin(); part != differ.first; ++part) shared /= *part;
    common = shared;
  }
  return common.string();
}

std::string path_within(const std::string& folder, const std::string& path) {
  if (path == kStandardInput) return path;
  const fs::path inside = absolute(path).lexically_relative(folder);
  const bool is_outside = inside.empty() || *inside.begin() == "..";
  return is_outside ? "." : inside.generic_string();
}

}  // namespace kinefile::cli
