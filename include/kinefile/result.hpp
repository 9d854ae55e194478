// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "kinefile/diagnostics.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// A value or an `Error`. Unlike its base class it is [[nodiscard]], so that no error is ignored.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
 public:
  using tl::expected<T, Error>::expected;
};

/// Converts an error to a failed `Result` of any type.
inline tl::unexpected<Error> fail(Error error) { return tl::unexpected<Error>(std::move(error)); }
/// As above, with an error that has no place in a text.
inline tl::unexpected<Error> fail(ErrorKind kind, std::string code, std::string message) {
  return fail(make_error(kind, std::move(code), std::move(message)));
}

}  // namespace kinefile

#pragma GCC visibility pop
