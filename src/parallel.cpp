// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <exception>
#include <mutex>

namespace scanworld {

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  // Which exception TBB passes on depends on timing, so each is caught here and the first by index
  // kept.
  std::mutex mutex;
  std::exception_ptr error;
  std::size_t error_at = count;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    try {
      body(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (i < error_at) error_at = i, error = std::current_exception();
    }
  });
  if (error) std::rethrow_exception(error);
}

struct ThreadLimit::Impl {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    impl_.reset(new Impl{tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                             static_cast<std::size_t>(threads))});
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace scanworld
