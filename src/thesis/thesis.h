// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The method of 2012: V. Petrik, Spatial Models in Mobile Robotics, bachelor thesis, CTU in Prague.
// Its stages are the headers of this folder; their options, most of which the thesis does not give,
// are here together.
#pragma once

#include "../options.h"
#include "filter.h"
#include "placing.h"
#include "snapping.h"
#include "spreading.h"

namespace scanworld::thesis {

struct ThesisOptions {
  FilterOptions filter;
  PlacingOptions placing;
  SpreadingOptions spreading;
  SnappingOptions snapping;
  ReductionOptions reduction;
};

// All of them by name, "thesis.filter.min_size" and so on.
OptionList list_options(ThesisOptions& options);

}  // namespace scanworld::thesis
