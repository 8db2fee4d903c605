// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "doors/door.hpp"

#include <openssl/ssl.h>

#include <sstream>
#include <string>

namespace orca::view {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

std::string text_of(const tcp::endpoint& endpoint) {
  std::ostringstream text;
  text << endpoint;
  return text.str();
}

// TLS as current advice has it (RFC 9325): no version before 1.2, keys that are used once, and nothing that lets a client make work
// or memory for nothing.
bool restrict(SSL_CTX& tls) {
  SSL_CTX_set_options(&tls,
                      SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_session_cache_mode(&tls, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(&tls, SSL_MODE_RELEASE_BUFFERS);
  return SSL_CTX_set_min_proto_version(&tls, TLS1_2_VERSION) == 1 &&
         SSL_CTX_set_cipher_list(&tls, "ECDHE+AESGCM:ECDHE+CHACHA20") == 1;
}

}  // namespace

Status Door::open(const tcp::endpoint& here) {
  error_code error;
  acceptor_.close(error);
  acceptor_.open(here.protocol(), error);
  if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(here, error);
  if (!error) acceptor_.listen(tcp::acceptor::max_listen_connections, error);
  if (error) return fail(Code::unavailable, "cannot listen at " + text_of(here) + ": " + error.message());
  port_ = acceptor_.local_endpoint().port();
  return ok();
}

Status Door::secure(const keys::ServerCertificate& certificate) {
  tls_.emplace(asio::ssl::context::tls_server);
  error_code error;
  if (!restrict(*tls_->native_handle())) return fail(Code::internal, "OpenSSL has no TLS 1.2");
  tls_->use_certificate_chain(asio::buffer(certificate.chain), error);
  if (!error) tls_->use_private_key(asio::buffer(certificate.key), asio::ssl::context::pem, error);
  if (error) return fail(Code::invalid_argument, "the certificate cannot be used: " + error.message());
  return ok();
}

Door::Stranger::Stranger(Door& door, Stream::Plain& connection) : door_(door), connection_(&connection) {
  door_.strangers_.push_back(connection_);
  if (door_.strangers_.size() <= kMostStrangers) return;
  door_.strangers_.front()->close();
  door_.strangers_.pop_front();
}

Door::Stranger::~Stranger() { door_.strangers_.remove(connection_); }

}  // namespace orca::view
