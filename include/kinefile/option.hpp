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

/// What an option takes.
enum class OptionType {
  Flag,    ///< nothing: it is given or not
  Number,  ///< a finite number
  Count,   ///< a whole number
  Choice,  ///< one of some words
  Text,    ///< any other text
  File,    ///< the name of a file
};

/// What the command's flags, its man page and completions, Python's keywords and the page's
/// controls know of an option of a format or a parameter of an operation.
struct OptionInfo {
  std::string_view name;  ///< the flag's without dashes: "seq-version"
  OptionType type = OptionType::Text;
  std::string_view value_name = {};  ///< what help calls the value: "N"; empty for a flag
  std::string_view help = {};        ///< what it does, in one line
  std::span<const std::string_view> choices = {};  ///< of a choice, in the order of its enum
  std::string_view default_word = {};  ///< what holds without the option; empty: nothing to say
  std::string_view wanted = {};  ///< of a text or a number, in an error: "frames a second above 0"
  double least = std::numeric_limits<double>::lowest();  ///< of a number or a count, included
  double most = std::numeric_limits<double>::max();
  bool is_required = false;  ///< of an operation: whether it must be given
  /// Of a parameter of an operation: what stands before it in the operation's word; 0 where it is
  /// told by its name: ",blend=10".
  char separator = 0;
};

/// An option that sets a member of `Target`, a struct of options.
template <class Target>
struct Option {
  OptionInfo info;
  /// Reads a word into the member; of a flag the word is not looked at. Returns false, and changes
  /// nothing, if the word is not what the option takes. Null for a file that the caller reads.
  bool (*set)(Target& target, const OptionInfo& info, std::string_view word) = nullptr;
};

/// The option of a name, or null.
template <class Target>
const Option<Target>* find_option(std::span<const Option<Target>> table, std::string_view name) {
  for (const Option<Target>& option : table) {
    if (option.info.name == name) return &option;
  }
  return nullptr;
}

/// Options of single formats: structs of the formats' own (`bvh::ReadOptions`), at most one of a
/// type.
class FormatOptions {
 public:
  FormatOptions() = default;

  /// The options of one format: `{.of_formats = bvh::ReadOptions{...}}`.
  template <class T>
    requires(!std::is_same_v<std::remove_cvref_t<T>, FormatOptions>)
  FormatOptions(T&& options)  // NOLINT(*-explicit-*): the struct is what it is made of
      : structs_{std::any(std::forward<T>(options))} {}

  /// The options of a type as they were set, else their defaults.
  template <class T>
  const T& get() const {
    static const T kDefaults{};
    for (const std::any& known : structs_) {
      if (const T* found = std::any_cast<T>(&known)) return *found;
    }
    return kDefaults;
  }

  /// The options of a type, to be set.
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
