// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "io/system_calls.hpp"
#include "kinefile/io.hpp"

namespace kinefile {

/// A file in the folder of the file that it becomes, or that it keeps a copy of, until it is gone.
///
/// Where the system can, it has no name while it is written, so that nothing stays if the process
/// is killed. A name is one of a few that belong to the final name (`.kinefile-HASH-N.part`: short,
/// since the final name may be as long as a name can be). The process that made the file holds a
/// lock on it (flock); a file with such a name and without a lock is of a process that was killed,
/// and the next one that needs these names removes it.
class TemporaryFile {
 public:
  /// Creates an empty file that becomes `path`, and removes what killed processes left of such. If
  /// it is not open, the fault is in errno.
  static TemporaryFile create(const std::string& path, Cancellation* cancellation);

  /// Gives the file at `path` a second, temporary name, so that what it holds stays when `path` is
  /// replaced. If it has no name, the fault is in errno. (Where a file system has no links, `path`
  /// does not exist from here until it is replaced.)
  static TemporaryFile second_name(const std::string& path, Cancellation* cancellation);

  TemporaryFile() = default;
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  TemporaryFile(TemporaryFile&& other) noexcept;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  /// Removes the file if it has a temporary name.
  ~TemporaryFile();

  bool is_open() const { return static_cast<bool>(descriptor_); }
  bool has_name() const { return !name_.empty(); }
  int descriptor() const { return descriptor_.number(); }

  /// Gives a file without a name a temporary one.
  /// \returns 0, or errno of the fault
  int give_name(const std::string& path);

  /// Becomes `path`, which must not exist.
  /// \returns 0, or errno of the fault: EEXIST if it exists by now
  int become_new(const std::string& path);

  /// Becomes `path` and replaces what is there. It must have a name.
  /// \returns 0, or errno of the fault
  int replace(const std::string& path);

 private:
  /// Finds a temporary name that `take` can have.
  /// \param take  returns 0, EEXIST if the name is not free, or errno of another fault
  int take_name(const std::string& path, const std::function<int(const std::string& name)>& take);
  int link_descriptor(const std::string& name) const;
  void forget_name();

  Descriptor descriptor_;
  std::string name_;
  Cancellation* cancellation_ = nullptr;
};

}  // namespace kinefile
