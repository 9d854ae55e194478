// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string_view>

namespace kinefile::text {

/// Collects output and passes it on in large pieces.
class Printer {
 public:
  /// \param sink      receives the pieces; printing ends if it returns false
  /// \param decimals  digits after the point of every number; absent: the shortest form that reads
  /// back as the same double
  explicit Printer(const std::function<bool(std::string_view)>& sink,
                   std::optional<int> decimals = std::nullopt)
      : sink_(sink), decimals_(decimals) {}

  void print(std::string_view text);
  void print(double number);
  /// Prints a number in its shortest exact form, whatever `decimals` is: for times and counts.
  void print_exact(double number);
  /// As `print`, with a point in numbers that have an exponent: without it, some readers of YAML
  /// read 1e-05 as a word.
  void print_yaml(double number);
  void print(char character) { buffer_.push_back(character); }

  /// Passes on the rest. Returns false if the sink ever returned false.
  bool finish();

 private:
  void append(double number);
  void hand_on();

  const std::function<bool(std::string_view)>& sink_;
  std::optional<int> decimals_;
  fmt::memory_buffer buffer_;
  bool is_good_ = true;
};

/// A field of a CSV table, quoted if RFC 4180 requires it.
std::string csv_field(std::string_view text);

/// A text as a JSON string, with its quotes, which YAML reads in the same way.
/// \param text  UTF-8
std::string json_string(std::string_view text);

}  // namespace kinefile::text
