// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/idl/object.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/request_link.hpp"

namespace orca::host {

/// A question on its way out of the copy of a process.
struct TrialQuestion {
  graph::PortRef server;
  ObjectLoan object;
};

/// Pack and unpack a question, and its answer. @errors  data_loss for impossible bytes.
[[nodiscard]] std::string packed_question(const graph::PortRef& server, const ObjectRef& question);
[[nodiscard]] Result<TrialQuestion> unpacked_question(const std::string& bytes);
[[nodiscard]] std::string packed_answer(const Result<ObjectRef>& answer);
[[nodiscard]] Result<ObjectRef> unpacked_answer(const std::string& bytes);

/// The servers of an object on trial: what it asks goes to the process that waits for the trial, which answers at once, and what
/// it sends is accepted and thrown away.
///
/// Thread contract: connect() on one thread, before the object's strand starts.
class TrialServers {
 public:
  /// Takes a packed question, and returns the packed answer.
  using Ask = std::function<std::string(const std::string& question)>;

  explicit TrialServers(Ask ask) : ask_(std::move(ask)) {}

  /// Connects a client of Query or Send at its end of an edge, like all further edges of the graph there.
  void connect(const graph::Edge& edge, Endpoint& client);

 private:
  class Answering;
  class Accepting;

  const Ask ask_;
  std::vector<std::unique_ptr<QueryTarget>> answering_;
  std::vector<std::unique_ptr<SendTarget>> accepting_;
};

}  // namespace orca::host
