// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "compare.h"

namespace scanworld::sim {

// A comparison as tables in Markdown, which a README or a paper takes; the promises of the worlds,
// and the verdict.
std::string markdown_of(const Comparison& comparison);

// A line per figure: place, figure, robots, unit, mean, deviation, median, 99 %, ratio and so on.
std::string csv_of(const Comparison& comparison);

// All of it. Times in seconds, lengths in metres, memory in bytes.
std::string json_of(const Comparison& comparison);

// Bars, on a logarithmic scale: how long each figure takes in each place.
std::string svg_of(const Comparison& comparison);

// "fit for use", or what does not keep its promises.
std::string verdict_of(const Comparison& comparison);

}  // namespace scanworld::sim
