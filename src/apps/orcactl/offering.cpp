// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "offering.hpp"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <string>
#include <utility>

#include "asking.hpp"
#include "client.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/value.hpp"
#include "orca/text/object_xml.hpp"
#include "table.hpp"
#include "tapping/object_learning.hpp"

namespace orca::orcactl {
namespace {

using supervisor::Channel;
using supervisor::LineAnswer;
using supervisor::OfferOutcome;

// Finds the first number of an object that is none.
class NanSearch final : public FieldVisitor {
 public:
  /// Returns its name; empty: there is none.
  std::string find(const ObjectType& type, void* object) {
    type.fields(object, *this);
    return found_;
  }

  void field(const FieldInfo& info, const Value& value) override {
    if (found_.empty()) look(std::string(info.name), value);
  }

 private:
  void look(const std::string& name, const Value& value) {
    if (const auto* const part = std::get_if<StructValue>(&value.of))
      return part->fields(part->object, *this);
    if (const auto* const* number = std::get_if<double*>(&value.of);
        number != nullptr && std::isnan(**number))
      found_ = name;
    const auto* const list = std::get_if<ListValue>(&value.of);
    const std::size_t count = list == nullptr ? 0 : list->size(list->list);
    for (std::size_t i = 0; i < count && found_.empty(); ++i) look(name, list->at(list->list, i));
  }

  std::string found_;
};

std::string read_stdin() { return {std::istreambuf_iterator<char>(std::cin), {}}; }

// Reads the object that the command line gives. Prints all errors in it.
Result<ObjectLoan> read_object(const std::string& word, const LineAnswer& line) {
  xml::Diagnostics diagnostics;
  const bool from_stdin = word == "-";
  Result<ObjectLoan> object =
      object_from(from_stdin ? read_stdin() : word, from_stdin ? "stdin" : "XML", line.type, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  return object;
}

Result<OfferOutcome> exchange(Channel& line, const ObjectLoan& object, Duration limit) {
  supervisor::Offer offer{std::string(object.type().name), {}};
  object.type().serialize(object.get(), offer.object);
  if (const Status sent = line.send(supervisor::encode(supervisor::LineWord(std::move(offer)), 1), limit);
      !sent.ok())
    return sent.error();
  Result<supervisor::Message> message = line.wait_for_message(limit);
  if (!message && message.error().code == Code::deadline_exceeded)
    return fail(Code::deadline_exceeded,
                "no answer came in time, and it may still be handled; see --timeout");
  if (!message) return fail(Code::unavailable, "the process of the port has ended");
  Result<supervisor::LineWord> word = supervisor::decode_line_word(std::move(message).value());
  if (!word) return word.error();
  auto* const outcome = std::get_if<OfferOutcome>(&*word);
  if (outcome == nullptr) return fail(Code::data_loss, "the process has sent something else than an answer");
  return std::move(*outcome);
}

Result<ObjectLoan> reply_in(const OfferOutcome& outcome) {
  const ObjectType* const type = find_object_type(outcome.type);
  if (type == nullptr)
    return fail(Code::data_loss, "replies of the type " + outcome.type + " are not known here");
  ObjectLoan object = make_object(*type);
  if (Status read = type->deserialize(outcome.object, object.get()); !read.ok()) return read.error();
  return object;
}

Status print_reply(const OfferOutcome& outcome, bool as_json) {
  const Result<ObjectLoan> object = reply_in(outcome);
  if (!object) return object.error();
  const std::string xml = to_xml(object->type(), object->get());
  std::fputs(as_json ? record_json({{"type", outcome.type}, {"xml", xml}}).c_str() : (xml + "\n").c_str(),
             stdout);
  return ok();
}

Status carry_out(const apps::Call& call, LineAnswer& answer) {
  const bool asks = call.command->name == "query";
  if (asks && answer.reply.empty())
    return fail(Code::invalid_argument, call.words[0] + " answers no questions; use orcactl send");
  if (!asks && !answer.reply.empty())
    return fail(Code::invalid_argument, call.words[0] + " is asked, not sent to; use orcactl query");
  const Result<ObjectLoan> object = read_object(call.words[1], answer);
  if (!object) return object.error();
  Channel line(std::move(answer.line));
  const Result<OfferOutcome> outcome =
      exchange(line, *object, call.duration("--timeout").value_or(kAnswerLimit));
  if (!outcome) return outcome.error();
  if (!outcome->outcome.ok()) return outcome->outcome;
  return outcome->type.empty() ? ok() : print_reply(*outcome, call.has("--json"));
}

}  // namespace

Result<ObjectLoan> object_from(const std::string& text, const std::string& source,
                               const std::string& type_name, xml::Diagnostics& diagnostics) {
  const ObjectType* const type = find_object_type(type_name);
  if (type == nullptr)
    return fail(Code::unimplemented, "objects of the type " + type_name + " are not known here");
  std::optional<ObjectLoan> object = from_xml(text, source, diagnostics, type);
  if (!object) return fail(Code::invalid_argument, "nothing was sent: the text is no " + type_name);
  if (const std::string name = NanSearch().find(object->type(), object->get()); !name.empty())
    return fail(Code::invalid_argument, "nothing was sent: " + name + " of the " + type_name +
                                            " is nan, which is no number; give it a value");
  return std::move(*object);
}

Result<ObjectLoan> ask_port(Client& client, const std::string& port, const ObjectLoan& question,
                            Duration limit) {
  Result<LineAnswer> answer = client.open_line(port, {});
  if (!answer) return answer.error();
  if (answer->reply.empty()) return fail(Code::invalid_argument, port + " answers no questions");
  Channel line(std::move(answer->line));
  const Result<OfferOutcome> outcome = exchange(line, question, limit);
  if (!outcome) return outcome.error();
  if (!outcome->outcome.ok()) return outcome->outcome.error();
  return reply_in(*outcome);
}

ExitCode offer(const apps::Call& call) {
  std::variant<Client, Failure> connected = Client::connect(call);
  if (auto* const failure = std::get_if<Failure>(&connected)) return report(*failure);
  learn_objects(call);
  Result<LineAnswer> answer = std::get<Client>(connected).open_line(call.words.front(), {});
  if (!answer) return report({answer.error()});
  const Status done = carry_out(call, *answer);
  return done.ok() ? ExitCode::done : report({done.error()});
}

}  // namespace orca::orcactl
