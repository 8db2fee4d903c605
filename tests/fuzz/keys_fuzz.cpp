// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever stands in a file of keys, it is refused with a reason or means the same when it is written again. The first byte chooses what
// the rest is.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "crypto.hpp"
#include "key_files.hpp"
#include "orca/keys/certificate_list.hpp"
#include "orca/keys/server_certificate.hpp"

namespace {

using namespace orca;
using namespace orca::keys;

void check(bool holds) {
  if (!holds) std::abort();
}

template <class T>
bool is_read(const Result<T>& read) {
  check(read || !read.error().message.empty());
  return static_cast<bool>(read);
}

void try_list(std::string_view text) {
  const Result<CertificateList> list = parse_certificates(text);
  if (!is_read(list)) return;
  const Result<CertificateList> again = parse_certificates(print(*list));
  check(again && print(*again) == print(*list));
}

void try_certificate(std::string_view text) {
  const Result<X509Ptr> certificate = certificate_of_pem(text);
  if (!is_read(certificate)) return;
  (void)span_of(**certificate);
  (void)rfc_name(**certificate);
  (void)hash_of_name(common_name(**certificate));
  check(static_cast<bool>(certificate_of_pem(to_pem(**certificate))));
}

void try_key(std::string_view text) {
  const Result<Key> key = key_of_pem(text);
  if (is_read(key)) check(static_cast<bool>(key_of_pem(to_pem(**key))));
}

// Signed by nobody whom it knows: a text that is not proven is never used.
void try_signed(std::string_view text) {
  static const KeyPair authority = make_pair("orca authority", {0, 4'000'000'000}, nullptr).value();
  check(!is_read(signed_text(text, *authority.certificate)));
}

// A file that nobody else may read.
struct OwnFile {
  OwnFile() { check(write_own(path, "").ok()); }
  ~OwnFile() { std::filesystem::remove(path); }
  std::string path =
      (std::filesystem::temp_directory_path() / ("orca-keys-fuzz-" + std::to_string(getpid()))).string();
};

void try_server(const std::string& text) {
  static const OwnFile file;
  std::ofstream(file.path, std::ios::binary) << text;
  const Result<ServerCertificate> server = read_server_certificate(file.path, std::time(nullptr));
  if (!is_read(server)) return;
  check(!server->names.empty() && certificate_of_pem(server->chain));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  switch (data[0] % 5) {
    case 0: try_list(text); break;
    case 1: try_certificate(text); break;
    case 2: try_key(text); break;
    case 3: try_signed(text); break;
    default: try_server(text); break;
  }
  return 0;
}
