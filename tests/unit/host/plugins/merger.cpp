// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <utility>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"

namespace {

/// Finds its sources by name when it is configured, and logs from whom each of them brings something.
class Merger final : public orca::Component {
 public:
  explicit Merger(orca::ComponentHost& host) : Component(host) {}

 private:
  using Port = orca::PushProxyArray<orca::idl::MotionCommand>;

  orca::Status configure() override {
    for (const Port::Source& source : in_.sources()) known_.emplace_back(source.path(), source);
    lap_every(std::chrono::milliseconds(10));
    stay_active(true);
    return orca::ok();
  }

  orca::Status start() override {
    for (const auto& [name, source] : known_) source.subscribe();
    return orca::ok();
  }

  orca::Outcome work() override {
    for (const auto& [name, source] : known_)
      if (source.new_data_arrived()) log_debug(name + " brings " + source.take_latest()->origin() + ".out");
    return orca::again();
  }

  Port in_{*this, "in", {.optional = true}};
  std::vector<std::pair<std::string, Port::Source>> known_;
};

}  // namespace

ORCA_COMPONENT(Merger, "test.Merger")
