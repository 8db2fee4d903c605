// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "template_folder.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

#include "asking.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/base/input_file.hpp"
#include "orca/base/output_file.hpp"
#include "orca/base/text.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 40;  // so that names derived from it fit into lines and paths
constexpr std::size_t kLongestFile = std::size_t{1} << 20;  // [bytes]
constexpr std::string_view kLink =
    ".link";  // ends the name of a file of a template that holds where a link leads

using Files = std::map<std::string, std::string>;  // path in the folder and text

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

Status check_name(const std::string& name) {
  const bool fits = !name.empty() && name.size() <= kLongestName &&
                    std::isalpha(static_cast<unsigned char>(name.front())) != 0 &&
                    std::ranges::all_of(name, is_word);
  if (fits) return ok();
  return fail(
      Code::invalid_argument,
      in_quotes(printable(name)) +
          " cannot be the name of a class and a folder: write a letter, then letters, digits and _, " +
          std::to_string(kLongestName) + " at most, such as follow_light");
}

// "follow_light" becomes "FollowLight".
std::string class_name(const std::string& name) {
  std::string made;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') made += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = c == '_';
  }
  return made;
}

std::string replaced(std::string text, const std::map<std::string, std::string>& values) {
  for (const auto& [word, value] : values)
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += value.size())
      text.replace(at, word.size(), value);
  return text;
}

bool has_word(const std::string& text, const std::string& word) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) {
    const bool begins = at == 0 || !is_word(text[at - 1]);
    const std::size_t end = at + word.size();
    if (begins && (end == text.size() || !is_word(text[end]))) return true;
  }
  return false;
}

// Names that the template itself uses, and those that CMake keeps to itself.
Status check_is_free(const Files& files, const std::string& name) {
  static const std::set<std::string> targets{"all",     "clean",   "depend",        "edit_cache", "help",
                                             "install", "package", "rebuild_cache", "test"};
  const auto uses = [&](const Files::value_type& file) {
    return file.second.find("name=\"" + name + "\"") != std::string::npos ||
           (file.first.ends_with(".cpp") && has_word(file.second, class_name(name)));
  };
  if (!targets.contains(name) && std::ranges::none_of(files, uses)) return ok();
  return fail(Code::invalid_argument,
              in_quotes(name) +
                  " is the name of something else in such a folder; write another one, such as my_" + name);
}

Result<Files> read_template(const fs::path& folder) {
  Files files;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    Result<std::string> text = read_input_file(entry.path().string(), kLongestFile);
    if (!text) return text.error();
    files.emplace(entry.path().filename().string(), std::move(*text));
  }
  return files;
}

// Returns the name of what is made of a file of a template.
std::string made_of(const std::string& file) {
  return file.ends_with(kLink) ? file.substr(0, file.size() - kLink.size()) : file;
}

Status write(const fs::path& folder, const std::string& name, const std::string& text) {
  const fs::path path = folder / made_of(name);
  if (name.ends_with(kLink)) {
    std::error_code failure;
    fs::create_directory_symlink(text.substr(0, text.find('\n')), path, failure);
    return failure ? Status(fail(Code::unavailable, path.string() + ": " + failure.message())) : ok();
  }
  OutputFile file("the file");
  if (Status opened = file.open(path.string()); !opened.ok()) return opened;
  file.write(text);
  return file.close();
}

Status make(const fs::path& folder, const Files& files) {
  std::error_code failure;
  const bool made = fs::create_directory(folder, failure);
  if (!made && (!failure || failure == std::errc::file_exists))
    return fail(Code::already_exists, "there is a " + in_quotes(folder.string()) +
                                          " already, which stays as it is; write another name, or remove it");
  if (!made)
    return fail(Code::unavailable, "cannot make the folder " + folder.string() + ": " + failure.message());
  for (const auto& [name, text] : files)
    if (Status written = write(folder, name, text); !written.ok()) {
      fs::remove_all(folder, failure);
      return written;
    }
  return ok();
}

Status check_kind(const fs::path& templates, const std::string& kind) {
  std::set<std::string> kinds;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(templates, failure))
    kinds.insert(entry.path().filename().string());
  if (kinds.empty())
    return fail(Code::not_found, "there are no templates in " + templates.string() +
                                     "; install the package orca-tools anew, or build Orca with ./dev build");
  if (kinds.contains(kind)) return ok();
  return fail(Code::invalid_argument, "new expects one of " +
                                          listed(std::vector<std::string>(kinds.begin(), kinds.end())) +
                                          ", not " + in_quotes(printable(kind)));
}

// The commands of the README that was made, in their order.
std::string commands_of(const fs::path& folder) {
  static constexpr std::string_view kBegin = "```sh\n", kEnd = "```\n";
  const Result<std::string> text = read_input_file((folder / "README.md").string(), kLongestFile);
  const std::size_t begin = text ? text->find(kBegin) : std::string::npos;
  if (begin == std::string::npos) return {};
  const std::size_t from = begin + kBegin.size();
  return text->substr(from, text->find(kEnd, from) - from);
}

std::string own_programs() {
  return (fs::path(own_file("")).parent_path().parent_path().parent_path() / "bin").string();
}

bool is_in_path(const std::string& folder) {
  const char* const path = std::getenv("PATH");
  return path != nullptr && std::ranges::count(apps::split(path, ':'), folder) > 0;
}

}  // namespace

Result<std::vector<std::string>> make_folder(const fs::path& templates, const std::string& kind,
                                             const std::string& name) {
  if (Status named = check_name(name); !named.ok()) return named.error();
  if (Status known = check_kind(templates, kind); !known.ok()) return known.error();
  const Result<Files> read = read_template(templates / kind);
  if (!read) return read.error();
  if (Status is_free = check_is_free(*read, name); !is_free.ok()) return is_free.error();
  const std::string own = class_name(name);
  const std::map<std::string, std::string> values{{"@NAME@", name},
                                                  {"@CLASS@", own},
                                                  {"@TYPE@", "my." + own},
                                                  {"@ORCA@", fs::path(own_file("")).parent_path().string()},
                                                  {"@BIN@", own_programs()}};
  Files files;
  for (const auto& [file, text] : *read)
    if (!files.emplace(replaced(file, values), replaced(text, values)).second)
      return fail(Code::invalid_argument,
                  in_quotes(name) +
                      " is the name of another file in such a folder; write another one, such as my_" + name);
  if (Status made = make(name, files); !made.ok()) return made.error();
  std::vector<std::string> names;
  for (const auto& [file, text] : files) names.push_back(made_of(file));
  return names;
}

ExitCode handle_new(const apps::Call& call) {
  const std::string& name = call.words[1];
  const Result<std::vector<std::string>> made = make_folder(own_file("templates"), call.words[0], name);
  if (!made) {
    const bool misread = made.error().code == Code::invalid_argument;
    return report({made.error(), misread ? ExitCode::usage : ExitCode::refused});
  }
  print("# made " + name + ": " + listed(*made) + "\n");
  if (!is_in_path(own_programs())) print("export PATH=" + in_shell_quotes(own_programs()) + ":$PATH\n");
  print("cd " + name + "\n" + commands_of(name));
  return ExitCode::done;
}

}  // namespace orca::orcactl
