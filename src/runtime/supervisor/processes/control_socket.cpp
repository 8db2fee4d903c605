// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/control_socket.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>

#include "orca/base/exhaustion.hpp"
#include "orca/base/files/own_folder.hpp"
#include "orca/base/hash.hpp"
#include "orca/base/text.hpp"

namespace orca::supervisor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSuffix = ".sock";
constexpr int kWaiting = 128;            // clients that have not been accepted yet
constexpr int kSendBuffer = 256 * 1024;  // [bytes]
constexpr timeval kPatience{1, 0};       // with a system that many want to talk to
constexpr int kLeaving = 2000;           // [ms] for what a killed process had forked, to end too

std::string file_of(const std::string& system) { return system + kSuffix; }

std::string path_of(const std::string& file) { return OwnFolder::path_of_user() + "/" + file; }

Error refused(const std::string& what, int reason) {
  throw_if_exhausted(reason);
  return fail(Code::unavailable, what + ": " + std::strerror(reason));
}

// Gives the socket room for a packet of a Channel.
void make_room(const Descriptor& socket) {
  setsockopt(socket.number(), SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
}

Descriptor make_socket(int flags = 0) {
  Descriptor made(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | flags, 0));
  if (!made) throw_if_exhausted(errno);
  make_room(made);
  return made;
}

// An address of the system, with its length.
struct Address {
  sockaddr_un name{};
  socklen_t size = sizeof name;
};

std::optional<Address> address_of(const std::string& path) {
  Address address;
  address.name.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.name.sun_path) return std::nullopt;
  std::memcpy(address.name.sun_path, path.data(), path.size());
  return address;
}

// A name without a file, so that nobody loses it with the file. Processes with other folders have other names.
Address name_in_memory(const std::string& path) {
  struct stat mounts {};
  (void)stat("/proc/self/ns/mnt", &mounts);
  Fnv1a hash;
  hash.add_text(path);
  hash.add_u64(mounts.st_ino);
  char text[64];
  const int length = std::snprintf(text, sizeof text, "orca-%u-%016llx", geteuid(),
                                   static_cast<unsigned long long>(hash.value()));
  Address address;
  address.name.sun_family = AF_UNIX;
  std::memcpy(address.name.sun_path + 1, text, static_cast<std::size_t>(length));  // behind a zero: no file
  address.size =
      static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + static_cast<std::size_t>(length));
  return address;
}

Error too_long(const std::string& path) {
  return fail(Code::unavailable, "the path of the socket is too long: " + path);
}

const sockaddr* plain(const Address& address) { return reinterpret_cast<const sockaddr*>(&address.name); }

// Returns 0 if somebody listens there, otherwise the system's number.
int connect_to(const Descriptor& socket, const Address& address) {
  if (!socket) return EMFILE;
  return connect(socket.number(), plain(address), address.size) == 0 ? 0 : errno;
}

// Whether who began to listen has ended. Then only what it had forked holds the socket, and that ends with it.
bool is_left_behind(const Descriptor& asking) {
  const std::optional<ucred> listener = peer_of(asking);
  if (!listener) return false;
  const Descriptor process(static_cast<int>(syscall(SYS_pidfd_open, listener->pid, 0)));
  if (!process) return errno == ESRCH;
  pollfd end{process.number(), POLLIN, 0};
  return poll(&end, 1, 0) == 1;
}

struct Asked {
  int reason = 0;  // as of connect_to()
  Descriptor socket;
};

// Asks who listens there, and waits while it is only the rest of a process that was killed.
Asked ask_for_living(const Address& address) {
  const auto ask = [&] {
    Asked asked{0, make_socket(SOCK_NONBLOCK)};
    asked.reason = connect_to(asked.socket, address);
    return asked;
  };
  Asked first = ask();
  if (first.reason != 0 || !is_left_behind(first.socket)) return first;
  pollfd last_close{first.socket.number(), 0, 0};
  (void)poll(&last_close, 1, kLeaving);
  return ask();
}

bool is_trusted(uid_t user, uid_t owner) { return user == owner || user == 0; }

// Checks that somebody else has not put a socket in the place of the owner's.
Status prove_listener(const Descriptor& socket, const std::string& path, uid_t owner) {
  const std::optional<ucred> peer = peer_of(socket);
  if (peer && is_trusted(peer->uid, owner)) return ok();
  const std::string who = peer ? "user " + std::to_string(peer->uid) : std::string("nobody knows who");
  return fail(Code::unavailable, "at the socket " + path + " listens " + who + ", and no deployer of " +
                                     (owner == geteuid() ? "yours" : "user " + std::to_string(owner)) +
                                     "; have that process ended");
}

std::string shared_folder_of(uid_t owner) { return "/tmp/orca-shared-" + std::to_string(owner); }

