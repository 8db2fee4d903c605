// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/keys/server_certificate.hpp"

#include <arpa/inet.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <string_view>
#include <utility>

#include "crypto.hpp"
#include "key_files.hpp"

namespace orca::keys {
namespace {

using Names = std::unique_ptr<GENERAL_NAMES, Freed<GENERAL_NAMES_free>>;

constexpr std::int64_t kServerLife =
    std::int64_t{365} * 86'400;  // browsers refuse those of more than 398 days
constexpr std::int64_t kEarly = std::int64_t{30} * 86'400;
constexpr std::int64_t kWrongClock = 3'600;  // [s] by which a browser's clock may be late
constexpr std::string_view kBegin = "-----BEGIN CERTIFICATE-----";
constexpr std::string_view kEnd = "-----END CERTIFICATE-----";

std::string_view bytes_of(const ASN1_STRING& text) {
  return {reinterpret_cast<const char*>(ASN1_STRING_get0_data(&text)),
          static_cast<std::size_t>(ASN1_STRING_length(&text))};
}

// Returns a name of DNS, in small letters; empty: it has what no such name has.
std::string host_of(std::string_view name) {
  std::string host;
  for (const char each : name) {
    const auto letter = static_cast<unsigned char>(each);
    if (std::isalnum(letter) == 0 && each != '-' && each != '.' && each != '_' && each != '*') return {};
    host += static_cast<char>(std::tolower(letter));
  }
  return host;
}

std::string address_of(std::string_view bytes) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (bytes.size() == sizeof(in_addr))
    return inet_ntop(AF_INET, bytes.data(), text.data(), text.size()) == nullptr ? "" : text.data();
  if (bytes.size() != sizeof(in6_addr)) return {};
  return inet_ntop(AF_INET6, bytes.data(), text.data(), text.size()) == nullptr
             ? ""
             : "[" + std::string(text.data()) + "]";
}

std::vector<std::string> names_of(const X509& certificate) {
  const Names all(
      static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(&certificate, NID_subject_alt_name, nullptr, nullptr)));
  std::vector<std::string> names;
  for (int i = 0; i < sk_GENERAL_NAME_num(all.get()); ++i) {
    const GENERAL_NAME& each = *sk_GENERAL_NAME_value(all.get(), i);
    std::string name;
    if (each.type == GEN_DNS) name = host_of(bytes_of(*each.d.dNSName));
    if (each.type == GEN_IPADD) name = address_of(bytes_of(*each.d.iPAddress));
    if (!name.empty()) names.push_back(std::move(name));
  }
  return names;
}

std::string fingerprint_of(const X509& certificate) {
  std::array<unsigned char, 32> hash{};
  unsigned int size = 0;
  X509_digest(&certificate, EVP_sha256(), hash.data(), &size);
  std::string text;
  constexpr const char* kDigits = "0123456789ABCDEF";
  for (const unsigned byte : hash) {
    if (!text.empty()) text += ':';
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xFU];
  }
  return text;
}

// Returns all certificates of a file.
std::string chain_of(std::string_view text) {
  std::string chain;
  for (;;) {
    const std::size_t begin = text.find(kBegin);
    const std::size_t end = text.find(kEnd, begin);
    if (end == std::string_view::npos) return chain;
    chain += std::string(text.substr(begin, end + kEnd.size() - begin)) + "\n";
    text.remove_prefix(end + kEnd.size());
  }
}

Result<ServerCertificate> parse(const std::string& text, const std::string& file, std::int64_t now) {
  Result<Key> key = key_of_pem(text);
  if (!key) return fail(Code::data_loss, key.error().message, file);
  const Result<X509Ptr> certificate = certificate_of_pem(text);
  if (!certificate) return fail(Code::data_loss, "it has no certificate", file);
  const X509& own = **certificate;
  if (X509_check_private_key(&own, key->get()) != 1)
    return fail(Code::data_loss,
                "its key is not that of its first certificate; a file must have the server's own "
                "certificate first",
                file);
  const Span span = keys::span_of(own);
  if (now < span.from)
    return fail(Code::failed_precondition, "the time of its certificate has not begun", file);
  if (now > span.until) return fail(Code::failed_precondition, "its certificate has expired", file);
  std::vector<std::string> names = names_of(own);
  if (names.empty())
    return fail(Code::data_loss, "its certificate names no host (subjectAltName), so no browser takes it",
                file);
  return ServerCertificate{chain_of(text), to_pem(**key), std::move(names), fingerprint_of(own)};
}

// Returns names as OpenSSL writes them in a subjectAltName.
std::string alternative_names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    in_addr number{};
    if (!text.empty()) text += ',';
    if (name.starts_with('['))
      text += "IP:" + name.substr(1, name.size() - 2);
    else
      text += (inet_pton(AF_INET, name.c_str(), &number) == 1 ? "IP:" : "DNS:") + name;
  }
  return text;
}

Result<std::string> make(const std::vector<std::string>& names, std::int64_t now) {
  const Result<KeyPair> pair = make_pair("orca", {now - kWrongClock, now + kServerLife}, nullptr,
                                         {{NID_basic_constraints, "critical,CA:FALSE"},
                                          {NID_key_usage, "critical,digitalSignature"},
                                          {NID_ext_key_usage, "serverAuth"},
                                          {NID_subject_alt_name, alternative_names(names)}});
  if (!pair) return pair.error();
  return to_pem(*pair->key) + to_pem(*pair->certificate);
}

bool has_all(const std::vector<std::string>& has, const std::vector<std::string>& wanted) {
  return std::ranges::all_of(
      wanted, [&](const std::string& name) { return std::ranges::find(has, name) != has.end(); });
}

}  // namespace

Result<ServerCertificate> read_server_certificate(const std::string& file, std::int64_t now) {
  const Result<std::string> text = read_own(file);
  if (!text) return text.error();
  return parse(*text, file, now);
}

Result<ServerCertificate> own_server_certificate(const std::string& folder,
                                                 const std::vector<std::string>& names, std::int64_t now) {
  if (Status there = make_own_folder(folder); !there.ok()) return there.error();
  const std::string file = folder + "/" + kServerCertificateFile;
  const Result<ServerCertificate> found = read_server_certificate(file, now);
  if (found && has_all(found->names, names) && read_server_certificate(file, now + kEarly)) return found;
  const bool can_be_replaced =
      found || found.error().code == Code::not_found || found.error().code == Code::failed_precondition;
  if (!can_be_replaced) return fail(found.error().code, found.error().text() + "; remove it, or mend it");
  const Result<std::string> made = make(names, now);
  if (!made) return made.error();
  if (Status kept = write_own(file, *made); !kept.ok()) return kept.error();
  return parse(*made, file, now);
}

}  // namespace orca::keys
