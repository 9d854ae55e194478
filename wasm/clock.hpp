// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "kinefile/document.hpp"

// Which time of what was read a document shows after steps. A clock is a body motion whose one
// value is the time of each frame; it goes through the steps that the document goes through.
namespace kinefile::page {

/// The clock of a document that was read; absent if it has no frames.
std::optional<Document> clock_of(const Document& document);

/// Changes a clock as its document was changed; it is dropped where it no longer tells the times of
/// the document's frames.
/// \param document  after the change
/// \param change    false where it cannot be made to a clock
void turn_clock(std::optional<Document>& clock, const Document& document,
                const std::function<bool(Document& clock)>& change);

/// The time that the first frame shows, from the first frame that was read on; 0 where that is not
/// known, or time does not run forward.
double start_of(const std::optional<Document>& clock);

}  // namespace kinefile::page
