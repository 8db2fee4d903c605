// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "trial.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "orca/base/executive.hpp"
#include "orca/hw/link/device_files.hpp"
#include "orca/hw/link/make_link.hpp"
#include "orca/text/object_xml.hpp"
#include "probe_host.hpp"

namespace orca::hwprobe {
namespace {

using namespace std::chrono_literals;

constexpr Duration kSettling = 1s;  // in which a device that measures piece by piece has done all

// The latest object of each sensor.
class LatestData {
 public:
  explicit LatestData(hw::HardwareContainer& driver) : driver_(driver) {
    latest_.resize(driver.sensors().size());
    for (std::size_t i = 0; i < latest_.size(); ++i)
      driver.sensors()[i]->set_sink(this,
                                    [this, i](ObjectLoan reading) { return note(i, std::move(reading)); });
  }
  ~LatestData() {
    for (hw::SensorEndpoint* const sensor : driver_.sensors()) sensor->set_sink(this, nullptr);
  }
  LatestData(const LatestData&) = delete;
  LatestData& operator=(const LatestData&) = delete;

  [[nodiscard]] bool is_complete() const {
    const std::lock_guard lock(mutex_);
    return std::ranges::all_of(latest_, [](const ObjectRef& object) { return bool(object); });
  }
  void tell(Finding& finding) const {
    const std::lock_guard lock(mutex_);
    finding.data.clear();
    finding.silent.clear();
    for (std::size_t i = 0; i < latest_.size(); ++i) {
      if (latest_[i])
        finding.data.push_back(to_xml(latest_[i]));
      else
        finding.silent.push_back(driver_.sensors()[i]->port_stem());
    }
  }

 private:
  ObjectRef note(std::size_t sensor, ObjectLoan reading) {
    ObjectRef object = std::move(reading).seal();
    const std::lock_guard lock(mutex_);
    latest_[sensor] = object;
    return object;
  }

  hw::HardwareContainer& driver_;
  mutable std::mutex mutex_;
  std::vector<ObjectRef> latest_;
};

// A look at one driver.
class Trial {
 public:
  Trial(hw::HardwareContainer& driver, Executive& executive, const Look& look)
      : driver_(driver), executive_(executive), look_(look) {}

  Finding run() {
    driver_.run();
    wait_for(look_.limit, [&] { return driver_.state() == hw::HardwareState::ready || has_failed(); });
    finding_.answers = driver_.state() == hw::HardwareState::ready;
    if (finding_.answers) {
      finding_.what = driver_.description();
      finding_.learned = driver_.learned();
      if (finding_.learned.empty()) take_data();
    } else {
      finding_.reason = has_failed() ? driver_.fault() : "it has not answered in time";
    }
    driver_.shut_down();
    (void)driver_.join_until(executive_.now() + look_.limit);
    finding_.line = driver_.statistics();
    return std::move(finding_);
  }

 private:
  // Waits until something holds, at most until the limit.
  void wait_for(Duration limit, const std::function<bool()>& holds) {
    const TimePoint end = executive_.now() + limit;
    while (!holds() && !is_stopped() && executive_.now() < end)
      executive_.sleep_until(executive_.now() + 10ms);
  }

  void take_data() {
    const LatestData data(driver_);
    driver_.acquire();
    wait_for(look_.limit, [&] { return data.is_complete() || has_failed(); });
    wait_for(kSettling, [&] { return has_failed(); });
    data.tell(finding_);
    while (look_.show && !is_stopped() && !has_failed()) {
      look_.show(finding_);
      wait_for(1s, [&] { return has_failed(); });
      data.tell(finding_);
    }
    if (has_failed()) finding_.said.push_back(driver_.fault());
    driver_.release();
  }

  [[nodiscard]] bool has_failed() const {
    return driver_.state() == hw::HardwareState::fault || driver_.state() == hw::HardwareState::backoff;
  }
  [[nodiscard]] bool is_stopped() const { return look_.is_stopped && look_.is_stopped(); }

  hw::HardwareContainer& driver_;
  Executive& executive_;
  const Look& look_;
  Finding finding_;
};

Result<Finding> try_with(const host::LoadedType& loaded, const std::string& port, const Learned& params,
                         const Look& look) {
  Result<std::unique_ptr<Executive>> executive = make_executive({});
  if (!executive) return executive.error();
  ProbeHost host(**executive);
  const std::unique_ptr<hw::HardwareContainer, void (*)(void*)> driver(
      static_cast<hw::HardwareContainer*>(loaded.entry->create(host)), loaded.entry->destroy);
  (void)host.set("device", port);
  for (const auto& [name, value] : params) (void)host.set(name, value);
  for (const HardwareFault& fault : driver->prepare())
    if (!fault.only_warns) return fail(Code::invalid_argument, fault.text);
  Finding finding;
  (*executive)->run([&] { finding = Trial(*driver, **executive, look).run(); });
  finding.said.insert(finding.said.begin(), host.said().begin(), host.said().end());
  return finding;
}

}  // namespace

std::vector<DriverType> drivers(host::PluginCatalogue& catalogue) {
  std::vector<DriverType> found;
  for (const std::string& type : catalogue.type_names(PluginKind::hardware)) {
    const Result<Contract> contract = catalogue.hardware(type);
    if (!contract) continue;
    const auto port = std::ranges::find(contract->params, "device", &ParamContract::name);
    if (port == contract->params.end()) continue;
    const auto* const usual = std::get_if<std::string>(&port->default_value);
    found.push_back({type, usual != nullptr ? place_of(*usual) : Place::serial});
  }
  return found;
}

Place place_of(std::string_view port) {
  if (port.starts_with("tcp:")) return Place::network;
  return hw::link::is_camera(std::string(port)) ? Place::camera : Place::serial;
}

Result<Finding> try_driver(host::PluginCatalogue& catalogue, const std::string& type, const std::string& port,
                           const Look& look) {
  const Result<host::LoadedType> loaded = catalogue.acquire(PluginKind::hardware, type);
  if (!loaded) return loaded.error();
  Result<Finding> finding = try_with(*loaded, port, {}, look);
  if (!finding || finding->learned.empty()) return finding;
  Result<Finding> closer = try_with(*loaded, port, finding->learned, look);
  if (closer && closer->answers) {
    closer->learned = finding->learned;
    return closer;
  }
  finding->said.push_back("it did not answer a second time, as what it calls itself");
  return finding;
}

Status try_port(const std::string& port) {
  const auto link = hw::link::make_link(port);
  if (!link) return link.error();
  return hw::link::open_within(**link, 5s);
}

}  // namespace orca::hwprobe
