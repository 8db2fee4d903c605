// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/x509.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::keys {

template <auto free>
struct Freed {
  void operator()(auto* object) const { free(object); }
};
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using X509Ptr = std::unique_ptr<X509, Freed<X509_free>>;
using BioPtr = std::unique_ptr<BIO, Freed<BIO_free_all>>;

/// A key of the curve P-256, and its certificate.
struct KeyPair {
  Key key;
  X509Ptr certificate;
};

/// When a certificate begins and ends [s since 1970-01-01 UTC].
struct Span {
  std::int64_t from = 0;
  std::int64_t until = 0;
};

/// Makes a key and its certificate.
/// @param subject    its common name.
/// @param authority  who signs it; null: itself, as an authority.
/// @errors  internal with OpenSSL's reason.
[[nodiscard]] Result<KeyPair> make_pair(const std::string& subject, const Span& span,
                                        const KeyPair* authority);

/// Extensions of a certificate: OpenSSL's number of each, and its value as OpenSSL's configuration writes it.
using Extensions = std::vector<std::pair<int, std::string>>;
/// The same with extensions of one's own.
[[nodiscard]] Result<KeyPair> make_pair(const std::string& subject, const Span& span,
                                        const KeyPair* authority, const Extensions& extensions);

/// Return keys and certificates as PEM, and read them.
/// @errors  data_loss; a key behind a password is none.
[[nodiscard]] std::string to_pem(const EVP_PKEY& key);
[[nodiscard]] std::string to_pem(const X509& certificate);
[[nodiscard]] Result<Key> key_of_pem(std::string_view text);
[[nodiscard]] Result<X509Ptr> certificate_of_pem(std::string_view text);

/// Signs a text as S/MIME, as DDS Security wants it.
/// @errors  internal.
[[nodiscard]] Result<std::string> sign(std::string_view text, const KeyPair& by);
/// Returns the text of a message that exactly this certificate's key has signed.
/// @errors  data_loss.
[[nodiscard]] Result<std::string> signed_text(std::string_view message, X509& by);

/// Returns the common name of a certificate's subject, and the whole name as permissions write it.
[[nodiscard]] std::string common_name(const X509& certificate);
[[nodiscard]] std::string rfc_name(const X509& certificate);
/// Returns when a certificate begins and ends.
[[nodiscard]] Span span_of(const X509& certificate);
/// Returns the SHA-256 of the name that a certificate with this common name has.
[[nodiscard]] std::array<std::uint8_t, 32> hash_of_name(const std::string& common_name);
/// Returns 32 random hexadecimal digits.
[[nodiscard]] std::string random_digits();

}  // namespace orca::keys
