// SPDX-License-Identifier: MIT
// The functions that the page's worker calls; CMakeLists.txt exports them. Texts are UTF-8.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "answers.hpp"
#include "kinefile/version.hpp"

namespace {

using namespace kinefile::page;

Session session;   // NOLINT(*-global-*): the worker that owns this module is the session
Held held;         // NOLINT(*-global-*)
std::string text;  // NOLINT(*-global-*)

}  // namespace

extern "C" {

/// Adds a file. The memory at `bytes`, from malloc, then belongs to the core. Returns whether a
/// file of this path with the same bytes was there already.
bool kinefile_add_file(const char* path, char* bytes, std::size_t size) {
  const std::shared_ptr<const void> owner(bytes, [](const void* memory) {
    std::free(const_cast<void*>(memory));  // NOLINT: made by malloc in the worker
  });
  using Bytes = kinefile::Array<char>;
  auto& file = session.files[normalised(path)];
  if (file != nullptr && view(*file) == std::string_view(bytes, size)) return true;
  file = std::make_shared<const Bytes>(Bytes::adopt({bytes, size}, owner));
  return false;
}

/// Answers a question. The answer is valid until the next one.
const char* kinefile_answer(const char* question) {
  const Json json = Json::parse(question, nullptr, false);
  text = answer(session, held, json).dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.c_str();
}

const char* kinefile_version() { return kinefile::kVersion; }

}  // extern "C"
