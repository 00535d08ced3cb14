// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "facets.h"

#include <fmt/format.h>

#include "world/refacet.h"

namespace scanworld::cli {

void add_sagitta(CLI::App& verb, std::string& text) {
  verb.add_option("--sagitta", text,
                  "Cut what is round anew for the exported files, so that a chord is off it by no "
                  "more: 5mm, 1cm or 0.01 [m]; without it they have the facets of the world")
      ->type_name("LENGTH");
}

double sagitta_from(const std::string& text) {
  return text.empty() ? 0 : length_from("--sagitta", text);
}

World cut_anew(World world, double sagitta, const Console& console) {
  if (sagitta == 0) return world;
  Refaceted cut = refacet(std::move(world), sagitta);
  for (int id : cut.kept) console.warn(fmt::format("curve {} keeps the facets of the world", id));
  return std::move(cut.world);
}

}  // namespace scanworld::cli
