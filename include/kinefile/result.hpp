// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "kinefile/diagnostics.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// A value or an `Error`. Unlike the class it stands on, it cannot be dropped unseen.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
 public:
  using tl::expected<T, Error>::expected;
};

/// Turns an error into the failed state of any `Result`.
inline tl::unexpected<Error> fail(Error error) { return tl::unexpected<Error>(std::move(error)); }
/// The same of an error that has no place in a text.
inline tl::unexpected<Error> fail(ErrorKind kind, std::string code, std::string message) {
  return fail(make_error(kind, std::move(code), std::move(message)));
}

}  // namespace kinefile

#pragma GCC visibility pop
