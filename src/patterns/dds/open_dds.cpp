// SPDX-License-Identifier: LGPL-3.0-or-later
#include <dlfcn.h>

#include <utility>

#include "orca/patterns/dds/dds_backend.hpp"
#include "orca/patterns/dds/ros_topics.hpp"
#include "orca/patterns/dds/team_topics.hpp"

namespace orca {
namespace {

// Calls a function of the library that makes one of its parts.
template <class Make, class Made, class Options>
void make_part(const std::string& library, const char* function, const Options& options, Made& made) {
  void* const opened = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (opened == nullptr) {
    made.emplace(fail(Code::unavailable, "the library for DDS cannot be used: " + std::string(dlerror())));
    return;
  }
  if (const auto make = reinterpret_cast<Make>(dlsym(opened, function)))
    make(options, made);
  else
    made.emplace(fail(Code::unavailable, library + " is not Orca's library for DDS"));
}

}  // namespace

Result<std::unique_ptr<DdsBackend>> open_dds(const std::string& library, const DdsOptions& options) {
  MadeDdsBackend made;
  make_part<MakeDdsBackend>(library, "orca_make_dds_backend", options, made);
  return std::move(*made);
}

Result<std::unique_ptr<RosTopics>> open_ros_topics(const std::string& library, const RosOptions& options) {
  MadeRosTopics made;
  make_part<MakeRosTopics>(library, "orca_make_ros_topics", options, made);
  return std::move(*made);
}

Result<std::unique_ptr<TeamTopics>> open_team_topics(const std::string& library, const TeamOptions& options) {
  MadeTeamTopics made;
  make_part<MakeTeamTopics>(library, "orca_make_team_topics", options, made);
  return std::move(*made);
}

}  // namespace orca
