// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "facets.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "error.h"
#include "world/refacet.h"

namespace scanworld::cli {

void add_sagitta(CLI::App& verb, std::string& text) {
  verb.add_option("--sagitta", text,
                  "Cut what is round anew for the exported files, so that a chord is off it by no "
                  "more: 5mm, 1cm or 0.01 [m]; without it they have the facets of the world")
      ->type_name("LENGTH");
}

double sagitta_from(const std::string& text) {
  if (text.empty()) return 0;
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const double factor = unit == "mm"                  ? 1e-3
                        : unit == "cm"                ? 1e-2
                        : unit == "m" || unit.empty() ? 1
                                                      : 0;
  const double metres = number * factor;
  if (end == text.c_str() || !(metres >= 1e-5 && metres <= 10))
    throw Error(Cause::usage,
                "--sagitta: '" + text + "' is no length from 0.01 mm to 10 m; write 5mm or 1cm");
  return metres;
}

World cut_anew(World world, double sagitta, const Console& console) {
  if (sagitta == 0) return world;
  Refaceted cut = refacet(std::move(world), sagitta);
  for (int id : cut.kept) console.warn(fmt::format("curve {} keeps the facets of the world", id));
  return std::move(cut.world);
}

}  // namespace scanworld::cli
