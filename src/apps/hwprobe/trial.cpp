// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "trial.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>

#include "orca/base/executive.hpp"
#include "orca/hw/link/make_link.hpp"
#include "orca/text/object_xml.hpp"
#include "probe_host.hpp"

namespace orca::hwprobe {
namespace {

using namespace std::chrono_literals;

// The first object of each sensor.
class FirstData {
 public:
  explicit FirstData(hw::HardwareContainer& driver) : driver_(driver) {
    texts_.resize(driver.sensors().size());
    for (std::size_t i = 0; i < texts_.size(); ++i)
      driver.sensors()[i]->set_sink(this,
                                    [this, i](ObjectLoan reading) { return note(i, std::move(reading)); });
  }
  ~FirstData() {
    for (hw::SensorEndpoint* const sensor : driver_.sensors()) sensor->set_sink(this, nullptr);
  }
  FirstData(const FirstData&) = delete;
  FirstData& operator=(const FirstData&) = delete;

  [[nodiscard]] bool is_complete() const {
    const std::lock_guard lock(mutex_);
    return std::ranges::none_of(texts_, &std::string::empty);
  }
  void tell(Finding& finding) const {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < texts_.size(); ++i) {
      if (texts_[i].empty())
        finding.silent.emplace_back(driver_.sensors()[i]->type().name);
      else
        finding.data.push_back(texts_[i]);
    }
  }

 private:
  ObjectRef note(std::size_t sensor, ObjectLoan reading) {
    ObjectRef object = std::move(reading).seal();
    const std::lock_guard lock(mutex_);
    if (texts_[sensor].empty()) texts_[sensor] = to_xml(object);
    return object;
  }

  hw::HardwareContainer& driver_;
  mutable std::mutex mutex_;
  std::vector<std::string> texts_;
};

// Waits until something holds, at most until the limit.
void wait_for(Executive& executive, Duration limit, const std::function<bool()>& holds) {
  const TimePoint end = executive.now() + limit;
  while (!holds() && executive.now() < end) executive.sleep_until(executive.now() + 10ms);
}

void take_data(hw::HardwareContainer& driver, Executive& executive, Duration limit, Finding& finding) {
  const FirstData data(driver);
  driver.acquire();
  wait_for(executive, limit,
           [&] { return data.is_complete() || driver.state() == hw::HardwareState::fault; });
  data.tell(finding);
  driver.release();
}

Finding looked(hw::HardwareContainer& driver, Executive& executive, Duration limit) {
  Finding finding;
  driver.run();
  wait_for(executive, limit, [&] {
    return driver.state() == hw::HardwareState::ready || driver.state() == hw::HardwareState::fault;
  });
  finding.answers = driver.state() == hw::HardwareState::ready;
  if (finding.answers) {
    finding.what = driver.description();
    take_data(driver, executive, limit, finding);
  } else {
    finding.reason =
        driver.state() == hw::HardwareState::fault ? driver.fault() : "it has not answered in time";
  }
  driver.shut_down();
  (void)driver.join_until(executive.now() + limit);
  finding.line = driver.statistics();
  return finding;
}

}  // namespace

bool Driver::may_be_at(std::string_view port) const {
  const bool is_serial = port.starts_with('/') || port.starts_with("serial:");
  return !is_serial || !usual_line.starts_with("tcp:");
}

std::vector<Driver> drivers(host::PluginCatalogue& catalogue) {
  std::vector<Driver> found;
  for (const std::string& type : catalogue.type_names(PluginKind::hardware)) {
    const Result<Contract> contract = catalogue.hardware(type);
    if (!contract) continue;
    for (const ParamContract& param : contract->params)
      if (const auto* usual = std::get_if<std::string>(&param.default_value); usual && param.name == "device")
        found.push_back({type, *usual});
  }
  return found;
}

Result<Finding> try_driver(host::PluginCatalogue& catalogue, const std::string& type, const std::string& port,
                           Duration limit) {
  const Result<host::LoadedType> loaded = catalogue.acquire(PluginKind::hardware, type);
  if (!loaded) return loaded.error();
  Result<std::unique_ptr<Executive>> executive = make_executive({});
  if (!executive) return executive.error();
  ProbeHost host(**executive);
  const std::unique_ptr<hw::HardwareContainer, void (*)(void*)> driver(
      static_cast<hw::HardwareContainer*>(loaded->entry->create(host)), loaded->entry->destroy);
  (void)host.set("device", port);
  for (const HardwareFault& fault : driver->prepare())
    if (!fault.only_warns) return fail(Code::invalid_argument, fault.text);
  Finding finding;
  (*executive)->run([&] { finding = looked(*driver, **executive, limit); });
  finding.said = host.said();
  return finding;
}

Status try_port(const std::string& port) {
  const auto link = hw::link::make_link(port);
  if (!link) return link.error();
  return hw::link::open_within(**link, 5s);
}

}  // namespace orca::hwprobe
