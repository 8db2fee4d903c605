// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/describe.hpp"

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <utility>

#include "contract_faults.hpp"
#include "orca/base/activity.hpp"
#include "orca/base/exception_text.hpp"
#include "orca/base/text.hpp"
#include "orca/component/component.hpp"
#include "orca/hw/container.hpp"
#include "orca/hw/seat.hpp"
#include "orca/plugin/code_limit.hpp"

namespace orca::plugin {
namespace {

Error cannot_describe(const std::string& type, const std::string& what) {
  return fail(Code::internal, "the type " + type + " cannot be described: " + what);
}

// Runs a plugin's code. An exception becomes an error, with its text copied before the plugin is unloaded.
// @param code  an address in the plugin.
template <class Run>
auto guarded(const std::string& type, Hook hook, const void* code, Run&& run) -> decltype(run()) {
  const CodeLimit limit;
  const Activity activity(type.c_str(), hook, code);
  try {
    return run();
  } catch (...) {
    return cannot_describe(type, std::string(to_string(hook)) + " " + describe_current_exception());
  }
}

// Returns an error if the type declares something that no graph could use.
Status check_declared(const Contract& contract) {
  const std::vector<std::string> faults = plugin::faults_of(contract);
  return faults.empty() ? ok() : Status(cannot_describe(contract.type, joined(faults, "; ")));
}

// A host that takes declarations and refuses every service, because a constructor must not use any.
template <class Base>
class Describer : public Base {
 public:
  Describer(PluginKind kind, const TypeEntry& type, const std::string& library, std::string name)
      : name_(std::move(name)) {
    contract_.kind = kind;
    contract_.type = type.type;
    contract_.library = std::filesystem::path(library).filename().string();
  }

  void declare_param(ParamDeclaration declaration) override {
    contract_.params.push_back(declaration.contract);
    setters_[declaration.contract.name] = std::move(declaration.set);
    *declaration.locked = true;
    locks_.push_back(declaration.locked);
  }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] TimePoint now() const override { refuse("asked for the time"); }
  [[nodiscard]] RandomStream random(std::string_view /*stream*/) const override {
    refuse("drew random numbers");
  }
  void write_log(log::Level level, std::string_view text) const override { log::write(level, name_, text); }

  [[noreturn]] static void refuse(const std::string& what) {
    throw std::logic_error("it " + what + ", but a constructor may only declare ports and parameters");
  }

  // Lets parameters be read: the constructor is over.
  void unlock_params() {
    for (bool* const lock : locks_) *lock = false;
  }

  Contract contract_;
  std::map<std::string, std::function<void(const ParamValue&)>> setters_;

 private:
  std::vector<bool*> locks_;
  std::string name_;
};

class ComponentDescriber final : public Describer<ComponentHost> {
 public:
  ComponentDescriber(const TypeEntry& type, const std::string& library, hw::HardwareSeat* hardware)
      : Describer(PluginKind::component, type, library, type.type), hardware_(hardware) {}

  void declare_port(PortDeclaration declaration) override {
    contract_.ports.push_back(std::move(declaration.contract));
  }
  void set_default_trigger(const Trigger& trigger) override { contract_.default_trigger = trigger; }
  [[nodiscard]] Duration lap_period() const override { refuse("asked for the time between its laps"); }
  [[nodiscard]] Device* hardware() override {
    contract_.needs_hardware = true;
    return hardware_;
  }
  void stay_active(bool /*active*/) override { refuse("called stay_active()"); }
  std::uint64_t begin_mission() override { refuse("began a mission"); }
  void end_mission() override { refuse("ended a mission"); }
  void note_cause(const idl::OrcaObject& /*object*/) override { refuse("named the cause of what it sends"); }
  void raise_alarm(std::string_view /*kind*/, idl::AlarmSeverity /*severity*/,
                   std::string_view /*text*/) override {
    refuse("raised an alarm");
  }
  void clear_alarm(std::string_view /*kind*/, std::string_view /*text*/) override {
    refuse("cleared an alarm");
  }
  [[nodiscard]] Strand& strand() override { refuse("blocked"); }

 private:
  hw::HardwareSeat* hardware_;
};

class HardwareDescriber final : public Describer<hw::HardwareHost>, public DescribedHardware {
 public:
  HardwareDescriber(const TypeEntry& type, const std::string& library, const std::string& name)
      : Describer(PluginKind::hardware, type, library, name),
        entry_(type),
        container_(static_cast<hw::HardwareContainer*>(type.create(*this))),
        seat_(*container_) {
    unlock_params();
  }
  ~HardwareDescriber() override {
    const CodeLimit limit;
    const Activity activity(contract_.type.c_str(), Hook::destructor, &entry_);
    try {
      entry_.destroy(container_);
    } catch (...) {
      write_log(log::Level::error, "its destructor " + describe_current_exception());
    }
  }

  [[nodiscard]] const Contract& contract() const override { return contract_; }
  std::vector<HardwareFault> prepare(const std::map<std::string, ParamValue>& params) override {
    for (const auto& [name, value] : params)
      if (const auto setter = setters_.find(name); setter != setters_.end()) setter->second(value);
    return faults_of([this] { return container_->prepare(); });
  }
  std::vector<HardwareFault> conflicts_with(DescribedHardware& earlier) override {
    return faults_of([&] { return container_->conflicts_with(earlier.container()); });
  }
  [[nodiscard]] hw::HardwareContainer& container() override { return *container_; }
  [[nodiscard]] hw::HardwareSeat& seat() override { return seat_; }

  [[nodiscard]] std::uint64_t run_seed() const override { refuse("asked for the seed"); }
  void state_changed(hw::HardwareState /*state*/) override { refuse("changed its state"); }
  void held(const std::optional<std::string>& /*reason*/) override { refuse("held its base"); }
  [[nodiscard]] Executive& executive() override { refuse("asked for the executive"); }
  void report(const idl::Contact& /*contact*/) override { refuse("reported a contact"); }
  void pausing() override { refuse("waited"); }

 private:
  using Faults = std::vector<HardwareFault>;
  // Calls the driver. An exception becomes a fault.
  Faults faults_of(const std::function<Faults()>& ask) const {
    const Result<Faults> faults =
        guarded(contract_.type, Hook::prepare, &entry_, [&]() -> Result<Faults> { return ask(); });
    return faults ? *faults : Faults{{"", faults.error().text()}};
  }

  const TypeEntry& entry_;
  hw::HardwareContainer* container_;
  hw::HardwareSeat seat_;
};

}  // namespace

Result<std::unique_ptr<DescribedHardware>> describe_hardware(const TypeEntry& type,
                                                             const std::string& library,
                                                             const std::string& name) {
  return guarded(type.type, Hook::constructor, &type, [&]() -> Result<std::unique_ptr<DescribedHardware>> {
    std::unique_ptr<DescribedHardware> described = std::make_unique<HardwareDescriber>(type, library, name);
    if (const Status sound = check_declared(described->contract()); !sound.ok()) return sound.error();
    return described;
  });
}

Result<Contract> describe_component(const TypeEntry& type, const std::string& library,
                                    hw::HardwareSeat* hardware) {
  return guarded(type.type, Hook::constructor, &type, [&]() -> Result<Contract> {
    ComponentDescriber describer(type, library, hardware);
    void* const component = type.create(describer);
    describer.unlock_params();
    {
      const Activity activity(type.type, Hook::destructor, &type);
      type.destroy(component);
    }
    if (const Status sound = check_declared(describer.contract_); !sound.ok()) return sound.error();
    return describer.contract_;
  });
}

}  // namespace orca::plugin
