// SPDX-License-Identifier: MIT
#include "formats/npz/format.hpp"

#include <array>

#include "formats/npz/pose_table.hpp"
#include "kinefile/npz.hpp"

namespace kinefile::npz {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".npz"};

/// A flag that sets the precision.
template <Precision precision>
constexpr WriteOption precision_option(std::string_view name, std::string_view help) {
  return {{.name = name, .type = OptionType::Flag, .help = help},
          [](kinefile::WriteOptions& options, const OptionInfo&, std::string_view) {
            options.of_formats.edit<WriteOptions>().precision = precision;
            return true;
          }};
}

constexpr std::array<WriteOption, 2> kPoseOptions = {
    precision_option<Precision::Single>("float32", "Numbers of single precision (.npz)"),
    precision_option<Precision::Double>("float64", "Numbers of double precision, as else (.npz)"),
};

}  // namespace

Format format() {
  Format format;
  format.name = "npz";
  format.description = "NumPy's archive of arrays, for poses (fk)";
  format.extensions = kExtensions;
  format.write_poses = write_poses;
  format.pose_options = kPoseOptions;
  return format;
}

}  // namespace kinefile::npz
