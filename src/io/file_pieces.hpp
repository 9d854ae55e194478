// SPDX-License-Identifier: MIT
#pragma once

#include <sys/stat.h>

#include <optional>
#include <string>

#include "io/system_calls.hpp"
#include "kinefile/format.hpp"

namespace kinefile {

/// A regular file that is read piece by piece.
class FilePieces {
 public:
  /// Empty if it cannot be opened, is no regular file, or has fewer bytes than `least_size`.
  static std::optional<FilePieces> open(const std::string& path, std::size_t least_size);

  /// Valid as long as this object stays where it is.
  ByteSource source() const;

  /// The first bytes, at most `count`; none after a fault.
  std::string head(std::size_t count) const;

  /// Whether the file is still what it was when it was opened.
  bool is_unchanged() const;

 private:
  Descriptor file_;
  struct stat opened_ {};
};

/// Whether a file is no longer what it was. Its time may stand still while it is written twice
/// within one tick of the system's clock; its size tells most of these.
bool has_changed(const struct stat& before, const struct stat& after);

}  // namespace kinefile
