// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"

namespace orca {

/// The folder in which the programs of one user meet: `$XDG_RUNTIME_DIR/orca`, or `/tmp/orca-<uid>` where there is no such
/// folder. Everything in it has a name that others can guess, so nothing in it is used before the folder is proven: it is a
/// folder and no symbolic link, belongs to this user, and has mode 0700, and nobody else can rename it. Another user who
/// makes it first can only make open() and make() fail, with the reason.
///
/// Thread contract: a plain value.
class OwnFolder {
 public:
  /// Returns the path of the folder. It need not exist.
  /// @thread  any that may read the environment.
  [[nodiscard]] static std::string path_of_user();

  /// Opens the folder and proves it.
  /// @errors  not_found if there is none; unavailable with the reason if it cannot be trusted. Throws std::system_error if
  ///          there are no descriptors left (orca/base/exhaustion.hpp).
  [[nodiscard]] static Result<OwnFolder> open();
  /// Makes the folder if necessary, opens it and proves it.
  /// @errors  unavailable, as open().
  [[nodiscard]] static Result<OwnFolder> make();
  /// The same of the folder in which programs keep what is to be there after a restart of the machine: `$XDG_STATE_HOME/orca`, or
  /// `~/.local/state/orca`.
  /// @errors  unavailable, as open(), and if there is no home.
  [[nodiscard]] static Result<OwnFolder> make_for_state();
  /// Returns the path of that folder; empty: there is no home.
  [[nodiscard]] static std::string path_for_state();
  /// The same of the folder `kept` in it, in which components keep things from one run to the next. It is all that their processes may
  /// write there.
  /// @errors  as make_for_state().
  [[nodiscard]] static Result<OwnFolder> make_for_components();
  /// Returns the number of the open folder, for openat() and its like.
  [[nodiscard]] int descriptor() const { return folder_.number(); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  OwnFolder(Descriptor folder, std::string path) : folder_(std::move(folder)), path_(std::move(path)) {}

  Descriptor folder_;
  std::string path_;
};

}  // namespace orca
