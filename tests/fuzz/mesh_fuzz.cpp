// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a sound mesh or an error: an STL file, binary or text, or an OBJ file. The first byte
// chooses which.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "files/formats/mesh_file.hpp"

namespace {

// Checks that a mesh that was found sound can be used in computations.
void check(const orca::sim::Mesh& mesh) {
  const auto [low, high] = height_range_of(mesh);
  if (!(low <= high)) std::abort();
  for (const double height : {low, 0.5 * (low + high)})
    for (const orca::sim::Segment& edge : section_of(mesh, height).edges)
      if (!std::isfinite(edge.a.x + edge.a.y + edge.b.x + edge.b.y)) std::abort();
  static_cast<void>(plan_of(mesh));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const bool stl = data[0] != 'o';
  const auto mesh = stl ? orca::sim::detail::decode_stl(bytes, "fuzz.stl")
                        : orca::sim::detail::decode_obj(bytes, "fuzz.obj");
  if (mesh && orca::sim::detail::check_mesh(*mesh, "fuzz").ok()) check(*mesh);
  return 0;
}
