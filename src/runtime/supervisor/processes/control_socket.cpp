// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/control_socket.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>

#include "orca/base/exhaustion.hpp"

namespace orca::supervisor {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".sock";
constexpr int kWaiting = 16;             // clients that have not been accepted yet
constexpr int kSendBuffer = 256 * 1024;  // [bytes]

bool is_folder(const char* path) {
  struct stat found {};
  return stat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

std::string file_of(const std::string& system) { return system + std::string(kSuffix); }

std::string path_of(const std::string& file) { return control_folder() + "/" + file; }

Error refused(const std::string& what, int reason) {
  throw_if_exhausted(reason);
  return fail(Code::unavailable, what + ": " + std::strerror(reason));
}

// Gives the socket room for a packet of a Channel.
void make_room(const Descriptor& socket) {
  setsockopt(socket.number(), SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
}

Descriptor make_socket() {
  Descriptor made(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!made) throw_if_exhausted(errno);
  make_room(made);
  return made;
}

std::optional<sockaddr_un> address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) return std::nullopt;
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

Error too_long(const std::string& path) {
  return fail(Code::unavailable, "the path of the socket is too long: " + path);
}

// Returns 0 if somebody listens there, otherwise the system's number.
int connect_to(const Descriptor& socket, const sockaddr_un& address) {
  if (!socket) return EMFILE;
  return connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 ? 0
                                                                                                    : errno;
}

// Makes the folder of the sockets, or checks that nobody else can put something there. Returns it locked.
Result<Descriptor> lock_folder() {
  const std::string folder = control_folder();
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    return refused("cannot make the folder " + folder, errno);
  Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (!opened) return refused("cannot open the folder " + folder, errno);
  struct stat found {};
  if (fstat(opened.number(), &found) != 0) return refused("cannot look at the folder " + folder, errno);
  if (found.st_uid != geteuid() || (found.st_mode & 077) != 0)
    return fail(
        Code::unavailable,
        "the folder " + folder + " does not belong to this user alone; remove it, or make it so (chmod 700)");
  while (flock(opened.number(), LOCK_EX) != 0)
    if (errno != EINTR) return refused("cannot lock the folder " + folder, errno);
  return opened;
}

// Binds the socket and listens.
Status listen_at(const Descriptor& socket, const std::string& path, const sockaddr_un& address) {
  const int bound = bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  if (bound != 0 || chmod(path.c_str(), 0600) != 0) return refused("cannot make the socket " + path, errno);
  if (listen(socket.number(), kWaiting) != 0) return refused("cannot listen at the socket " + path, errno);
  return ok();
}

bool is_of_this_user(const Descriptor& client) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return getsockopt(client.number(), SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.uid == geteuid();
}

}  // namespace

std::string control_folder() {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && runtime[0] == '/' && is_folder(runtime)) return std::string(runtime) + "/orca";
  return "/tmp/orca-" + std::to_string(geteuid());
}

Result<ControlSocket> ControlSocket::open(const std::string& system) {
  return open_file(
      file_of(system),
      fail(Code::already_exists, "a system named \"" + system +
                                     "\" runs already; stop it first: orcactl --system " + system + " stop"));
}

Result<ControlSocket> ControlSocket::open_file(const std::string& file, const Error& taken) {
  const std::string path = path_of(file);
  const std::optional<sockaddr_un> address = address_of(path);
  if (!address) return too_long(path);
  const Result<Descriptor> lock = lock_folder();  // two deployers may begin at the same time
  if (!lock) return lock.error();
  if (connect_to(make_socket(), *address) == 0) return taken;
  unlink(path.c_str());
  Descriptor socket = make_socket();
  if (!socket) return refused("cannot make a socket", errno);
  if (Status listens = listen_at(socket, path, *address); !listens.ok()) return listens.error();
  return ControlSocket(std::move(socket), path);
}

ControlSocket::~ControlSocket() {
  if (listening_) unlink(path_.c_str());
}

Result<Descriptor> ControlSocket::accept() const {
  for (;;) {
    Descriptor client(accept4(listening_.number(), nullptr, nullptr, SOCK_CLOEXEC));
    if (!client && errno == EINTR) continue;
    if (!client && (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM))
      return fail(Code::unavailable, std::string("cannot accept a client: ") + std::strerror(errno));
    if (client && !is_of_this_user(client)) continue;
    if (client) make_room(client);
    return client;
  }
}

Result<Descriptor> connect_to_file(const std::string& file) {
  const std::string path = path_of(file);
  const std::optional<sockaddr_un> address = address_of(path);
  if (!address) return too_long(path);
  Descriptor socket = make_socket();
  const int reason = connect_to(socket, *address);
  if (reason == 0) return socket;
  if (reason == ENOENT || reason == ECONNREFUSED)
    return fail(Code::not_found, "nobody listens at the socket " + path);
  return refused("cannot connect to " + path, reason);
}

// Somebody who is just about to listen holds the lock.
void remove_dead_file(const std::string& file) {
  const Result<Descriptor> lock = lock_folder();
  if (!lock) return;
  const Result<Descriptor> socket = connect_to_file(file);
  if (!socket && socket.error().code == Code::not_found) unlink(path_of(file).c_str());
}

Result<Descriptor> connect_to_system(const std::string& system) {
  Result<Descriptor> socket = connect_to_file(file_of(system));
  if (!socket && socket.error().code == Code::not_found)
    return fail(Code::not_found, "no system named \"" + system + "\" runs");
  return socket;
}

std::vector<std::string> running_systems() {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(control_folder(), none)) {
    if (entry.path().extension() != kSuffix) continue;
    const std::string name = entry.path().stem().string();
    if (connect_to_system(name)) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace orca::supervisor
