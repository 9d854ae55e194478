// SPDX-License-Identifier: MIT
#include "formats/npz/zip.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "simd/crc32.hpp"

namespace kinefile::npz {
namespace {

// A field that has all bits set says that the number is in a Zip64 field.
constexpr std::uint64_t kInZip64 = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint16_t kManyEntries = std::numeric_limits<std::uint16_t>::max();

constexpr std::uint32_t kHeaderSignature = 0x04034b50;
constexpr std::uint32_t kDescriptorSignature = 0x08074b50;
constexpr std::uint32_t kDirectorySignature = 0x02014b50;
constexpr std::uint32_t kEndSignature = 0x06054b50;
constexpr std::uint32_t kEnd64Signature = 0x06064b50;
constexpr std::uint32_t kLocatorSignature = 0x07064b50;

constexpr std::uint16_t kVersion = 20;    ///< of the specification: 2.0
constexpr std::uint16_t kVersion64 = 45;  ///< the first with Zip64
constexpr std::uint16_t kHasDescriptor = 1u << 3;
constexpr std::uint16_t kStored = 0;
constexpr std::uint16_t kMidnight = 0;
constexpr std::uint16_t kFirstOfJanuary1980 = 1u << 5 | 1u;
constexpr std::uint16_t kZip64Field = 1;
constexpr std::uint16_t kNothing = 0;

/// Appends a number, its low byte first, as wide as its type.
template <class Integer>
void append(Integer number, std::string& bytes) {
  for (std::size_t k = 0; k < sizeof(Integer); ++k) {
    bytes += static_cast<char>(number >> (8 * k) & 0xFF);
  }
}

void append32_or_mark(std::uint64_t number, std::string& bytes) {
  append(static_cast<std::uint32_t>(std::min(number, kInZip64)), bytes);
}

std::uint16_t length_of(std::string_view text) {
  assert(text.size() < kManyEntries);
  return static_cast<std::uint16_t>(text.size());
}

/// Appends what is the same in the header of an entry and in the directory.
void append_common(std::uint16_t version, std::string& bytes) {
  append(version, bytes);
  append(kHasDescriptor, bytes);
  append(kStored, bytes);
  append(kMidnight, bytes);
  append(kFirstOfJanuary1980, bytes);
}

}  // namespace

bool ZipWriter::write(std::string_view bytes) {
  is_good_ = is_good_ && sink_(bytes);
  offset_ += bytes.size();
  return is_good_;
}

void ZipWriter::begin(std::string name, std::uint64_t size) {
  end();
  const bool is_large = size >= kInZip64;
  std::string header;
  append(kHeaderSignature, header);
  append_common(is_large ? kVersion64 : kVersion, header);
  append(std::uint32_t{0}, header);  // with a descriptor, the CRC and both sizes are 0 here
  const std::uint64_t no_size = is_large ? kInZip64 : 0;
  append32_or_mark(no_size, header);
  append32_or_mark(no_size, header);
  append(length_of(name), header);
  append(is_large ? std::uint16_t{20} : kNothing, header);
  header += name;
  if (is_large) {  // it also says that the descriptor has eight bytes a size
    append(kZip64Field, header);
    append(std::uint16_t{16}, header);
    append(std::uint64_t{0}, header);
    append(std::uint64_t{0}, header);
  }
  entries_.push_back({std::move(name), size, offset_, 0});
  write(header);
}

bool ZipWriter::add(std::string_view bytes) {
  Entry& entry = entries_.back();
  entry.crc = simd::crc32(entry.crc, bytes);
  return write(bytes);
}

/// Writes the descriptor of the last entry.
void ZipWriter::end() {
  if (entries_.empty()) return;
  const Entry& entry = entries_.back();
  std::string descriptor;
  append(kDescriptorSignature, descriptor);
  append(entry.crc, descriptor);
  for (int k = 0; k < 2; ++k) {  // as it is stored, and as it was
    if (entry.size >= kInZip64) {
      append(entry.size, descriptor);
    } else {
      append32_or_mark(entry.size, descriptor);
    }
  }
  write(descriptor);
}

void ZipWriter::append_to_directory(const Entry& entry, std::string& directory) {
  std::string large;  // those of the numbers that need eight bytes, in this order
  if (entry.size >= kInZip64) {
    append(entry.size, large);
    append(entry.size, large);
  }
  if (entry.offset >= kInZip64) append(entry.offset, large);
  const std::uint16_t version = large.empty() ? kVersion : kVersion64;
  append(kDirectorySignature, directory);
  append(version, directory);  // who made it: no system whose attributes would count
  append_common(version, directory);
  append(entry.crc, directory);
  append32_or_mark(entry.size, directory);
  append32_or_mark(entry.size, directory);
  append(length_of(entry.name), directory);
  append(large.empty() ? kNothing : static_cast<std::uint16_t>(large.size() + 4), directory);
  append(kNothing, directory);          // no comment,
  append(kNothing, directory);          // on the first disk,
  append(kNothing, directory);          // no attributes inside
  append(std::uint32_t{0}, directory);  // or outside
  append32_or_mark(entry.offset, directory);
  directory += entry.name;
  if (large.empty()) return;
  append(kZip64Field, directory);
  append(length_of(large), directory);
  directory += large;
}

void ZipWriter::append_end(std::uint64_t directory_size, std::string& bytes) const {
  const std::uint64_t num_entries = entries_.size();
  assert(num_entries < kManyEntries);
  const std::uint64_t directory_offset = offset_;
  if (directory_offset >= kInZip64) {
    append(kEnd64Signature, bytes);
    append(std::uint64_t{44}, bytes);  // the length of what follows in this record
    append(kVersion64, bytes);
    append(kVersion64, bytes);
    append(std::uint32_t{0}, bytes);  // this disk
    append(std::uint32_t{0}, bytes);  // the directory's disk
    append(num_entries, bytes);
    append(num_entries, bytes);
    append(directory_size, bytes);
    append(directory_offset, bytes);
    append(kLocatorSignature, bytes);
    append(std::uint32_t{0}, bytes);  // the disk of the record above
    append(directory_offset + directory_size, bytes);
    append(std::uint32_t{1}, bytes);  // the number of disks
  }
  append(kEndSignature, bytes);
  append(kNothing, bytes);  // this disk
  append(kNothing, bytes);  // the directory's disk
  append(static_cast<std::uint16_t>(num_entries), bytes);
  append(static_cast<std::uint16_t>(num_entries), bytes);
  append32_or_mark(directory_size, bytes);
  append32_or_mark(directory_offset, bytes);
  append(kNothing, bytes);  // no comment
}

bool ZipWriter::finish() {
  end();
  std::string directory;
  for (const Entry& entry : entries_) append_to_directory(entry, directory);
  append_end(directory.size(), directory);
  return write(directory);
}

}  // namespace kinefile::npz
