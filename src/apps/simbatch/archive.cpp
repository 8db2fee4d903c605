// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "archive.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "command.hpp"
#include "orca/base/text.hpp"

namespace orca::simbatch {
namespace {

constexpr std::size_t kMostFiles = 100'000;
constexpr std::uint64_t kMostBytes = 4'000'000'000;

// Returns whether a path stays within the folder that it starts from, however it is read.
bool is_inside(const std::filesystem::path& path) {
  return path.is_relative() && path == path.lexically_normal() && path.has_filename() &&
         *path.begin() != ".." && *path.begin() != ".";
}

// What an archive holds, as far as its list was read.
class Content {
 public:
  // Takes a line of `tar --list --verbose --numeric-owner`: "-rw-r--r-- 0/0 12 1970-01-01 00:00 runs.csv".
  Status add(const std::string& line) {
    std::istringstream words(line);
    std::string mode, owner, date, time, path;
    std::uint64_t bytes = 0;
    if (!(words >> mode >> owner >> bytes >> date >> time) || words.get() != ' ' ||
        !std::getline(words, path))
      return refused(line, "is no entry of a file");
    if (mode.front() != '-' && mode.front() != 'd') return refused(path, "is neither a file nor a folder");
    if (path.ends_with('/')) path.pop_back();
    if (!is_inside(path)) return refused(path, "leads out of the archive's folder");
    if (!paths_.insert(path).second) return refused(path, "is there twice");
    if (bytes > kMostBytes - bytes_ || paths_.size() > kMostFiles)
      return refused(path, "is more than an archive of 4 GB and 100,000 files holds");
    bytes_ += bytes;
    return ok();
  }

 private:
  static Error refused(const std::string& path, const std::string& why) {
    return fail(Code::invalid_argument, "nothing is unpacked: " + in_quotes(printable(path)) + " " + why);
  }

  std::set<std::string> paths_;
  std::uint64_t bytes_ = 0;
};

}  // namespace

Status write_archive(const std::filesystem::path& archive, const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& one : std::filesystem::directory_iterator(folder))
    names.push_back(one.path().filename().string());
  std::ranges::sort(names);
  std::vector<std::string> words{"tar",
                                 "--create",
                                 "--gzip",
                                 "--force-local",
                                 "--format=gnu",
                                 "--sort=name",
                                 "--mtime=@0",
                                 "--owner=0",
                                 "--group=0",
                                 "--numeric-owner",
                                 "--mode=u=rwX,go=rX",
                                 "--file=" + archive.string(),
                                 "--directory=" + folder.string(),
                                 "--"};
  words.insert(words.end(), names.begin(), names.end());
  const Result<std::string> written = output_of(words);
  return written ? ok() : Status(written.error());
}

Status unpack_archive(const std::filesystem::path& archive, const std::filesystem::path& folder) {
  // Without --absolute-names tar would show paths that lead out as if they did not.
  const Result<std::string> list =
      output_of({"tar", "--list", "--verbose", "--gzip", "--force-local", "--numeric-owner",
                 "--absolute-names", "--quoting-style=literal", "--file=" + archive.string()});
  if (!list)
    return fail(Code::invalid_argument,
                in_quotes(archive.string()) + " cannot be unpacked: " + list.error().message);
  Content content;
  std::istringstream lines(*list);
  for (std::string line; std::getline(lines, line);)
    if (Status taken = content.add(line); !taken.ok()) return taken;
  const Result<std::string> unpacked =
      output_of({"tar", "--extract", "--gzip", "--force-local", "--no-same-owner", "--no-same-permissions",
                 "--file=" + archive.string(), "--directory=" + folder.string()});
  return unpacked ? ok() : Status(unpacked.error());
}

}  // namespace orca::simbatch
