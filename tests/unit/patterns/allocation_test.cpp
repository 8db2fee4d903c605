// SPDX-License-Identifier: GPL-3.0-or-later
// Pushing over the local link takes nothing from the heap once every place of the pool has been used (DESIGN
// 3).
#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <deque>
#include <memory>
#include <vector>

#include "allocation_counter.hpp"
#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "peer.hpp"

using namespace orca;
using namespace orca::test;

namespace {

constexpr int kLaps = 200;

void fill(idl::MotionCommand& command) { command.speed(0.5); }
void fill(idl::SonarRangeReadings& sonar) {
  sonar.ranges().assign(16, 2.0);
  sonar.ranges_uncertainty().assign(16, 0.01);
  sonar.pose(idl::Pose3D());
  sonar.poses().resize(16);
  sonar.stamps().resize(16);
}

template <class T>
struct Source : Peer {
  explicit Source(Executive& executive) : Peer(executive, "Platforms/Dewey/components/source") {}
  void push_one() {
    auto object = out.loan();
    fill(*object);
    out.push(std::move(object));
  }
  PushServer<T> out{*this, "out"};
};

// Takes every object on its own strand and tells the source.
template <class T>
struct Sink : Peer {
  Sink(Executive& executive, Event& taken)
      : Peer(executive, "Platforms/Dewey/components/sink"), done(taken) {}
  void take_all() {
    for (;;) {
      if (in.get_update_wait()) ++count;
      done.notify();
    }
  }
  PushProxy<T> in{*this, "in"};
  Event& done;
  std::atomic<int> count{0};
};

template <class T>
class Bench {
 public:
  Bench(Executive& executive, int subscribers)
      : executive_(executive), taken_(executive.make_event()), source_(executive) {
    for (int i = 0; i < subscribers; ++i) {
      Sink<T>& sink = sinks_.emplace_back(executive, *taken_);
      CHECK(LocalLinks().connect(source_.endpoint("out"), sink.endpoint("in"), {}).ok());
      sink.in.subscribe();
      scripts_.push_back(std::make_unique<Script>(sink, [&sink] { sink.take_all(); }));
    }
  }

  // Pushes and waits until every sink has taken it, lap by lap.
  void push(int laps) {
    for (int lap = 0; lap < laps; ++lap) {
      source_.push_one();
      ++pushed_;
      while (!all_taken()) taken_->wait_until(executive_.now() + 1s);
    }
  }

  // Gives every place of the pool that these laps can use the capacity that its object needs.
  static void warm_up_pool() {
    std::vector<Loan<T>> places;
    while (places.size() < 64) {
      places.push_back(make_object<T>());
      fill(*places.back());
      places.back()->origin() = "Platforms/Dewey/components/source";
    }
  }

 private:
  [[nodiscard]] bool all_taken() const {
    return std::all_of(sinks_.begin(), sinks_.end(),
                       [this](const auto& sink) { return sink.count == pushed_; });
  }

  Executive& executive_;
  std::unique_ptr<Event> taken_;
  Source<T> source_;
  std::deque<Sink<T>> sinks_;
  std::vector<std::unique_ptr<Script>> scripts_;
  int pushed_ = 0;
};

}  // namespace

TEST_CASE("the counter sees the allocations of every library", "[patterns][allocation]") {
  const long before = allocations();
  run_on_each(all_executives(), [](Executive& executive) { CHECK(executive.make_event() != nullptr); });
  CHECK(allocations() > before);
}

TEMPLATE_TEST_CASE("after warm-up a push takes nothing from the heap, for one subscriber or three",
                   "[patterns][allocation]", idl::MotionCommand, idl::SonarRangeReadings) {
  for (const int subscribers : {1, 3}) {
    INFO("subscribers: " << subscribers);
    run_on_each(all_executives(), [&](Executive& executive) {
      Bench<TestType> bench(executive, subscribers);
      Bench<TestType>::warm_up_pool();
      bench.push(kLaps);
      const long before = allocations();
      bench.push(kLaps);
      CHECK(allocations() - before == 0);
    });
  }
}

EXECUTIVE_CASE("after warm-up a push that nobody hears takes nothing from the heap",
               "[patterns][allocation]") {
  Bench<idl::MotionCommand> bench(executive, 0);
  bench.push(kLaps);
  const long before = allocations();
  bench.push(kLaps);
  CHECK(allocations() == before);
}
