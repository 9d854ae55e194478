// SPDX-License-Identifier: MIT
// The tests run on the instruction set that KINEFILE_TEST_TARGET names, as if the machine had no
// better one, and with as many threads as KINEFILE_TEST_THREADS says. The tests' CMakeLists.txt
// runs some of them once for each; tools/torture.sh all of them.
#include <hwy/highway.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "kinefile/threads.hpp"

namespace kinefile::test {
namespace {

std::int64_t targets_up_to(std::string_view name) {
  if (name == "none") return HWY_STATIC_TARGET;
  if (name == "ssse3") return HWY_STATIC_TARGET | HWY_SSSE3;
  if (name == "sse4") return HWY_STATIC_TARGET | HWY_SSSE3 | HWY_SSE4;
  if (name == "avx2") return HWY_STATIC_TARGET | HWY_SSSE3 | HWY_SSE4 | HWY_AVX2;
  std::fprintf(stderr, "KINEFILE_TEST_TARGET is none, ssse3, sse4 or avx2\n");
  std::exit(2);
}

[[maybe_unused]] const bool is_chosen = [] {
  const char* const name = std::getenv("KINEFILE_TEST_TARGET");
  if (name == nullptr) return false;
  hwy::SetSupportedTargetsForTest(hwy::SupportedTargets() & targets_up_to(name));
  return true;
}();

[[maybe_unused]] const bool are_threads_chosen = [] {
  const char* const count = std::getenv("KINEFILE_TEST_THREADS");
  if (count == nullptr) return false;
  set_max_threads(std::strtoul(count, nullptr, 10));
  return true;
}();

}  // namespace
}  // namespace kinefile::test
