// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin that uses spdlog and Eigen, both full of templates with statics.
#include <spdlog/sinks/null_sink.h>
#include <spdlog/spdlog.h>

#include <Eigen/Dense>

#include "orca/component.hpp"

namespace {

class Libraries final : public orca::Component {
 public:
  explicit Libraries(orca::ComponentHost& host) : Component(host) {
    spdlog::logger quiet("quiet", std::make_shared<spdlog::sinks::null_sink_mt>());
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    quiet.info("determinant {}", turned.determinant());
    determinant_ = turned.determinant();
  }
  orca::Outcome work() override { return determinant_ > 0.0 ? orca::done() : orca::again(); }

 private:
  double determinant_ = 0.0;
};

}  // namespace

ORCA_COMPONENT(Libraries, "test.Libraries")
