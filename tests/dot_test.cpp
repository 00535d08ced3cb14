// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "exporters/dot.h"

#include <algorithm>

#include "exporters/export.h"
#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// The tokens of Graphviz' language: words and numbers, strings without their quotes, signs.
std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < text.size();) {
    const auto is_word = [&](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    };
    if (std::isspace(static_cast<unsigned char>(text[i]))) {
      ++i;
    } else if (text.compare(i, 2, "//") == 0) {
      i = text.find('\n', i);
    } else if (text.compare(i, 2, "--") == 0) {
      tokens.push_back("--");
      i += 2;
    } else if (text[i] == '"') {
      std::string word;
      for (++i; text.at(i) != '"'; ++i) {
        if (text[i] == '\\') word += text[i++];
        word += text.at(i);
      }
      ++i;
      tokens.push_back("\"" + word);
    } else if (is_word(text[i])) {
      std::string word;
      while (i < text.size() && is_word(text[i])) word += text[i++];
      tokens.push_back(word);
    } else {
      tokens.emplace_back(1, text[i++]);
    }
  }
  return tokens;
}

}  // namespace

TEST_CASE("a file for Graphviz follows its grammar, with a statement a room and a door") {
  const TempFolder folder;
  World world = read_world(in_project("worlds/office.json"));
  world.rooms[2].name = "a \"big\" \\ room;\n}";
  export_world(world, folder / "w.dot");
  const auto t = tokens_of(read_file(folder / "w.dot"));
  // graph ID { statement ; ... } where a statement is  ID [-- ID] [ ID = ID , ... ]
  std::size_t i = 0, nodes = 0, edges = 0;
  const auto expect = [&](const std::string& token) {
    REQUIRE(i < t.size());
    CHECK(t[i++] == token);
  };
  expect("graph"), expect("rooms"), expect("{");
  while (i < t.size() && t[i] != "}") {
    const bool is_default = t[i++] == "node";
    bool is_edge = false;
    if (t[i] == "--") is_edge = true, i += 2;
    expect("[");
    while (true) {
      ++i;  // name
      expect("=");
      ++i;  // value
      if (t[i] != ",") break;
      ++i;
    }
    expect("]"), expect(";");
    nodes += !is_default && !is_edge, edges += is_edge;
  }
  expect("}");
  CHECK(i == t.size());
  CHECK(nodes == world.rooms.size());
  CHECK(edges == world.doors.size());
  CHECK(std::find(t.begin(), t.end(), "\"a \\\"big\\\" \\\\ room;\\n}\\n16.6 m2") != t.end());
}
