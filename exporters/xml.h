// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scanworld {

// An XML element as a value: its attributes and children in the order of the file, else its text.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  std::string text;

  // Adds a child and gives it back; it stays where it is until the next is added.
  XmlElement& add(XmlElement child) { return children.emplace_back(std::move(child)); }
};

inline XmlElement text_element(std::string name, std::string text) {
  return {std::move(name), {}, {}, std::move(text)};
}

// The document with this root; what XML does not allow as it is gets escaped.
std::string xml_document(const XmlElement& root);

}  // namespace scanworld
