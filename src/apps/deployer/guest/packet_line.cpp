// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "packet_line.hpp"

#include <fcntl.h>
#include <sys/socket.h>

#include <cerrno>
#include <utility>

namespace orca::guest {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30;

void append(std::string& bytes, std::size_t number) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 0xFF);
}

std::size_t number_at(const char* bytes) {
  std::size_t number = 0;
  for (int i = 3; i >= 0; --i) number = number << 8 | static_cast<unsigned char>(bytes[i]);
  return number;
}

// Returns the words of a packet; nothing if the lengths contradict each other.
std::optional<Packet> words_of(std::string_view bytes) {
  Packet words;
  while (bytes.size() >= 4) {
    const std::size_t length = number_at(bytes.data());
    bytes.remove_prefix(4);
    if (length > bytes.size()) return std::nullopt;
    words.emplace_back(bytes.substr(0, length));
    bytes.remove_prefix(length);
  }
  if (!bytes.empty() || words.empty()) return std::nullopt;
  return words;
}

}  // namespace

PacketLine::PacketLine(Descriptor socket) : socket_(std::move(socket)) {
  fcntl(socket_.number(), F_SETFD, FD_CLOEXEC);
}

void PacketLine::end_input() { shutdown(socket_.number(), SHUT_RD); }

void PacketLine::send(const Packet& packet) {
  std::string body;
  for (const std::string& word : packet) {
    append(body, word.size());
    body += word;
  }
  std::string bytes;
  append(bytes, body.size());
  bytes += body;
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t sent = ::send(socket_.number(), rest.data(), rest.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EINTR) return;
    if (sent > 0) rest.remove_prefix(static_cast<std::size_t>(sent));
  }
}

std::optional<Packet> PacketLine::receive() {
  char head[4];
  if (!read(head, sizeof head)) return std::nullopt;
  const std::size_t size = number_at(head);
  if (size > kMostBytes) return std::nullopt;
  std::string body(size, '\0');
  if (!read(body.data(), size)) return std::nullopt;
  return words_of(body);
}

bool PacketLine::read(char* to, std::size_t count) {
  while (count > 0) {
    const ssize_t got = ::recv(socket_.number(), to, count, 0);
    if (got == 0 || (got < 0 && errno != EINTR)) return false;
    if (got < 0) continue;
    to += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace orca::guest
