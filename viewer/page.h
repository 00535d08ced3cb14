// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A world as a page for a browser: one file that needs nothing else. docs/page.md has what is in
// it.
#pragma once

#include <optional>
#include <string>

#include "world/fidelity.h"
#include "world/world.h"

namespace scanworld {

// A scan beside its world.
struct ScanView {
  std::size_t points = 0;  // of the whole scan; the atlas has a part of them
  Fidelity fidelity;
  std::string fidelity_json;  // as report.json has it
};

// What a page shows. The texts are JSON documents, or empty.
struct PageContent {
  std::string title;
  World world;
  std::optional<ScanView> scan;
  std::string report, replay, sim_check;
};

// The page. Text from the content cannot end up as markup. Throws check_failed naming a surface
// that is no valid polygon.
std::string page_of(const PageContent& content);

}  // namespace scanworld
