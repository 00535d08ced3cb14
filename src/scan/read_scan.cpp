// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "read_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "../error.h"
#include "../files.h"
#include "../mix.h"
#include "../parallel.h"
#include "assemble_cloud.h"
#include "camera_frame.h"
#include "pcd.h"
#include "ply.h"
#include "rows.h"
#include "text_rows.h"
#include "xyz.h"

namespace scanworld {

std::string scan_format(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".ply") return "ply";
  if (extension == ".pcd") return "pcd";
  for (const char* text : {".xyz", ".txt", ".csv", ".asc", ".pts"})
    if (extension == text) return "xyz";
  char start[5] = {};
  const std::size_t n = open_stream(path)->read(start, sizeof(start));
  const std::string_view bytes(start, n);
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return "ply";
  if (bytes == "# .PC") return "pcd";
  throw Error(Cause::bad_input,
              fmt::format("{}: not a scan format that is known (PLY, PCD, XYZ, TXT, CSV, ASC, PTS)",
                          path.string()));
}

RowSource open_scan(const std::filesystem::path& path) {
  if (InputFile(path).size() == 0)
    throw Error(Cause::bad_input, path.string() + ": the file is empty");
  const std::string format = scan_format(path);
  if (format == "ply") return open_ply(path);
  if (format == "pcd") return open_pcd(path);
  return open_xyz(path);
}

PointCloud read_scan(const std::vector<std::filesystem::path>& paths,
                     const std::vector<Vec3>& poses) {
  std::vector<RowSource> sources;
  for (const auto& path : paths) sources.push_back(open_scan(path));
  PointCloud cloud = assemble_cloud(sources, poses);
  cloud.camera_frame = sources.size() == 1 && sources[0].image_width > 0 &&
                       is_camera_image(cloud, sources[0].image_width);
  return cloud;
}

bool has_scan_index(const std::filesystem::path& path) { return open_scan(path).scan_index; }

std::vector<Vec3> read_poses(const std::filesystem::path& path) {
  LineReader lines(path);
  std::vector<Vec3> poses;
  for (std::string line; lines.next_line(line);) {
    if (is_comment(line)) continue;
    std::vector<double> v;
    for (std::string_view word : split_columns(line)) {
      const auto value = number_of(word);
      if (!value)
        throw Error(Cause::bad_input, fmt::format("{}:{}: '{}' is not a number", lines.name(),
                                                  lines.line_number(), word.substr(0, 40)));
      v.push_back(*value);
    }
    if (v.size() != 3 && v.size() != 8)
      throw Error(
          Cause::bad_input,
          fmt::format("{}:{}: a pose has 3 numbers (x y z) or 8 (t x y z qx qy qz qw), not {}",
                      lines.name(), lines.line_number(), v.size()));
    const std::size_t at = v.size() == 8 ? 1 : 0;
    poses.emplace_back(v[at], v[at + 1], v[at + 2]);
    if (!(poses.back().array().abs() < kFarthest).all())
      throw Error(
          Cause::bad_input,
          fmt::format("{}:{}: the pose {} {} {} is not within {:.0f} m of the origin", lines.name(),
                      lines.line_number(), v[at], v[at + 1], v[at + 2], kFarthest));
  }
  if (poses.empty()) throw Error(Cause::bad_input, lines.name() + ": holds no poses");
  return poses;
}

std::string fingerprint(const PointCloud& cloud) {
  struct Sum {
    std::uint64_t low = 0, high = 0;
  };
  std::vector<Sum> sums(part_count(cloud.points.size(), kPointsPerPart));
  parallel_for(sums.size(), [&](std::size_t i) {
    const Part part = part_of(i, cloud.points.size(), kPointsPerPart);
    for (std::size_t k = part.begin; k < part.end; ++k) {
      const Vec3 p = cloud.points[k].cast<double>() + cloud.origin + Vec3::Zero();  // makes -0 a 0
      std::uint64_t h = 0;
      for (double v : p) h = mix(h ^ std::bit_cast<std::uint64_t>(v)) + 0x9e3779b97f4a7c15;
      sums[i].low += mix(h);
      sums[i].high += mix(h + 1);
    }
  });
  Sum all;  // sums modulo 2^64, so the order of the points does not matter
  for (const Sum& s : sums) all.low += s.low, all.high += s.high;
  return fmt::format("{:016x}{:016x}", all.high, all.low);
}

}  // namespace scanworld
