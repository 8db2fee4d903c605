// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/idl/object.hpp"
#include "orca/supervisor/channel.hpp"

namespace orca::supervisor {

/// A line to the host process of a server, for questions to it.
struct ServerLine {
  graph::PortRef server;
  Descriptor line;  ///< As an operator's line: see orca/supervisor/control.hpp.
};

/// Asks the servers of a system for real what new code asks in its trial, each different question once: in a trial laps follow
/// each other much faster than servers are made for.
///
/// Thread contract: one thread.
class Questioner {
 public:
  /// @param give_up  asked several times a second; true ends a wait for an answer.
  Questioner(std::vector<ServerLine> lines, std::function<bool()> give_up);

  /// @errors  the server's own; unavailable if it cannot be reached or does not answer in time.
  Result<ObjectRef> ask(const graph::PortRef& server, ObjectLoan question);
  /// Returns why a question got no answer, not even an error of the server; empty: all got one.
  [[nodiscard]] const std::string& silence() const { return silence_; }

 private:
  Result<ObjectRef> ask_for_real(const graph::PortRef& server, const std::string& type,
                                 const std::vector<std::byte>& bytes);
  Error note_silence(const graph::PortRef& server, const std::string& why);

  std::map<graph::PortRef, std::unique_ptr<Channel>> lines_;
  const std::function<bool()> give_up_;
  std::map<std::pair<graph::PortRef, std::vector<std::byte>>, Result<ObjectRef>> known_;
  std::uint64_t last_request_ = 0;
  std::string silence_;
};

}  // namespace orca::supervisor
