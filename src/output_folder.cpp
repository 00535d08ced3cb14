// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "error.h"
#include "known_files.h"
#include "mix.h"

namespace scanworld {

namespace fs = std::filesystem;

namespace {

constexpr const char* kListTitle = "scanworld files 1 ";  // and the mark

[[noreturn]] void fail_folder(const fs::path& path, const std::string& why) {
  throw Error(Cause::failure, fmt::format("{}: writing the folder: {}", path.string(), why));
}

std::vector<fs::path> sorted_entries(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

// The size and hash of a file's bytes, as one word.
std::string bytes_word(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<std::uint64_t> block(1 << 17);
  std::uint64_t hash = 0, size = 0;
  while (in) {
    std::fill(block.begin(), block.end(), 0);
    in.read(reinterpret_cast<char*>(block.data()),
            static_cast<std::streamsize>(block.size() * sizeof(block[0])));
    const auto count = static_cast<std::size_t>(in.gcount());
    size += count;
    for (std::size_t i = 0; 8 * i < count; ++i) hash = mix(hash ^ block[i]) + 0x9e3779b97f4a7c15;
  }
  if (in.bad()) fail_folder(file, "cannot be read");
  return fmt::format("{}-{:016x}", size, hash);
}

// Calls visit(path from the folder) for all files in it.
template <typename Visit>
void visit_files(const fs::path& folder, const fs::path& below, const Visit& visit) {
  for (const fs::path& name : sorted_entries(folder / below))
    if (fs::is_directory(folder / below / name))
      visit_files(folder, below / name, visit);
    else
      visit(below / name);
}

void write_list(const fs::path& folder, const std::string& mark) {
  std::string text = kListTitle + mark + "\n";
  visit_files(folder, "", [&](const fs::path& file) {
    text += bytes_word(folder / file) + " " + file.generic_string() + "\n";
  });
  write_text(folder / kFileList, text);
}

// Of a folder that is there: what was written into it, by its list.
struct FileList {
  std::string mark;
  std::map<fs::path, std::string> files;  // size and hash
};

std::optional<FileList> read_list(const fs::path& folder) {
  std::ifstream in(folder / kFileList);
  std::string line;
  if (!std::getline(in, line) || !line.starts_with(kListTitle)) return std::nullopt;
  FileList list{.mark = line.substr(std::strlen(kListTitle))};
  while (std::getline(in, line))
    if (const std::size_t space = line.find(' '); space != std::string::npos)
      list.files[line.substr(space + 1)] = line.substr(0, space);
  return list;
}

std::optional<FileStamp> stamp_of(const fs::path& file) {
  struct stat info {};
  if (::lstat(file.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
  return FileStamp{info.st_dev, info.st_ino, info.st_size,
                   info.st_ctim.tv_sec * 1000000000 + info.st_ctim.tv_nsec};
}

// A look into the folder that is to be replaced: what is ours, and what is in the way.
class OlderFolder {
 public:
  OlderFolder(const fs::path& folder, const std::string& mark)
      : folder_(folder), list_(read_list(folder)) {
    is_of_kind_ = list_ ? list_->mark == mark : is_known_file(folder, mark);
    if (list_)
      for (const auto& [file, word] : list_->files)
        for (fs::path at = file; at.has_parent_path();) folders_.insert(at = at.parent_path());
    look_at("");
  }

  std::map<fs::path, FileStamp> ours;
  std::vector<std::string> in_the_way;

 private:
  void look_at(const fs::path& below) {
    for (const fs::path& name : sorted_entries(folder_ / below)) {
      const fs::path at = below / name;
      const fs::file_status status = fs::symlink_status(folder_ / at);
      const std::optional<FileStamp> stamp = stamp_of(folder_ / at);  // before it is looked at
      if (fs::is_directory(status) && is_our_folder(at))
        look_at(at);
      else if (const std::string why = why_not_ours(at, status); !why.empty() || !stamp)
        in_the_way.push_back(at.string() + " " + why);
      else
        ours[at] = *stamp;
    }
  }

  bool is_our_folder(const fs::path& at) const {
    return is_of_kind_ && (list_ ? folders_.count(at) == 1 : is_known_folder(at));
  }

  std::string why_not_ours(const fs::path& at, const fs::file_status& status) const {
    if (fs::is_symlink(status)) return "is a symlink";
    const std::string foreign = "was not written by this command";
    if (!fs::is_regular_file(status) || !is_of_kind_) return foreign;
    if (list_ ? is_known_guest(folder_, at) || at == kFileList : is_known_file(folder_, at))
      return "";
    if (!list_ || !list_->files.count(at)) return foreign;
    return list_->files.at(at) == bytes_word(folder_ / at) ? "" : "was changed since";
  }

  fs::path folder_;
  std::optional<FileList> list_;
  std::set<fs::path> folders_;  // that the list has files in
  bool is_of_kind_ = false;
};

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& why) {
  throw Error(Cause::usage, fmt::format("{}: not written: {}", folder.string(), why));
}

void check_place(const fs::path& path, const fs::file_status& status) {
  if (fs::is_symlink(status))
    refuse_folder(path, fmt::format("is a symlink to {}; name the folder itself",
                                    fs::read_symlink(path).string()));
  if (!fs::is_directory(status)) refuse_folder(path, "there is a file of this name");
  struct stat own {
  }, above{};
  if (::stat(path.c_str(), &own) == 0 && ::stat(path.parent_path().c_str(), &above) == 0 &&
      (own.st_dev != above.st_dev || own.st_ino == above.st_ino))
    refuse_folder(path,
                  "a file system begins there, which cannot be replaced; name a folder in it");
  if (::access(path.c_str(), W_OK) != 0) fail_folder(path, std::strerror(errno));
}

void check_inputs(const fs::path& folder, const std::vector<fs::path>& inputs) {
  for (const fs::path& input : inputs)
    if (!input.empty() && is_within(folder, input))
      refuse_folder(folder,
                    fmt::format("the input {} is in it; name another folder", input.string()));
}

void check_nothing_in_the_way(const fs::path& folder, const std::vector<std::string>& in_the_way) {
  constexpr std::size_t kNamed = 3;
  if (in_the_way.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min(kNamed, in_the_way.size()); ++i)
    names += (i > 0 ? ", " : "") + in_the_way[i];
  if (in_the_way.size() > kNamed) names += fmt::format(" and {} more", in_the_way.size() - kNamed);
  refuse_folder(folder, names + "; move that elsewhere, or name another folder");
}

// Where a folder may be moved to that holds what was kept.
fs::path kept_beside(const fs::path& path) {
  for (int i = 1;; ++i)
    if (fs::path name = path.string() + fmt::format(".kept-{}", i);
        !fs::exists(fs::symlink_status(name)))
      return name;
}

// The files of a folder that may be replaced; makes the folder above where there is none.
std::map<fs::path, FileStamp> ours_in(const fs::path& path, const std::string& mark,
                                      const std::vector<fs::path>& inputs) try {
  const fs::file_status status = fs::symlink_status(path);
  if (!fs::exists(status)) {
    fs::create_directories(path.parent_path());
    return {};
  }
  check_place(path, status);
  check_inputs(path, inputs);
  OlderFolder older(path, mark);
  check_nothing_in_the_way(path, older.in_the_way);
  return std::move(older.ours);
} catch (const fs::filesystem_error& e) {
  fail_folder(e.path1(), e.code().message());
}

bool move_to_free(const fs::path& from, const fs::path& to) {
  return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& path, std::string mark,
                           const std::vector<fs::path>& inputs)
    : path_(place_of(path)),
      mark_(std::move(mark)),
      ours_(ours_in(path_, mark_, inputs)),
      part_(path_) {}

std::vector<std::string> OutputFolder::commit() try {
  write_list(part_.path(), mark_);
  const fs::path older = swap_in();
  if (older.empty()) return {};
  Paths kept;
  remove_ours(older, "", kept);
  return keep(older, kept);
} catch (const fs::filesystem_error& e) {
  fail_folder(e.path1(), e.code().message());
}

// Puts the new folder in its place; where the older one is then, if there was one.
fs::path OutputFolder::swap_in() {
  const fs::path part = part_.path();
  const fs::file_status status = fs::symlink_status(path_);
  if (!fs::exists(status)) {
    fs::rename(part, path_);
    part_.let_go();
    return {};
  }
  if (!fs::is_directory(status)) fail_folder(path_, "something else appeared there meanwhile");
  // The two change places in one step, so that one of them is there at any time.
  if (::renameat2(AT_FDCWD, part.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0) {
    part_.let_go();
    return part;
  }
  ScratchFolder older(path_);  // a file system that cannot exchange
  fs::rename(path_, older.path());
  const fs::path there = older.path();
  older.let_go();
  std::error_code error;
  fs::rename(part, path_, error);
  if (error) {
    fs::rename(there, path_);
    fail_folder(path_, error.message());
  }
  part_.let_go();
  return there;
}

// Removes what is ours and was not touched, one by one, and the folders that are empty then.
void OutputFolder::remove_ours(const fs::path& older, const fs::path& below, Paths& kept) const {
  for (const fs::path& name : sorted_entries(older / below)) {
    const fs::path at = below / name;
    const auto ours = ours_.lower_bound(at);
    if (fs::is_directory(fs::symlink_status(older / at)) && ours != ours_.end() &&
        ours->first.string().starts_with(at.string() + "/"))
      remove_ours(older, at, kept);
    else if (const auto found = ours_.find(at);
             found == ours_.end() || stamp_of(older / at) != found->second)
      kept.push_back(at);
    else
      ::unlink((older / at).c_str());
  }
  ::rmdir((older / below).c_str());  // unless something is in it
}

// Moves what is left of the older folder to where it can be seen.
std::vector<std::string> OutputFolder::keep(const fs::path& older, const Paths& kept) const {
  std::vector<std::string> told;
  for (const fs::path& at : kept)
    if (move_to_free(older / at, path_ / at))
      told.push_back((path_ / at).string() + ": appeared meanwhile, and was kept");
  if (!fs::exists(older)) return told;
  Paths left;
  remove_ours(older, "", left);
  if (!fs::exists(older)) return told;
  const fs::path beside = kept_beside(path_);
  fs::rename(older, beside);
  for (const fs::path& at : left)
    told.push_back(fmt::format("{}: was changed meanwhile; it is kept as {}", (path_ / at).string(),
                               (beside / at).string()));
  return told;
}

}  // namespace scanworld
