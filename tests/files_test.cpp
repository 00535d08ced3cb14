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

TEST_CASE("a file takes the place of a plain file only, and of none that is read") {
  const TempFolder folder;
  const fs::path input = write_file(folder / "in.txt", "precious"), link = folder / "link";
  fs::create_symlink("in.txt", link);
  fs::create_directory(folder / "folder");
  const auto refused = [](const fs::path& out, const std::vector<fs::path>& inputs = {}) {
    return error_of(Cause::usage, [&] { check_output(out, inputs); });
  };
  CHECK(contains(refused(input, {folder / "absent", input}), "is the input"));
  CHECK(contains(refused(input, {link}), "is the input"));
  CHECK(contains(refused(link), "is a symlink to in.txt"));
  CHECK(contains(refused(folder / "folder"), "is a folder"));
  CHECK(contains(refused("/dev/null"), "no plain file"));
  error_of(Cause::usage, [&] { write_text(link, "gone"); });
  fs::create_symlink("nowhere", folder / "dangling");
  error_of(Cause::usage, [&] { write_text(folder / "dangling", "gone"); });
  CHECK(read_file(input) == "precious");
  CHECK_FALSE(fs::exists(folder / "nowhere"));
  check_output(input, {folder / "other"});
  check_output(folder / "new", {input});
}

TEST_CASE("a file that the user did not name is replaced only where it bears our mark") {
  const TempFolder folder;
  check_replaces_own(folder / "absent", "# scanworld");
  check_replaces_own(write_file(folder / "ours", "# scanworld\n"), "# scanworld");
  CHECK(contains(
      error_of(Cause::usage,
               [&] { check_replaces_own(write_file(folder / "mine", "# by me"), "# scanworld"); }),
      "mine"));
}

TEST_CASE("a path is within a folder whatever symlinks name it") {
  const TempFolder folder;
  fs::create_directories(folder / "a/b");
  write_file(folder / "a/b/file", "");
  write_file(folder / "file", "");
  fs::create_symlink("a/b", folder / "link");
  CHECK(is_within(folder / "a", folder / "link/file"));
  CHECK(is_within(folder / "link", folder / "a/b/../b"));
  CHECK_FALSE(is_within(folder / "a", folder / "file"));
  CHECK_FALSE(is_within(folder / "a", folder / "a/absent"));
  CHECK(place_of(folder / "link/") == place_of(folder / "link/."));
  CHECK(place_of(folder / "link/../x") == place_of(folder / "a/x"));
}

TEST_CASE("the extension is lower case, and that before .gz") {
  CHECK(lower_extension("a/B.PLY") == ".ply");
  CHECK(lower_extension("scan.xyz.gz") == ".xyz");
  CHECK(lower_extension("scan.gz") == ".gz");
  CHECK(lower_extension("scan") == "");
}
