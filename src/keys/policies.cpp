// SPDX-License-Identifier: LGPL-3.0-or-later
#include "policies.hpp"

#include <array>
#include <ctime>

namespace orca::keys {
namespace {

constexpr const char* kDomains = "<domains><id_range><min>0</min><max>232</max></id_range></domains>";
constexpr std::int64_t kDay = 86'400;  // [s]

std::string time_text(std::int64_t seconds) {
  const std::time_t time = seconds;
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 32> text{};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  return {text.data(), size};
}

// Names of graphs have no character that XML would have to escape.
std::string rule(const char* what, const std::set<std::string>& topics) {
  if (topics.empty()) return {};
  std::string text = std::string("<") + what + "><topics>";
  for (const std::string& topic : topics) text += "<topic>" + topic + "</topic>";
  return text + "</topics></" + what + ">\n";
}

}  // namespace

// Whole messages are encrypted for participants (rtps), and in them what each writer and reader says, with its own key
// (metadata), so that a participant without permission for a topic can neither read nor forge it. To encrypt the data in that once
// more would protect nothing.
std::string governance() {
  return std::string(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds><domain_access_rules><domain_rule>
)") + kDomains +
         R"(
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
<rtps_protection_kind>ENCRYPT</rtps_protection_kind>
<topic_access_rules><topic_rule>
<topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection>
<enable_liveliness_protection>true</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>ENCRYPT</metadata_protection_kind>
<data_protection_kind>NONE</data_protection_kind>
</topic_rule></topic_access_rules>
</domain_rule></domain_access_rules></dds>
)";
}

// The certificate says when it ends. Fast DDS reads these times in the zone of the machine, so they are a day longer.
std::string permissions(const std::string& subject, const Permit& permit, const Span& span) {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds><permissions><grant name="orca">
<subject_name>)" +
         subject + "</subject_name>\n<validity><not_before>" + time_text(span.from - kDay) +
         "</not_before><not_after>" + time_text(span.until + kDay) + "</not_after></validity>\n<allow_rule>" +
         kDomains + "\n" + rule("publish", permit.writes) + rule("subscribe", permit.reads) +
         "</allow_rule>\n<default>DENY</default>\n</grant></permissions></dds>\n";
}

}  // namespace orca::keys
