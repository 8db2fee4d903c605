// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"

namespace orca::supervisor {

/// The Unix socket of a running system: `<graph>.sock` in the folder of the user (orca/base/files/own_folder.hpp), with mode 0600.
/// It keeps packets apart, as a Channel needs it. Both ends are proven: the folder is this user's alone, and who is at the
/// other end is this user, or root.

/// Returns who is at the other end of a Unix socket, as the system says; nothing if it does not know.
/// @thread  any.
[[nodiscard]] std::optional<ucred> peer_of(const Descriptor& socket);

/// The listening end of a system's socket. The destructor removes it.
///
/// As long as the object lives, nobody else gets a socket of the same name, even if its file was removed: a name in memory
/// keeps the others out.
///
/// Thread contract: not synchronised.
class ControlSocket {
 public:
  /// Makes the socket, and its folder if necessary. A socket that a dead system has left behind is replaced; while
  /// something that the dead process had forked still ends and holds it, the call waits up to 2 s.
  /// @param system  name of the graph.
  /// @errors  already_exists if a system of this name runs; unavailable, with the reason, if the socket cannot be made.
  ///          Throws std::system_error if there are no descriptors left (orca/base/exhaustion.hpp).
  [[nodiscard]] static Result<ControlSocket> open(const std::string& system);
  /// Makes a socket for another purpose in the same folder. One at which nobody listens is replaced.
  /// @param file   its name there.
  /// @param taken  the error if somebody listens there.
  /// @errors  `taken`; unavailable as above.
  [[nodiscard]] static Result<ControlSocket> open_file(const std::string& file, const Error& taken);
  /// Makes a second socket of a system, at which everybody may ask: who may be answered, the caller decides (access.hpp). It lies in a folder
  /// that only this user may write to, /tmp/orca-shared-UID.
  /// @errors  unavailable as above; already_exists if another system of this user and of this name has one.
  [[nodiscard]] static Result<ControlSocket> open_shared(const std::string& system);
  ~ControlSocket();
  ControlSocket(ControlSocket&&) = default;
  ControlSocket& operator=(ControlSocket&&) = delete;

  /// Looks whether the file still leads to this socket, and makes file and folder again if somebody has removed them.
  /// Clients that are connected notice nothing.
  /// @return whether they were made again.
  /// @errors  unavailable, with the reason, if they cannot be made again: nobody can reach the socket.
  [[nodiscard]] Result<bool> restore();

  /// Accepts the next client that waits; empty if there is none. A client of another user, except root, is turned
  /// away, but not at a shared socket.
  /// @errors  unavailable if there are no descriptors left: the client waits on, and poll() reports it all the time.
  [[nodiscard]] Result<Descriptor> accept() const;
  /// Returns the number of the socket, for poll().
  [[nodiscard]] int descriptor() const { return listening_.number(); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  ControlSocket(Descriptor name, std::string path, bool is_shared)
      : name_(std::move(name)), path_(std::move(path)), is_shared_(is_shared) {}
  [[nodiscard]] Status listen();

  Descriptor name_;       // keeps others out; empty after a move
  Descriptor listening_;  // empty after a move
  std::string path_;
  bool is_shared_;
  dev_t device_ = 0;  // of the file
  ino_t number_ = 0;
};

/// Connects to a running system of this user. Waits up to 1 s if many others want to, too.
/// @errors  not_found if none of this name runs; unavailable with the reason, also if another user answers in its place.
/// @thread  any.
[[nodiscard]] Result<Descriptor> connect_to_system(const std::string& system);

/// Connects to the shared socket of a system of another user. It is that user, or root, who listens there, and only they could have put it
/// there.
/// @param system  empty: the only one of that user.
/// @errors  not_found if that user shares none, or none of this name; invalid_argument if it is to be chosen among several; unavailable with the
///          reason.
/// @thread  any.
[[nodiscard]] Result<Descriptor> connect_to_shared(const std::string& system, uid_t owner);

/// Connects to a socket of ControlSocket::open_file(), in the same way.
/// @errors  not_found if nobody listens there; unavailable as above.
/// @thread  any.
[[nodiscard]] Result<Descriptor> connect_to_file(const std::string& file);

/// Removes such a socket if nobody listens there.
/// @thread  any.
void remove_dead_file(const std::string& file);

/// Returns the names of the files with an ending in the folder of the user, sorted.
/// @errors  unavailable if the folder cannot be trusted.
/// @thread  any.
[[nodiscard]] Result<std::vector<std::string>> files_of_user(const std::string& ending);

/// Returns the names of the systems of this user that run, sorted.
/// @errors  unavailable if the folder of their sockets cannot be trusted.
/// @thread  any.
[[nodiscard]] Result<std::vector<std::string>> running_systems();

}  // namespace orca::supervisor
