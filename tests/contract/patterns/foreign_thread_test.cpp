// SPDX-License-Identifier: GPL-3.0-or-later
// What a thread that runs no component gets when it calls a port: a refusal, on every link and executive.
#include "orca/base/activity.hpp"
#include "orca/base/team.hpp"
#include "query_kits.hpp"
#include "send_kits.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

namespace {

/// Counts the calls that ports have refused.
class Doorkeeper final : public LinkObserver {
 public:
  void delivered(std::string_view, std::string_view, const ObjectRef&) override { ++deliveries; }
  void link_changed(std::string_view, std::string_view, bool) override {}
  void foreign_call(std::string_view component, std::string_view port, const void* code) override {
    const std::lock_guard lock(mutex_);
    refused_.push_back(std::string(component) + "." + std::string(port) + (code != nullptr ? ", known" : ""));
  }

  [[nodiscard]] std::vector<std::string> refused() const {
    const std::lock_guard lock(mutex_);
    return refused_;
  }

  std::atomic<int> deliveries{0};

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> refused_;
};

void on_a_thread_of_its_own(const std::function<void()>& body) { std::thread(body).join(); }

void check_refused(const Error& error, const std::string& port) {
  CHECK(error.code == Code::failed_precondition);
  CHECK_THAT(error.text(), Contains(port) && Contains("a thread that runs no component"));
}

}  // namespace

CONTRACT_CASE("a push from a thread that runs no component is refused, reported, and delivered to nobody",
              "[contract][push][threads]") {
  Doorkeeper doorkeeper;
  Source source(kit.executive);
  source.home().observer = &doorkeeper;
  source.home().code = &doorkeeper;
  Listener listener(kit.executive);
  listener.listen(kit, source, {.depth = 8});
  bool pushed = true;
  on_a_thread_of_its_own([&] { pushed = source.out.push(numbered(1)) || source.out.push(MotionCommand{}); });
  CHECK_FALSE(pushed);
  CHECK(source.out.push(numbered(2)));
  CHECK(number_of(listener.in.get_update_wait_max(5s)) == 2);
  CHECK_FALSE(listener.in.new_data_arrived());
  CHECK(doorkeeper.refused() == std::vector<std::string>{"source.out, known", "source.out, known"});
}

CONTRACT_CASE("what a thread that runs no component sends is refused in every form of Send",
              "[contract][send][threads]") {
  Doorkeeper doorkeeper;
  Line line(kit);
  line.sender.home().observer = &doorkeeper;
  line.taker.open();
  auto& out = line.sender.out;
  std::vector<Error> refusals;
  on_a_thread_of_its_own([&] {
    refusals = {out.send(numbered(1)).error(), out.send_wait(numbered(1)).error(),
                out.send_wait_max(numbered(1), 1s).error(), out.send_request(numbered(1)).error()};
  });
  for (const Error& refusal : refusals) check_refused(refusal, "sender.out");
  CHECK(line.taker.counters().accepted == 0);
  CHECK(doorkeeper.refused() == std::vector<std::string>(4, "sender.out"));
  CHECK(out.send(numbered(2)).ok());
}

CONTRACT_CASE("what a thread that runs no component asks is refused in every form of Query",
              "[contract][query][threads]") {
  Doorkeeper doorkeeper;
  Counter counter(kit);
  counter.asker.home().observer = &doorkeeper;
  counter.answerer.open();
  auto& question = counter.asker.question;
  std::vector<Error> refusals;
  on_a_thread_of_its_own([&] {
    refusals = {question.query(counter.asker.about("time"), 1s).error(),
                question.query_request(counter.asker.about("time")).error()};
  });
  for (const Error& refusal : refusals) check_refused(refusal, "asker.question");
  CHECK(counter.answerer.counters().accepted == 0);
  CHECK(doorkeeper.refused() == std::vector<std::string>(2, "asker.question"));
  const Service service(counter.answerer);
  CHECK(question.query(counter.asker.about("time"), 5s).has_value());
}

TEST_CASE("a wait on a thread that runs no component throws instead of joining the component's wait",
          "[contract][push][threads]") {
  on_each_executive<LocalKit>([](LocalKit& kit) {
    Source source(kit.executive);
    Listener listener(kit.executive);
    listener.listen(kit, source);
    const Script take(listener, [&] { (void)listener.in.get_update_wait(); });
    sleep(kit.executive, 1ms);
    std::vector<std::string> thrown;
    on_a_thread_of_its_own([&] {
      for (const auto& wait : std::vector<std::function<void()>>{
               [&] { (void)listener.in.get_update_wait(); },
               [&] { (void)listener.in.get_update_wait_max(1s); },
               [&] { listener.strand().wait_for(kForever, [] { return false; }); }}) {
        try {
          wait();
        } catch (const ForeignThread& error) {
          thrown.emplace_back(error.what());
        }
      }
    });
    REQUIRE(thrown.size() == 3);
    for (const std::string& text : thrown)
      CHECK_THAT(text, Contains("listener") && Contains("a thread that runs no component"));
    source.push_numbers(1, 1);
    CHECK(eventually(kit.executive, [&] { return take.ended(); }));
  });
}

TEST_CASE("a component may push in its destructor, wherever that runs", "[contract][push][threads]") {
  on_each_executive<LocalKit>([](LocalKit& kit) {
    Source source(kit.executive);
    bool pushed = false;
    on_a_thread_of_its_own([&] {
      const Activity destruction("source", Hook::destructor, nullptr);
      pushed = source.out.push(numbered(1));
    });
    CHECK(pushed);
  });
}

TEST_CASE("a helper of a team cannot push, but whoever called the team can", "[contract][push][threads]") {
  on_each_executive<LocalKit>([](LocalKit& kit) {
    Source source(kit.executive);
    Team team(2);
    const std::thread::id mine = std::this_thread::get_id();
    std::atomic<int> wrong{0};
    std::atomic<int> helped{0};
    while (helped == 0) {
      team.for_all(2, [&](std::size_t) {
        const bool is_mine = std::this_thread::get_id() == mine;
        if (!is_mine) ++helped;
        if (source.out.push(numbered(1)) != is_mine) ++wrong;
        std::this_thread::sleep_for(1ms);
      });
    }
    CHECK(wrong == 0);
  });
}
