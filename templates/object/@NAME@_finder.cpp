#include <algorithm>

#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

#include "@NAME@_objects/@NAME@.hpp"

namespace {

/// Finds what is nearest among the readings of a ring of sensors.
class @CLASS@Finder final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::PushProxy<orca::idl::RangeReadings> ranges_{*this, "ranges"};
  orca::PushServer<my::@CLASS@> nearest_{*this, "nearest"};

  orca::Outcome work() override {
    const auto readings = ranges_.get_update_wait();
    const auto& ranges = readings->ranges();
    if (ranges.empty()) return orca::again();
    const auto nearest = std::ranges::min_element(ranges);
    auto found = nearest_.loan();
    found->distance(*nearest);
    found->sensor(static_cast<std::uint32_t>(nearest - ranges.begin()));
    found->stamp(orca::to_time_value(readings.ref().stamp()));
    nearest_.push(std::move(found));
    return orca::again();
  }
};

}  // namespace

ORCA_COMPONENT(@CLASS@Finder, "@TYPE@Finder")
