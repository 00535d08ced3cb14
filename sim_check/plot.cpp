// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A comparison as a picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "text.h"
#include "report.h"

namespace scanworld::sim {

namespace {

constexpr double kWidth = 860, kLeft = 210, kRight = 110, kBar = 15, kGap = 34;
constexpr const char* kColors[] = {"#8c6d31", "#1f77b4", "#2ca02c", "#d62728",
                                   "#9467bd", "#17becf", "#7f7f7f", "#c7c7c7"};

struct Group {
  std::string title;
  std::vector<const Timing*> bars;  // one a row
};

std::vector<Group> groups_of(const Comparison& c) {
  std::vector<Group> groups;
  const auto add = [&](const std::string& title, auto timing_of) {
    Group group{title, {}};
    for (const Row& row : c.rows) group.bars.push_back(timing_of(row.speed));
    groups.push_back(group);
  };
  const auto& steps = c.rows[0].speed.steps;
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (steps[k].robots == steps.back().robots)
      add(fmt::format("step, {} {}s", steps[k].robots, name_of(steps[k].kind)),
          [k](const Speed& s) { return &s.steps[k].time; });
  add("collision detection", [](const Speed& s) { return &s.collide; });
  if (c.rows[0].speed.contact) {
    add("contact test", [](const Speed& s) { return &*s.contact; });
    add("sweep over 1 m", [](const Speed& s) { return &*s.sweep; });
  }
  add("lidar, 16 x 360 rays", [](const Speed& s) { return &s.lidar; });
  return groups;
}

// The end of a name that is too long for its place.
std::string shortened(const std::string& name) {
  constexpr std::size_t kMost = 32;
  if (name.size() <= kMost) return name;
  std::size_t from = name.size() - kMost + 3;
  while (from < name.size() && (name[from] & 0xC0) == 0x80) ++from;  // not amid a character
  return "..." + name.substr(from);
}

std::string time_text(double seconds) {
  return seconds >= 1e-3 ? fmt::format("{:.3g} ms", 1e3 * seconds)
                         : fmt::format("{:.3g} µs", 1e6 * seconds);
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     markup_text(text));
}

}  // namespace

std::string svg_of(const Comparison& c) {
  const std::vector<Group> groups = c.options.with_speed ? groups_of(c) : std::vector<Group>{};
  double low = 1, high = 1e-9;
  for (const Group& group : groups)
    for (const Timing* bar : group.bars) {
      low = std::min(low, bar->cpu.median), high = std::max(high, bar->cpu.median);
    }
  const double first = std::floor(std::log10(std::max(low, 1e-9)) - 0.3),
               last = std::ceil(std::log10(high));
  const auto x_of = [&](double seconds) {
    return kLeft + (kWidth - kLeft - kRight) *
                       std::clamp((std::log10(seconds) - first) / (last - first), 0.0, 1.0);
  };
  const double rows = static_cast<double>(c.rows.size());
  const double height = 60 + static_cast<double>(groups.size()) * (rows * kBar + kGap);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"11\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      kWidth, height);
  for (double power = first; power <= last; ++power) {
    const double x = x_of(std::pow(10, power));
    svg += fmt::format("<path d=\"M{0:.1f} 30V{1:.1f}\" stroke=\"#ddd\"/>\n", x, height - 20);
    svg += text_at(x, 22, "middle", time_text(std::pow(10, power)));
  }
  double y = 40;
  for (const Group& group : groups) {
    svg += "<g font-weight=\"bold\">" + text_at(10, y + 12, "start", group.title) + "</g>\n";
    y += 18;
    for (std::size_t i = 0; i < group.bars.size(); ++i, y += kBar) {
      const Timing& bar = *group.bars[i];
      const double end = x_of(bar.cpu.median);
      svg += text_at(kLeft - 6, y + 11, "end", shortened(c.rows[i].name));
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" fill=\"{}\"/>\n", kLeft,
          y + 1, end - kLeft, kBar - 3, kColors[std::min<std::size_t>(i, std::size(kColors) - 1)]);
      svg +=
          text_at(end + 5, y + 11, "start",
                  time_text(bar.cpu.median) + (i > 0 ? fmt::format(", {:.3g} x", bar.ratio) : ""));
    }
    y += kGap - 18;
  }
  return svg + "</svg>\n";
}

}  // namespace scanworld::sim
