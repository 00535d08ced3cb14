// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// How files are recognised that this program wrote where no list of them lies beside (see
// OutputFolder): by their names and by what is near their start.
#pragma once

#include <filesystem>

namespace scanworld {

// Whether `file`, a path from `folder`, has the name and content of one that a version without
// lists wrote.
bool is_known_file(const std::filesystem::path& folder, const std::filesystem::path& file);

// Whether those versions wrote folders of this name.
bool is_known_folder(const std::filesystem::path& folder);

// Whether it is one that other commands than the folder's own put there: the page of `view`,
// results of sim_check.
bool is_known_guest(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace scanworld
