// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <unordered_set>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"

namespace {

struct Thing {
  double number;
  double room[7]{};
};

double number_of(const std::string& text) {
  unsigned sum = 0;
  for (const char c : text) sum = sum * 31 + static_cast<unsigned char>(c);
  return 0.001 * (sum % 1000);
}

// Two orders of the same numbers hardly ever give the same one.
template <class Things>
double number_of_order(const Things& things) {
  std::uint64_t sum = 0;
  for (const Thing* const thing : things)
    sum = sum * 6364136223846793005U + std::llround(1000.0 * thing->number);
  return 0.001 * static_cast<double>((sum >> 32U) % 1000);
}

void* volatile g_block = nullptr;

// What memory holds that was never set.
double garbage() {
  g_block = std::malloc(1000);
  const double found = 0.001 * static_cast<volatile unsigned char*>(g_block)[500];
  std::free(g_block);
  return found;
}

/// Says a number each lap that depends on something that no run may depend on: faults that no look at the plugin's symbols can
/// find.
class Dependent final : public orca::Component {
 public:
  explicit Dependent(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(100));
  }

 private:
  static constexpr int kThings = 200;

  orca::Status start() override {
    motion_.start(lap_period());
    for (int i = 0; i < kThings; ++i) things_.push_back(std::make_unique<Thing>(Thing{0.001 * i}));
    if (*on_ == "addresses" || *on_ == "hashes") return say_things();
    const char* const user = std::getenv("USER");
    if (*on_ == "nothing") said_ = 0.5;
    if (*on_ == "environment") said_ = number_of(user == nullptr ? "" : user);
    if (*on_ == "folder") said_ = number_of(std::filesystem::current_path().string());
    if (*on_ == "garbage") said_ = garbage();
    if (*on_ == "bit")
      said_ = (reinterpret_cast<std::uintptr_t>(things_.front().get()) >> 14U) % 2 == 0 ? 0.1 : 0.3;
    return orca::ok();
  }

  orca::Status say_things() {
    std::set<const Thing*> by_address;
    std::unordered_set<const Thing*> by_hash;
    for (const auto& thing : things_) {
      by_address.insert(thing.get());
      by_hash.insert(thing.get());
    }
    said_ = *on_ == "addresses" ? number_of_order(by_address) : number_of_order(by_hash);
    return orca::ok();
  }

  orca::Outcome work() override {
    motion_.push(orca::head(0.0, said_));
    return orca::again();
  }

  orca::PushServer<orca::idl::MotionCommand> motion_{*this, "motion"};
  orca::Param<std::string> on_{
      *this,
      "on",
      "nothing",
      {.choices = {"nothing", "addresses", "hashes", "environment", "folder", "garbage", "bit"}}};
  std::vector<std::unique_ptr<Thing>> things_;
  double said_ = 0.0;
};

}  // namespace

ORCA_COMPONENT(Dependent, "test.Dependent")