// Checks that only the owner can have put something there. Its parent, /tmp, lets nobody else rename it.
Status prove_shared_folder(const std::string& folder, uid_t owner) {
  struct stat found {};
  if (lstat(folder.c_str(), &found) != 0) {
    if (errno == ENOENT) return fail(Code::not_found, "user " + std::to_string(owner) + " shares no system");
    return refused("cannot look at the folder " + folder, errno);
  }
  const bool is_owners = S_ISDIR(found.st_mode) && found.st_uid == owner && (found.st_mode & 0022) == 0;
  struct stat parent {};
  const bool is_kept = stat("/tmp", &parent) == 0 && is_trusted(parent.st_uid, geteuid()) &&
                       ((parent.st_mode & 0022) == 0 || (parent.st_mode & S_ISVTX) != 0);
  if (is_owners && is_kept) return ok();
  return fail(Code::unavailable, "the folder " + folder + " is not one that only user " +
                                     std::to_string(owner) +
                                     " can change; have it removed, and /tmp given mode 1777");
}

Status make_shared_folder() {
  const std::string folder = shared_folder_of(geteuid());
  constexpr mode_t kOthersLook = 0755;
  if (mkdir(folder.c_str(), 0700) == 0 && chmod(folder.c_str(), kOthersLook) != 0)
    return refused("cannot open the folder " + folder + " for others", errno);
  return prove_shared_folder(folder, geteuid());
}

Result<OwnFolder> lock_folder() {
  Result<OwnFolder> folder = OwnFolder::make();
  if (!folder) return folder.error();
  while (flock(folder->descriptor(), LOCK_EX) != 0)
    if (errno != EINTR) return refused("cannot lock the folder " + folder->path(), errno);
  return folder;
}

// Takes the name that keeps others out.
Result<Descriptor> take_name(const std::string& path, const Error& taken) {
  const Address address = name_in_memory(path);
  Descriptor name = make_socket(SOCK_NONBLOCK);
  if (!name) return refused("cannot make a socket", errno);
  if (bind(name.number(), plain(address), address.size) == 0) {
    if (listen(name.number(), 1) == 0) return name;
    return refused("cannot keep the name of the socket " + path, errno);
  }
  if (errno != EADDRINUSE) return refused("cannot take the name of the socket " + path, errno);
  const Asked asked = ask_for_living(address);
  if (asked.reason == ECONNREFUSED && bind(name.number(), plain(address), address.size) == 0) return name;
  const std::optional<ucred> holder = asked.reason == 0 ? peer_of(asked.socket) : std::nullopt;
  if (asked.reason == EAGAIN || (holder && holder->uid == geteuid())) return taken;
  return fail(Code::unavailable, "the name of the socket " + path + " is held by " +
                                     (holder ? "process " + std::to_string(holder->pid) + " of user " +
                                                   std::to_string(holder->uid)
                                             : std::string("a process that does not say who it is")) +
                                     "; have that process ended (ss -xlp shows it)");
}

}  // namespace

