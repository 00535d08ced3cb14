// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruction.h"

#include "scan/read_scan.h"
#include "scan/write_scan.h"
#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("the thesis' own example: load, filter, save") {
  const TempFolder folder;
  write_scan(folder / "with_floor3.txt", room_points({5, 4, 2.7}, 0.01, 0.003));
  Reconstruction recon;
  recon.load_points(folder / "with_floor3.txt");
  const std::size_t before = recon.points().points.size();
  const double delta = recon.filter_points(100, 10);
  recon.save_points(folder / "filtered.txt");
  CHECK(delta == doctest::Approx(0.05).scale(0).epsilon(0.02));
  const PointCloud filtered = read_scan({folder / "filtered.txt"});
  CHECK(filtered.points == recon.points().points);
  CHECK(filtered.points.size() < before / 10);
  CHECK(filtered.points.size() > 5000);
  const World world = recon.reconstruct();
  CHECK(world.surfaces.size() == 6);
  CHECK(std::get<std::int64_t>(world.provenance.options.at("thesis.filter.min_points")) == 10);
}
