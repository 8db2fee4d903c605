// SPDX-License-Identifier: GPL-3.0-or-later
// Writes seeds for keys_fuzz into a folder: one of each kind of file, with keys that are made here and used for nothing else.
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "crypto.hpp"
#include "orca/keys/certificate_list.hpp"
#include "orca/keys/server_certificate.hpp"

namespace {

using namespace orca::keys;

void write_seed(const std::string& path, char kind, const std::string& text) {
  std::ofstream(path, std::ios::binary) << kind << text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: keys_seeds FOLDER\n";
    return 2;
  }
  const std::string folder = argv[1];
  const CertificateList list{3,
                             {{std::string(32, 'a'), "", "brain", 1'900'000'000, false},
                              {std::string(32, 'b'), "base", "+peers", 1'900'000'000, true}}};
  const KeyPair pair = make_pair("orca authority", {0, 4'000'000'000}, nullptr).value();
  const auto server =
      own_server_certificate(folder + "/server", {"robot", "10.0.0.7", "[fd00::7]"}, std::time(nullptr))
          .value();
  std::filesystem::remove_all(folder + "/server");
  write_seed(folder + "/list", 0, print(list));
  write_seed(folder + "/certificate", 1, to_pem(*pair.certificate));
  write_seed(folder + "/key", 2, to_pem(*pair.key));
  write_seed(folder + "/signed", 3, sign(print(list), pair).value());
  write_seed(folder + "/server_file", 4, server.key + server.chain);
  return 0;
}
