// SPDX-License-Identifier: MIT
#include "text/printer.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "kinefile/threads.hpp"

namespace kinefile::text {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;
constexpr std::size_t kPieceNumbers = 1024;
constexpr std::size_t kPartNumbers = std::size_t{1} << 15;  ///< that a thread prints at a time

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

void Printer::print_rows(std::size_t num_rows, std::size_t numbers_per_row, PrintRows print) {
  const std::size_t part =
      std::max<std::size_t>(kPartNumbers / std::max<std::size_t>(numbers_per_row, 1), 1);
  if (!kHasThreads || num_rows <= part || max_threads() < 2) return print(*this, 0, num_rows);
  hand_on();
  std::vector<std::string> texts(slots_for_threads());
  const auto make = [&](std::size_t i, std::size_t slot) {
    std::string& text = texts[slot];
    text.clear();
    const std::function<bool(std::string_view)> append = [&text](std::string_view piece) {
      text += piece;
      return true;
    };
    Printer printer(append, spelling_);
    print(printer, i * part, std::min((i + 1) * part, num_rows));
    printer.finish();
  };
  make_in_order((num_rows + part - 1) / part, texts.size(), make,
                [&](std::size_t, std::size_t slot) {
                  is_good_ = is_good_ && sink_(texts[slot]);
                  return is_good_;
                });
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
