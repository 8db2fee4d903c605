// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "tally_file.hpp"

namespace {

using namespace std::chrono_literals;

/// Sends numbers one after the other, and writes each of which it was told that it is sent into a file.
class TallySender final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Status start() override { return sent_.open_at(*path_); }
  void stop() override { sent_.end(); }

  orca::Outcome work() override {
    while (number_ < *count_) {
      auto object = out_.loan();
      object->angle(static_cast<double>(++number_));
      if (!out_.send(std::move(object)).ok()) {
        ++refused_;
        sleep(1ms);
      } else if (const orca::Status kept = sent_.add(number_); !kept.ok()) {
        return orca::failed(kept.error().message);
      }
    }
    log_info("tally of " + std::to_string(number_) + ", told of " + std::to_string(refused_) + " not sent");
    return orca::done();
  }

  orca::SendProxy<orca::idl::TurretCommand> out_{*this, "out"};
  orca::Param<std::int64_t> count_{*this, "count", 1000};
  orca::Param<std::string> path_{*this, "path", ""};
  TallyFile sent_;
  std::int64_t number_ = 0;
  std::int64_t refused_ = 0;
};

}  // namespace

ORCA_COMPONENT(TallySender, "test.TallySender")
