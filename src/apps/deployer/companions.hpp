// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/child_program.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/run_outputs.hpp"

namespace orca::deployer {

/// Starts orcaview for a system, and prints its address on stderr.
/// @return nothing if that fails, after it was said: a system runs without its page, too.
[[nodiscard]] std::optional<apps::ChildProgram> start_viewer(const std::string& system);

/// Sends a notice to the program that started this one as a service, by systemd's protocol (sd_notify(3)): a datagram to the socket
/// that $NOTIFY_SOCKET names. Without that variable nothing is sent; a notice that cannot be sent is lost.
void notify_service(const std::string& notice);

/// The processes that record a system of several processes: one `orcactl record` for each MCAP file, and one for the recording
/// that its graph says is always made, in the user's state folder (docs/recordings.md). They wait for the system and end with it.
/// The one that is always made is started again if it ends before.
///
/// Thread contract: the main thread.
class Recorders {
 public:
  /// Starts them.
  /// @param machine  name of this one in the graph; empty: it declares none.
  /// @errors  already_exists if a file is there; as apps::ChildProgram::start().
  Status start(const graph::Graph& graph, const std::string& machine,
               const std::vector<host::RecordingOptions>& recordings);
  [[nodiscard]] std::size_t count() const { return running_.size(); }
  /// Looks after them. To be called now and then.
  /// @return what is wrong, by file or folder.
  std::map<std::string, std::string> look();
  /// Waits until they have written everything.
  /// @errors  data_loss if one of them says on stderr why it could not.
  Status finish();

 private:
  struct Recorder {
    std::string target;  // file or folder
    std::vector<std::string> words;
    bool is_renewed;                              // if it ends too early
    std::optional<apps::ChildProgram> program{};  // nothing: it could not be started
    std::string fault{};                          // of the last one
    std::chrono::steady_clock::time_point begun{};
    std::optional<std::chrono::steady_clock::time_point> ended{};  // if it has, and no other one was tried
    std::chrono::seconds patience{1};                              // until the next one
  };
  void keep_always(const graph::Graph& graph, const std::string& name);
  Status start(Recorder& recorder);
  void look_at(Recorder& recorder);

  std::vector<Recorder> running_;
  std::string unkept_;  // why nothing can be kept
};

}  // namespace orca::deployer
