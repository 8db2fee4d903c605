// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/keys/key_ring.hpp"

#include <sys/stat.h>

#include "crypto.hpp"
#include "key_files.hpp"
#include "orca/base/files/key_folder.hpp"

namespace orca::keys {
namespace {

// What the files of a process hold.
struct Files {
  X509Ptr authority;
  X509Ptr certificate;
};

Error of_file(const Error& error, const std::string& path) {
  return fail(error.code, path + ": " + error.message);
}

Error useless(const Error& why, const std::string& folder, const std::string& process) {
  return fail(why.code,
              "security is on, and process " + process + " has no keys that can be used: " + why.message +
                  "; make keys with orcactl keys GRAPH and copy this machine's folder to " + folder);
}

Result<X509Ptr> read_certificate(const std::string& path) {
  const Result<std::string> text = read_own(path);
  if (!text) return text.error();
  Result<X509Ptr> certificate = certificate_of_pem(*text);
  if (!certificate) return of_file(certificate.error(), path);
  return certificate;
}

// The library for DDS proves the rest of these two, and does not say which file is at fault.
Status prove_signed(const std::string& path, X509& authority) {
  const Result<std::string> message = read_own(path);
  if (!message) return message.error();
  const Result<std::string> text = signed_text(*message, authority);
  return text ? ok() : Status(of_file(text.error(), path));
}

Status prove_key(const std::string& path, const X509& certificate) {
  const Result<std::string> text = read_own(path);
  if (!text) return text.error();
  const Result<Key> key = key_of_pem(*text);
  if (!key) return of_file(key.error(), path);
  if (X509_check_private_key(&certificate, key->get()) == 1) return ok();
  return fail(Code::data_loss, path + " does not belong to the certificate beside it");
}

Result<Files> read_files(const std::string& folder, const std::string& process) {
  if (Status own = prove_own_folder(folder); !own.ok()) return own.error();
  Result<X509Ptr> authority = read_certificate(folder + "/" + kAuthorityFile);
  if (!authority) return authority.error();
  const std::string path = folder + "/" + certificate_file(process);
  Result<X509Ptr> certificate = read_certificate(path);
  if (!certificate) return certificate.error();
  if (X509_verify(certificate->get(), X509_get0_pubkey(authority->get())) != 1)
    return fail(Code::failed_precondition,
                path + " was issued by another authority than that of this folder");
  if (Status fits = prove_key(folder + "/" + key_file_name(process), **certificate); !fits.ok())
    return fits.error();
  for (const std::string& file : {std::string(kGovernanceFile), permissions_file(process)})
    if (Status proven = prove_signed(folder + "/" + file, **authority); !proven.ok()) return proven.error();
  return Files{std::move(authority).value(), std::move(certificate).value()};
}

std::vector<std::pair<std::string, std::string>> properties_of(const std::string& folder,
                                                               const std::string& process) {
  const std::string files = "file://" + folder + "/";
  const std::string pki = "dds.sec.auth.builtin.PKI-DH.";
  const std::string access = "dds.sec.access.builtin.Access-Permissions.";
  return {{"dds.sec.auth.plugin", "builtin.PKI-DH"},
          {pki + "identity_ca", files + kAuthorityFile},
          {pki + "identity_certificate", files + certificate_file(process)},
          {pki + "private_key", files + key_file_name(process)},
          {"dds.sec.access.plugin", "builtin.Access-Permissions"},
          {access + "permissions_ca", files + kAuthorityFile},
          {access + "governance", files + kGovernanceFile},
          {access + "permissions", files + permissions_file(process)},
          {"dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC"}};
}

std::int64_t time_of_change(const std::string& path) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return 0;
  return found.st_mtim.tv_sec * kNanoseconds + found.st_mtim.tv_nsec;
}

}  // namespace

struct KeyRing::Proof {
  X509Ptr authority;
};

Mark mark_of(const std::string& subject) {
  const auto hash = hash_of_name(subject);
  Mark mark{};
  std::uint8_t carried = 1;  // the first bit is 1, the hash follows
  for (std::size_t i = 0; i < mark.size(); ++i) {
    mark[i] = static_cast<std::uint8_t>((carried << 7U) | (hash[i] >> 1U));
    carried = hash[i] & 1U;
  }
  return mark;
}

Result<KeyRing> KeyRing::open(const std::string& folder, const std::string& process, std::int64_t now) {
  Result<Files> files = read_files(folder, process);
  if (!files) return useless(files.error(), folder, process);
  KeyRing ring;
  ring.folder_ = folder;
  ring.properties_ = properties_of(folder, process);
  const Span span = span_of(*files->certificate);
  ring.own_ = {common_name(*files->certificate), "", process, span.until, false};
  ring.proof_ = std::make_shared<const Proof>(Proof{std::move(files->authority)});
  if (const Result<bool> list = ring.look(); !list) return useless(list.error(), folder, process);
  if (now < span.from)
    return useless(fail(Code::failed_precondition,
                        "its certificate is not valid yet; is the clock of this machine right?"),
                   folder, process);
  if (const std::string fault = ring.fault(now); !fault.empty())
    return useless(fail(Code::failed_precondition, fault), folder, process);
  return ring;
}

Result<bool> KeyRing::look() {
  const std::string path = folder_ + "/" + kListFile;
  const std::int64_t changed = time_of_change(path);
  if (changed == changed_) return false;
  changed_ = changed;
  Result<CertificateList> list = read_list(path, *proof_->authority);
  if (!list) return list.error();
  if (list->edition < edition_)
    return fail(Code::failed_precondition,
                path + " is older than the list that this process has; it is not used");
  if (list->edition == edition_) return false;
  take(std::move(list).value());
  return true;
}

void KeyRing::take(CertificateList list) {
  edition_ = list.edition;
  known_.clear();
  for (Certificate& each : list.certificates) {
    const Mark mark = mark_of(each.subject);
    known_[mark] = std::move(each);
  }
}

std::string KeyRing::fault(std::int64_t now) const {
  const auto entry = known_.find(mark_of(own_.subject));
  if (entry == known_.end()) return "the authority's list of certificates does not have its certificate";
  if (entry->second.process != own_.process)
    return "its certificate is that of process " + entry->second.process;
  if (entry->second.revoked) return "its certificate was revoked";
  if (now > own_.not_after) return "its certificate has expired";
  return {};
}

}  // namespace orca::keys
