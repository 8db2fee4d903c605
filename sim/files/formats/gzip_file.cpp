// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gzip_file.hpp"

#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "orca/base/input_file.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::size_t kLargest = 64'000'000;  // [bytes]

struct Close {
  void operator()(gzFile file) const { gzclose(file); }
};
using File = std::unique_ptr<gzFile_s, Close>;

// Returns the reason why reading ended early, or nothing.
std::string fault_of(gzFile file) {
  int code = Z_OK;
  const char* const text = gzerror(file, &code);
  if (code == Z_OK || code == Z_STREAM_END) return {};
  return code == Z_ERRNO ? std::strerror(errno) : text;
}

}  // namespace

Result<std::string> read_maybe_packed(const std::string& path) {
  std::error_code unused;
  // zlib would wait for ever for the writer of a pipe.
  if (std::filesystem::is_other(path, unused))
    return fail(Code::invalid_argument, "cannot read the file: it is a pipe or a device");
  remember_input_file(path);
  errno = 0;
  const File file(gzopen(path.c_str(), "rb"));
  if (file == nullptr)
    return fail(Code::not_found, std::string("cannot read the file: ") + std::strerror(errno));
  std::string all;
  std::vector<char> buffer(1 << 16);
  int got = 0;
  while ((got = gzread(file.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0) {
    all.append(buffer.data(), static_cast<std::size_t>(got));
    if (all.size() > kLargest) return fail(Code::invalid_argument, "the file holds more than 64 MB");
  }
  if (const std::string fault = fault_of(file.get()); !fault.empty())
    return fail(Code::data_loss, "cannot read the file: " + fault);
  if (all.empty()) return fail(Code::data_loss, "the file is empty");
  return all;
}

}  // namespace orca::sim::detail
