// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trial_servers.hpp"

#include <cstddef>
#include <optional>
#include <utility>

#include "orca/idl/object_type.hpp"
#include "orca/patterns/endpoints/query_client_endpoint.hpp"
#include "orca/patterns/endpoints/send_client_endpoint.hpp"
#include "run/system/component_making.hpp"

namespace orca::host {
namespace {

constexpr char kReplyMark = 'r';
constexpr char kErrorMark = 'e';

Error damaged_words() { return fail(Code::data_loss, "what a trial asked or was told has arrived damaged"); }

// An object as its type's name, a zero and its bytes.
std::string packed_object(const ObjectRef& object) {
  std::vector<std::byte> bytes;
  object.type().serialize(object.get(), bytes);
  return std::string(object.type().name) + '\0' +
         std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

Result<ObjectLoan> unpacked_object(const std::string& bytes) {
  const std::size_t end = bytes.find('\0');
  const ObjectType* const type = end == std::string::npos ? nullptr : find_object_type(bytes.substr(0, end));
  if (type == nullptr) return damaged_words();
  const auto* const data = reinterpret_cast<const std::byte*>(bytes.data()) + end + 1;
  ObjectLoan object = make_object(*type);
  if (Status read = type->deserialize({data, bytes.size() - end - 1}, object.get()); !read.ok())
    return read.error();
  return object;
}

}  // namespace

// --- Packing ----------------------------------------------------------------------------------------------

std::string packed_question(const graph::PortRef& server, const ObjectRef& question) {
  return server.component + '\0' + server.port + '\0' + packed_object(question);
}

Result<TrialQuestion> unpacked_question(const std::string& bytes) {
  const std::size_t first = bytes.find('\0');
  const std::size_t second = first == std::string::npos ? first : bytes.find('\0', first + 1);
  if (second == std::string::npos) return damaged_words();
  Result<ObjectLoan> object = unpacked_object(bytes.substr(second + 1));
  if (!object) return object.error();
  return TrialQuestion{{bytes.substr(0, first), bytes.substr(first + 1, second - first - 1)},
                       std::move(object).value()};
}

std::string packed_answer(const Result<ObjectRef>& answer) {
  if (answer) return kReplyMark + packed_object(*answer);
  const Error& error = answer.error();
  return std::string{kErrorMark, static_cast<char>(error.code)} + error.where + '\0' + error.message;
}

Result<ObjectRef> unpacked_answer(const std::string& bytes) {
  if (bytes.starts_with(kReplyMark)) {
    Result<ObjectLoan> object = unpacked_object(bytes.substr(1));
    if (!object) return object.error();
    return std::move(object).value().seal();
  }
  const std::size_t end = bytes.find('\0', 2);
  if (!bytes.starts_with(kErrorMark) || end == std::string::npos) return damaged_words();
  return fail(static_cast<Code>(bytes[1]), bytes.substr(end + 1), bytes.substr(2, end - 2));
}

// --- The servers ------------------------------------------------------------------------------------------

class TrialServers::Answering final : public QueryTarget {
 public:
  Answering(const Ask& ask, graph::PortRef server) : ask_(ask), server_(std::move(server)) {}

  std::optional<Result<ObjectRef>> offer(const ObjectRef& question, QueryReplySink& reply_to, QueryId id,
                                         bool /*may_wait*/) override {
    reply_to.reply(id, unpacked_answer(ask_(packed_question(server_, question))));
    return std::nullopt;
  }
  void withdraw(QueryId /*id*/) override {}  // it has its answer
  [[nodiscard]] Duration patience() const override { return Duration{0}; }
  [[nodiscard]] std::string path() const override { return server_.text(); }

 private:
  const Ask& ask_;
  const graph::PortRef server_;
};

class TrialServers::Accepting final : public SendTarget {
 public:
  explicit Accepting(graph::PortRef server) : server_(std::move(server)) {}

  std::optional<Status> offer(const ObjectRef& /*object*/, SendReplySink& /*reply_to*/, SendId /*id*/,
                              bool /*may_wait*/) override {
    return ok();
  }
  void withdraw(SendId /*id*/) override {}
  [[nodiscard]] Duration patience() const override { return Duration{0}; }
  [[nodiscard]] std::string path() const override { return server_.text(); }

 private:
  const graph::PortRef server_;
};

void TrialServers::connect(const graph::Edge& edge, Endpoint& client) {
  if (auto* const asking = dynamic_cast<QueryClientEndpoint*>(&client)) {
    answering_.push_back(std::make_unique<Answering>(ask_, edge.to));
    asking->connect(*answering_.back());
  }
  if (auto* const sending = dynamic_cast<SendClientEndpoint*>(&client)) {
    accepting_.push_back(std::make_unique<Accepting>(edge.to));
    sending->connect(*accepting_.back());
  }
}

}  // namespace orca::host
