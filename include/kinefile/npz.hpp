// SPDX-License-Identifier: MIT
#pragma once

#pragma GCC visibility push(default)

namespace kinefile::npz {

/// The numbers of an array. Those of single precision are the doubles, rounded; beyond the range of
/// single precision they are infinite.
enum class Precision { Double, Single };

/// How to write an archive, in addition to `kinefile::WriteOptions`.
struct WriteOptions {
  Precision precision = Precision::Double;
};

}  // namespace kinefile::npz

#pragma GCC visibility pop
