#include "orca/component.hpp"
#include "orca/idl/motion.hpp"

#include "@NAME@_objects/@NAME@.hpp"

namespace {

/// Commands a full stop while the nearest thing is nearer than `stop_distance`.
class @CLASS@Stop final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::PushProxy<my::@CLASS@> nearest_{*this, "nearest"};
  orca::PushServer<orca::idl::MotionCommand> motion_{*this, "motion"};
  orca::Param<double> stop_distance_{*this, "stop_distance", 0.5, {.unit = "m", .min = 0.0}};

  orca::Outcome work() override {
    const bool is_near = nearest_.get_update_wait()->distance() < *stop_distance_;
    motion_.push(is_near ? orca::full_stop() : orca::dont_care());
    return orca::again();
  }
};

}  // namespace

ORCA_COMPONENT(@CLASS@Stop, "@TYPE@Stop")
