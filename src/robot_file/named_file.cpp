// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/robot_file/named_file.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "orca/base/text.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/extras.hpp"
#include "orca/xml/number.hpp"

namespace orca::robot_file {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// Returns whether a folder is that of a package: by its own name, or by that in its package.xml.
bool is_package(const fs::path& folder, const std::string& package) {
  if (folder.filename() == package) return true;
  if (!is_file(folder / "package.xml")) return false;
  xml::Diagnostics ignored;
  const Result<std::string> text = xml::read_bytes((folder / "package.xml").string());
  const auto document = text ? xml::read_text(xml::without_extras(*text), "", ignored) : std::nullopt;
  if (!document) return false;
  for (const xml::Element& e : document->root.children())
    if (e.name() == "name") return xml::trimmed(e.text()) == package;
  return false;
}

std::optional<fs::path> find_above(const fs::path& robot_file, const std::string& package,
                                   const fs::path& rest) {
  for (fs::path folder = fs::absolute(robot_file).parent_path();; folder = folder.parent_path()) {
    if (is_file(folder / package / rest)) return folder / package / rest;
    if (is_package(folder, package) && is_file(folder / rest)) return folder / rest;
    if (folder == folder.parent_path()) return std::nullopt;
  }
}

Result<fs::path> path_in_package(const std::string& name, const std::string& inside,
                                 const std::string& robot_file, const std::string& packages) {
  const std::string package = inside.substr(0, inside.find('/'));
  const fs::path rest = inside.substr(std::min(package.size() + 1, inside.size()));
  if (!packages.empty()) {
    if (const fs::path path = fs::path(packages) / package / rest; is_file(path)) return path;
    return fail(Code::not_found,
                in_quotes(name) + ": there is no such file in the folder of packages, " + packages);
  }
  if (const auto found = find_above(robot_file, package, rest)) return *found;
  return fail(Code::not_found, in_quotes(name) + ": no folder above this file is or holds a package " +
                                   in_quotes(package) +
                                   " with that file; set the parameter packages to the folder that holds " +
                                   in_quotes(package) + ", or write the path");
}

Result<fs::path> path_of(const std::string& name, const std::string& robot_file,
                         const std::string& packages) {
  const std::size_t scheme = name.find("://");
  if (scheme == std::string::npos) return fs::path(robot_file).parent_path() / name;
  const std::string behind = name.substr(scheme + 3);
  if (name.starts_with("file://")) return fs::path(robot_file).parent_path() / behind;
  if (name.starts_with("package://") || name.starts_with("model://"))
    return path_in_package(name, behind, robot_file, packages);
  return fail(
      Code::invalid_argument,
      in_quotes(name) +
          " cannot be looked up; write package://PACKAGE/PATH, or the path, beside this file or from /");
}

}  // namespace

Result<std::string> find_named_file(const std::string& name, const std::string& robot_file,
                                    const std::string& packages) {
  const Result<fs::path> path = path_of(name, robot_file, packages);
  if (!path) return path.error();
  return path->lexically_normal().string();
}

}  // namespace orca::robot_file
