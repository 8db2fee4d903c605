#include <algorithm>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// Commands a full stop while anything is nearer than `stop_distance`.
class @CLASS@ final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::PushProxy<orca::idl::RangeReadings> ranges_{*this, "ranges"};
  orca::PushServer<orca::idl::MotionCommand> motion_{*this, "motion"};
  orca::Param<double> stop_distance_{*this, "stop_distance", 0.5, {.unit = "m", .min = 0.0}};

  orca::Outcome work() override {
    const auto readings = ranges_.get_update_wait();
    const auto near = [&](double range) { return range < *stop_distance_; };
    const bool stops = std::ranges::any_of(readings->ranges(), near);
    motion_.push(stops ? orca::full_stop() : orca::dont_care());
    return orca::again();
  }
};

}  // namespace

ORCA_COMPONENT(@CLASS@, "@TYPE@")
