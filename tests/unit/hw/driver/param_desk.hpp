// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fake_scout.hpp"
#include "temp_folder.hpp"

namespace orca::test {

/// A host that sets parameters as the graph would.
class ParamHost final : public FakeHardwareHost {
 public:
  using FakeHardwareHost::FakeHardwareHost;

  void declare_param(ParamDeclaration declaration) override {
    params_[declaration.contract.name] = std::move(declaration);
  }
  void set(const std::string& name, ParamValue value) { params_.at(name).set(value); }

 private:
  std::map<std::string, ParamDeclaration> params_;
};

/// A driver that is never run, and the parameters of a driver's part.
/// @tparam Part  is constructed from the driver and `arguments`.
template <class Part>
struct ParamDesk {
  template <class... Arguments>
  explicit ParamDesk(Arguments&&... arguments)
      : executive(make_executive({ClockKind::virtual_time, Backend::baton}).value()),
        host(*executive, diary),
        driver(host, diary),
        part(driver, std::forward<Arguments>(arguments)...) {}

  /// Sets a parameter, as the graph would.
  ParamDesk& with(const std::string& name, ParamValue value) {
    host.set(name, std::move(value));
    return *this;
  }

  Diary diary;
  std::unique_ptr<Executive> executive;
  ParamHost host;
  FakeScout driver;
  Part part;
};

/// Returns "PARAM: TEXT" of each fault; of a warning, "warning PARAM: TEXT".
inline std::vector<std::string> texts_of(const std::vector<HardwareFault>& faults) {
  std::vector<std::string> texts;
  for (const HardwareFault& fault : faults)
    texts.push_back((fault.only_warns ? "warning " : "") + fault.param + ": " + fault.text);
  return texts;
}

inline const std::string kRobotBody =
    R"(<link name="base"><inertial><mass value="10"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="0.5"/></inertial>)"
    R"(<collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.2" length="0.3"/></geometry></collision></link>)"
    R"(<link name="deck"/><joint name="j" type="fixed"><parent link="base"/><child link="deck"/>)"
    R"(<origin xyz="0.1 -0.02 0.3" rpy="0 0 1.5"/></joint>)"
    R"(<link name="lid"/><joint name="k" type="fixed"><parent link="base"/><child link="lid"/><origin xyz="-0.1 0 0.5"/></joint>)";

/// Returns the text of a robot file with this inside its <orca>, after a drive of that type.
inline std::string robot_text(const std::string& devices, const std::string& drive = "differential",
                              const std::string& name = "Rover") {
  return "<robot name=\"" + name + "\">\n" + kRobotBody +
         "\n<orca vendor=\"Makers\" model=\"R1\" radius=\"0.2 m\" bumper_radius=\"0.22 m\">\n"
         "<drive type=\"" +
         drive +
         "\" max_speed=\"0.8 m/s\" max_steer_speed=\"2 rad/s\" max_acceleration=\"0.6 m/s2\" "
         "max_steer_acceleration=\"4 rad/s2\" track=\"0.33 m\" wheel_diameter=\"0.15 m\" steer_gain=\"1.5\" "
         "big_turn_angle=\"0.7 rad\" big_turn_speed=\"0.25 m/s\" vendor=\"Wheelers\"/>\n" +
         devices + "</orca>\n</robot>\n";
}

inline std::string laser_text(const std::string& name, const std::string& link,
                              const std::string& first_angle = "-90 deg") {
  return "<laser name=\"" + name + "\" link=\"" + link + "\" count=\"181\" first_angle=\"" + first_angle +
         "\" pitch=\"1 deg\" max_range=\"8 m\" period=\"100 ms\"/>\n";
}

}  // namespace orca::test
