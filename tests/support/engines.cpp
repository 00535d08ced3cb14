// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "engines.h"

#include <iterator>
#include <sstream>

#include "exporters/assimp.h"
#include "exporters/export.h"

namespace scanworld::test {

std::filesystem::path node_script(const std::string& name) {
  return in_project("tests/node/" + name);
}

bool has_node_packages() {
  const bool installed = std::filesystem::exists(node_script("node_modules/mujoco-js"));
  if (!installed) MESSAGE("skipped: no packages from npm; './dev test' installs them");
  return installed;
}

std::vector<Engine> present(std::vector<Engine> engines) {
  if (!has_node_packages())
    std::erase_if(engines, [](const Engine& e) { return e.program == kMuJoCo3.program; });
  return engines;
}

std::vector<std::string> ask(const Engine& engine, const std::filesystem::path& file,
                             const std::string& orders) {
  const TempFolder folder;
  const auto path = write_file(folder / "orders", orders);
  const bool is_script = engine.program.ends_with(".mjs");
  const auto program = is_script ? node_script(engine.program)
                                 : std::filesystem::path(SCANWORLD_CONSUMERS) / engine.program;
  std::vector<std::string> command = {program.string(), file.string(), path.string()};
  if (is_script) command.insert(command.begin(), "node");
  const Outcome outcome = run_program(command);
  CHECK_MESSAGE(outcome.code == 0, engine.name << ": " << outcome.err);
  std::vector<std::string> lines;
  std::istringstream in(outcome.out);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<double> numbers_in(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<double>(in), {}};
}

Mesh reread(const World& world, const std::string& format) {
  const TempFolder folder;
  export_world(world, folder / ("world." + format));
  Mesh mesh = read_mesh(folder / ("world." + format));
  for (Vec3& v : mesh.vertices) {
    if (format == "glb") v = Vec3(v.x(), -v.z(), v.y());  // from Y up
    if (format == "3mf") v /= 1000;                       // from millimetres
  }
  return mesh;
}

}  // namespace scanworld::test
