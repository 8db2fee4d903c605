// SPDX-License-Identifier: LGPL-3.0-or-later
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "orca/patterns/dds/ros_topics.hpp"

namespace orca {
namespace {

// With a higher one the ports of DDS would reach into those that the system gives to anybody.
constexpr std::uint32_t kHighestDomain = 101;

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody changes it
  return value == nullptr ? std::string_view() : value;
}

}  // namespace

Result<RosOptions> ros_options_of_environment() {
  RosOptions options;
  if (const std::string_view domain = variable("ROS_DOMAIN_ID"); !domain.empty()) {
    const auto [end, error] = std::from_chars(domain.data(), domain.data() + domain.size(), options.domain);
    if (error != std::errc{} || end != domain.data() + domain.size() || options.domain > kHighestDomain)
      return fail(Code::invalid_argument,
                  "ROS_DOMAIN_ID is '" + std::string(domain) + "'; expected a number from 0 to 101");
  }
  const std::string_view only = variable("ROS_LOCALHOST_ONLY");
  if (!only.empty() && only != "0" && only != "1")
    return fail(Code::invalid_argument, "ROS_LOCALHOST_ONLY is '" + std::string(only) + "'; expected 0 or 1");
  const std::string_view range = variable("ROS_AUTOMATIC_DISCOVERY_RANGE");
  if (!range.empty() && range != "SUBNET" && range != "LOCALHOST")
    return fail(Code::invalid_argument, "ROS_AUTOMATIC_DISCOVERY_RANGE is '" + std::string(range) +
                                            "'; Orca knows SUBNET and LOCALHOST");
  options.only_here = only == "1" || range == "LOCALHOST";
  return options;
}

}  // namespace orca
