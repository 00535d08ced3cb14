// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "find_surfaces.h"

#include <fmt/format.h>

#include <algorithm>

#include "find_inferred.h"
#include "parallel.h"
#include "surface/describe.h"
#include "world/find_frame.h"

namespace scanworld {

using namespace surface;

namespace {

// What planes say about up, by the number of their points.
std::vector<Facing> facings_of(const PointCloud& cloud, const std::vector<Plane>& planes,
                               const Members& members) {
  std::vector<Facing> facings;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double points = static_cast<double>(members.of(k).size());
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t i : members.of(k)) sum += cloud.points[i].cast<double>();
    facings.push_back({planes[k].normal, points, sum / std::max(1.0, points)});
  }
  return facings;
}

// Gives the points of each plane to its first piece, and what is known of the plane to all of them.
void relabel(const std::vector<Piece>& pieces, std::size_t planes, ReconstructResult& result) {
  std::vector<std::int32_t> first(planes, -1);
  std::vector<double> noise;
  for (std::size_t k = pieces.size(); k-- > 0;)
    if (const auto plane = static_cast<std::size_t>(pieces[k].patch); plane < planes)
      first[plane] = static_cast<std::int32_t>(k);
  for (const Piece& piece : pieces) {
    const auto plane = static_cast<std::size_t>(piece.patch);
    noise.push_back(plane < planes ? result.report.plane_noise[plane] : 0);
  }
  result.report.plane_noise = std::move(noise);
  result.labels = labels_by(first, std::move(result.labels));
}

// Pieces, and first the planes of the patches, then those of the pieces.
struct PiecesInPlanes {
  std::vector<Piece> pieces;
  std::vector<Plane> planes;
  std::vector<std::vector<int>> patches;  // of each piece, that are in its plane and look its way
  std::vector<double> depths;             // [m] of what is behind each
};

// [m2] of a piece where a plane has points.
double area_on(const space::Cover& cover, const Piece& piece) {
  const Raster& raster = cover.supported;
  return static_cast<double>(count_cells(raster, cover.frame, piece).set) * raster.cell *
         raster.cell;
}

// Whether some of the patches have points at a place or just beside it.
bool is_measured(const Vec3& place, const std::vector<int>& patches,
                 const std::vector<space::Cover>& covers) {
  constexpr float kBeside = 0.1F;  // [m]
  return std::any_of(patches.begin(), patches.end(), [&](int patch) {
    const space::Cover& cover = covers[static_cast<std::size_t>(patch)];
    const auto at = cover.supported.find(cover.frame.to_plane(place));
    return at && cover.distance[*at] <= kBeside;
  });
}

// Each surface between free and solid as a piece of the plane that it has points of; of none it is
// inferred. Those with most points first.
PiecesInPlanes pieces_of(const space::LabelledSpace& space, std::vector<space::Interface> shown,
                         const std::vector<space::Label>& behind, const std::vector<Plane>& planes,
                         const std::vector<space::Cover>& covers) {
  std::stable_sort(shown.begin(), shown.end(),
                   [](const space::Interface& a, const space::Interface& b) {
                     return a.supported > b.supported;
                   });
  constexpr double kMinSupport = 0.02;   // of the area of what counts as measured
  constexpr double kLeastDepth = 0.001;  // [m] of what is behind a surface
  PiecesInPlanes result{{}, planes, {}, std::vector<double>(shown.size())};
  parallel_for(shown.size(), [&](std::size_t k) {
    result.depths[k] =
        std::max(kLeastDepth, space::depth_behind(space.arrangement.cells, behind, shown[k]));
  });
  for (space::Interface& i : shown) {
    Piece piece{static_cast<int>(result.planes.size()), std::move(i.loops)};
    const Plane& plane = space.arrangement.cells.plane(i.plane);
    result.planes.push_back(i.is_flipped ? plane.flipped() : plane);
    std::vector<int> patches;
    double most = 0;
    if (i.supported > kMinSupport * i.area)
      for (const auto& part : space.arrangement.parts[static_cast<std::size_t>(i.plane)]) {
        const space::SpacePlane& p = space.planes[static_cast<std::size_t>(part.plane)];
        if (p.kind != space::SpacePlane::Kind::surface || part.is_flipped != i.is_flipped) continue;
        patches.push_back(p.patch);
        const double points = area_on(covers[static_cast<std::size_t>(p.patch)], piece);
        if (points > most) most = points, piece.patch = p.patch;
      }
    result.pieces.push_back(std::move(piece));
    result.patches.push_back(std::move(patches));
  }
  return result;
}

