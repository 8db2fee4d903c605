// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <string>

#include "mesh_file.hpp"

// Wavefront OBJ, of which only corners (v) and faces (f) matter here.
namespace orca::sim::detail {
namespace {

bool is_ignored(std::string_view word) {
  static constexpr std::array<std::string_view, 14> kOthers{
      "vn", "vt", "vp", "o", "g", "s", "l", "p", "usemtl", "mtllib", "usemap", "maplib", "lod", "mg"};
  return word.starts_with('#') || std::ranges::find(kOthers, word) != kOthers.end();
}

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& path) : words_(text), path_(path) {}

  Result<Mesh> read() {
    for (; !words_.at_end(); words_.skip_line()) {
      const std::string_view word = words_.next_of_line();
      if (word == "v") {
        if (const Status s = corner(); !s) return s.error();
      } else if (word == "f") {
        if (const Status s = face(); !s) return s.error();
      } else if (!word.empty() && !is_ignored(word)) {
        return wrong_at(words_.line(), "v, f or another word of OBJ", word, path_);
      }
    }
    return mesh_;
  }

 private:
  Status corner() {
    Vec3 v;
    for (double* value : {&v.x, &v.y, &v.z}) {
      const std::string_view found = words_.next_of_line();
      const auto number = number_of(found);
      if (!number) return wrong_at(words_.line(), "a number", found, path_);
      *value = *number;
    }
    corners_.push_back(v);
    return ok();
  }

  // "7", "7/1", "7//3"; negative: counted from the last corner back.
  [[nodiscard]] const Vec3* corner_of(std::string_view word) const {
    word = word.substr(0, word.find('/'));
    long number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size()) return nullptr;
    const auto count = static_cast<long>(corners_.size());
    if (number == 0 || number > count || number < -count) return nullptr;
    return &corners_[static_cast<std::size_t>(number > 0 ? number - 1 : count + number)];
  }

  Status face() {
    std::vector<Vec3> corners;
    for (std::string_view word = words_.next_of_line(); !word.empty(); word = words_.next_of_line()) {
      const Vec3* const v = corner_of(word);
      if (v == nullptr) return wrong_at(words_.line(), "the number of a corner before it", word, path_);
      corners.push_back(*v);
    }
    if (corners.size() < 3) return wrong_at(words_.line(), "three corners of a face", "", path_);
    faces_ += corners.size() - 2;
    if (faces_ > kMaxFaces) return too_many_faces(path_);
    for (std::size_t i = 2; i < corners.size(); ++i)
      add_triangle(mesh_, {corners[0], corners[i - 1], corners[i]});
    return ok();
  }

  Words words_;
  const std::string& path_;
  std::vector<Vec3> corners_;
  std::size_t faces_ = 0;
  Mesh mesh_;
};

}  // namespace

Result<Mesh> decode_obj(std::string_view bytes, const std::string& path) {
  return ObjReader(bytes, path).read();
}

}  // namespace orca::sim::detail
