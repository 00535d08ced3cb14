// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "view.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <memory>

#include "cli.h"
#include "error.h"
#include "fidelity.h"
#include "files.h"
#include "parallel.h"
#include "viewer/drawn_plan.h"
#include "viewer/page.h"
#include "viewer/picture.h"
#include "world/world_json.h"

namespace scanworld::cli {

namespace {

constexpr const char* kViewExample = R"(Examples:
  scanworld view office                                  office/view.html, for any browser, from disk
  scanworld view office office.ply --poses poses.txt -o office.html
  scanworld view office -o office.png --from top         a picture, on a machine without a display too
  scanworld view office -o office.svg                    the floor plan, with dimensions
The page also shows report.json, replay.json (build --record) and sim_check.json where these are beside
world.json. docs/page.md tells what is in it.)";

constexpr int kMaxDepth = 100;                              // of lists in JSON that the page shows
constexpr const char* kPageMark = "The scanworld authors";  // that each page bears

struct ViewRequest {
  std::filesystem::path world, poses, out, sim_check;
  std::vector<std::filesystem::path> scans;
  std::string from = "iso";
  std::vector<int> size = {PictureOptions{}.width, PictureOptions{}.height};
  DrawnPlanOptions plan;
  std::size_t points = kPagePoints;
  int threads = 0;
  Console console;
};

// The text of a JSON file; empty where there is none. Throws bad_input where it is none.
std::string read_json(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "";
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  // Deeper lists than that would use up the stack where they are written.
  const auto check_depth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kMaxDepth)
      throw Error(Cause::bad_input,
                  fmt::format("{}: lists and objects lie more than {} deep in each other",
                              file.string(), kMaxDepth));
    return true;
  };
  try {
    return Json::parse(text, check_depth).dump();
  } catch (const Json::exception& e) {
    throw Error(Cause::bad_input, file.string() + ": no JSON: " + e.what());
  }
}

// A report that is of this world; else empty, and a warning.
std::string report_of(const World& world, const std::filesystem::path& file,
                      const Console& console) {
  const std::string text = read_json(file);
  if (text.empty()) return text;
  const Json report = Json::parse(text);
  const Json hash = report.is_object() ? report.value("world_hash", Json()) : Json();
  if (hash == Json(world_hash(world))) return text;
  console.warn(file.string() + ": is left out, as it is the report of another world");
  return "";
}

// Of a world that has a folder of its own, or of another file.
std::string title_of(const std::filesystem::path& world) {
  if (std::filesystem::is_directory(world)) return folder_name(world);
  if (world.filename() == "world.json")
    return folder_name(std::filesystem::absolute(world).parent_path());
  return world.stem().string();
}

// What belongs to a world, beside its scan.
void add_results(PageContent& content, const ViewRequest& request) {
  const bool is_folder = std::filesystem::is_directory(request.world);
  const std::filesystem::path folder = is_folder ? request.world : request.world.parent_path();
  // What lies beside a world.json of its own is about it; beside other files it may be of any.
  if (is_folder || request.world.filename() == "world.json") {
    content.report = report_of(content.world, folder / "report.json", request.console);
    content.replay = read_json(folder / "replay.json");
    content.sim_check = read_json(folder / "sim_check.json");
  }
  if (request.sim_check.empty()) return;
  const bool is_result_folder = std::filesystem::is_directory(request.sim_check);
  const auto file = is_result_folder ? request.sim_check / "sim_check.json" : request.sim_check;
  content.sim_check = read_json(file);
  if (content.sim_check.empty())
    throw Error(Cause::bad_input, file.string() + ": cannot be opened");
}

void write_page(const ViewRequest& request, const World& world, const std::filesystem::path& out) {
  PageContent content{.title = title_of(request.world), .world = world};
  add_results(content, request);  // before a large scan is read
  if (!request.scans.empty()) {
    const PointCloud scan = read_scan_with_poses(request.scans, request.poses);
    content.scan = scan_view(world, scan, request.points);
  }
  write_text(out, page_of(content));
}

