// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "orca/base/input_file.hpp"
#include "orca/robot_file/values.hpp"

namespace orca::sim {
namespace detail {
namespace {

bool near_enough(const Vec3& p) {
  return std::fabs(p.x) <= robot_file::values::kFarthest && std::fabs(p.y) <= robot_file::values::kFarthest &&
         std::fabs(p.z) <= robot_file::values::kFarthest;
}

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

void add_triangle(Mesh& mesh, const Triangle& t) {
  const Vec3 d{t[1].x - t[0].x, t[1].y - t[0].y, t[1].z - t[0].z};
  const Vec3 e{t[2].x - t[0].x, t[2].y - t[0].y, t[2].z - t[0].z};
  const bool flat = d.y * e.z == d.z * e.y && d.z * e.x == d.x * e.z && d.x * e.y == d.y * e.x;
  if (!flat) mesh.triangles.push_back(t);
}

Status check_mesh(const Mesh& mesh, const std::string& path) {
  if (mesh.triangles.empty()) return fail(Code::invalid_argument, "the mesh has no face with an area", path);
  for (const Triangle& t : mesh.triangles)
    if (!std::ranges::all_of(t, near_enough))
      return fail(Code::invalid_argument, "a corner of the mesh is not finite or farther than 100 km", path);
  return ok();
}

Error too_many_faces(const std::string& path) {
  return fail(Code::invalid_argument,
              "the mesh has more than 1000000 faces, the most that is read; simplify it", path);
}

std::string_view Words::next_of_line() {
  while (at_ < text_.size() && blank(text_[at_])) ++at_;
  const std::size_t start = at_;
  while (at_ < text_.size() && !blank(text_[at_]) && text_[at_] != '\n') ++at_;
  return text_.substr(start, at_ - start);
}

void Words::skip_line() {
  at_ = std::min(text_.find('\n', at_), text_.size());
  if (at_ == text_.size()) return;
  ++at_;
  ++line_;
}

bool Words::at_end() { return at_ >= text_.size(); }

std::string_view Words::next() {
  for (;;) {
    const std::string_view word = next_of_line();
    if (!word.empty() || at_end()) return word;
    skip_line();
  }
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

Error wrong_at(int line, const std::string& what, std::string_view found, const std::string& path) {
  const std::string shown = found.empty() ? "the end" : "\"" + std::string(found.substr(0, 40)) + "\"";
  return fail(Code::data_loss, "line " + std::to_string(line) + ": expected " + what + ", found " + shown,
              path);
}

}  // namespace detail

namespace {

constexpr std::uintmax_t kMaxMeshBytes = 400'000'000;  // A text of a million faces has 300 million.

Result<std::string> bytes_of(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return fail(Code::not_found, "there is no such mesh file", path);
  if (!std::filesystem::is_regular_file(status))
    return fail(Code::invalid_argument, "this is not a file; expected a mesh", path);
  if (std::filesystem::file_size(path, error) > kMaxMeshBytes)
    return fail(Code::invalid_argument,
                "the file is larger than 400 million bytes; at most 1000000 faces are read; simplify it",
                path);
  Result<std::string> bytes = read_input_file(path, kMaxMeshBytes);
  if (!bytes) return fail(bytes.error().code, "cannot read the mesh: " + bytes.error().message, path);
  if (bytes->empty()) return fail(Code::data_loss, "the file is empty; expected a mesh", path);
  return bytes;
}

bool ends_with(const std::string& path, std::string_view ending) {
  return path.size() >= ending.size() &&
         std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
}

// A binary STL has as many bytes as its number of faces says; a text one begins with "solid" and has facets.
bool looks_like_stl(std::string_view bytes) {
  constexpr std::size_t kHeader = 84, kFace = 50;
  if (bytes.size() >= kHeader) {
    std::uint32_t faces = 0;
    std::memcpy(&faces, bytes.data() + 80, sizeof faces);
    if (bytes.size() == kHeader + kFace * faces) return true;
  }
  return bytes.starts_with("solid") && bytes.find("facet") != std::string_view::npos;
}

// Returns the name of a format that is known but not read; empty: none of these.
std::string foreign_format(std::string_view bytes) {
  const std::string_view start = bytes.substr(0, 1000);
  if (start.find("<COLLADA") != std::string_view::npos) return "COLLADA";
  if (start.starts_with("glTF")) return "glTF";
  if (start.starts_with("ply\n") || start.starts_with("ply\r")) return "PLY";
  if (start.starts_with("Kaydara FBX")) return "FBX";
  return "";
}

}  // namespace

Result<std::string> detail::foreign_mesh_format(const std::string& path) {
  const Result<std::string> bytes = bytes_of(path);
  if (!bytes) return bytes.error();
  return foreign_format(*bytes);
}

Result<Mesh> read_mesh(const std::string& path) {
  const Result<std::string> bytes = bytes_of(path);
  if (!bytes) return bytes.error();
  const bool stl = looks_like_stl(*bytes) || ends_with(path, ".stl");
  if (const std::string foreign = foreign_format(*bytes); !foreign.empty())
    return fail(Code::invalid_argument, "this is a " + foreign + " file; convert it to STL or OBJ", path);
  if (!stl && !ends_with(path, ".obj"))
    return fail(Code::invalid_argument,
                "this is no STL file, and its name does not end in .obj; convert the mesh to STL or OBJ",
                path);
  Result<Mesh> mesh = stl ? detail::decode_stl(*bytes, path) : detail::decode_obj(*bytes, path);
  if (!mesh) return mesh.error();
  if (const Status sound = detail::check_mesh(*mesh, path); !sound) return sound.error();
  return mesh;
}

}  // namespace orca::sim
