// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "drawn_plan.h"
#include "exporters/xml.h"

namespace scanworld {

namespace {

constexpr double kPaper = 380;  // [mm] the longer side of the drawing, at most
constexpr double kMargin = 14;  // [mm] around all that is drawn

constexpr const char* kStyle =
    "text{font-family:sans-serif;fill:#222}"
    ".floor{fill:#f4f1ea;fill-rule:evenodd}.solid{fill:#9aa0a6}.thing{fill:#e3ddd3;stroke:#8d8478}"
    ".wall{stroke:#1c1f24}.door{stroke:#c8641e}.window{stroke:#2a78c8}.passage{stroke:#2a8f5c}"
    ".dimension{stroke:#7a4a9c}.dimension-text{fill:#7a4a9c}.small{fill:#555}";

Eigen::AlignedBox2d box_of(const DrawnPlan& plan) {
  Eigen::AlignedBox2d box;
  for (const auto& floor : plan.floors)
    for (const auto& ring : floor)
      for (const Vec2& p : ring) box.extend(p);
  for (const auto& ring : plan.things)
    for (const Vec2& p : ring) box.extend(p);
  for (const DrawnPlan::Line& line : plan.walls) box.extend(line.a), box.extend(line.b);
  for (const DrawnPlan::Dimension& d : plan.overall) box.extend(d.a), box.extend(d.b);
  if (box.isEmpty()) box.extend(Vec2(0, 0)), box.extend(Vec2(1, 1));
  return box;
}

// The scale, one to this, at which a length [m] fits on the paper.
double scale_for(double length) {
  for (double decade = 10;; decade *= 10)
    for (double step : {1.0, 2.0, 5.0})
      if (1000 * length / (step * decade) <= kPaper - 2 * kMargin) return step * decade;
}

class Sheet {
 public:
  Sheet(const DrawnPlan& plan, const std::string& title) : plan_(plan), title_(title) {
    const Eigen::AlignedBox2d box = box_of(plan);
    scale_ = scale_for(std::max(box.sizes().maxCoeff(), 0.1));
    mm_ = scale_ / 10;
    corner_ = Vec2(box.min().x() - 0.01 * kMargin * mm_, box.max().y() + 0.01 * kMargin * mm_);
    size_ = 100 * box.sizes() + Vec2::Constant(2 * kMargin * mm_) + Vec2(0, 10 * mm_);
  }

  std::string text() {
    root_ = {"svg",
             {{"xmlns", "http://www.w3.org/2000/svg"},
              {"width", fmt::format("{:.2f}mm", size_.x() / mm_)},
              {"height", fmt::format("{:.2f}mm", size_.y() / mm_)},
              {"viewBox", fmt::format("0 0 {:.2f} {:.2f}", size_.x(), size_.y())}}};
    root_.add(text_element("title", title_));
    root_.add(text_element("style", kStyle));
    root_.add({"rect", {{"width", "100%"}, {"height", "100%"}, {"fill", "#fff"}}});
    for (const auto& floor : plan_.floors) path("floor", floor);
    for (const auto& ring : plan_.solids) path("solid", {ring});
    for (const auto& ring : plan_.things) path("thing", {ring}, 0.15);
    for (const DrawnPlan::Line& wall : plan_.walls) line("wall", wall.a, wall.b, 0.35);
    for (const DrawnPlan::Opening& opening : plan_.openings) add(opening);
    for (const DrawnPlan::Dimension& d : plan_.widths) add(d);
    for (const DrawnPlan::Dimension& d : plan_.overall) add(d);
    for (const DrawnPlan::Room& room : plan_.rooms) add(room);
    add_head();
    return xml_document(root_);
  }

 private:
  // On the sheet: centimetres, y down.
  Vec2 on_sheet(const Vec2& p) const {
    return 100 * Vec2(p.x() - corner_.x(), corner_.y() - p.y());
  }
  std::string length(double mm) const { return fmt::format("{:.2f}", mm * mm_); }

  void path(const char* kind, const std::vector<std::vector<Vec2>>& rings, double stroke = 0) {
    std::string d;
    for (const auto& ring : rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 p = on_sheet(ring[i]);
        d += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", p.x(), p.y());
      }
      d += "Z";
    }
    XmlElement& element = root_.add({"path", {{"class", kind}, {"d", d}}});
    if (stroke > 0) element.attributes.emplace_back("stroke-width", length(stroke));
  }

