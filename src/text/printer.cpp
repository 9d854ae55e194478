// SPDX-License-Identifier: MIT
#include "text/printer.hpp"

#include <cmath>
#include <iterator>
#include <string>
#include <utility>

namespace kinefile::text {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;

}  // namespace

void Printer::print(std::string_view text) {
  buffer_.append(text.data(), text.data() + text.size());
  if (buffer_.size() >= kPieceBytes) hand_on();
}

void Printer::print(double number) {
  if (std::isnan(number)) {
    print(std::string_view("nan"));  // a NaN's sign says nothing, and its spelling varies
  } else if (decimals_) {
    fmt::format_to(std::back_inserter(buffer_), "{:.{}f}", number, *decimals_);
  } else {
    fmt::format_to(std::back_inserter(buffer_), "{}", number);
  }
  if (buffer_.size() >= kPieceBytes) hand_on();
}

void Printer::print_exact(double number) {
  const std::optional<int> decimals = std::exchange(decimals_, std::nullopt);
  print(number);
  decimals_ = decimals;
}

void Printer::print_yaml(double number) {
  const std::size_t start = buffer_.size();
  print(number);
  if (buffer_.size() <= start) return;  // has been handed on, which is rare
  const std::string_view text(buffer_.data() + start, buffer_.size() - start);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string_view::npos || text.find('.') != std::string_view::npos) return;
  const std::string tail(text.substr(exponent));
  buffer_.resize(start + exponent);
  const std::string pointed = ".0" + tail;
  buffer_.append(pointed.data(), pointed.data() + pointed.size());
}

bool Printer::finish() {
  hand_on();
  return is_good_;
}

void Printer::hand_on() {
  if (is_good_ && buffer_.size() > 0) {
    is_good_ = sink_(std::string_view(buffer_.data(), buffer_.size()));
  }
  buffer_.clear();
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

std::string json_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      quoted += fmt::format("\\u{:04x}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace kinefile::text
