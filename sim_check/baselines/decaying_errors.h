// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace scanworld::sim {

// The accumulated errors of nodes, all of which shrink by the factor beta with every signal.
// Instead, the unit that new ones are counted in grows: sums, means and comparisons do not notice.
class DecayingErrors {
 public:
  explicit DecayingErrors(double beta) : beta_(beta) {}

  // In a unit that is the same for all nodes until the next decay.
  double& operator[](int node) {
    const auto i = static_cast<std::size_t>(node);
    if (i >= errors_.size()) errors_.resize(i + 1);
    return errors_[i];
  }
  double operator[](int node) const { return errors_[static_cast<std::size_t>(node)]; }

  void add(int node, double error) { (*this)[node] += error * unit_; }
  void decay() {
    unit_ /= beta_;
    if (unit_ < kLargestUnit) return;
    for (double& e : errors_) e /= unit_;
    unit_ = 1;
  }

 private:
  static constexpr double kLargestUnit = 1e100;

  double beta_, unit_ = 1;
  std::vector<double> errors_;
};

}  // namespace scanworld::sim
