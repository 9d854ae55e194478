// SPDX-License-Identifier: MIT
#include "formats/robovie/decode.hpp"

namespace kinefile::robovie {

Result<text::DecodedText> decode_motion(std::string_view bytes,
                                        const kinefile::ReadOptions& options,
                                        Diagnostics& diagnostics) {
  Diagnostics own;
  own.warnings_are_errors = diagnostics.warnings_are_errors || !options.lenient;
  auto decoded = text::decode(bytes, options.encoding, options.source_name, own, "cp932");
  diagnostics.append(std::move(own));
  return decoded;
}

}  // namespace kinefile::robovie
