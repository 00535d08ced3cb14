// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "output_folder.h"

#include <functional>

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace fs = std::filesystem;

namespace {

constexpr const char* kMark = "world.json";
const std::string kWorld = R"({"schema": {"name": "scanworld", "version": 1}})";

// Writes a folder with a world, a file in a folder of its own, and what else is asked for.
std::vector<std::string> write_folder(const fs::path& path, const std::string& world = kWorld) {
  OutputFolder out(path, kMark);
  write_file(out.path() / "world.json", world);
  fs::create_directory(out.path() / "meshes");
  write_file(out.path() / "meshes/floor.obj", "o floor");
  return out.commit();
}

std::string refused(const fs::path& path, const std::vector<fs::path>& inputs = {}) {
  return error_of(Cause::usage, [&] { OutputFolder(path, kMark, inputs); });
}

// All that is in a folder, with what the files hold.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    all[entry.path().lexically_relative(folder).string()] =
        entry.is_regular_file() ? read_file(entry.path()) : "";
  return all;
}

}  // namespace

TEST_CASE("a folder appears whole or not at all, and takes the place of an older one of its kind") {
  const TempFolder folder;
  const fs::path path = folder / "deep/world";
  {
    OutputFolder out(path, kMark);
    write_file(out.path() / "world.json", "1");
  }
  CHECK(contents(folder / "deep").empty());
  for (const char* text : {"1", "22"}) CHECK(write_folder(path, text).empty());
  CHECK(read_file(path / "world.json") == "22");
  CHECK(contents(folder / "deep").size() == 5);  // world, world.json, meshes, floor.obj, the list
  fs::create_directory(folder / "empty");
  write_folder(folder / "empty/");
  CHECK(fs::exists(folder / "empty/world.json"));
}

TEST_CASE("whatever this program did not write stops it, and is not touched") {
  const TempFolder folder;
  const fs::path path = folder / "world";
  const std::vector<std::pair<const char*, std::function<void()>>> intruders = {
      {"notes.txt was not written", [&] { write_file(path / "notes.txt", "mine"); }},
      {"meshes/mine.obj was not written", [&] { write_file(path / "meshes/mine.obj", "o x"); }},
      {"mine was not written", [&] { fs::create_directory(path / "mine"); }},
      {"world.json was changed", [&] { write_file(path / "world.json", kWorld + " "); }},
      {"floor.obj was changed", [&] { write_file(path / "meshes/floor.obj", "o flooR"); }},
      {"link is a symlink", [&] { fs::create_symlink("world.json", path / "link"); }},
      {"meshes is a symlink",
       [&] {
         fs::rename(path / "meshes", folder / "elsewhere");
         fs::create_symlink("../elsewhere", path / "meshes");
       }},
      {"1, 2, 3 and 2 more",
       [&] {
         for (const char* name : {"1", "2", "3", "4", "5"}) write_file(path / name, name);
       }},
      {"written by this command",  // but by another one
       [&] { write_file(path / kFileList, "scanworld files 1 sim_check.json\n"); }},
  };
  for (const auto& [told, intrude] : intruders) {
    write_folder(path);
    intrude();
    const auto before = contents(folder.path());
    const std::string why = refused(path);
    const std::string first = std::string(told).substr(0, std::string(told).find(','));
    CHECK_MESSAGE(contains(why, first), why);
    CHECK(contents(folder.path()) == before);
    fs::remove_all(path);
    fs::remove_all(folder / "elsewhere");
  }
  write_folder(path);
  fs::create_directory_symlink("world", folder / "link");
  CHECK(contains(refused(folder / "link"), "is a symlink to world"));
  CHECK(contains(refused(folder / "link/"), "is a symlink to world"));
  CHECK(contains(refused(path / "world.json"), "file of this name"));
}

