// SPDX-License-Identifier: LGPL-3.0-or-later
#include "driver_swap.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "fit.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"

namespace orca::host {
namespace {

constexpr Duration kDriverMakeLimit = 10s;
constexpr Duration kCloseLimit = 2s;
constexpr Duration kDriverEndLimit = 5s;
constexpr Duration kLook = 2ms;  // between two looks whether a strand has ended, which nobody reports
constexpr const char* kPause = "its driver is being exchanged";

// Whether a driver failed, also if it means to open its device again.
bool has_failed(HardwareInstance& driver) {
  const hw::HardwareState state = driver.container().state();
  return state == hw::HardwareState::fault || state == hw::HardwareState::backoff;
}

std::vector<std::string> texts_of(const std::vector<HardwareFault>& faults) {
  std::vector<std::string> texts;
  for (const HardwareFault& fault : faults)
    texts.push_back((fault.param.empty() ? "" : "parameter " + in_quotes(fault.param) + ": ") + fault.text);
  return texts;
}

}  // namespace

DriverSwap::DriverSwap(const Site& site, SwapOrder order)
    : site_(site), order_(std::move(order)), task_(site.run) {}

Error DriverSwap::refuse(Code code, const std::string& why) const {
  return fail(code, why, order_.component);
}

std::string DriverSwap::way_out() const {
  return "; orcactl restart " + site_.process + " starts its process again";
}

// --- Beside the present driver ----------------------------------------------------------------------------

Status DriverSwap::prepare() {
  if (!site_.place.remove_spare(site_.run.executive.now()))
    return refuse(Code::unavailable, "an earlier driver of it hangs" + way_out());
  report_.old_type = site_.type;
  report_.new_type = order_.type.empty() ? site_.type : order_.type;
  task_.begin(kDriverMakeLimit, [this] { made_ = make_driver(); });
  return ok();
}

DriverSwap::Outcome DriverSwap::made() {
  if (!task_.is_done()) return task_.is_late() ? leave_behind() : std::nullopt;
  task_.reset();
  if (!made_) return Outcome(made_.error());
  const std::vector<std::string> faults = driver_misfits(site_.place.driver(), **made_);
  if (!faults.empty()) {
    made_ = std::unique_ptr<HardwareInstance>();
    return Outcome(refuse(Code::failed_precondition,
                          report_.new_type + " cannot take its place: " + joined(faults, "; ")));
  }
  (*made_)->put_on_trial();
  site_.place.add_spare(std::move(made_).value());
  begin();
  return std::nullopt;
}

// The exchange ends without the new driver, and the present one has not noticed. One that sleeps for ever takes nothing but memory.
DriverSwap::Outcome DriverSwap::leave_behind() {
  const std::string what = "the constructor or prepare() of the new driver";
  is_stuck_ = true;
  if (is_loading_.load() || task_.computes()) {
    if (site_.stand_still)
      site_.stand_still(
          order_.component,
          what +
              (is_loading_.load() ? " or its static initialisation hangs, and no code can be loaded any more"
                                  : " computes without end") +
              ", so the process is ended, and begins anew with the code of the graph");
  } else {
    site_.run.reporter.log(log::Level::error, order_.component,
                           what + " does not return; it stays in memory until the process is started again");
  }
  return Outcome(refuse(Code::deadline_exceeded, what + " did not return within 10 s"));
}

Result<std::unique_ptr<HardwareInstance>> DriverSwap::make_driver() {
  is_loading_.store(true);
  Result<LoadedType> type =
      site_.catalogue.acquire(std::move(order_.plugin), PluginKind::hardware, report_.new_type, order_.trial);
  is_loading_.store(false);
  if (!type) return type.error();
  report_.build_id = type->library->build_id();
  auto described = plugin::describe_hardware(*type->entry, type->file(), order_.component);
  if (!described) return described.error();
  const Result<ParamValues> values =
      inherited((*described)->contract().params, site_.place.driver().params(), order_.params);
  if (!values) return values.error();
  report_.params = (*described)->contract().params;
  report_.values = *values;
  auto faults = (*described)->prepare(*values);
  std::erase_if(faults, [](const HardwareFault& fault) { return fault.only_warns; });
  if (!faults.empty()) return refuse(Code::invalid_argument, joined(texts_of(faults), "; "));
  auto driver = std::make_unique<HardwareInstance>(site_.run, order_.component, *type);
  if (Status made = driver->construct(*values); !made.ok()) return made.error();
  return driver;
}

void DriverSwap::begin() {
  began_ = site_.run.executive.now();
  site_.place.seat().pause(kPause);
  close(site_.place.driver(), Phase::closing);
}

// --- Step by step -----------------------------------------------------------------------------------------

std::optional<Result<SwapReport>> DriverSwap::step() {
  switch (phase_) {
    case Phase::making: return made();
    case Phase::closing: return closed();
    case Phase::opening: return opened();
    case Phase::closing_new: return closed_new();
    case Phase::opening_again: return opened_again();
  }
  return std::nullopt;
}

TimePoint DriverSwap::wake_up() const {
  if (phase_ == Phase::making) return task_.limit();
  const bool closes = phase_ == Phase::closing || phase_ == Phase::closing_new;
  return closes ? std::min(limit_, saturating_add(site_.run.executive.now(), kLook)) : limit_;
}

void DriverSwap::close(HardwareInstance& driver, Phase phase) {
  phase_ = phase;
  limit_ = saturating_add(site_.run.executive.now(), kCloseLimit);
  driver.container().shut_down();
}

// A driver whose device is in use has to start it, too, before the servers get it.
void DriverSwap::open(HardwareInstance& driver, Phase phase) {
  phase_ = phase;
  limit_ = saturating_add(site_.run.executive.now(), order_.open_limit);
  is_to_start_ = site_.place.seat().is_used();
  if (is_to_start_) driver.container().acquire();
  site_.place.run(driver);
}

bool DriverSwap::has_opened(HardwareInstance& driver) const {
  return driver.container().state() == (is_to_start_ ? hw::HardwareState::active : hw::HardwareState::ready);
}

bool DriverSwap::is_late() const { return site_.run.executive.now() >= limit_; }

std::string DriverSwap::trouble_of(HardwareInstance& driver) const {
  if (has_failed(driver)) return driver.container().fault();
  return "it was not ready within " + xml::number_text(to_seconds(order_.open_limit)) + " s";
}

DriverSwap::Outcome DriverSwap::closed() {
  HardwarePlace& place = site_.place;
  if (place.driver().container().join_until(site_.run.executive.now())) {
    open(*place.spare(), Phase::opening);
    return std::nullopt;
  }
  if (!is_late()) return std::nullopt;
  (void)place.remove_spare(kForever);  // it has never run
  const std::string why = "the present driver does not close the device" + way_out();
  place.seat().give_up(why);
  site_.run.reporter.raise(make_alarm(idl::HARDWARE_FAULT, order_.component, "", why));
  return refuse(Code::deadline_exceeded, why);
}

DriverSwap::Outcome DriverSwap::opened() {
  HardwareInstance& driver = *site_.place.spare();
  if (has_opened(driver)) return take();
  if (!has_failed(driver) && !is_late()) return std::nullopt;
  why_ = trouble_of(driver);
  close(driver, Phase::closing_new);
  return std::nullopt;
}

DriverSwap::Outcome DriverSwap::take() {
  site_.place.exchange();
  HardwareInstance& driver = site_.place.driver();
  site_.place.seat().resume(driver.container(), driver.description());
  if (is_to_start_) driver.container().release();
  driver.accept();
  report_.pause = site_.run.executive.now() - began_;
  (void)site_.place.remove_spare(kForever);  // its strand has ended
  return report_;
}

// A new driver that hangs stays beside the present one, which may find the device occupied.
DriverSwap::Outcome DriverSwap::closed_new() {
  if (!site_.place.remove_spare(site_.run.executive.now())) {
    if (!is_late()) return std::nullopt;
    why_ += ", and hangs";
  }
  HardwareInstance& driver = site_.place.driver();
  if (has_failed(driver)) {  // as it was before
    is_to_start_ = false;
    return put_back(driver.container().fault());
  }
  open(driver, Phase::opening_again);
  return std::nullopt;
}

DriverSwap::Outcome DriverSwap::opened_again() {
  HardwareInstance& driver = site_.place.driver();
  if (!has_opened(driver) && !has_failed(driver) && !is_late()) return std::nullopt;
  return put_back(has_opened(driver) ? "" : trouble_of(driver));
}

// @param trouble  of the present driver; empty: it works as before.
DriverSwap::Outcome DriverSwap::put_back(const std::string& trouble) {
  HardwareInstance& driver = site_.place.driver();
  site_.place.seat().resume(driver.container(), driver.description());
  if (is_to_start_) driver.container().release();
  return undone("the new driver failed, and the old one " +
                (trouble.empty() ? "is back: " : "does not open the device again (" + trouble + "): ") +
                why_);
}

Result<SwapReport> DriverSwap::undone(const std::string& what) {
  site_.run.reporter.raise(make_alarm(idl::SWAP_UNDONE, order_.component, "", what));
  return refuse(Code::failed_precondition, what);
}

// What has not ended by now will not.
Result<SwapReport> DriverSwap::give_up() {
  if (!task_.join_until(saturating_add(site_.run.executive.now(), kDriverEndLimit))) is_stuck_ = true;
  return refuse(Code::unavailable, "the system was stopped before the swap was done");
}

}  // namespace orca::host
