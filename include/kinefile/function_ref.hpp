// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#pragma GCC visibility push(default)

namespace kinefile {

template <class Signature>
class FunctionRef;

/// A function that is only called while the call lasts that it is passed to: a reference to
/// anything that can be called so. As `std::function_ref` of C++26.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Function,
            class = std::enable_if_t<!std::is_same_v<std::decay_t<Function>, FunctionRef>>>
  FunctionRef(const Function& function)  // NOLINT(*-explicit-*): as a reference is bound
      : object_(std::addressof(function)), call_([](const void* object, Arguments... arguments) {
          return (*static_cast<const Function*>(object))(std::forward<Arguments>(arguments)...);
        }) {}

  Result operator()(Arguments... arguments) const {
    return call_(object_, std::forward<Arguments>(arguments)...);
  }

 private:
  const void* object_;
  Result (*call_)(const void* object, Arguments... arguments);
};

}  // namespace kinefile

#pragma GCC visibility pop