TEST_CASE("an input in the folder stops the run, even where it is ours") {
  const TempFolder folder;
  const fs::path path = folder / "world";
  write_folder(path);
  fs::create_symlink("world/meshes", folder / "to_it");
  for (const fs::path& input :
       {path / "world.json", folder / "to_it/floor.obj", path, folder / "to_it"})
    CHECK(contains(refused(path, {"", folder / "absent", input}), "the input"));
  OutputFolder(path, kMark, {folder.path()});
}

TEST_CASE("folders without a list are known by the names and content of their files") {
  const TempFolder folder;
  const fs::path path = folder / "world";
  const auto make = [&] {
    fs::create_directories(path / "world_meshes");
    write_file(path / "world.json", kWorld);
    write_file(path / "world.obj", "# scanworld: metres\nv 0 0 0\n");
    write_file(path / "world_meshes/surfaces.obj", "# scanworld: metres\n");
    write_file(path / "world_meshes/wall_1_solid_0.obj", "o wall_1_solid_0\n");
  };
  make();
  CHECK(write_folder(path).empty());
  CHECK_FALSE(fs::exists(path / "world.obj"));
  fs::remove_all(path);
  make();
  write_file(path / "world.obj", "# Blender\nv 0 0 0\n");
  CHECK(contains(refused(path), "world.obj"));
  fs::remove(path / "world.obj");
  write_file(path / "world_meshes/mine.obj", "o mine\n");
  CHECK(contains(refused(path), "world_meshes/mine.obj"));
  fs::remove_all(path / "world_meshes");
  write_file(path / "world.json", "{}");
  CHECK(contains(refused(path), "world.json"));
}

TEST_CASE("what other commands of ours put beside a world goes with it") {
  const TempFolder folder;
  const fs::path path = folder / "world";
  write_folder(path);
  write_file(path / "sim_check.json", R"({"keeps_promises": true})");
  write_file(path / "view.html", "<!-- The scanworld authors -->");
  CHECK(write_folder(path).empty());
  CHECK_FALSE(fs::exists(path / "view.html"));
  CHECK_FALSE(fs::exists(path / "sim_check.json"));
  write_file(path / "view.html", "<p>My view of it");
  CHECK(contains(refused(path), "view.html"));
}

TEST_CASE("what appears or changes during the run is kept and told") {
  const TempFolder folder;
  const fs::path path = folder / "world";
  write_folder(path);
  OutputFolder out(path, kMark);
  write_file(out.path() / "world.json", "new");
  write_file(path / "notes.txt", "mine");
  fs::create_directories(path / "photos/of");
  write_file(path / "world.json", kWorld + " edited");
  write_file(path / "meshes/floor.obj", "edited");
  const std::vector<std::string> kept = out.commit();
  REQUIRE(kept.size() == 4);
  CHECK(contains(kept[0], "notes.txt: appeared meanwhile"));
  CHECK(contains(kept[1], "photos: appeared meanwhile"));
  CHECK(contains(kept[2], "world.kept-1/meshes/floor.obj"));
  CHECK(contains(kept[3], "world.kept-1/world.json"));
  CHECK(read_file(path / "world.json") == "new");
  CHECK(read_file(path / "notes.txt") == "mine");
  CHECK(fs::exists(path / "photos/of"));
  CHECK(read_file(folder / "world.kept-1/world.json") == kWorld + " edited");
  CHECK(read_file(folder / "world.kept-1/meshes/floor.obj") == "edited");
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 2);
}

TEST_CASE("a folder or a file that appears in an empty place during the run is kept") {
  const TempFolder folder;
  OutputFolder out(folder / "world", kMark);
  write_file(out.path() / "world.json", "new");
  fs::create_directory(folder / "world");
  write_file(folder / "world/notes.txt", "mine");
  CHECK(out.commit().size() == 1);
  CHECK(read_file(folder / "world/notes.txt") == "mine");
  CHECK(read_file(folder / "world/world.json") == "new");

  OutputFolder second(folder / "other", kMark);
  write_file(folder / "other", "mine");
  CHECK(contains(error_of(Cause::failure, [&] { second.commit(); }), "appeared"));
  CHECK(read_file(folder / "other") == "mine");
}
