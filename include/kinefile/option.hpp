// SPDX-License-Identifier: MIT
#pragma once

#include <any>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#pragma GCC visibility push(default)

namespace kinefile {

/// The type of an option's value.
enum class OptionType {
  Flag,    ///< no value: the option is given or not
  Number,  ///< a finite number
  Count,   ///< a whole number
  Choice,  ///< one of a list of words
  Text,    ///< any other text
  File,    ///< the name of a file
};

/// Describes an option of a format or a parameter of an operation. The command's flags, man page
/// and completions, Python's keywords and the page's controls are made from it.
struct OptionInfo {
  std::string_view name;  ///< the flag without dashes: "seq-version"
  OptionType type = OptionType::Text;
  std::string_view value_name = {};  ///< the name of the value in help: "N"; empty for a flag
  std::string_view help = {};        ///< what it does, in one line
  std::span<const std::string_view> choices = {};  ///< for a choice, in the order of its enum
  std::string_view default_word = {};              ///< the default, for help; empty: not shown
  std::string_view wanted = {};  ///< for a text or a number, what an error expects: "frames a
                                 ///< second above 0"
  double least = std::numeric_limits<double>::lowest();  ///< for a number or a count, inclusive
  double most = std::numeric_limits<double>::max();
  bool is_required = false;  ///< it must be given
  /// For a parameter of an operation: the character before it in the operation's word; 0 for a
  /// named parameter: ",blend=10".
  char separator = 0;
  bool can_repeat = false;  ///< it may be given several times; each adds to those before
};

/// An option that sets a member of `Target`, a struct of options.
template <class Target>
struct Option {
  OptionInfo info;
  /// Reads a word into the member; for a flag the word is ignored. Returns false, and changes
  /// nothing, if the word is not valid for the option. Null for a file that the caller reads.
  bool (*set)(Target& target, const OptionInfo& info, std::string_view word) = nullptr;
};

/// The option with this name, or null.
template <class Target>
const Option<Target>* find_option(std::span<const Option<Target>> table, std::string_view name) {
  for (const Option<Target>& option : table) {
    if (option.info.name == name) return &option;
  }
  return nullptr;
}

/// Options of single formats: structs that the formats define (`bvh::ReadOptions`), at most one of
/// each type.
class FormatOptions {
 public:
  FormatOptions() = default;

  /// The options of one format: `{.of_formats = bvh::ReadOptions{...}}`.
  template <class T, class = std::enable_if_t<!std::is_same_v<T, FormatOptions>>>
  FormatOptions(T options)  // NOLINT(*-explicit-*): the struct is what it is made of
      : structs_{std::any(std::move(options))} {}

  /// The options of type T as they were set, otherwise their defaults.
  template <class T>
  const T& get() const {
    static const T kDefaults{};
    for (const std::any& known : structs_) {
      if (const T* found = std::any_cast<T>(&known)) return *found;
    }
    return kDefaults;
  }

  /// The options of type T, for writing.
  template <class T>
  T& edit() {
    for (std::any& known : structs_) {
      if (T* found = std::any_cast<T>(&known)) return *found;
    }
    return *std::any_cast<T>(&structs_.emplace_back(T{}));
  }

 private:
  std::vector<std::any> structs_;
};

}  // namespace kinefile

#pragma GCC visibility pop
