// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The engines that exported worlds are loaded into, as programs that answer orders about a file
// (tests/consumers/consumer.h).
#pragma once

#include "exporters/bodies.h"
#include "support.h"

namespace scanworld::test {

// A consumer, and the format that it takes.
struct Engine {
  std::string name, program, extension;
};
inline const Engine kBullet = {"Bullet", "bullet_consumer", "bullet"},
                    kBullet64 = {"Bullet in double precision", "bullet64_consumer", "bullet"},
                    kMuJoCo = {"MuJoCo", "mujoco_consumer", "xml"},
                    kMuJoCo3 = {"MuJoCo 3", "mujoco_consumer.mjs", "xml"},
                    kDart = {"SDF in DART", "sdf_consumer", "sdf"},
                    kUrdf = {"urdfdom", "urdf_consumer", "urdf"};

// A script of tests/node/, and whether the packages that those need are installed; says so where
// they are not.
std::filesystem::path node_script(const std::string& name);
bool has_node_packages();

// The engines of these that can be had here.
std::vector<Engine> present(std::vector<Engine> engines);

// What an engine answers to orders about a file, line by line.
std::vector<std::string> ask(const Engine& engine, const std::filesystem::path& file,
                             const std::string& orders);

std::vector<double> numbers_in(const std::string& line);

// A world as assimp finds it in a file of triangles, in the world's own axes and metres.
Mesh reread(const World& world, const std::string& format);

}  // namespace scanworld::test
