// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes may come from the line of a laser. They are read as a stream in both directions, and as one payload, whose first
// byte is the measuring mode, because few streams have good check words.
#include <algorithm>

#include "frame_stream.hpp"
#include "orca/hw/sick_lms/request.hpp"
#include "orca/hw/sick_lms/scan.hpp"

namespace {

using namespace orca::hw;
using fuzz::Bytes;
using fuzz::require;

void read_answers(const sick_lms::Reply& reply) {
  (void)sick_lms::parse_mode_answer(reply);
  (void)sick_lms::parse_variant(reply);
  (void)sick_lms::parse_type(reply);
  (void)sick_lms::parse_written(reply);
}

void read_configuration(const sick_lms::Reply& reply) {
  auto configuration = sick_lms::parse_configuration(reply);
  if (!configuration) return;
  require(std::ranges::equal(configuration->bytes(), reply.data));
  (void)configuration->set_measuring_mode(6);
  require(configuration->bytes().size() == reply.data.size());
  require(sick_lms::write_configuration(configuration->bytes()).has_value() == !reply.data.empty());
}

void read_scan(const sick_lms::Reply& reply, std::uint8_t mode) {
  static std::vector<double> ranges;
  const orca::Status status = sick_lms::parse_scan(reply, mode, ranges);
  require(status.ok() || !status.error().message.empty());
  if (status.ok()) require(2 * ranges.size() <= reply.data.size());
}

void read_payload(Bytes payload, std::uint8_t mode) {
  const auto reply = sick_lms::parse_reply(payload);
  require(reply.has_value() == (payload.size() >= 2));
  if (!reply) return;
  read_answers(*reply);
  read_configuration(*reply);
  read_scan(*reply, mode);
  read_scan(*reply, mode & 0x07);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes input(data, size);
  fuzz::check_stream(sick_lms::kFromLaser, input, [](Bytes telegram) {
    if (sick_lms::heard(telegram) == sick_lms::Heard::telegram)
      read_payload(sick_lms::payload_of(telegram), 6);
  });
  fuzz::check_stream(sick_lms::kFromHost, input, [](Bytes telegram) {
    require(std::ranges::equal(sick_lms::make_request(sick_lms::payload_of(telegram)), telegram));
  });
  if (size > 1) read_payload(input.subspan(1, std::min(size - 1, sick_lms::kLongestPayload)), data[0]);
  return 0;
}