class SurfaceFinder {
 public:
  SurfaceFinder(const PlanesInScan& in, const ReconstructOptions& options, StageLog& log,
                ReconstructResult& result, Recorder& recorder)
      : in_(in),
        options_(options.surface),
        space_options_(options.space),
        log_(log),
        result_(result),
        recorder_(recorder) {}

  SurfacesInScan find() {
    cover();
    const std::vector<Seam> seams = log_.run("Finding seams", "patches -> seams", patches_,
                                             [&] { return find_seams(patches_, options_.seams); });
    const std::vector<std::vector<CutLine>> lines = lines_of(patches_, seams, options_.seams);
    around_ = in_.find_around();
    around_.viewpoints = viewpoints_;
    around_.viewers = labels_by(number_, std::move(around_.viewers));
    std::optional<space::Outlook> outlook;
    if (space_options_.is_on)
      outlook = log_.run("Looking around", "patches -> rays", patches_, [&] {
        return space::look_out(patches_, *rays_, seams, around_, in_.voxel, result_.report.noise,
                               space_options_, up_);
      });
    patches_ = log_.run("Weighing gaps", "patches -> patches", patches_, [&] {
      around_.viewers = find_sole_viewers(around_, *rays_, viewpoints_, options_.gaps.through);
      rays_.reset();
      return weigh_gaps(std::move(patches_), lines, around_, up_, options_.gaps);
    });
    const std::vector<SharedEdge> edges =
        log_.run("Finding free edges", "patches -> edges", patches_, [&] {
          std::vector<SharedEdge> shared = share_edges(
              find_free_edges(in_.cloud, members_, patches_, lines, options_.free_edges), patches_,
              seams, options_.shared_edges);
          return move_to_reveals(std::move(shared), patches_, around_, options_.shared_edges);
        });
    std::vector<FoundSurface> surfaces =
        outlook ? label_space(seams, edges, *outlook) : outline(lines, edges);
    return {std::move(surfaces), std::move(around_)};
  }

 private:
  void cover() {
    patches_ = log_.run("Covering planes", "points -> patches", in_.cloud, [&] {
      members_ = group_points(result_.labels, in_.planes.size());
      up_ = find_frame(in_.cloud, facings_of(in_.cloud, in_.planes, members_)).up;
      std::vector<Patch> found =
          find_patches(in_.cloud, members_, in_.planes, in_.voxel, options_.patch);
      rays_.emplace(found);
      Faced faced =
          face_free_side(std::move(found), *rays_, in_.cloud, members_, up_, options_.facing);
      viewpoints_ = std::move(faced.viewpoints), number_ = std::move(faced.number);
      return std::move(faced.patches);
    });
    const std::size_t all = in_.cloud.viewpoints.size(), blind = all - viewpoints_.size();
    if (blind > 0)
      result_.report.warnings.push_back(fmt::format(
          "{} of {} scanner positions are left out: no lines of sight go from there to the "
          "points, but through the backs of surfaces",
          blind, all));
  }

  // Plane by plane.
  std::vector<FoundSurface> outline(const std::vector<std::vector<CutLine>>& lines,
                                    const std::vector<SharedEdge>& edges) {
    const Pieces pieces = log_.run("Outlining", "patches -> polygons", patches_, [&] {
      return add_reveals(outline_patches(patches_, lines, edges, options_), options_.reveals);
    });
    recorder_.add("Arrangement", "lines cut each plane into cells; those with evidence are kept",
                  loops_of(pieces.polygons));
    return log_.run("Welding", "polygons -> surfaces", pieces, [&] {
      const std::vector<Piece> welded = weld(pieces.polygons, pieces.planes, options_.weld);
      recorder_.add("Arrangement", "corners that are nearly one become one", loops_of(welded));
      return describe_all(welded, pieces.planes);
    });
  }

