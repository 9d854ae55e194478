// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "kinefile/function_ref.hpp"
#include "simd/number_text.hpp"

namespace kinefile::text {

/// Collects output and passes it on in large pieces.
class Printer {
 public:
  /// Prints some rows, from one up to another that is not included.
  using PrintRows = FunctionRef<void(Printer& printer, std::size_t begin, std::size_t end)>;

  /// \param sink      receives the pieces; printing ends if it returns false
  /// \param spelling  of every number
  explicit Printer(const std::function<bool(std::string_view)>& sink,
                   const simd::NumberSpelling& spelling = {})
      : sink_(sink), spelling_(spelling) {}

  void print(std::string_view text);
  void print(double number) { print_row({&number, 1}, {}); }
  /// Prints a number in its shortest exact form, whatever `decimals` is: for times and counts.
  void print_exact(double number);
  /// Prints numbers with a separator, of two characters at most, between them.
  void print_row(std::span<const double> numbers, std::string_view separator);
  /// Prints numbers behind something else: with a separator before each.
  void continue_row(std::span<const double> numbers, std::string_view separator);
  void print(char character) { buffer_.push_back(character); }

  /// Prints rows, in parts on several threads if they are many.
  /// \param print  called with a printer for each part, for several parts at once
  void print_rows(std::size_t num_rows, std::size_t numbers_per_row, PrintRows print);

  /// Whether the sink never returned false.
  bool is_good() const { return is_good_; }

  /// Passes on the rest. Returns false if the sink ever returned false.
  bool finish();

 private:
  void hand_on_if_full();
  void hand_on();

  const std::function<bool(std::string_view)>& sink_;
  simd::NumberSpelling spelling_;
  fmt::memory_buffer buffer_;
  bool is_good_ = true;
};

/// A field of a CSV table, quoted if RFC 4180 requires it.
std::string csv_field(std::string_view text);

/// A text as a JSON string, with its quotes, which YAML reads in the same way.
/// \param text  UTF-8
std::string json_string(std::string_view text);

}  // namespace kinefile::text
