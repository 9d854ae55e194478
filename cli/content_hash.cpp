// SPDX-License-Identifier: MIT
#include "content_hash.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace kinefile::cli {
namespace {

constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15U;  // 2^64 / the golden ratio

std::uint64_t mixed(std::uint64_t state, std::uint64_t word) {
  return std::rotl((state ^ word) * kFactor, 29);
}

/// A hash of bytes that come one piece after the other.
class Hashing {
 public:
  /// The length of every piece but the last one is a multiple of this.
  static constexpr std::size_t kStep = 4 * sizeof(std::uint64_t);

  /// \param num_bytes  of all pieces
  explicit Hashing(std::size_t num_bytes) : hash_(num_bytes) {}

  /// Takes as much as makes whole steps, and returns the rest.
  std::string_view take(std::string_view bytes) {
    for (; bytes.size() >= kStep; bytes.remove_prefix(kStep)) {
      std::array<std::uint64_t, 4> words{};
      std::memcpy(words.data(), bytes.data(), kStep);
      for (std::size_t k = 0; k < words.size(); ++k) chains_[k] = mixed(chains_[k], words[k]);
    }
    return bytes;
  }

  /// \param rest  of the last piece
  std::uint64_t finish(std::string_view rest) {
    for (const std::uint64_t chain : chains_) hash_ = mixed(hash_, chain);
    for (const char c : rest) hash_ = mixed(hash_, static_cast<unsigned char>(c));
    return mixed(hash_ ^ (hash_ >> 32), 0);
  }

 private:
  // Several chains, since a step waits for the one before it.
  std::array<std::uint64_t, 4> chains_ = {1, 2, 3, 4};
  std::uint64_t hash_;
};

}  // namespace

std::uint64_t content_hash(std::string_view bytes) {
  Hashing hashing(bytes.size());
  return hashing.finish(hashing.take(bytes));
}

std::optional<std::uint64_t> content_hash(const ByteSource& bytes) {
  constexpr std::size_t kMostBytes = Hashing::kStep << 15;
  Hashing hashing(bytes.size);
  std::string piece;
  std::string_view rest;
  for (std::size_t offset = 0; offset < bytes.size; offset += piece.size()) {
    piece.resize(std::min(kMostBytes, bytes.size - offset));
    if (!bytes.read(offset, piece)) return std::nullopt;
    rest = hashing.take(piece);
  }
  return hashing.finish(rest);
}

}  // namespace kinefile::cli
