// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation.h"

#include "bullet.h"
#include "named.h"
#ifdef SCANWORLD_MUJOCO
#include "mujoco.h"
#endif
#ifdef SCANWORLD_ODE
#include "ode.h"
#endif

namespace scanworld::sim {

const char* name_of(RobotKind kind) {
  constexpr const char* names[] = {"cube", "module", "ball"};
  return names[static_cast<int>(kind)];
}

const std::vector<EngineMaker>& engines() {
  static const std::vector<EngineMaker> all = {
      {"bullet", make_bullet, true},
#ifdef SCANWORLD_ODE
      {"ode", make_ode, true},
#endif
#ifdef SCANWORLD_MUJOCO
      {"mujoco", make_mujoco, false},
#endif
  };
  return all;
}

const EngineMaker& engine_named(const std::string& name) {
  return find_named(engines(), name, "engine");
}

}  // namespace scanworld::sim
