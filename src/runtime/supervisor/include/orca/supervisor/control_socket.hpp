// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"

namespace orca::supervisor {

/// The Unix socket of a running system: `$XDG_RUNTIME_DIR/orca/<graph>.sock`, or `/tmp/orca-<uid>/<graph>.sock` where there
/// is no such folder. The socket has mode 0600 and lies in a folder of mode 0700 that belongs to the user. It keeps packets
/// apart, as a Channel needs it.

/// Returns the folder of the sockets of this user. It need not exist.
/// @thread  any.
[[nodiscard]] std::string control_folder();

/// The listening end of a system's socket. The destructor removes it.
///
/// Thread contract: not synchronised.
class ControlSocket {
 public:
  /// Makes the socket, and its folder if necessary. A socket that a dead system has left behind is replaced.
  /// @param system  name of the graph.
  /// @errors  already_exists if a system of this name runs; unavailable, with the reason, if the socket cannot be made.
  ///          Throws std::system_error if there are no descriptors left (orca/base/exhaustion.hpp).
  [[nodiscard]] static Result<ControlSocket> open(const std::string& system);
  /// Makes a socket for another purpose in the same folder. One at which nobody listens is replaced.
  /// @param file   its name there.
  /// @param taken  the error if somebody listens there.
  /// @errors  `taken`; unavailable as above.
  [[nodiscard]] static Result<ControlSocket> open_file(const std::string& file, const Error& taken);
  ~ControlSocket();
  ControlSocket(ControlSocket&&) = default;
  ControlSocket& operator=(ControlSocket&&) = delete;

  /// Accepts the next client that waits; empty if there is none. A client of another user is turned away.
  /// @errors  unavailable if there are no descriptors left: the client waits on, and poll() reports it all the time.
  [[nodiscard]] Result<Descriptor> accept() const;
  /// Returns the number of the socket, for poll().
  [[nodiscard]] int descriptor() const { return listening_.number(); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  ControlSocket(Descriptor listening, std::string path)
      : listening_(std::move(listening)), path_(std::move(path)) {}

  Descriptor listening_;  // empty after a move
  std::string path_;
};

/// Connects to a running system of this user.
/// @errors  not_found if none of this name runs; unavailable with the system's reason.
/// @thread  any.
[[nodiscard]] Result<Descriptor> connect_to_system(const std::string& system);

/// Connects to a socket of ControlSocket::open_file().
/// @errors  not_found if nobody listens there; unavailable with the system's reason.
/// @thread  any.
[[nodiscard]] Result<Descriptor> connect_to_file(const std::string& file);

/// Removes such a socket if nobody listens there.
/// @thread  any.
void remove_dead_file(const std::string& file);

/// Returns the names of the systems of this user that run, sorted.
/// @thread  any.
[[nodiscard]] std::vector<std::string> running_systems();

}  // namespace orca::supervisor
