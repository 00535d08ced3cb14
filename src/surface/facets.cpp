// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "facets.h"

#include <algorithm>
#include <cmath>

namespace scanworld::surface {

namespace {

// How many chords an arc is cut into.
int chords(double radius, double angle, const FacetOptions& options, double sagitta) {
  const double most = 2 * std::acos(std::clamp(1 - sagitta / radius, -1.0, 1.0));
  const double wanted = std::ceil(angle / most), limit = std::floor(angle / options.min_turn);
  return std::max(1, static_cast<int>(std::min(wanted, limit)));
}

double latitude_of(const Curve& curve, const Vec3& p) {
  const double up = curve.height_of(p), out = (p - curve.shape.point).norm();
  return std::asin(std::clamp(up / std::max(out, 1e-9), -1.0, 1.0));
}

int piece_at(double share, int parts) {
  return std::clamp(static_cast<int>(std::floor(share * parts)), 0, parts - 1);
}

}  // namespace

Facets::Facets(const Curve& curve, const FacetOptions& options) : curve_(curve) {
  const RoundShape& shape = curve.shape;
  const Vec3 left = shape.axis.cross(curve.start);
  const bool is_sphere = shape.type == CurveType::sphere;
  // A facet of a sphere bends both ways.
  const double sagitta = is_sphere ? options.sagitta / 2 : options.sagitta;
  if (is_sphere) {
    low_ = std::asin(std::clamp(curve.low / shape.radius, -1.0, 1.0));
    high_ = std::asin(std::clamp(curve.high / shape.radius, -1.0, 1.0));
  }
  if (shape.type == CurveType::cone) {
    cut_cone(options);
    return;
  }
  bands_.resize(static_cast<std::size_t>(chords(shape.radius, high_ - low_, options, sagitta)));
  const double tall = (high_ - low_) / static_cast<double>(bands_.size());
  for (std::size_t k = 0; k < bands_.size(); ++k) {
    const double rise = low_ + (static_cast<double>(k) + 0.5) * tall;
    const double sweep = curve.sweep * (is_sphere ? std::cos(rise) : 1);  // along the surface
    bands_[k] = {planes_.size(), chords(shape.radius, sweep, options, sagitta)};
    const double half = sweep / bands_[k].facets / 2;
    // As far out as the curve is on the mean.
    const double mean = 1 - (half * half + tall * tall / 4) / 6;
    for (int j = 0; j < bands_[k].facets; ++j) {
      const double angle = (j + 0.5) * curve.sweep / bands_[k].facets;
      const Vec3 level = std::cos(angle) * curve.start + std::sin(angle) * left;
      const Vec3 out = std::cos(rise) * level + std::sin(rise) * shape.axis;
      planes_.push_back(plane_through(shape.point + mean * shape.radius * out, out));
    }
  }
}

// All go through the apex.
void Facets::cut_cone(const FacetOptions& options) {
  const RoundShape& shape = curve_.shape;
  const Vec3 left = shape.axis.cross(curve_.start);
  // Neighbours are turned less than the circle is.
  FacetOptions turned = options;
  turned.min_turn /= std::cos(shape.half_angle);
  const double radius = shape.radius_at(curve_.high);
  const int count = chords(radius, curve_.sweep, turned, options.sagitta);
  const double half = curve_.sweep / count / 2,
               slope = (1 - half * half / 6) * std::tan(shape.half_angle);
  bands_ = {{0, count}};
  for (int j = 0; j < count; ++j) {
    const double angle = (2 * j + 1) * half;
    const Vec3 level = std::cos(angle) * curve_.start + std::sin(angle) * left;
    planes_.push_back(plane_through(shape.point, (level - slope * shape.axis).normalized()));
  }
}

std::size_t Facets::of(const Vec3& p) const {
  double angle = curve_.angle_of(p);
  // What is a little before the beginning.
  if (angle > (curve_.sweep + 2 * M_PI) / 2) angle -= 2 * M_PI;
  const int count = static_cast<int>(bands_.size());
  const Band& band = bands_[static_cast<std::size_t>(
      count == 1 ? 0 : piece_at((latitude_of(curve_, p) - low_) / (high_ - low_), count))];
  return band.first + static_cast<std::size_t>(piece_at(angle / curve_.sweep, band.facets));
}

}  // namespace scanworld::surface
