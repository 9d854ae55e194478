// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string_view>

namespace kinefile::text {

/// Collects output and hands it on in large pieces.
class Printer {
 public:
  /// \param sink      takes the pieces; false from it ends all printing
  /// \param decimals  digits after the point of every number; absent: the shortest form that
  ///                  reads back as the same double
  explicit Printer(const std::function<bool(std::string_view)>& sink,
                   std::optional<int> decimals = std::nullopt)
      : sink_(sink), decimals_(decimals) {}

  void print(std::string_view text);
  void print(double number);
  /// Prints a number in its shortest exact form, whatever `decimals` says: a time, a count.
  void print_exact(double number);
  /// As `print`, with a point in numbers that have an exponent: without it, some readers of YAML
  /// take 1e-05 for a word.
  void print_yaml(double number);
  void print(char character) { buffer_.push_back(character); }

  /// Hands on what is left. Returns false if the sink ever did.
  bool finish();

 private:
  void append(double number);
  void hand_on();

  const std::function<bool(std::string_view)>& sink_;
  std::optional<int> decimals_;
  fmt::memory_buffer buffer_;
  bool is_good_ = true;
};

/// A field of a CSV table, quoted as RFC 4180 says where it must be.
std::string csv_field(std::string_view text);

/// A text as a JSON string, with its quotes, which YAML reads the same. \param text UTF-8
std::string json_string(std::string_view text);

}  // namespace kinefile::text
