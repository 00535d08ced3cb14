#!/bin/bash
# SPDX-FileCopyrightText: 2026 The scanworld authors
# SPDX-License-Identifier: Apache-2.0
#
# install_test.sh BUILD: installs the build into a folder of its own and builds and runs a program of a user
# against it, who has nothing but find_package(scanworld).
set -euo pipefail
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/usr" >/dev/null
mkdir "$work/user"
cat > "$work/user/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(user CXX)
find_package(scanworld 0.1 REQUIRED)
add_executable(user user.cpp)
target_link_libraries(user scanworld::exporters)
END
cat > "$work/user/user.cpp" <<'END'
#include <scanworld/exporters/export.h>
#include <scanworld/reconstruct.h>
#include <scanworld/reconstruction.h>
#include <scanworld/scan/read_scan.h>

#include <cstdio>

int main(int, char** argv) {
  const auto result = scanworld::reconstruct(scanworld::read_scan({argv[1]}));
  scanworld::export_world(result.world, argv[2]);
  std::printf("%zu surfaces\n", result.world.surfaces.size());
  return result.world.surfaces.size() > 10 ? 0 : 1;
}
END
cmake -S "$work/user" -B "$work/user/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/usr" >/dev/null
cmake --build "$work/user/build" >/dev/null
"$work/user/build/user" "$(dirname "$0")/../data/office.ply" "$work/world.glb"
"$work/usr/bin/scanworld" info "$work/world.glb" >/dev/null
echo 'find_package(scanworld) works'
