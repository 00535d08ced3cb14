// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/bullet_file.h"

#include "exporters/export.h"
#include "exporters/parts.h"
#include "support/places.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

TEST_CASE("a .bullet file gives back the solids and what is seen") {
  const TempFolder folder;
  const World world = prepare_export(full_world(), {});
  export_world(world, folder / "w.bullet");
  const BulletFile file = read_bullet(folder / "w.bullet");
  const std::vector<ExportBody> bodies = export_bodies(world, {});
  REQUIRE(file.solids.size() == bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    CHECK(file.solids[i].name == bodies[i].name);
    CHECK(file.solids[i].shape.index() == bodies[i].shape.index());
    CHECK(volume_of(mesh_of(file.solids[i])) ==
          doctest::Approx(volume_of(mesh_of(bodies[i]))).epsilon(1e-3));
    CHECK((file.solids[i].position - bodies[i].position).norm() < 0.02);
  }
  CHECK(area_of(file.seen) ==
        doctest::Approx(area_of(export_parts(world, {.merge = true})[0].mesh)).epsilon(1e-4));
}

TEST_CASE("a .bullet file that is cut or damaged is refused or read, and never a crash") {
  const TempFolder folder;
  export_world(world_named("room"), folder / "w.bullet");
  const std::string whole = read_file(folder / "w.bullet");
  for (int tenth = 0; tenth < 10; ++tenth) {
    const auto path = write_file(folder / "cut.bullet", whole.substr(0, tenth * whole.size() / 10));
    CHECK(contains(error_of(Cause::bad_input, [&] { read_bullet(path); }), "cut.bullet"));
  }
  Random random(4);
  int refused = 0;
  for (int i = 0; i < 12; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 200; ++k)
      damaged[random.next() % damaged.size()] = static_cast<char>(random.next());
    const auto path = write_file(folder / "damaged.bullet", damaged);
    try {
      read_bullet(path);
    } catch (const Error& e) {
      CHECK(e.cause == Cause::bad_input);
      ++refused;
    }
  }
  CHECK(refused > 0);
}
