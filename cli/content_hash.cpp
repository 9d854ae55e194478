// SPDX-License-Identifier: MIT
#include "content_hash.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace kinefile::cli {
namespace {

constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15U;  // 2^64 / the golden ratio

std::uint64_t mixed(std::uint64_t state, std::uint64_t word) {
  return std::rotl((state ^ word) * kFactor, 29);
}

}  // namespace

std::uint64_t content_hash(std::string_view bytes) {
  // Four chains, since a step waits for the one before it.
  constexpr std::size_t kNumChains = 4;
  std::array<std::uint64_t, kNumChains> chains = {1, 2, 3, 4};
  std::uint64_t hash = bytes.size();
  for (; bytes.size() >= sizeof chains; bytes.remove_prefix(sizeof chains)) {
    std::array<std::uint64_t, kNumChains> words{};
    std::memcpy(words.data(), bytes.data(), sizeof words);
    for (std::size_t k = 0; k < kNumChains; ++k) chains[k] = mixed(chains[k], words[k]);
  }
  for (const std::uint64_t chain : chains) hash = mixed(hash, chain);
  for (const char c : bytes) hash = mixed(hash, static_cast<unsigned char>(c));
  return mixed(hash ^ (hash >> 32), 0);
}

}  // namespace kinefile::cli
