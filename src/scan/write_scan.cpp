// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "write_scan.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "../error.h"
#include "../files.h"

namespace scanworld {

namespace {

// Binary records gathered into large writes.
class RecordWriter {
 public:
  explicit RecordWriter(OutputFile& file) : file_(file) {}

  template <typename T>
  void put(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
    if (bytes_.size() > kFlushAt) flush();
  }
  void flush() {
    file_.write(bytes_.data(), bytes_.size());
    bytes_.clear();
  }

 private:
  static constexpr std::size_t kFlushAt = 1 << 20;
  OutputFile& file_;
  std::vector<char> bytes_;
};

void write_ply(const std::filesystem::path& path, const PointCloud& cloud,
               const std::vector<ExtraColumn>& extra) {
  // Far from zero only double holds the coordinates; most programs read both.
  const bool wide = !cloud.origin.isZero();
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment scanworld, metres\nelement vertex {}\n",
      cloud.points.size());
  for (char axis : {'x', 'y', 'z'})
    header += fmt::format("property {} {}\n", wide ? "double" : "float", axis);
  if (!cloud.normals.empty()) header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!cloud.colors.empty())
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  for (const ExtraColumn& column : extra) header += fmt::format("property int {}\n", column.name);
  header += "end_header\n";

  OutputFile file(path);
  file.write(header);
  RecordWriter records(file);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (wide)
        records.put(static_cast<double>(cloud.points[i][k]) + cloud.origin[k]);
      else
        records.put(cloud.points[i][k]);
    }
    if (!cloud.normals.empty())
      for (float v : cloud.normals[i]) records.put(v);
    if (!cloud.colors.empty())
      for (std::uint8_t v : {cloud.colors[i].r, cloud.colors[i].g, cloud.colors[i].b})
        records.put(v);
    for (const ExtraColumn& column : extra) records.put(column.values[i]);
  }
  records.flush();
  file.commit();
}

void write_xyz(const std::filesystem::path& path, const PointCloud& cloud,
               const std::vector<ExtraColumn>& extra) {
  OutputFile file(path);
  std::string text = "# x y z";
  if (!cloud.colors.empty()) text += " red green blue";
  if (!cloud.normals.empty()) text += " nx ny nz";
  for (const ExtraColumn& column : extra) text += " " + column.name;
  text += "\n";
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3f& p = cloud.points[i];
    // The shortest text that reads back as the same number, of float where it was one.
    if (cloud.origin.isZero()) {
      fmt::format_to(out, "{} {} {}", p.x(), p.y(), p.z());
    } else {
      const Vec3 q = p.cast<double>() + cloud.origin;
      fmt::format_to(out, "{} {} {}", q.x(), q.y(), q.z());
    }
    if (!cloud.colors.empty())
      fmt::format_to(out, " {} {} {}", cloud.colors[i].r, cloud.colors[i].g, cloud.colors[i].b);
    if (!cloud.normals.empty())
      fmt::format_to(out, " {} {} {}", cloud.normals[i].x(), cloud.normals[i].y(),
                     cloud.normals[i].z());
    for (const ExtraColumn& column : extra) fmt::format_to(out, " {}", column.values[i]);
    text += '\n';
    if (text.size() > (1 << 20)) file.write(text), text.clear();
  }
  file.write(text);
  file.commit();
}

}  // namespace

void write_scan(const std::filesystem::path& path, const PointCloud& cloud,
                const std::vector<ExtraColumn>& more) {
  std::vector<ExtraColumn> extra = more;
  if (!cloud.viewers.empty()) extra.push_back({kScanIndex, cloud.viewers});
  const std::string extension = lower_extension(path);
  if (extension == ".ply") return write_ply(path, cloud, extra);
  if (extension == ".xyz" || extension == ".txt") return write_xyz(path, cloud, extra);
  throw Error(Cause::usage, fmt::format("{}: a scan is written as .ply, .xyz or .txt, not '{}'",
                                        path.string(), extension));
}

void write_labels(const std::filesystem::path& path, const PointCloud& cloud,
                  const std::vector<std::int32_t>& labels) {
  PointCloud all;
  all.origin = cloud.origin;
  all.points.reserve(cloud.input_size());
  ExtraColumn ids{"plane_id", {}};
  ids.values.reserve(cloud.input_size());
  std::size_t skip = 0;
  for (std::size_t row = 0, i = 0; row < cloud.input_size(); ++row) {
    const bool left_out = skip < cloud.skipped.size() && cloud.skipped[skip] == row;
    all.points.push_back(left_out ? Vec3f::Constant(std::numeric_limits<float>::quiet_NaN())
                                  : cloud.points[i]);
    ids.values.push_back(left_out ? -1 : labels[i]);
    left_out ? ++skip : ++i;
  }
  write_ply(path, all, {ids});
}

}  // namespace scanworld
