// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "files.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace fs = std::filesystem;

namespace {

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a file appears whole or not at all") {
  const TempFolder folder;
  const fs::path path = write_file(folder / "out.txt", "old");
  {
    OutputFile file(path);
    file.write("new");
  }  // not committed
  CHECK(read_file(path) == "old");
  CHECK(files_in(folder.path()) == 1);
  OutputFile file(path);
  file.write("new");
  CHECK(read_file(path) == "old");
  file.commit();
  CHECK(read_file(path) == "new");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE(
    "a folder appears whole or not at all, and takes the place of an older one of its kind only") {
  const TempFolder folder;
  const fs::path path = folder / "world";
  {
    OutputFolder out(path, "world.json");
    write_file(out.path() / "world.json", "1");
  }
  CHECK(files_in(folder.path()) == 0);
  for (const char* text : {"1", "2"}) {
    OutputFolder out(path, "world.json");
    write_file(out.path() / "world.json", text);
    out.commit();
  }
  CHECK(read_file(path / "world.json") == "2");
  CHECK(files_in(folder.path()) == 1);
  fs::create_directory(folder / "holiday");
  write_file(folder / "holiday/photo.jpg", "precious");
  CHECK(contains(error_of(Cause::failure, [&] { OutputFolder(folder / "holiday", "world.json"); }),
                 "other files"));
  CHECK(contains(error_of(Cause::failure, [&] { OutputFolder(path / "world.json", "world.json"); }),
                 "file of this name"));
  fs::create_directory(folder / "empty");
  OutputFolder out(folder / "empty/", "world.json");
  out.commit();
  CHECK(fs::exists(folder / "empty"));
}

TEST_CASE("the extension is lower case, and that before .gz") {
  CHECK(lower_extension("a/B.PLY") == ".ply");
  CHECK(lower_extension("scan.xyz.gz") == ".xyz");
  CHECK(lower_extension("scan.gz") == ".gz");
  CHECK(lower_extension("scan") == "");
}