void write_picture(const ViewRequest& request, const World& world,
                   const std::filesystem::path& out) {
  const PictureOptions options{.width = request.size[0], .height = request.size[1]};
  const double aspect = static_cast<double>(options.width) / options.height;
  write_text(out, png_of(draw(world, camera_named(request.from, world, aspect), options)));
}

void run(const ViewRequest& request) {
  if (request.scans.empty() && !request.poses.empty())
    throw Error(Cause::usage, "--poses needs a SCAN that was made from there");
  std::filesystem::path out = request.out;
  if (out.empty())
    out = std::filesystem::is_directory(request.world)
              ? request.world / "view.html"
              : std::filesystem::path(request.world).replace_extension(".html");
  const std::string extension = lower_extension(out);
  if (extension != ".html" && extension != ".png" && extension != ".svg")
    throw Error(Cause::usage, out.string() + ": view writes .html, .png and .svg");
  if (extension != ".html" && !request.scans.empty())
    throw Error(Cause::usage, out.string() + ": a scan is shown on pages only");
  std::vector<std::filesystem::path> inputs = request.scans;
  inputs.insert(inputs.end(), {world_file(request.world), request.poses, request.sim_check});
  check_output(out, inputs);
  if (request.out.empty()) check_replaces_own(out, kPageMark);
  const ThreadLimit threads(request.threads);
  const World world = read_valid_world(request.world);
  if (extension == ".png")
    write_picture(request, world, out);
  else if (extension == ".svg")
    write_text(out, svg_of(draw_plan(world, request.plan), title_of(request.world)));
  else
    write_page(request, world, out);
  fmt::print("{}\n", out.string());
}

}  // namespace

std::string folder_name(const std::filesystem::path& folder) {
  const std::filesystem::path path = std::filesystem::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

ScanView scan_view(const World& world, const PointCloud& scan, std::size_t points) {
  Fidelity fidelity = fidelity_of(world, scan, points);
  std::string json = json_of(fidelity).dump();
  return {scan.points.size(), std::move(fidelity), std::move(json)};
}

void add_view(CLI::App& app) {
  auto request = std::make_shared<ViewRequest>();
  CLI::App* verb = app.add_subcommand("view", "Show a world: as a page, a picture or a floor plan");
  verb->add_option("world", request->world, "A world.json or its folder")
      ->required()
      ->type_name("WORLD");
  verb->add_option("scans", request->scans, "The scan that it was made of, to show with it")
      ->type_name("SCAN");
  verb->add_option("-o,--out", request->out,
                   "File to write: .html, .png or .svg; view.html in the world's folder where it "
                   "is not given")
      ->type_name("F");
  verb->add_option("--from", request->from,
                   "Pictures: from the top, iso (a corner, above), or a place x,y,z in the world")
      ->type_name("VIEW")
      ->capture_default_str();
  verb->add_option("--size", request->size, "Pictures: width and height in pixels")
      ->expected(2)
      ->type_name("W H")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  verb->add_option("--storey", request->plan.storey,
                   "Floor plans of one: 0 for the lowest; where it is not given, that of the "
                   "largest floor")
      ->check(CLI::Range(0, 1000));
  verb->add_option("--cut", request->plan.cut, "Floor plans: height of the cut over the floor [m]")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  verb->add_option("--poses", request->poses, kPosesHelp)->type_name("F");
  verb->add_option("--points", request->points, "About so many points of the scan are shown")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100000000}))
      ->capture_default_str();
  verb->add_option("--sim-check", request->sim_check,
                   "Result of sim_check to show, its JSON or folder; sim_check.json beside "
                   "world.json where it is not given")
      ->type_name("F")
      ->check(CLI::ExistingPath);
  verb->add_option("--threads", request->threads, "Threads to use; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  verb->add_flag("-q,--quiet", request->console.quiet, "No warnings");
  verb->footer(kViewExample);
  verb->callback([request] { run(*request); });
}

}  // namespace scanworld::cli
