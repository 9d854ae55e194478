// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace kinefile::text::xml {

/// An attribute of an element.
struct Attribute {
  std::string_view name;  ///< a view into the text, with its prefix
  std::string value;      ///< references replaced; a tab or a line end is a space

  const char* at() const { return name.data(); }  ///< where it starts in the text
};

/// An element of an XML text.
struct Element {
  std::string_view name;     ///< a view into the text, with its prefix
  const char* at = nullptr;  ///< its '<' in the text
  const Element* parent = nullptr;
  std::vector<Attribute> attributes;
  std::vector<const Element*> children;
  /// Its character data, without those of its children; references replaced, line ends are LF.
  std::string characters;
};

/// What is wrong with an XML text, and where.
struct Fault {
  const char* at = nullptr;
  std::string message;  ///< "expected ..., found ..."
};

/// The elements of an XML text. Views and pointers into it live as long as it and its text.
struct Tree {
  std::deque<Element> elements;  ///< in the order of the text, the outermost one first

  const Element& root() const { return elements.front(); }
};

/// The largest depth of elements in each other.
inline constexpr std::size_t kMostLevels = 100;

/// Reads a text of one element. Comments, processing instructions, the XML declaration and a
/// document type without declarations of its own are skipped. References: the five entities of
/// XML and character references; any other ampersand stands for itself, as many readers take it.
/// Name spaces are not resolved. Null after a fault: XML that is not well-formed, declarations
/// within a DOCTYPE, a zero byte, more than `kMostLevels` elements in each other.
/// \param text  UTF-8 without a byte order mark
/// Source: Extensible Markup Language (XML) 1.0, fifth edition.
std::unique_ptr<Tree> read_tree(std::string_view text, Fault& fault);

/// The attribute of this name, or null.
const Attribute* find_attribute(const Element& element, std::string_view name);

/// The first child of this name, or null.
const Element* find_child(const Element& element, std::string_view name);

}  // namespace kinefile::text::xml
