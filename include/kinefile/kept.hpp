// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <type_traits>
#include <typeinfo>
#include <utility>

#pragma GCC visibility push(default)

namespace kinefile {

/// A value of any type, which only code that knows the type can access. A format keeps in it what
/// the model does not hold of a file, a joint or a component, to write it again unchanged. Copies
/// share the value, which never changes. Several threads may copy and read it at once.
class Kept {
 public:
  /// No value.
  Kept() = default;

  /// Keeps a value.
  template <class T>
  requires(!std::is_same_v<T, Kept>) explicit Kept(T value)
      : value_(std::make_shared<const T>(std::move(value))), type_(&typeid(T)) {}

  /// The value; null if there is none, or one of another type.
  template <class T>
  const T* get() const {
    const bool is_same = type_ != nullptr && *type_ == typeid(T);
    return is_same ? static_cast<const T*>(value_.get()) : nullptr;
  }

  /// Whether there is no value.
  bool is_empty() const { return value_ == nullptr; }

 private:
  std::shared_ptr<const void> value_;
  const std::type_info* type_ = nullptr;
};

}  // namespace kinefile

#pragma GCC visibility pop
