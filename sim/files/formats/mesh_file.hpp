// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/sim/mesh.hpp"

namespace orca::sim::detail {

inline constexpr std::size_t kMaxFaces = 1'000'000;

// Decode a mesh from the bytes of a whole file; `path` only appears in errors.
[[nodiscard]] Result<Mesh> decode_stl(std::string_view bytes, const std::string& path);
[[nodiscard]] Result<Mesh> decode_obj(std::string_view bytes, const std::string& path);

// Returns the name of the file's format if it is one that read_mesh() knows but does not read, such as "COLLADA"; else nothing.
// @errors  as read_mesh() where the file cannot be read at all.
[[nodiscard]] Result<std::string> foreign_mesh_format(const std::string& path);

// Adds a triangle, unless it has no area.
void add_triangle(Mesh& mesh, const Triangle& triangle);
// Checks a whole mesh. @errors  invalid_argument: no face at all, or a corner that is not finite or beyond
// 100 km.
[[nodiscard]] Status check_mesh(const Mesh& mesh, const std::string& path);
[[nodiscard]] Error too_many_faces(const std::string& path);

// The words of a text, with their lines.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  // Returns the next word; empty at the end.
  std::string_view next();
  // Returns the next word of the same line; empty at its end.
  std::string_view next_of_line();
  void skip_line();
  [[nodiscard]] bool at_end();
  [[nodiscard]] int line() const { return line_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

// Returns a whole word as a number; nothing if it is not a number.
[[nodiscard]] std::optional<double> number_of(std::string_view word);
[[nodiscard]] Error wrong_at(int line, const std::string& what, std::string_view found,
                             const std::string& path);

}  // namespace orca::sim::detail
