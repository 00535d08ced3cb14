// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "trace_loops.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace scanworld::surface {

namespace {

class LoopTracer {
 public:
  LoopTracer(const std::vector<HalfEdge>& edges, const std::function<Vec2(int)>& at)
      : edges_(edges), at_(at), used_(edges.size()) {
    cancel();
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (!used_[i]) leaving_[edges_[i].from].push_back(i);
  }

  std::vector<std::vector<std::size_t>> trace() {
    std::vector<std::vector<std::size_t>> loops;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (!used_[i]) walk(i, loops);
    return loops;
  }

 private:
  void cancel() {
    std::map<std::pair<int, int>, std::vector<std::size_t>> there;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const auto back = there.find({edges_[i].to, edges_[i].from});
      if (back != there.end() && !back->second.empty()) {
        used_[i] = used_[back->second.back()] = 1;
        back->second.pop_back();
      } else {
        there[{edges_[i].from, edges_[i].to}].push_back(i);
      }
    }
  }

  // Walks until it is back; what was walked around a vertex that it comes to again is a loop.
  void walk(std::size_t start, std::vector<std::vector<std::size_t>>& loops) {
    std::vector<std::size_t> open;
    std::map<int, std::size_t> place;  // in `open`, of the edge that leaves a vertex
    for (std::size_t i = start;; i = next(i)) {
      used_[i] = 1;
      place[edges_[i].from] = open.size();
      open.push_back(i);
      if (const auto again = place.find(edges_[i].to); again != place.end()) {
        const std::size_t first = again->second;
        loops.emplace_back(open.begin() + static_cast<std::ptrdiff_t>(first), open.end());
        for (std::size_t k = first; k < open.size(); ++k) place.erase(edges_[open[k]].from);
        open.resize(first);
        if (open.empty()) return;
      }
    }
  }

  // What is outside stays together: the first way counter-clockwise from where it came.
  std::size_t next(std::size_t i) const {
    const Vec2 back = at_(edges_[i].from) - at_(edges_[i].to);
    std::size_t best = i;
    double least = 100;
    for (std::size_t k : leaving_.at(edges_[i].to)) {
      if (used_[k]) continue;
      const Vec2 way = at_(edges_[k].to) - at_(edges_[k].from);
      double angle = std::atan2(back.x() * way.y() - back.y() * way.x(), back.dot(way));
      if (angle <= 1e-9) angle += 6.283185307179586;
      if (angle < least) least = angle, best = k;
    }
    return best;
  }

  const std::vector<HalfEdge>& edges_;
  const std::function<Vec2(int)>& at_;
  std::vector<char> used_;
  std::map<int, std::vector<std::size_t>> leaving_;  // by vertex
};

}  // namespace

std::vector<std::vector<std::size_t>> trace_loops(const std::vector<HalfEdge>& edges,
                                                  const std::function<Vec2(int)>& at) {
  return LoopTracer(edges, at).trace();
}

}  // namespace scanworld::surface
