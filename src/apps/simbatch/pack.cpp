// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "pack.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "archive.hpp"
#include "command.hpp"
#include "folders.hpp"
#include "orca/base/files/open_output.hpp"
#include "orca/base/text.hpp"
#include "orca/batch/inputs.hpp"
#include "orca/batch/report.hpp"
#include "orca/xml/document.hpp"
#include "tables.hpp"

namespace orca::simbatch {
namespace {

namespace fs = std::filesystem;

// The layout of a pack.
constexpr const char* kContents = "contents.txt";  // a line each: a hash or the kind, and the name
constexpr const char* kFirstLine = "orca-pack 1";
constexpr const char* kRuns = "runs.csv";
constexpr const char* kFiles = "files";
constexpr const char* kExperiment = "experiment";

constexpr const char* kHowToRepeat =
    "# A batch of Orca that can be repeated\n\n"
    "    simbatch repeat %s.pack.tar.gz\n\n"
    "unpacks this archive, checks it, makes all runs again, and says whether the results are the same, byte "
    "for byte.\n"
    "`files` holds the experiment and all files that its runs read, `runs.csv` the results, and "
    "`contents.txt`\n"
    "hashes (64-bit FNV-1a) of the files, and of the programs, libraries and plugins that made the results.\n"
    "The experiment is `%s`.\n";

Error cannot(const fs::path& path, const std::error_code& error) {
  return fail(Code::unavailable, path.string() + ": " + error.message());
}

// A folder that is deleted with what is in it.
class Scratch {
 public:
  explicit Scratch(fs::path path) : path_(std::move(path)) {}
  ~Scratch() {
    std::error_code unused;
    if (!path_.empty()) fs::remove_all(path_, unused);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  void keep() { path_.clear(); }

 private:
  fs::path path_;
};

// Returns the deepest folder that all files are in.
fs::path common_folder(const std::vector<std::string>& files) {
  fs::path common = fs::path(files.front()).parent_path();
  const auto holds = [&](const std::string& file) {
    return *fs::path(file).lexically_relative(common).begin() != "..";
  };
  while (!std::ranges::all_of(files, holds)) common = common.parent_path();
  return common;
}

Status write(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  return out ? ok() : Status(fail(Code::unavailable, file.string() + " cannot be written"));
}

bool is_program(const std::string& name) { return !name.starts_with("file ") && !name.starts_with("world "); }

using Copies = std::map<fs::path, fs::path>;  // the place of each copy, and the file

// Adds the files to which links in a folder lead, at the places that these links give them: so whoever read them has named them. Links behind
// these count as well, for `depth` more of them.
void add_linked(const fs::path& folder, const fs::path& place, const std::vector<std::string>& files,
                int depth, Copies& copies) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_symlink(error)) continue;
    const fs::path target = fs::canonical(entry.path(), error);
    if (error) continue;  // it leads nowhere
    const fs::path link = place / entry.path().filename();
    for (const std::string& file : files) {
      const fs::path behind = fs::path(file).lexically_relative(target);
      if (behind == ".") copies.emplace(link, file);
      if (behind != "." && *behind.begin() != "..") copies.emplace(link / behind, file);
    }
    if (depth > 0 && fs::is_directory(target, error)) add_linked(target, link, files, depth - 1, copies);
  }
}

// Returns what goes to which place below the folder that all files are in. A link in the pack would lead out of it, so what is behind one is
// copied.
Copies copies_of(const std::vector<std::string>& files, const fs::path& common) {
  Copies copies;
  std::set<fs::path> folders;
  for (const std::string& file : files) {
    copies.emplace(file, file);
    folders.insert(fs::path(file).parent_path());
  }
  for (const fs::path& folder : folders) add_linked(folder, folder, files, 1, copies);
  Copies below;
  for (const auto& [place, file] : copies) below.emplace(place.lexically_relative(common), file);
  return below;
}

// Copies the files to their places in the pack.
Status copy_files(const Copies& copies, const fs::path& to) {
  for (const auto& [place, file] : copies) {
    const fs::path copy = to / place;
    std::error_code error;
    fs::create_directories(copy.parent_path(), error);
    if (!error) fs::copy_file(file, copy, error);
    if (error) return cannot(file, error);
  }
  return ok();
}

// Finds out whether the copied experiment reads the copies and nothing else: a path that is absolute leads back here.
Status check_copies(const fs::path& experiment, const fs::path& copies,
                    const std::vector<std::string>& plugins) {
  std::vector<std::string> words{"/proc/self/exe", kListFiles, experiment.string()};
  words.insert(words.end(), plugins.begin(), plugins.end());
  const Result<std::string> listed = output_of(words);
  if (!listed)
    return fail(
        Code::failed_precondition,
        "the copied experiment cannot be loaded: it names a file in a way that depends on where it lies");
  std::istringstream lines(*listed);
  for (std::string file; std::getline(lines, file);)
    if (*fs::path(file).lexically_relative(copies).begin() == "..")
      return fail(Code::failed_precondition,
                  in_quotes(file) +
                      " is named by an absolute path, which means nothing on another machine; "
                      "name it from the folder of the file on that names it");
  return ok();
}

std::string contents_of(const fs::path& copies, const fs::path& experiment, const batch::Inputs& inputs) {
  std::string text = std::string(kFirstLine) + "\n" + kExperiment + " " + experiment.string() + "\n";
  for (const auto& [name, hash] : inputs)
    if (is_program(name)) text += hash + " " + name + "\n";
  std::vector<std::string> files;
  for (const auto& one : fs::recursive_directory_iterator(copies))
    if (one.is_regular_file()) files.push_back(one.path());
  std::ranges::sort(files);
  for (const std::string& file : files)
    text += batch::content_hash(file).value_or("") + " file " +
            fs::path(file).lexically_relative(copies).string() + "\n";
  return text;
}

