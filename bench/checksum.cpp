// SPDX-License-Identifier: MIT
#include "checksum.hpp"

#include <zlib.h>

#include <random>
#include <string>

#include "report.hpp"
#include "simd/crc32.hpp"

namespace kinefile::bench {
namespace {

/// As many bytes as stay in the cache from when they are computed.
const std::string& checked_bytes() {
  static const std::string all = [] {
    std::mt19937 random(1);
    std::string bytes(std::size_t{1} << 18, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    return bytes;
  }();
  return all;
}

void checksum_kinefile(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(simd::crc32(0, checked_bytes()));
}

void checksum_zlib(benchmark::State& state) {
  const std::string& bytes = checked_bytes();
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
  }
}

}  // namespace

void add_checksum() {
  measure("checksum/kinefile", checksum_kinefile);
  measure("checksum/zlib", checksum_zlib);
  compare("CRC-32 of bytes in the cache, against zlib", "checksum/kinefile", "checksum/zlib");
}

}  // namespace kinefile::bench
