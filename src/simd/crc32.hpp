// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace kinefile::simd {

/// The CRC-32 of zip, gzip and PNG (ISO 3309, reflected polynomial EDB88320), of bytes that come in
/// pieces: crc32(crc32(0, a), b) is that of a followed by b.
/// \param crc  of what comes before; 0 if nothing does
std::uint32_t crc32(std::uint32_t crc, std::string_view bytes);

}  // namespace kinefile::simd