  XmlElement& line(const char* kind, const Vec2& a, const Vec2& b, double stroke) {
    const Vec2 p = on_sheet(a), q = on_sheet(b);
    return root_.add({"line",
                      {{"class", kind},
                       {"x1", fmt::format("{:.2f}", p.x())},
                       {"y1", fmt::format("{:.2f}", p.y())},
                       {"x2", fmt::format("{:.2f}", q.x())},
                       {"y2", fmt::format("{:.2f}", q.y())},
                       {"stroke-width", length(stroke)}}});
  }

  // Text in the middle of a place, along a way.
  void write(const char* kind, const std::string& what, const Vec2& at, double mm,
             const Vec2& way = Vec2::UnitX()) {
    const Vec2 p = on_sheet(at);
    XmlElement& element = root_.add(text_element("text", what));
    element.attributes = {{"class", kind},
                          {"x", fmt::format("{:.2f}", p.x())},
                          {"y", fmt::format("{:.2f}", p.y())},
                          {"font-size", length(mm)},
                          {"text-anchor", "middle"}};
    const double degrees = -std::atan2(way.y(), way.x()) * 180 / M_PI;
    if (std::abs(degrees) > 1e-6)
      element.attributes.emplace_back(
          "transform", fmt::format("rotate({:.4f} {:.2f} {:.2f})", degrees, p.x(), p.y()));
  }

  // The way from one place to another that text reads along, from the left or from below.
  static Vec2 reading(const Vec2& a, const Vec2& b) {
    const Vec2 way = (b - a).normalized();
    constexpr double kLevel = 0.05;  // what is steeper is read from below
    return way.x() < -kLevel || (way.x() <= kLevel && way.y() < 0) ? Vec2(-way) : way;
  }

  // Beside the middle of a line, by a distance on paper.
  Vec2 beside(const Vec2& a, const Vec2& b, double share, double mm) const {
    const Vec2 way = reading(a, b);
    return a + share * (b - a) + 0.01 * mm * mm_ * Vec2(-way.y(), way.x());
  }

  void add(const DrawnPlan::Opening& o) {
    const char* kind = name_of(o.kind);
    XmlElement& mark = line(kind, o.a, o.b, o.kind == OpeningKind::window ? 0.9 : 0.5);
    if (o.kind != OpeningKind::window)
      mark.attributes.emplace_back("stroke-dasharray", length(1) + " " + length(0.7));
    write("small", fmt::format("{:.3f}", o.width), beside(o.a, o.b, 0.5, 1), 1.9,
          reading(o.a, o.b));
  }

  void add(const DrawnPlan::Dimension& d) {
    line("dimension", d.a, d.b, 0.13);
    const Vec2 way = (d.b - d.a).normalized();
    const Vec2 tick = 0.008 * mm_ * (way + Vec2(-way.y(), way.x()));
    for (const Vec2& end : {d.a, d.b}) line("dimension", end - tick, end + tick, 0.25);
    write("dimension-text", fmt::format("{:.3f}", d.length()), beside(d.a, d.b, 0.25, 0.7), 2.3,
          reading(d.a, d.b));
  }

  void add(const DrawnPlan::Room& room) {
    write("name", room.name, room.at, 3.2);
    if (room.area)
      write("small", fmt::format("{:.2f} m²", *room.area), room.at - Vec2(0, 0.035 * mm_), 2.4);
  }

  void add_head() {
    XmlElement& head = root_.add(
        text_element("text", fmt::format("{}: cut {:.2f} m over the floor, 1:{:.0f}, lengths in m",
                                         title_, plan_.cut - plan_.level, scale_)));
    head.attributes = {{"class", "small"},
                       {"x", length(kMargin)},
                       {"y", fmt::format("{:.2f}", size_.y() - 5 * mm_)},
                       {"font-size", length(3)}};
  }

  const DrawnPlan& plan_;
  const std::string& title_;
  double scale_ = 50, mm_ = 5;  // one to so much; [cm] of the place for a millimetre of paper
  Vec2 corner_, size_;          // [m] the place of the upper left; [cm]
  XmlElement root_;
};

}  // namespace

std::string svg_of(const DrawnPlan& plan, const std::string& title) {
  return Sheet(plan, title).text();
}

}  // namespace scanworld
