// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz.h"
#include "scan/assemble_cloud.h"
#include "scan/ply.h"

void fuzz(const std::string& bytes) {
  const scanworld::fuzzing::MemoryFile file(bytes);
  scanworld::assemble_cloud({scanworld::open_ply(file.path())});
}
