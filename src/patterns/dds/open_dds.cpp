// SPDX-License-Identifier: LGPL-3.0-or-later

#include "orca/base/files/own_library.hpp"
#include "orca/patterns/dds/dds_backend.hpp"
#include "orca/patterns/dds/ros_topics.hpp"
#include "orca/patterns/dds/team_topics.hpp"

namespace orca {
namespace {

// Calls a function of the library that makes one of its parts.
template <class Make, class Made, class Options>
Made made_by(const char* function, const Options& options) {
  Made made;
  if (const auto make = late_function<Make>("liborca_dds.so", function))
    (*make)(options, made);
  else
    made.emplace(make.error());
  return made;
}

}  // namespace

Result<std::unique_ptr<DdsBackend>> open_dds(const DdsOptions& options) {
  return *made_by<MakeDdsBackend, MadeDdsBackend>("orca_make_dds_backend", options);
}

Result<std::unique_ptr<RosTopics>> open_ros_topics(const RosOptions& options) {
  return *made_by<MakeRosTopics, MadeRosTopics>("orca_make_ros_topics", options);
}

Result<std::unique_ptr<TeamTopics>> open_team_topics(const TeamOptions& options) {
  return *made_by<MakeTeamTopics, MadeTeamTopics>("orca_make_team_topics", options);
}

}  // namespace orca
