// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "foxglove/assets.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "orca/base/descriptor.hpp"
#include "orca/base/text.hpp"
#include "orca/robot_file/named_file.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/extras.hpp"
#include "outbox.hpp"

namespace orca::view {
namespace {

namespace fs = std::filesystem;

bool is_asset(const fs::path& path) {
  static const std::set<std::string> endings{".urdf", ".stl", ".obj", ".dae",  ".glb",
                                             ".gltf", ".ply", ".png", ".jpeg", ".jpg"};
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return endings.contains(ending);
}

// Collects the names of meshes and textures in an element and all that it holds. The reader bounds how deep that is.
void collect_names(const xml::Element& element, std::set<std::string>& names) {
  const xml::Attribute* const name = element.attribute("filename");
  if (name != nullptr && (element.name() == "mesh" || element.name() == "texture")) names.insert(name->value);
  for (const xml::Element& child : element.children()) collect_names(child, names);
}

std::set<std::string> names_in(const RobotFile& robot) {
  std::set<std::string> names;
  xml::Diagnostics ignored;  // the deployer has told them
  const auto document = xml::read_text(xml::without_extras(robot.text), robot.path, ignored);
  if (document) collect_names(document->root, names);
  return names;
}

}  // namespace

Result<std::string> read_asset(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  if (error) return fail(Code::not_found, error.message(), path);
  if (!is_asset(real))
    return fail(Code::failed_precondition, "this is no robot's file, no mesh and no picture", path);
  const Descriptor file(::open(real.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW));
  struct stat facts {};
  if (!file || fstat(file.number(), &facts) != 0 || !S_ISREG(facts.st_mode))
    return fail(Code::not_found, "this is no file that can be read", path);
  const auto size = static_cast<std::size_t>(facts.st_size);
  if (size > kLargestAsset)
    return fail(Code::unavailable, "the file is larger than " + std::to_string(kLargestAsset) + " bytes",
                path);
  std::string content(size, '\0');
  if (::read(file.number(), content.data(), size) != facts.st_size)
    return fail(Code::not_found, "the file changes while it is read", path);
  return content;
}

Assets::Assets(const std::vector<RobotFile>& robots) {
  for (const RobotFile& robot : robots) {
    add(robot.path);
    for (const std::string& name : names_in(robot)) {
      const Result<std::string> path = robot_file::find_named_file(name, robot.path, robot.packages);
      if (!path) continue;
      paths_.emplace(name, *path);
      add(*path);
    }
  }
}

void Assets::add(const std::string& path) {
  paths_.emplace(path, path);
  paths_.emplace("file://" + fs::absolute(path).lexically_normal().string(), path);
}

Result<std::string> Assets::read(const std::string& uri) const {
  const auto found = paths_.find(uri);
  if (found == paths_.end())
    return fail(Code::not_found, "no robot's file of this system names " + in_quotes(uri));
  return read_asset(found->second);
}

std::string asset_response(std::uint32_t request, const Result<std::string>& content) {
  constexpr char kAsset = '\x04';
  const std::string error = content ? std::string() : content.error().text();
  std::string message(1, kAsset);
  append(message, request);
  message += content ? '\0' : '\1';
  append(message, static_cast<std::uint32_t>(error.size()));
  return message + (content ? *content : error);
}

}  // namespace orca::view
