// SPDX-License-Identifier: MIT
#include "text/printer.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace kinefile::text {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;
constexpr std::size_t kPieceNumbers = 1024;

}  // namespace

void Printer::print(std::string_view text) {
  buffer_.append(text.data(), text.data() + text.size());
  hand_on_if_full();
}

void Printer::print_exact(double number) {
  const std::optional<int> decimals = std::exchange(spelling_.decimals, std::nullopt);
  print(number);
  spelling_.decimals = decimals;
}

void Printer::print_row(std::span<const double> numbers, std::string_view separator) {
  while (!numbers.empty()) {
    const auto piece = numbers.first(std::min(kPieceNumbers, numbers.size()));
    numbers = numbers.subspan(piece.size());
    simd::append_numbers(piece, separator, spelling_, buffer_);
    if (numbers.empty()) buffer_.resize(buffer_.size() - separator.size());
    hand_on_if_full();
  }
}

void Printer::continue_row(std::span<const double> numbers, std::string_view separator) {
  if (!numbers.empty()) print(separator);
  print_row(numbers, separator);
}

bool Printer::finish() {
  hand_on();
  return is_good_;
}

void Printer::hand_on_if_full() {
  if (buffer_.size() >= kPieceBytes) hand_on();
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

namespace {

/// The code of the multi-byte character at the start of a text if YAML does not allow it in a text,
/// or reads it as a line end; 0 for others.
unsigned unsafe_in_yaml(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (text.size() >= 2 && byte(0) == 0xC2 && byte(1) < 0xA0) return byte(1);
  if (text.size() < 3) return 0;
  if (text.starts_with("\xE2\x80") && (byte(2) & 0xFEu) == 0xA8) return 0x2000u + (byte(2) & 0x3Fu);
  if (text.starts_with("\xEF\xBF") && byte(2) >= 0xBE) return 0xFFC0u + (byte(2) & 0x3Fu);
  return 0;
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string quoted = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (const unsigned code = byte < 0x80 ? 0 : unsafe_in_yaml(text.substr(i))) {
      quoted += fmt::format("\\u{:04x}", code);
      i += code < 0x100 ? 1 : 2;
    } else if (byte < 0x20 || byte == 0x7F) {
      quoted += fmt::format("\\u{:04x}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace kinefile::text