  // As what is between free and solid.
  std::vector<FoundSurface> label_space(const std::vector<Seam>& seams,
                                        const std::vector<SharedEdge>& edges,
                                        const space::Outlook& outlook) {
    const space::SpaceInput input{patches_, outlook.covers,      seams, edges,
                                  up_,      result_.report.noise};
    const space::LabelledSpace space =
        log_.run("Labelling space", "planes -> cells", patches_,
                 [&] { return space::label_space(input, outlook, viewpoints_, space_options_); });
    record_space(space);
    space::InterfaceOptions interfaces = space_options_.interfaces;
    interfaces.is_closed = space_options_.unknown == space::Unknown::solid;
    return log_.run("Finding interfaces", "cells -> surfaces", space, [&] {
      const PiecesInPlanes found = pieces_of(
          space,
          space::find_interfaces(space.arrangement.cells, space.evidence,
                                 space::labels_of_surfaces(space.labels, space_options_.unknown),
                                 interfaces),
          space::labels_behind(space.labels, space_options_.unknown), in_.planes, outlook.covers);
      recorder_.add("Labelling space", "what lies in one plane between free and solid is a surface",
                    loops_of(found.pieces));
      std::vector<FoundSurface> surfaces = describe_all(found.pieces, found.planes);
      parallel_for(surfaces.size(), [&](std::size_t k) {
        FoundSurface& surface = surfaces[k];
        surface.plane = found.planes[in_.planes.size() + k];
        surface.thickness = found.depths[k];
        if (surface.source != Source::measured) return;
        const auto patch = static_cast<std::size_t>(found.pieces[k].patch);
        surface.inferred = find_inferred(
            surface,
            [&](const Vec3& place) { return is_measured(place, found.patches[k], outlook.covers); },
            {.cell = std::max(InferredOptions{}.cell, outlook.covers[patch].supported.cell)});
      });
      return surfaces;
    });
  }

  void record_space(const space::LabelledSpace& space) {
    if (!recorder_.is_on()) return;
    const auto count = [&](space::Label label) {
      return std::count(space.labels.begin(), space.labels.end(), label);
    };
    recorder_.add("Labelling space",
                  fmt::format("planes cut space into {} cells", space.labels.size()),
                  cells_of(space));
    recorder_.add("Labelling space",
                  fmt::format("a cut tells what each is: {} are free, {} solid, {} unknown",
                              count(space::Label::free), count(space::Label::solid),
                              count(space::Label::unknown)),
                  free_sides_of(space));
  }

  std::vector<FoundSurface> describe_all(const std::vector<Piece>& pieces,
                                         const std::vector<Plane>& planes) {
    relabel(pieces, in_.planes.size(), result_);
    std::vector<FoundSurface> found = describe(in_.cloud, members_, patches_, planes, pieces);
    for (std::size_t k = 0; k < found.size(); ++k)
      if (const auto plane = static_cast<std::size_t>(pieces[k].patch);
          plane < in_.planes.size() && in_.round.curve_of_plane[plane] >= 0)
        found[k].curve = in_.round.curve_of_plane[plane];
    return found;
  }

  const PlanesInScan& in_;
  const SurfaceOptions& options_;
  const space::SpaceOptions& space_options_;
  StageLog& log_;
  ReconstructResult& result_;
  Recorder& recorder_;
  Members members_;
  std::vector<Patch> patches_;
  std::optional<PatchRays> rays_;
  Vec3 up_ = Vec3::UnitZ();
  std::vector<Vec3> viewpoints_;      // those of the cloud that saw something
  std::vector<std::int32_t> number_;  // of each of the cloud's, among those
  Surroundings around_;
};

}  // namespace

SurfacesInScan find_surfaces(const PlanesInScan& in, const ReconstructOptions& options,
                             StageLog& log, ReconstructResult& result, Recorder& recorder) {
  return SurfaceFinder(in, options, log, result, recorder).find();
}

}  // namespace scanworld
