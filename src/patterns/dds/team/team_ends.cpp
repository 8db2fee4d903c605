// SPDX-License-Identifier: LGPL-3.0-or-later
#include "team_ends.hpp"

#include <cstring>
#include <vector>

#include "orca/base/exhaustion.hpp"
#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/time.hpp"
#include "orca/idl/time_shift.hpp"
#include "orca/ros/cdr.hpp"

namespace orca::dds::of_team {
namespace {

constexpr std::size_t kMostComplaints = 64;

}  // namespace

// --- Out --------------------------------------------------------------------------------------------------

bool TeamPublication::write(const ObjectRef& object, std::size_t /*size*/, const Label& /*label*/) {
  idl::TeamObject sent;
  sent.origin(system_);
  sent.seq(++seq_);
  sent.run(run_);
  sent.type(object.type().layout_hash);
  sent.content().resize(object.type().write(object.get(), {}));
  object.type().write(object.get(), std::as_writable_bytes(std::span(sent.content())));
  sent.creation_time(to_time_value(clock_.now()));
  std::vector<std::byte> payload(ros::kEncapsulation);
  std::memcpy(payload.data(), ros::kPlainCdr.data(), ros::kPlainCdr.size());
  std::vector<std::byte> fields;  // their alignment counts from their own beginning
  object_type<idl::TeamObject>().serialize(&sent, fields);
  payload.insert(payload.end(), fields.begin(), fields.end());
  writer().write(payload);
  return true;
}

// --- In ---------------------------------------------------------------------------------------------------

ObjectRef TeamToPush::read(std::span<const std::byte> payload, TimePoint now) {
  if (payload.size() < ros::kEncapsulation) return {};
  const Status whole =
      object_type<idl::TeamObject>().deserialize(payload.subspan(ros::kEncapsulation), &sent_);
  if (!whole.ok()) return complain("somebody", whole.error().message), ObjectRef{};
  if (sent_.origin() == system_ && sent_.run() == run_) return {};
  Result<ObjectRef> object = contain_exhaustion([&] { return object_of(sent_, now); });
  if (object) return std::move(object).value();
  complain(may_be_system(sent_.origin()) ? sent_.origin() : "somebody", object.error().message);
  return {};
}

Result<ObjectRef> TeamToPush::object_of(const idl::TeamObject& sent, TimePoint now) {
  if (!may_be_system(sent.origin())) return fail(Code::data_loss, "its name is none that a system can have");
  const ObjectType* const type = find_subtype(wanted_, sent.type());
  if (type == nullptr)
    return fail(Code::data_loss, "its objects are no " + std::string(wanted_.name) +
                                     " as this system has it; run the same version of Orca on both");
  const auto sender = senders_.note(sent.origin(), sent.run(), to_time_point(sent.creation_time()), now);
  if (!sender) return fail(Code::data_loss, "too many systems speak");
  ObjectLoan loan = make_object(*type);
  if (Status read = type->deserialize(std::as_bytes(std::span(sent.content())), loan.get()); !read.ok())
    return read.error();
  shift_times(loan, sender->shift);
  loan.header().origin(sender->name);
  return std::move(loan).seal();
}

void TeamToPush::complain(const std::string& sender, const std::string& text) {
  if (complained_.size() >= kMostComplaints || !complained_.insert(sender).second) return;
  log::warning(user(), "what " + in_quotes(shortened(sender, 64)) + " offers to the team as " +
                           in_quotes(topic()) + " is dropped: " + text);
}

}  // namespace orca::dds::of_team
