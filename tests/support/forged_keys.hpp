// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "crypto.hpp"
#include "key_files.hpp"
#include "orca/base/files/key_folder.hpp"
#include "policies.hpp"

namespace orca::test {

/// Makes keys that another authority has issued, with the subject of a process of a system, which everybody in the network hears.
/// @param machine  folder of keys that the system has.
/// @param folder   gets the forged ones.
inline void forge_keys(const std::string& machine, const std::string& process, const std::string& folder) {
  const auto text_of = [](const std::string& file) {
    std::ifstream in(file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const auto must = [](const auto& done) {
    if (!done) throw std::runtime_error("no keys can be forged");
  };
  const auto write = [&](const std::string& name, const std::string& text) {
    if (!keys::write_own(folder + "/" + name, text).ok()) throw std::runtime_error("cannot write " + name);
  };
  const auto authority_now = keys::certificate_of_pem(text_of(machine + "/" + keys::kAuthorityFile));
  const auto true_one = keys::certificate_of_pem(text_of(machine + "/" + keys::certificate_file(process)));
  must(authority_now), must(true_one);
  const std::string subject = keys::common_name(**true_one);
  const keys::Span span = keys::span_of(**true_one);
  const auto authority = keys::make_pair(keys::common_name(**authority_now), span, nullptr);
  must(authority);
  const auto pair = keys::make_pair(subject, span, &*authority);
  must(pair);
  const std::string rules =
      keys::permissions(keys::rfc_name(*pair->certificate), {"", process, {"*"}, {"*"}}, span);
  const auto list = keys::read_list(machine + "/" + keys::kListFile, **authority_now);
  must(list);
  if (!keys::make_own_folder(folder).ok()) throw std::runtime_error("no folder " + folder);
  // The forger believes the system's processes, so that it is they who refuse.
  write(keys::kAuthorityFile, keys::to_pem(*authority->certificate) + keys::to_pem(**authority_now));
  write(keys::certificate_file(process), keys::to_pem(*pair->certificate));
  write(key_file_name(process), keys::to_pem(*pair->key));
  write(keys::permissions_file(process), keys::sign(rules, *authority).value());
  write(keys::kGovernanceFile, keys::sign(keys::governance(), *authority).value());
  write(keys::kListFile, keys::sign(keys::print(*list), *authority).value());
}

}  // namespace orca::test
