// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "xml.h"

#include <tinyxml2.h>

namespace scanworld {

namespace {

// XML has no way to write control characters: they become the sign for what cannot be shown.
std::string printable(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r')
      result += "\xef\xbf\xbd";
    else
      result += c;
  return result;
}

void print(tinyxml2::XMLPrinter& printer, const XmlElement& element) {
  printer.OpenElement(element.name.c_str());
  for (const auto& [name, value] : element.attributes)
    printer.PushAttribute(name.c_str(), printable(value).c_str());
  for (const XmlElement& child : element.children) print(printer, child);
  if (!element.text.empty()) printer.PushText(printable(element.text).c_str());
  printer.CloseElement();
}

}  // namespace

std::string xml_document(const XmlElement& root) {
  tinyxml2::XMLPrinter printer;
  printer.PushDeclaration("xml version=\"1.0\" encoding=\"UTF-8\"");
  print(printer, root);
  return printer.CStr();
}

}  // namespace scanworld
