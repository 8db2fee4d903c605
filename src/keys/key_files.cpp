// SPDX-License-Identifier: LGPL-3.0-or-later
#include "key_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "orca/base/descriptor.hpp"
#include "orca/base/files/key_folder.hpp"

namespace orca::keys {
namespace {

constexpr mode_t kOwnFolder = 0700;
constexpr mode_t kOwnFile = 0600;
constexpr mode_t kOthers = S_IRWXG | S_IRWXO;
constexpr std::size_t kLargest = std::size_t{16} << 20;  // [bytes] of a file

Error refused(const std::string& path) {
  const Code code = errno == ENOENT ? Code::not_found : Code::unavailable;
  return fail(code, path + ": " + std::strerror(errno));
}

Status prove(const struct stat& found, const std::string& path, const char* mode) {
  if (found.st_uid != geteuid())
    return fail(Code::unavailable, path + " belongs to user " + std::to_string(found.st_uid) +
                                       ", and keys must belong to who uses them: chown " +
                                       std::to_string(geteuid()) + " '" + path + "'");
  if ((found.st_mode & kOthers) != 0)
    return fail(Code::unavailable, path + " can be used by others, so its keys prove nothing: chmod " + mode +
                                       " '" + path + "', or make new keys");
  return ok();
}

}  // namespace

std::string certificate_file(const std::string& process) { return as_file_name(process) + ".pem"; }
std::string permissions_file(const std::string& process) {
  return as_file_name(process) + ".permissions.p7s";
}

Status prove_own_folder(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return refused(path);
  if (!S_ISDIR(found.st_mode)) return fail(Code::unavailable, path + " is no folder");
  return prove(found, path, "0700");
}

Status make_own_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  if (mkdir(path.c_str(), kOwnFolder) != 0 && errno != EEXIST) return refused(path);
  return prove_own_folder(path);
}

Result<std::string> read_own(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat found {};
  if (!file || fstat(file.number(), &found) != 0) return refused(path);
  if (!S_ISREG(found.st_mode)) return fail(Code::unavailable, path + " is no file");
  if (Status proven = prove(found, path, "0600"); !proven.ok()) return proven.error();
  std::string contents;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t size = ::read(file.number(), part.data(), part.size());
    if (size < 0) return refused(path);
    if (size == 0) return contents;
    contents.append(part.data(), static_cast<std::size_t>(size));
    if (contents.size() > kLargest) return fail(Code::unavailable, path + " is too large for what it is");
  }
}

Status write_own(const std::string& path, const std::string& contents) {
  const std::string other = path + ".new";
  ::unlink(other.c_str());
  {
    const Descriptor file(::open(other.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kOwnFile));
    if (!file) return refused(other);
    for (std::size_t at = 0; at < contents.size();) {
      const ssize_t size = ::write(file.number(), contents.data() + at, contents.size() - at);
      if (size < 0) return refused(other);
      at += static_cast<std::size_t>(size);
    }
    if (::fsync(file.number()) != 0) return refused(other);
  }
  return ::rename(other.c_str(), path.c_str()) == 0 ? ok() : Status(refused(path));
}

Result<CertificateList> read_list(const std::string& path, X509& authority) {
  const Result<std::string> message = read_own(path);
  if (!message) return message.error();
  const Result<std::string> text = signed_text(*message, authority);
  if (!text) return fail(text.error().code, path + ": " + text.error().message);
  Result<CertificateList> list = parse_certificates(*text);
  if (!list) return fail(list.error().code, path + ": " + list.error().message);
  return list;
}

}  // namespace orca::keys
