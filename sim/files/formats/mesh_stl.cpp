// SPDX-License-Identifier: LGPL-3.0-or-later
#include <bit>
#include <cstdint>

#include "mesh_file.hpp"

// STL, binary: 80 bytes of anything, the number of triangles as a 32-bit integer, then 50 bytes for each:
// normal and three corners as 32-bit floats, two bytes of anything; all little-endian. Normals are not
// needed.
namespace orca::sim::detail {
namespace {

constexpr std::size_t kHeader = 84;
constexpr std::size_t kRecord = 50;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return word;
}

double float_at(std::string_view bytes, std::size_t at) { return std::bit_cast<float>(word_at(bytes, at)); }

Result<Mesh> decode_binary(std::string_view bytes, const std::string& path) {
  const std::size_t count = word_at(bytes, 80);
  if (count > kMaxFaces) return too_many_faces(path);
  const std::size_t expected = kHeader + count * kRecord;
  if (bytes.size() < expected)
    return fail(Code::data_loss,
                "the file is torn: " + std::to_string(count) + " faces need " + std::to_string(expected) +
                    " bytes, and there are " + std::to_string(bytes.size()),
                path);
  Mesh mesh;
  for (std::size_t at = kHeader; at < expected; at += kRecord) {
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t corner = at + 12 * (k + 1);
      t[k] = {float_at(bytes, corner), float_at(bytes, corner + 4), float_at(bytes, corner + 8)};
    }
    add_triangle(mesh, t);
  }
  return mesh;
}

// Reads the text form, word by word.
class Text {
 public:
  Text(std::string_view text, const std::string& path) : words_(text), path_(path) {}

  Result<Mesh> read() {
    words_.skip_line();  // "solid" and a name.
    Mesh mesh;
    for (std::size_t faces = 0;; ++faces) {
      const std::string_view word = words_.next();
      if (word == "endsolid") {
        const Result<bool> another = next_solid();
        if (!another) return another.error();
        if (!*another) return mesh;
        continue;
      }
      if (word != "facet") return wrong_at(words_.line(), "facet or endsolid", word, path_);
      if (faces == kMaxFaces) return too_many_faces(path_);
      if (const Status s = facet(mesh); !s) return s.error();
    }
  }

 private:
  // A file may have several; their names are of no interest.
  Result<bool> next_solid() {
    words_.skip_line();
    const std::string_view word = words_.next();
    if (word.empty()) return false;
    if (word != "solid") return wrong_at(words_.line(), "solid", word, path_);
    words_.skip_line();
    return true;
  }

  Status facet(Mesh& mesh) {
    Vec3 normal;
    if (const Status s = vector("normal", normal); !s) return s;
    for (const char* word : {"outer", "loop"})
      if (const Status s = expect(word); !s) return s;
    Triangle t;
    for (Vec3& corner : t)
      if (const Status s = vector("vertex", corner); !s) return s;
    add_triangle(mesh, t);
    for (const char* word : {"endloop", "endfacet"})
      if (const Status s = expect(word); !s) return s;
    return ok();
  }

  Status expect(const char* word) {
    const std::string_view found = words_.next();
    if (found == word) return ok();
    return wrong_at(words_.line(), word, found, path_);
  }

  Status vector(const char* word, Vec3& v) {
    if (const Status s = expect(word); !s) return s;
    for (double* value : {&v.x, &v.y, &v.z}) {
      const std::string_view found = words_.next();
      const auto number = number_of(found);
      if (!number) return wrong_at(words_.line(), "a number", found, path_);
      *value = *number;
    }
    return ok();
  }

  Words words_;
  const std::string& path_;
};

}  // namespace

// Some binary files also begin with "solid", so a file whose size fits exactly is taken as binary.
Result<Mesh> decode_stl(std::string_view bytes, const std::string& path) {
  const bool has_header = bytes.size() >= kHeader;
  const bool fits = has_header && bytes.size() == kHeader + std::size_t{word_at(bytes, 80)} * kRecord;
  if (!fits && bytes.starts_with("solid")) return Text(bytes, path).read();
  if (!has_header)
    return fail(Code::data_loss, "the file is too short for an STL mesh: neither \"solid\" nor a header",
                path);
  return decode_binary(bytes, path);
}

}  // namespace orca::sim::detail
