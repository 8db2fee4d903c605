// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <zlib.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "public_data.hpp"

namespace orca::test {

/// Returns the text of a compressed file of public data; none, if it is not there.
inline std::string public_text(const std::string& file) {
  const std::string path = public_data(file);
  std::string text;
  if (path.empty()) return text;
  const gzFile in = gzopen(path.c_str(), "rb");
  if (in == nullptr) throw std::runtime_error("cannot open " + path);
  std::vector<char> part(1 << 16);
  for (int count = 0; (count = gzread(in, part.data(), static_cast<unsigned>(part.size()))) > 0;)
    text.append(part.data(), static_cast<std::size_t>(count));
  gzclose(in);
  return text;
}

}  // namespace orca::test
