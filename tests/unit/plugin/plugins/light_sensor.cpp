// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "test_light/light.hpp"

namespace {

class LightSensor final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::PushServer<test::Light> light_{*this, "light"};
  orca::PushServer<test::SureRanges> ranges_{*this, "ranges"};

  orca::Outcome work() override { return orca::again(); }
};

}  // namespace

ORCA_COMPONENT(LightSensor, "test.LightSensor")
