// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/component/param.hpp"
#include "orca/hw/container.hpp"
#include "orca/robots/characteristics.hpp"

namespace orca::hw {

/// A parameter of a driver whose value the graph sets; or else the robot's file gives it, if one is named; or else it is the
/// driver's own.
///
/// @tparam T  as of Param.
/// Thread contract: the container's strand.
template <class T>
class FileParam {
 public:
  FileParam(HardwareContainer& owner, std::string name, T own, ParamOptions options)
      : owner_(owner),
        name_(name),
        options_(options),
        param_(*this, std::move(name), std::move(own), options) {}

  [[nodiscard]] const T& operator*() const { return from_file_ && !is_set_ ? *from_file_ : *param_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const ParamOptions& options() const { return options_; }
  /// Returns whether the graph has set it.
  [[nodiscard]] bool is_set() const { return is_set_; }

  /// Takes the value of the robot's file. One that the graph has set counts more.
  void take_from_file(T value) { from_file_ = std::move(value); }

  /// Notes when the graph sets it.
  void declare_param(ParamDeclaration declaration) {
    owner_.declare_param(
        {std::move(declaration.contract), [this, set = std::move(declaration.set)](const ParamValue& value) {
           set(value);
           is_set_ = true;
         }});
  }

 private:
  HardwareContainer& owner_;
  const std::string name_;
  const ParamOptions options_;
  bool is_set_ = false;
  std::optional<T> from_file_;
  Param<T> param_;
};

/// The parameter `robot` of a driver: the file of the robot that the device belongs to, the same that the simulator reads
/// (docs/robot-files.md). Empty: the driver has its own figures.
///
/// Thread contract: the container's strand.
class RobotFileParam {
 public:
  explicit RobotFileParam(HardwareContainer& owner);

  /// Reads the file if one is named. To be called in prepare().
  /// @return what is wrong with it.
  [[nodiscard]] std::vector<HardwareFault> read();

  /// Returns the robot; null: no file is named, or it could not be read.
  [[nodiscard]] const robots::Characteristics* robot() const { return robot_ ? &*robot_ : nullptr; }
  [[nodiscard]] bool is_named() const { return !path_->empty(); }
  /// Returns the path of the file, in quotes for people.
  [[nodiscard]] std::string shown() const;

  /// Lets a parameter take a figure of the file. One beyond the parameter's range counts as the nearest within it.
  /// @param figure  as the file calls it: "max_speed of <drive>".
  /// @param most    the largest value that this device can take, if its range does not say it.
  /// @return a warning if it is beyond the range, unless the graph sets the parameter.
  [[nodiscard]] std::vector<HardwareFault> give(FileParam<double>& param, double value,
                                                const std::string& figure,
                                                std::optional<double> most = std::nullopt) const;

 private:
  Param<std::string> path_;
  std::optional<robots::Characteristics> robot_;
};

}  // namespace orca::hw