std::optional<ucred> peer_of(const Descriptor& socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (getsockopt(socket.number(), SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return std::nullopt;
  return peer;
}

Result<ControlSocket> ControlSocket::open(const std::string& system) {
  return open_file(
      file_of(system),
      fail(Code::already_exists, "a system named \"" + system +
                                     "\" runs already; stop it first: orcactl --system " + system + " stop"));
}

Result<ControlSocket> ControlSocket::open_file(const std::string& file, const Error& taken) {
  const std::string path = path_of(file);
  const std::optional<Address> address = address_of(path);
  if (!address) return too_long(path);
  const Result<OwnFolder> lock = lock_folder();  // two deployers may begin at the same time
  if (!lock) return lock.error();
  const int reason = ask_for_living(*address).reason;
  if (reason == 0 || reason == EAGAIN) return taken;
  Result<Descriptor> name = take_name(path, taken);
  if (!name) return name.error();
  ControlSocket socket(std::move(name).value(), path, false);
  if (Status listens = socket.listen(); !listens.ok()) return listens.error();
  return socket;
}

Result<ControlSocket> ControlSocket::open_shared(const std::string& system) {
  const std::string path = shared_folder_of(geteuid()) + "/" + file_of(system);
  if (!address_of(path)) return too_long(path);
  const Result<OwnFolder> lock = lock_folder();
  if (!lock) return lock.error();
  Result<Descriptor> name = take_name(
      path,
      fail(Code::already_exists, "another system of this user and of the name " + system + " is shared"));
  if (!name) return name.error();
  ControlSocket socket(std::move(name).value(), path, true);
  if (Status listens = socket.listen(); !listens.ok()) return listens.error();
  return socket;
}

ControlSocket::~ControlSocket() {
  struct stat found {};
  const bool is_own =
      listening_ && lstat(path_.c_str(), &found) == 0 && found.st_dev == device_ && found.st_ino == number_;
  if (is_own) unlink(path_.c_str());
}

// Called with the folder locked.
Status ControlSocket::listen() {
  const std::optional<Address> address = address_of(path_);
  if (!address) return too_long(path_);
  if (is_shared_)
    if (Status made = make_shared_folder(); !made.ok()) return made;
  unlink(path_.c_str());
  Descriptor made = make_socket(SOCK_NONBLOCK);
  if (!made) return refused("cannot make a socket", errno);
  struct stat found {};
  if (bind(made.number(), plain(*address), address->size) != 0 ||
      chmod(path_.c_str(), is_shared_ ? 0666 : 0600) != 0 || lstat(path_.c_str(), &found) != 0)
    return refused("cannot make the socket " + path_, errno);
  if (::listen(made.number(), kWaiting) != 0) return refused("cannot listen at the socket " + path_, errno);
  listening_ = std::move(made);
  device_ = found.st_dev;
  number_ = found.st_ino;
  return ok();
}

Result<bool> ControlSocket::restore() {
  struct stat found {};
  if (lstat(path_.c_str(), &found) == 0 && found.st_dev == device_ && found.st_ino == number_) return false;
  const Result<OwnFolder> lock = lock_folder();
  if (!lock) return lock.error();
  if (Status listens = listen(); !listens.ok()) return listens.error();
  return true;
}

Result<Descriptor> ControlSocket::accept() const {
  for (;;) {
    Descriptor client(accept4(listening_.number(), nullptr, nullptr, SOCK_CLOEXEC));
    if (!client && errno == EINTR) continue;
    if (!client && (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM))
      return fail(Code::unavailable, std::string("cannot accept a client: ") + std::strerror(errno));
    if (!client) return client;
    const std::optional<ucred> peer = peer_of(client);
    if (!peer || (!is_shared_ && !is_trusted(peer->uid, geteuid()))) continue;
    make_room(client);
    return client;
  }
}

namespace {

Error nobody_at(const std::string& path) {
  return fail(Code::not_found, "nobody listens at the socket " + path);
}

// Connects to a socket in a folder that was proven.
Result<Descriptor> connect_to_owner(const std::string& path, uid_t owner) {
  const std::optional<Address> address = address_of(path);
  if (!address) return too_long(path);
  Descriptor socket = make_socket();
  setsockopt(socket.number(), SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
  const int reason = connect_to(socket, *address);
  if (reason == ENOENT || reason == ECONNREFUSED) return nobody_at(path);
  if (reason == EAGAIN)
    return fail(Code::unavailable,
                "the system at the socket " + path + " takes in no more clients; try again");
  if (reason != 0) return refused("cannot connect to " + path, reason);
  if (Status proven = prove_listener(socket, path, owner); !proven.ok()) return proven.error();
  return socket;
}

}  // namespace

Result<Descriptor> connect_to_file(const std::string& file) {
  const std::string path = path_of(file);
  const Result<OwnFolder> folder = OwnFolder::open();
  if (!folder) return folder.error().code == Code::not_found ? nobody_at(path) : folder.error();
  return connect_to_owner(path, geteuid());
}

Result<Descriptor> connect_to_shared(const std::string& system, uid_t owner) {
  const std::string folder = shared_folder_of(owner);
  if (Status proven = prove_shared_folder(folder, owner); !proven.ok()) return proven.error();
  if (!system.empty()) return connect_to_owner(folder + "/" + file_of(system), owner);
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == kSuffix) names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  if (names.empty()) return fail(Code::not_found, "user " + std::to_string(owner) + " shares no system");
  if (names.size() == 1) return connect_to_owner(folder + "/" + file_of(names.front()), owner);
  return fail(Code::invalid_argument,
              "user " + std::to_string(owner) +
                  " shares several systems; choose one with --system: " + joined(names, ", "));
}

// Somebody who is just about to listen holds the lock.
void remove_dead_file(const std::string& file) {
  const Result<OwnFolder> lock = lock_folder();
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

Result<std::vector<std::string>> files_of_user(const std::string& ending) {
  std::vector<std::string> files;
  const Result<OwnFolder> folder = OwnFolder::open();
  if (!folder && folder.error().code == Code::not_found) return files;
  if (!folder) return folder.error();
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder->path(), none))
    if (entry.path().extension() == ending) files.push_back(entry.path().filename().string());
  std::ranges::sort(files);
  return files;
}

// One that is too busy to answer runs, too.
Result<std::vector<std::string>> running_systems() {
  const Result<std::vector<std::string>> files = files_of_user(kSuffix);
  if (!files) return files.error();
  std::vector<std::string> names;
  for (const std::string& file : *files) {
    const std::string name = fs::path(file).stem().string();
    const Result<Descriptor> socket = connect_to_system(name);
    if (socket || socket.error().code != Code::not_found) names.push_back(name);
  }
  return names;
}

}  // namespace orca::supervisor
