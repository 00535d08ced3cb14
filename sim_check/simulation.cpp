// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation.h"

#include "bullet.h"
#include "error.h"

namespace scanworld::sim {

const char* name_of(RobotKind kind) {
  constexpr const char* names[] = {"cube", "module", "ball"};
  return names[static_cast<int>(kind)];
}

const std::vector<EngineMaker>& engines() {
  static const std::vector<EngineMaker> all = {
      {"bullet", make_bullet},
  };
  return all;
}

const EngineMaker& engine_named(const std::string& name) {
  std::string known;
  for (const EngineMaker& engine : engines()) {
    if (engine.name == name) return engine;
    known += (known.empty() ? "" : ", ") + engine.name;
  }
  throw Error(Cause::usage, "no engine '" + name + "'; there is " + known);
}

}  // namespace scanworld::sim
