// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace kinefile::npz {

/// Writes a zip archive of stored entries to a stream, entry after entry. The size of an entry is
/// known when it begins, its CRC-32 only when it ends: it stands behind the bytes (a data
/// descriptor) and in the directory at the end, which readers use. Entries and archives of 4 GiB
/// and more have Zip64 fields. All time stamps are the first that zip knows, so that equal content
/// gives equal bytes.
/// Source: APPNOTE.TXT 6.3.10, "ZIP File Format Specification", PKWARE.
class ZipWriter {
 public:
  /// \param sink  receives the pieces; writing ends if it returns false
  explicit ZipWriter(const std::function<bool(std::string_view)>& sink) : sink_(sink) {}

  /// Starts an entry.
  /// \param name  ASCII
  /// \param size  the number of bytes that `add` gets before the next entry begins
  void begin(std::string name, std::uint64_t size);

  /// Adds bytes to the entry. Returns false if the sink ever returned false.
  bool add(std::string_view bytes);

  /// Writes the directory. Returns false if the sink ever returned false.
  bool finish();

 private:
  struct Entry {
    std::string name;
    std::uint64_t size = 0;
    std::uint64_t offset = 0;  ///< of its header
    std::uint32_t crc = 0;
  };

  bool write(std::string_view bytes);
  void end();
  static void append_to_directory(const Entry& entry, std::string& directory);
  void append_end(std::uint64_t directory_size, std::string& bytes) const;

  const std::function<bool(std::string_view)>& sink_;
  std::vector<Entry> entries_;
  std::uint64_t offset_ = 0;  ///< the number of bytes written
  bool is_good_ = true;
};

}  // namespace kinefile::npz
