// SPDX-License-Identifier: LGPL-3.0-or-later
#include "crypto.hpp"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <algorithm>

namespace orca::keys {
namespace {

using Name = std::unique_ptr<X509_NAME, Freed<X509_NAME_free>>;
using Pkcs7 = std::unique_ptr<PKCS7, Freed<PKCS7_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>>;
using Serial = std::unique_ptr<BIGNUM, Freed<BN_free>>;

constexpr int kSigning = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;

Error failed(Code code, const std::string& what) {
  std::array<char, 256> reason{};
  ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
  ERR_clear_error();
  return fail(code, what + ": " + reason.data());
}

BioPtr reading(std::string_view text) {
  return BioPtr(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}
BioPtr writing() { return BioPtr(BIO_new(BIO_s_mem())); }

std::string text_of(BIO& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(&bio, &data);
  return {data, static_cast<std::size_t>(size)};
}

Name name_of(const std::string& common_name) {
  Name name(X509_NAME_new());
  X509_NAME_add_entry_by_txt(name.get(), "CN", V_ASN1_UTF8STRING,
                             reinterpret_cast<const unsigned char*>(common_name.data()),
                             static_cast<int>(common_name.size()), -1, 0);
  return name;
}

bool add_extension(X509& certificate, int which, const char* value) {
  const Extension made(X509V3_EXT_conf_nid(nullptr, nullptr, which, value));
  return made != nullptr && X509_add_ext(&certificate, made.get(), -1) == 1;
}

bool set_serial(X509& certificate) {
  constexpr int kBits = 120;
  const Serial number(BN_new());
  return BN_rand(number.get(), kBits, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1 &&
         BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(&certificate)) != nullptr;
}

std::int64_t to_seconds(const ASN1_TIME& time) {
  const std::unique_ptr<ASN1_TIME, Freed<ASN1_TIME_free>> epoch(ASN1_TIME_set(nullptr, 0));
  int days = 0;
  int seconds = 0;
  ASN1_TIME_diff(&days, &seconds, epoch.get(), &time);
  return std::int64_t{days} * 86'400 + seconds;
}

// Asks nobody at the terminal.
int no_password(char*, int, int, void*) { return -1; }

}  // namespace

Result<KeyPair> make_pair(const std::string& subject, const Span& span, const KeyPair* authority) {
  return make_pair(
      subject, span, authority,
      {{NID_basic_constraints, authority == nullptr ? "critical,CA:TRUE" : "critical,CA:FALSE"}});
}

Result<KeyPair> make_pair(const std::string& subject, const Span& span, const KeyPair* authority,
                          const Extensions& extensions) {
  KeyPair pair{Key(EVP_EC_gen("P-256")), X509Ptr(X509_new())};
  if (pair.key == nullptr || pair.certificate == nullptr) return failed(Code::internal, "no key can be made");
  X509& made = *pair.certificate;
  const KeyPair& issuer = authority == nullptr ? pair : *authority;
  const Name name = name_of(subject);
  constexpr long kVersion3 = 2;
  const bool is_made = X509_set_version(&made, kVersion3) == 1 && set_serial(made) &&
                       ASN1_TIME_set(X509_getm_notBefore(&made), span.from) != nullptr &&
                       ASN1_TIME_set(X509_getm_notAfter(&made), span.until) != nullptr &&
                       X509_set_subject_name(&made, name.get()) == 1 &&
                       X509_set_issuer_name(&made, X509_get_subject_name(issuer.certificate.get())) == 1 &&
                       X509_set_pubkey(&made, pair.key.get()) == 1 &&
                       std::ranges::all_of(extensions,
                                           [&](const auto& each) {
                                             return add_extension(made, each.first, each.second.c_str());
                                           }) &&
                       X509_sign(&made, issuer.key.get(), EVP_sha256()) != 0;
  if (!is_made) return failed(Code::internal, "no certificate can be made");
  return pair;
}

std::string to_pem(const EVP_PKEY& key) {
  const BioPtr out = writing();
  PEM_write_bio_PrivateKey(out.get(), &key, nullptr, nullptr, 0, nullptr, nullptr);
  return text_of(*out);
}

std::string to_pem(const X509& certificate) {
  const BioPtr out = writing();
  PEM_write_bio_X509(out.get(), &certificate);
  return text_of(*out);
}

Result<Key> key_of_pem(std::string_view text) {
  Key key(PEM_read_bio_PrivateKey(reading(text).get(), nullptr, &no_password, nullptr));
  if (key == nullptr) return failed(Code::data_loss, "it has no private key without a password");
  return key;
}

Result<X509Ptr> certificate_of_pem(std::string_view text) {
  X509Ptr certificate(PEM_read_bio_X509(reading(text).get(), nullptr, &no_password, nullptr));
  if (certificate == nullptr) return failed(Code::data_loss, "it is no certificate");
  return certificate;
}

Result<std::string> sign(std::string_view text, const KeyPair& by) {
  const BioPtr in = reading(text);
  const Pkcs7 made(PKCS7_sign(by.certificate.get(), by.key.get(), nullptr, in.get(), kSigning));
  const BioPtr out = writing();
  if (made == nullptr || SMIME_write_PKCS7(out.get(), made.get(), in.get(), kSigning) != 1)
    return failed(Code::internal, "a text cannot be signed");
  return text_of(*out);
}

Result<std::string> signed_text(std::string_view message, X509& by) {
  BIO* contents = nullptr;
  const Pkcs7 read(SMIME_read_PKCS7(reading(message).get(), &contents));
  const BioPtr owned(contents);
  if (read == nullptr) return failed(Code::data_loss, "it is no signed text");
  const std::unique_ptr<STACK_OF(X509), decltype([](STACK_OF(X509) * stack) { sk_X509_free(stack); })>
      signers(sk_X509_new_null());
  sk_X509_push(signers.get(), &by);
  const BioPtr out = writing();
  // Who may sign is said by the stack, so neither certificates in the message nor chains count.
  if (PKCS7_verify(read.get(), signers.get(), nullptr, contents, out.get(),
                   PKCS7_TEXT | PKCS7_NOVERIFY | PKCS7_NOINTERN) != 1)
    return failed(Code::data_loss, "its signature is not the authority's");
  return text_of(*out);
}

std::string common_name(const X509& certificate) {
  std::array<char, 128> text{};
  X509_NAME_get_text_by_NID(X509_get_subject_name(&certificate), NID_commonName, text.data(),
                            static_cast<int>(text.size()));
  return text.data();
}

std::string rfc_name(const X509& certificate) {
  const BioPtr out = writing();
  X509_NAME_print_ex(out.get(), X509_get_subject_name(&certificate), 0, XN_FLAG_RFC2253);
  return text_of(*out);
}

Span span_of(const X509& certificate) {
  return {to_seconds(*X509_get0_notBefore(&certificate)), to_seconds(*X509_get0_notAfter(&certificate))};
}

std::array<std::uint8_t, 32> hash_of_name(const std::string& common_name) {
  std::array<std::uint8_t, 32> hash{};
  unsigned int size = 0;
  X509_NAME_digest(name_of(common_name).get(), EVP_sha256(), hash.data(), &size);
  return hash;
}

std::string random_digits() {
  std::array<unsigned char, 16> bytes{};
  RAND_bytes(bytes.data(), bytes.size());
  std::string text;
  constexpr const char* kDigits = "0123456789abcdef";
  for (const unsigned byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xFU];
  }
  return text;
}

}  // namespace orca::keys
