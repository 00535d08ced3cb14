// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "files.h"

namespace scanworld {

// The file of a folder that lists what this program wrote there.
inline constexpr const char* kFileList = ".scanworld";

// What tells that a file was not touched meanwhile.
struct FileStamp {
  std::uint64_t device = 0, inode = 0;
  std::int64_t size = 0, changed = 0;  // bytes, nanoseconds
  bool operator==(const FileStamp&) const = default;
};

// A folder that appears whole or not at all. It takes the place of an older one of its kind, and of
// nothing else: what is in the older one must be as this program wrote it, which a list of its
// files with their hashes tells (kFileList, written by commit()); in folders of versions that wrote
// no list the names and what is near the start of the files do. No other file is changed or
// removed.
class OutputFolder {
 public:
  // `mark` is a file that all folders of this kind hold. Throws usage naming what is in the way:
  // one of the inputs that the run reads, a symlink, or anything else that is not ours; failure
  // where nothing can be written.
  OutputFolder(const std::filesystem::path& path, std::string mark,
               const std::vector<std::filesystem::path>& inputs = {});

  // Where to write the files until commit().
  const std::filesystem::path& path() const { return part_.path(); }

  // Puts the folder in its place and then removes the older one, file by file. What appeared or
  // changed there meanwhile is kept, in the new folder or, where that has a file of the name, in a
  // folder beside it; in words, what was kept and where.
  std::vector<std::string> commit();

 private:
  using Paths = std::vector<std::filesystem::path>;

  std::filesystem::path swap_in();
  void remove_ours(const std::filesystem::path& older, const std::filesystem::path& below,
                   Paths& kept) const;
  std::vector<std::string> keep(const std::filesystem::path& older, const Paths& kept) const;

  std::filesystem::path path_;
  std::string mark_;
  std::map<std::filesystem::path, FileStamp> ours_;  // files of the older folder, from there
  ScratchFolder part_;
};

}  // namespace scanworld
