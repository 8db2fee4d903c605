// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh_place.hpp"

#include <filesystem>

#include "mesh_file.hpp"
#include "orca/robot_file/named_file.hpp"

namespace orca::sim::detail {

namespace fs = std::filesystem;

Result<MeshPlace> find_mesh(const std::string& name, const std::string& robot_file,
                            const std::string& packages) {
  const Result<std::string> named = robot_file::find_named_file(name, robot_file, packages);
  if (!named) return named.error();
  const Result<std::string> foreign = foreign_mesh_format(*named);
  if (!foreign || foreign->empty()) return MeshPlace{*named};
  std::error_code ignored;
  for (const char* const ending : {".stl", ".STL", ".obj", ".OBJ"})
    if (const fs::path other = fs::path(*named).replace_extension(ending);
        fs::is_regular_file(other, ignored))
      return MeshPlace{other.string(), true};
  return fail(
      Code::invalid_argument,
      "this is a " + *foreign +
          " file, which is not read; put the same mesh as STL or OBJ beside it, as made by \"assimp export " +
          fs::path(*named).filename().string() + " " +
          fs::path(*named).filename().replace_extension(".stl").string() +
          "\", or describe the body by boxes and cylinders",
      *named);
}

}  // namespace orca::sim::detail
