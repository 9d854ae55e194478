// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "kinefile/io.hpp"
#include "session.hpp"

// Writes documents for the page to save.
namespace kinefile::page {

/// What to write, and how.
struct Writing {
  std::string name;
  const Format& format;
  Json options = Json::object();  ///< words by the names in the tables of options
};

/// A slot's document after its steps, converted.
/// \errors CLI001 (Usage) for an option that the format does not have or with an invalid word, and
///         for the motion of a flow that lacks something; those of `project_of`, `adapt`, `write`
Result<std::vector<MemoryFile>> written_files(const Session& session, const Slot& slot,
                                              const Writing& writing, Diagnostics& diagnostics);

/// Why a format cannot be written of a slot's document, whatever its values are; empty: it can. It
/// is tried with the first frames.
std::string hindrance_of_writing(const Session& session, const Slot& slot, const Format& format);

}  // namespace kinefile::page
