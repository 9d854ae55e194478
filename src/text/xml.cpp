// SPDX-License-Identifier: MIT
#include "text/xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "text/decode.hpp"
#include "text/source.hpp"

namespace kinefile::text::xml {
namespace {

bool is_xml_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool starts_name(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || c == '_' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
}

bool is_in_name(char c) { return starts_name(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

/// The character of a reference such as "&#x41;", if it is one that XML has.
/// \param name  between the ampersand and the semicolon, "#x41"
std::optional<char32_t> referred_character(std::string_view name) {
  name.remove_prefix(1);
  const bool is_hexadecimal = name.starts_with('x');
  if (is_hexadecimal) name.remove_prefix(1);
  std::uint32_t code = 0;
  const char* const end = name.data() + name.size();
  const auto read = std::from_chars(name.data(), end, code, is_hexadecimal ? 16 : 10);
  const bool is_number = read.ec == std::errc() && read.ptr == end;
  const bool is_control = code < 0x20 && code != '\t' && code != '\n' && code != '\r';
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (!is_number || is_control || is_surrogate || code > 0x10FFFF) return std::nullopt;
  return code;
}

/// The character of an entity that XML itself has, or 0.
char character_of_entity(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kEntities = {
      {{"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}}};
  for (const auto& [known, character] : kEntities) {
    if (known == name) return character;
  }
  return 0;
}

/// Reads the pieces of a text, one after the other: tags, character data, and what is skipped.
class TreeReader {
 public:
  TreeReader(std::string_view text, Tree& tree, Fault& fault)
      : begin_(text.data()),
        next_(begin_),
        end_(begin_ + text.size()),
        tree_(tree),
        fault_(fault) {}

  bool read() {
    const char* const zero = std::find(begin_, end_, '\0');
    if (zero != end_) return fail(zero, "expected XML, found a zero byte");
    while (next_ != end_) {
      if (!read_piece()) return false;
    }
    if (tree_.elements.empty()) return fail(begin_, "expected an element, found none");
    if (open_.empty()) return true;
    return fail(open_.back()->at, fmt::format("expected </{}> at the end of this element, found "
                                              "none",
                                              open_.back()->name));
  }

 private:
  bool fail(const char* at, std::string message) {
    fault_ = {at, std::move(message)};
    return false;
  }

  /// Reports what is next in the text.
  bool unexpected(std::string_view expected) {
    const char* end = next_;
    while (end != end_ && !is_xml_space(*end) && *end != '<' && *end != '>') ++end;
    if (end == next_ && end != end_) ++end;
    const std::string_view found(next_, static_cast<std::size_t>(end - next_));
    return fail(next_, fmt::format("expected {}, found {}", expected, quoted(found)));
  }

  std::string_view rest() const { return {next_, static_cast<std::size_t>(end_ - next_)}; }

  void skip_space() { next_ = std::find_if_not(next_, end_, is_xml_space); }

  /// Consumes a character if it is next.
  bool take(char c) {
    const bool is_next = next_ != end_ && *next_ == c;
    if (is_next) ++next_;
    return is_next;
  }

  /// Consumes a name; empty if there is none.
  std::string_view take_name() {
    const char* const start = next_;
    if (next_ != end_ && starts_name(*next_)) next_ = std::find_if_not(next_, end_, is_in_name);
    return {start, static_cast<std::size_t>(next_ - start)};
  }

  bool read_piece() {
    if (!rest().starts_with('<')) return read_characters();
    if (rest().starts_with("<!--")) return skip_to("<!--", "-->");
    if (rest().starts_with("<?")) return skip_to("<?", "?>");
    if (rest().starts_with("<![CDATA[")) return read_cdata();
    if (rest().starts_with("<!DOCTYPE")) return skip_document_type();
    if (rest().starts_with("</")) return read_end_tag();
    return read_start_tag();
  }

  /// Skips a part of the text.
  /// \param end  the word that ends it
  bool skip_to(std::string_view start, std::string_view end) {
    const std::size_t at = rest().find(end, start.size());
    if (at == std::string_view::npos) {
      return fail(next_,
                  fmt::format("expected '{}' after '{}', found the end of the file", end, start));
    }
    next_ += at + end.size();
    return true;
  }

  bool read_cdata() {
    constexpr std::string_view kStart = "<![CDATA[";
    constexpr std::string_view kEnd = "]]>";
    if (open_.empty()) return unexpected("an element");
    const char* const start = next_ + kStart.size();
    if (!skip_to(kStart, kEnd)) return false;
    append_lines({start, static_cast<std::size_t>(next_ - kEnd.size() - start)});
    return true;
  }

  void append_lines(std::string_view data) {
    for (std::size_t i = 0; i < data.size(); ++i) {
      const bool is_return = data[i] == '\r';
      if (is_return && i + 1 < data.size() && data[i + 1] == '\n') continue;
      open_.back()->characters += is_return ? '\n' : data[i];
    }
  }

  bool skip_document_type() {
    if (!tree_.elements.empty()) return unexpected("an element");
    for (next_ += std::string_view("<!DOCTYPE").size(); next_ != end_; ++next_) {
      if (*next_ == '[') {
        return fail(next_, "expected a DOCTYPE without declarations, found '['");
      }
      if (*next_ == '"' || *next_ == '\'') {
        const char quote = *next_;
        next_ = std::find(next_ + 1, end_, quote);
        if (next_ == end_) break;
      }
      if (take('>')) return true;
    }
    return unexpected("'>' at the end of the DOCTYPE");
  }

  bool read_characters() {
    const char* const start = next_;
    next_ = std::find(next_, end_, '<');
    const std::string_view data(start, static_cast<std::size_t>(next_ - start));
    if (!open_.empty()) return append_decoded(data, false, open_.back()->characters);
    next_ = std::find_if_not(start, next_, is_xml_space);
    if (next_ == start + data.size()) return true;
    return unexpected(tree_.elements.empty() ? "an element" : "the end of the file");
  }

  bool read_end_tag() {
    const char* const start = next_;
    next_ += 2;
    const std::string_view name = take_name();
    if (name.empty()) return unexpected("the name of an element");
    if (open_.empty() || open_.back()->name != name) {
      const std::string expected =
          open_.empty() ? "an element" : fmt::format("</{}>", open_.back()->name);
      return fail(start, fmt::format("expected {}, found </{}>", expected, name));
    }
    skip_space();
    if (!take('>')) return unexpected(fmt::format("'>' at the end of </{}", name));
    open_.pop_back();
    return true;
  }

  bool read_start_tag() {
    const char* const start = next_++;
    const std::string_view name = take_name();
    if (name.empty()) return unexpected("the name of an element");
    if (open_.empty() && !tree_.elements.empty()) {
      return fail(start, fmt::format("expected the end of the file, found <{}>", name));
    }
    if (open_.size() == kMostLevels) {
      return fail(start, fmt::format("expected at most {} elements in each other, found more",
                                     kMostLevels));
    }
    Element& element = tree_.elements.emplace_back();
    element.name = name;
    element.at = start;
    if (!open_.empty()) {
      element.parent = open_.back();
      open_.back()->children.push_back(&element);
    }
    return read_attributes(element);
  }

  /// Reads the rest of a start tag.
  bool read_attributes(Element& element) {
    for (;;) {
      skip_space();
      if (take('>')) {
        open_.push_back(&element);
        return check_attributes(element);
      }
      if (rest().starts_with("/>")) {
        next_ += 2;
        return check_attributes(element);
      }
      if (!read_attribute(element)) return false;
    }
  }

  bool read_attribute(Element& element) {
    Attribute attribute;
    attribute.name = take_name();
    if (attribute.name.empty()) {
      return unexpected(fmt::format("an attribute or '>' in <{}", element.name));
    }
    skip_space();
    if (!take('=')) return unexpected(fmt::format("'=' after the attribute {}", attribute.name));
    skip_space();
    const char quote = next_ == end_ ? '\0' : *next_;
    if (quote != '"' && quote != '\'') {
      return unexpected(fmt::format("the value of the attribute {} in quotes", attribute.name));
    }
    const char* const start = ++next_;
    next_ = std::find_if(next_, end_, [quote](char c) { return c == quote || c == '<'; });
    const std::string_view value(start, static_cast<std::size_t>(next_ - start));
    if (!take(quote)) {
      return unexpected(fmt::format("{} at the end of the attribute {}", quote, attribute.name));
    }
    if (!append_decoded(value, true, attribute.value)) return false;
    element.attributes.push_back(std::move(attribute));
    return true;
  }

  /// Reports an attribute that an element has twice.
  bool check_attributes(const Element& element) {
    std::vector<std::string_view> names;
    for (const Attribute& attribute : element.attributes) names.push_back(attribute.name);
    std::sort(names.begin(), names.end(), [](std::string_view a, std::string_view b) {
      const int order = a.compare(b);
      return order != 0 ? order < 0 : a.data() < b.data();
    });
    const auto repeated = std::adjacent_find(names.begin(), names.end());
    if (repeated == names.end()) return true;
    return fail(
        (repeated + 1)->data(),
        fmt::format("expected one attribute {} in <{}>, found another", *repeated, element.name));
  }

  /// Adds a part of the text with its references replaced and its line ends made one character.
  bool append_decoded(std::string_view part, bool is_attribute, std::string& out) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      const char c = part[i];
      if (c == '&') {
        const std::size_t length = append_reference(part.substr(i), out);
        if (length == 0) {
          return fail(part.data() + i, "expected a reference to a character, found none of XML");
        }
        i += length - 1;
      } else if (c == '\r' && i + 1 < part.size() && part[i + 1] == '\n') {
        continue;
      } else if (c == '\r') {
        out += is_attribute ? ' ' : '\n';
      } else {
        out += is_attribute && is_xml_space(c) ? ' ' : c;
      }
    }
    return true;
  }

  /// Adds what a reference stands for; an ampersand that starts none stands for itself.
  /// \returns the length of the reference, 0 if it refers to no character
  static std::size_t append_reference(std::string_view part, std::string& out) {
    constexpr std::size_t kLongest = 16;
    const std::size_t end = part.substr(0, kLongest).find(';');
    const std::string_view name =
        end == std::string_view::npos ? std::string_view() : part.substr(1, end - 1);
    if (name.starts_with('#')) {
      const auto code = referred_character(name);
      if (!code) return 0;
      append_utf8(out, *code);
      return end + 1;
    }
    const char character = character_of_entity(name);
    out += character == 0 ? '&' : character;
    return character == 0 ? 1 : end + 1;
  }

  const char* begin_;
  const char* next_;
  const char* end_;
  Tree& tree_;
  Fault& fault_;
  std::vector<Element*> open_;  ///< the elements that are not closed yet, outermost first
};

}  // namespace

std::unique_ptr<Tree> read_tree(std::string_view text, Fault& fault) {
  auto tree = std::make_unique<Tree>();
  if (!TreeReader(text, *tree, fault).read()) return nullptr;
  return tree;
}

const Attribute* find_attribute(const Element& element, std::string_view name) {
  for (const Attribute& attribute : element.attributes) {
    if (attribute.name == name) return &attribute;
  }
  return nullptr;
}

const Element* find_child(const Element& element, std::string_view name) {
  for (const Element* child : element.children) {
    if (child->name == name) return child;
  }
  return nullptr;
}

}  // namespace kinefile::text::xml
