// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/keys/authority.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "crypto.hpp"
#include "key_files.hpp"
#include "orca/base/files/key_folder.hpp"
#include "policies.hpp"

namespace orca::keys {
namespace {

using namespace std::chrono_literals;

constexpr auto kLifeOfAuthority = std::chrono::years(20);

std::int64_t to_seconds(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
}

Span span_of(const Validity& validity) { return {to_seconds(validity.from), to_seconds(validity.until)}; }

// The authority of a system, with its list of certificates.
class Authority {
 public:
  static Result<Authority> make(const std::string& folder, const Validity& validity) {
    Validity own = validity;
    own.until = std::max(own.until, own.from + kLifeOfAuthority);
    Result<KeyPair> pair = make_pair("orca authority " + random_digits(), span_of(own), nullptr);
    if (!pair) return pair.error();
    Authority made(folder, std::move(pair).value());
    for (const std::string& path : {folder, made.own_folder()})
      if (Status there = make_own_folder(path); !there.ok()) return there.error();
    if (Status kept = write_own(made.own_folder() + "/" + kAuthorityKeyFile, to_pem(*made.pair_.key));
        !kept.ok())
      return kept.error();
    if (Status kept = made.write(made.own_folder(), kAuthorityFile, to_pem(*made.pair_.certificate));
        !kept.ok())
      return kept.error();
    return made;
  }

  static Result<Authority> read(const std::string& folder) {
    const std::string own = folder + "/" + kAuthorityFolder;
    const Result<std::string> key_text = read_own(own + "/" + kAuthorityKeyFile);
    if (!key_text) return key_text.error();
    const Result<std::string> certificate_text = read_own(own + "/" + kAuthorityFile);
    if (!certificate_text) return certificate_text.error();
    Result<Key> key = key_of_pem(*key_text);
    if (!key) return key.error();
    Result<X509Ptr> certificate = certificate_of_pem(*certificate_text);
    if (!certificate) return certificate.error();
    Authority read(folder, {std::move(key).value(), std::move(certificate).value()});
    Result<CertificateList> list = read_list(own + "/" + kListFile, *read.pair_.certificate);
    if (!list) return list.error();
    read.list_ = std::move(list).value();
    return read;
  }

  // Makes the files of a process.
  Status issue(const Permit& permit, const Validity& validity) {
    const Span span = span_of(validity);
    const std::string subject = random_digits();
    const Result<KeyPair> pair = make_pair(subject, span, &pair_);
    if (!pair) return pair.error();
    const std::string folder = folder_ + "/" + key_folder_name(permit.machine);
    if (Status there = make_own_folder(folder); !there.ok()) return there;
    const Result<std::string> rules = sign(permissions(rfc_name(*pair->certificate), permit, span), pair_);
    if (!rules) return rules.error();
    if (Status kept = write(folder, key_file_name(permit.process), to_pem(*pair->key)); !kept.ok())
      return kept;
    if (Status kept = write(folder, certificate_file(permit.process), to_pem(*pair->certificate)); !kept.ok())
      return kept;
    if (Status kept = write(folder, permissions_file(permit.process), *rules); !kept.ok()) return kept;
    list_.certificates.push_back({subject, permit.machine, permit.process, span.until, false});
    return ok();
  }

  // Marks the certificates of a process or machine, and returns whose they were.
  std::set<std::string> revoke(const std::string& name) {
    std::set<std::string> revoked;
    for (Certificate& each : list_.certificates) {
      if (each.process != name && each.machine != name) continue;
      each.revoked = true;
      revoked.insert("process " + each.process + (each.machine.empty() ? "" : " of machine " + each.machine));
    }
    return revoked;
  }

  // Signs the list, and gives each machine its copy and what it needs beside.
  Status publish(std::int64_t now) {
    std::erase_if(list_.certificates, [now](const Certificate& each) { return each.not_after < now; });
    ++list_.edition;
    const Result<std::string> list = sign(print(list_), pair_);
    if (!list) return list.error();
    const Result<std::string> rules = sign(governance(), pair_);
    if (!rules) return rules.error();
    std::set<std::string> folders;
    for (const Certificate& each : list_.certificates)
      folders.insert(folder_ + "/" + key_folder_name(each.machine));
    for (const std::string& folder : folders) {
      if (const Status there = prove_own_folder(folder); !there.ok()) {
        if (there.error().code == Code::not_found) continue;  // of a machine that the graph has no more
        return there;
      }
      if (Status kept = write(folder, kAuthorityFile, to_pem(*pair_.certificate)); !kept.ok()) return kept;
      if (Status kept = write(folder, kGovernanceFile, *rules); !kept.ok()) return kept;
      if (Status kept = write(folder, kListFile, *list); !kept.ok()) return kept;
    }
    return write(own_folder(), kListFile, *list);
  }

 private:
  Authority(std::string folder, KeyPair pair) : folder_(std::move(folder)), pair_(std::move(pair)) {}

  [[nodiscard]] std::string own_folder() const { return folder_ + "/" + kAuthorityFolder; }
  static Status write(const std::string& folder, const std::string& file, const std::string& contents) {
    return write_own(folder + "/" + file, contents);
  }

  std::string folder_;
  KeyPair pair_;
  CertificateList list_;
};

std::int64_t now() { return to_seconds(std::chrono::system_clock::now()); }

Status issue_all(Authority& authority, const std::vector<Permit>& permits, const Validity& validity) {
  for (const Permit& permit : permits)
    if (Status issued = authority.issue(permit, validity); !issued.ok()) return issued;
  return authority.publish(now());
}

}  // namespace

Status make_keys(const std::string& folder, const std::vector<Permit>& permits, const Validity& validity) {
  const std::string key = folder + "/" + kAuthorityFolder + "/" + kAuthorityKeyFile;
  if (const Result<std::string> there = read_own(key); there || there.error().code != Code::not_found)
    return fail(Code::already_exists, "there is an authority already: " + key);
  Result<Authority> authority = Authority::make(folder, validity);
  if (!authority) return authority.error();
  return issue_all(*authority, permits, validity);
}

Status renew_keys(const std::string& folder, const std::vector<Permit>& permits, const Validity& validity) {
  Result<Authority> authority = Authority::read(folder);
  if (!authority) return authority.error();
  return issue_all(*authority, permits, validity);
}

Result<std::vector<std::string>> revoke_keys(const std::string& folder, const std::string& name,
                                             const std::vector<Permit>& permits, const Validity& validity) {
  Result<Authority> authority = Authority::read(folder);
  if (!authority) return authority.error();
  const std::set<std::string> revoked = authority->revoke(name);
  if (revoked.empty()) return fail(Code::not_found, "the authority has issued no certificate for " + name);
  std::vector<Permit> again;
  for (const Permit& permit : permits)
    if (permit.process == name || permit.machine == name) again.push_back(permit);
  if (Status issued = issue_all(*authority, again, validity); !issued.ok()) return issued.error();
  return std::vector<std::string>(revoked.begin(), revoked.end());
}

}  // namespace orca::keys
