// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/hw/container.hpp"

namespace orca::hwprobe {

/// The host of one driver that is tried, without a system around it. What the driver says is kept.
///
/// Thread contract: the driver's strand; the rest while that does not run.
class ProbeHost final : public hw::HardwareHost {
 public:
  explicit ProbeHost(Executive& executive) : executive_(executive) {}

  /// Sets a parameter of the driver. @return whether it has one of that name.
  bool set(const std::string& name, const std::string& value);
  /// Returns what the driver has said.
  [[nodiscard]] const std::vector<std::string>& said() const { return said_; }

  void declare_param(ParamDeclaration declaration) override { params_.push_back(std::move(declaration)); }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] TimePoint now() const override { return executive_.now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override { return {1, name_, stream}; }
  void write_log(log::Level /*level*/, std::string_view text) const override { said_.emplace_back(text); }
  [[nodiscard]] std::uint64_t run_seed() const override { return 1; }
  void report(const idl::Contact& /*contact*/) override {}
  void state_changed(hw::HardwareState /*state*/) override {}
  void held(const std::optional<std::string>& /*reason*/) override {}
  void pausing() override {}
  [[nodiscard]] Executive& executive() override { return executive_; }

 private:
  Executive& executive_;
  const std::string name_ = "probe";
  std::vector<ParamDeclaration> params_;
  mutable std::vector<std::string> said_;
};

}  // namespace orca::hwprobe