Status write_texts(const batch::Experiment& experiment, const batch::Store& store, const fs::path& folder,
                   const fs::path& place) {
  std::string runs;
  if (Status read = runs_table(store, [&](std::string_view line) { runs += line; }); !read.ok()) return read;
  char how[2048];
  std::snprintf(how, sizeof how, kHowToRepeat, experiment.name.c_str(), (kFiles / place).c_str());
  for (const auto& [name, text] : {std::pair<const char*, std::string>{kRuns, runs},
                                   {"REPEAT.md", how},
                                   {"provenance.json", batch::provenance_json(experiment, store)},
                                   {kContents, contents_of(folder / kFiles, place, store.inputs())}})
    if (Status written = write(folder / name, text); !written.ok()) return written;
  return ok();
}

}  // namespace

Result<fs::path> write_pack(const batch::Experiment& experiment, const batch::Store& store,
                            const fs::path& folder, const std::vector<std::string>& plugins) {
  std::error_code error;
  const fs::path scratch = fs::canonical(folder, error) / (experiment.name + ".pack");
  if (error) return cannot(folder, error);
  const Scratch deleted(scratch);
  fs::remove_all(scratch, error);
  const std::vector<std::string> files = batch::files_of(experiment);
  const fs::path common = common_folder(files);
  const fs::path place = fs::weakly_canonical(fs::absolute(experiment.file)).lexically_relative(common);
  if (Status copied = copy_files(copies_of(files, common), scratch / kFiles); !copied.ok())
    return copied.error();
  if (Status checked = check_copies(scratch / kFiles / place, scratch / kFiles, plugins); !checked.ok())
    return checked.error();
  if (Status written = write_texts(experiment, store, scratch, place); !written.ok()) return written.error();
  const fs::path archive = folder / (experiment.name + ".pack.tar.gz");
  if (Status packed = write_archive(archive, scratch); !packed.ok()) return packed.error();
  return archive;
}

Result<Pack> open_pack(const fs::path& folder) {
  std::ifstream lines(folder / kContents);
  std::string line;
  if (!std::getline(lines, line) || line != kFirstLine)
    return fail(Code::failed_precondition,
                in_quotes(folder.string()) + " holds no pack of this version of simbatch");
  Pack pack{.experiment = {}, .runs = folder / kRuns, .programs = {}};
  std::set<fs::path> files;
  while (std::getline(lines, line)) {
    const std::size_t space = std::min(line.find(' '), line.size());
    const std::string hash = line.substr(0, space);
    const std::string name = line.substr(std::min(space + 1, line.size()));
    if (hash == kExperiment)
      pack.experiment = folder / kFiles / name;
    else if (is_program(name))
      pack.programs[name] = hash;
    else if (const fs::path file = folder / kFiles / name.substr(name.find(' ') + 1);
             batch::content_hash(file) == hash)
      files.insert(file);
    else
      return fail(Code::failed_precondition, in_quotes(file.string()) + " is not the file that was packed");
  }
  if (!files.contains(pack.experiment) || !fs::is_regular_file(pack.runs))
    return fail(Code::failed_precondition, "the archive has no experiment or no results");
  return pack;
}

Result<Pack> unpack(const fs::path& archive, const fs::path& folder) {
  if (!fs::is_regular_file(archive))
    return fail(Code::not_found, "there is no archive " + in_quotes(archive.string()));
  if (fs::exists(folder))
    return fail(Code::already_exists,
                in_quotes(folder.string()) +
                    " is there already; --resume goes on in it, --out DIR takes another folder");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return cannot(folder, error);
  Scratch half(folder);
  if (Status unpacked = unpack_archive(archive, folder); !unpacked.ok()) return unpacked.error();
  Result<Pack> pack = open_pack(folder);
  if (pack) half.keep();
  return pack;
}

std::vector<std::string> other_programs(const Pack& pack, const batch::Inputs& now) {
  std::vector<std::string> names;
  for (const auto& [name, hash] : pack.programs)
    if (const auto found = now.find(name); found == now.end() || found->second != hash) names.push_back(name);
  return names;
}

ExitCode compare_with(const Pack& pack, const fs::path& runs) {
  std::ifstream before(pack.runs, std::ios::binary), now(runs, std::ios::binary);
  std::size_t count = 0;
  for (std::string one, other;; ++count) {
    const bool has_one = static_cast<bool>(std::getline(before, one));
    const bool has_other = static_cast<bool>(std::getline(now, other));
    if (!has_one && !has_other) break;
    if (has_one == has_other && one == other && before.eof() == now.eof()) continue;
    std::printf("not the same: line %zu of runs.csv is\n  %s\nin the pack and now\n  %s\n", count + 1,
                has_one ? printable(one).c_str() : "missing",
                has_other ? printable(other).c_str() : "missing");
    return ExitCode::different;
  }
  std::printf("the same: all %zu runs, byte for byte\n", count - 1);
  return ExitCode::done;
}

ExitCode list_files(const std::vector<std::string>& words) {
  xml::Diagnostics diagnostics;
  const std::optional<batch::Experiment> experiment = batch::read_experiment(words.front(), diagnostics);
  if (!experiment) return ExitCode::bad_input;
  batch::BatchOptions options;
  options.plugin_folders.assign(words.begin() + 1, words.end());
  batch::check_graphs(*experiment, options, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.has_errors()) return ExitCode::bad_input;
  for (const std::string& file : batch::files_of(*experiment)) std::printf("%s\n", file.c_str());
  return ExitCode::done;
}

}  // namespace orca::simbatch
