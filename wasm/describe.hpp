// SPDX-License-Identifier: MIT
#pragma once

#include "session.hpp"

// What the page shows of documents and tables, as JSON.
namespace kinefile::page {

/// A number, or nan, inf, -inf as text.
Json number(double value);

/// The formats, the operations and the other tables of options.
Json tables();

/// Everything that the page shows of an open document, except for its numbers.
Json describe(const Slot& slot);

/// Diagnostics in the order of their places.
Json json_of(const Diagnostics& diagnostics);
Json json_of(const Diagnostic& diagnostic);

}  // namespace kinefile::page
