// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "landmarks.h"

#include <fmt/format.h>

#include "files.h"
#include "world/landmarks.h"

namespace scanworld {

namespace {

std::string place_text(const Vec3& v, const char* separator) {
  return fmt::format("{1:.6f}{0}{2:.6f}{0}{3:.6f}", separator, v.x(), v.y(), v.z());
}

// 1-sigma along each axis.
std::string sigma_text(const Mat3& c, const char* separator) {
  const Vec3 sigma = c.diagonal().cwiseMax(0).cwiseSqrt();
  return fmt::format("{1:.6e}{0}{2:.6e}{0}{3:.6e}", separator, sigma.x(), sigma.y(), sigma.z());
}

std::string covariance_text(const Mat3& c, const char* separator) {
  return fmt::format("{1:.6e}{0}{2:.6e}{0}{3:.6e}{0}{4:.6e}{0}{5:.6e}{0}{6:.6e}", separator,
                     c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2));
}

std::string yaml_of(const Landmark& l) {
  std::string text = fmt::format("  - id: {}\n    kind: {}\n    relief: {}\n", l.id,
                                 name_of(l.kind), name_of(l.relief));
  if (l.kind == LandmarkKind::corner)
    text += fmt::format("    position: [{}]\n", place_text(l.foot, ", "));
  else
    text += fmt::format("    foot: [{}]\n    top: [{}]\n", place_text(l.foot, ", "),
                        place_text(l.top, ", "));
  text += fmt::format("    surfaces: [{}]\n", fmt::join(l.surfaces, ", "));
  if (l.covariance)
    text += fmt::format("    sigma: [{}]\n    covariance: [{}]\n", sigma_text(*l.covariance, ", "),
                        covariance_text(*l.covariance, ", "));
  return text;
}

std::string csv_of(const Landmark& l) {
  const std::string known =
      l.covariance ? sigma_text(*l.covariance, ",") + "," + covariance_text(*l.covariance, ",")
                   : std::string(8, ',');
  return fmt::format("{},{},{},{},{},{},{}\n", l.id, name_of(l.kind), name_of(l.relief),
                     place_text(l.foot, ","), place_text(l.top, ","), fmt::join(l.surfaces, " "),
                     known);
}

}  // namespace

void write_landmarks_yaml(const std::filesystem::path& path, const World& world,
                          const ExportOptions&) {
  std::string text = fmt::format("# scanworld: landmarks; metres\nup: [{}]\nlandmarks:",
                                 place_text(world.frame.up, ", "));
  const std::vector<Landmark> landmarks = find_landmarks(world);
  text += landmarks.empty() ? " []\n" : "\n";
  for (const Landmark& l : landmarks) text += yaml_of(l);
  write_text(path, text);
}

void write_landmarks_csv(const std::filesystem::path& path, const World& world,
                         const ExportOptions&) {
  std::string text =
      "id,kind,relief,x,y,z,top_x,top_y,top_z,surfaces,sigma_x,sigma_y,sigma_z,xx,xy,xz,yy,yz,zz\n";
  for (const Landmark& l : find_landmarks(world)) text += csv_of(l);
  write_text(path, text);
}

}  // namespace scanworld
