// SPDX-License-Identifier: GPL-3.0-or-later
// The systems of a team as one of them knows them.
#include "machines/team_directory.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace orca;
using Catch::Contains;
using supervisor::Moment;
using supervisor::TeamDirectory;

namespace {

constexpr Moment kBegin{std::chrono::hours(1)};

graph::Team team_with(std::uint64_t hash) {
  graph::Team team;
  team.name = "lab";
  team.ports = {{"pose", "Teammate", hash, true}};
  return team;
}

// A system of the team on a network that loses nothing.
struct System {
  System(std::string name, std::uint64_t run, std::uint64_t hash = 7)
      : directory(team_with(hash), std::move(name), run) {}

  std::string news() {
    std::string text;
    for (const TeamDirectory::News& news : directory.take_news())
      text += (news.is_warning ? "!" : "") + news.text + "\n";
    return text;
  }
  std::vector<std::string> others() const {
    std::vector<std::string> names;
    for (const TeamDirectory::Member& member : directory.members()) names.push_back(member.name);
    return names;
  }
  TeamDirectory directory;
};

// Lets all say what they say, five times a second.
void talk(std::vector<System*> systems, Moment& now, Moment::duration time) {
  for (const Moment end = now + time; now < end; now += 200ms)
    for (System* const hearing : systems) {
      for (System* const speaking : systems) hearing->directory.hear(speaking->directory.state(), now);
      hearing->directory.look(now);
    }
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("systems of a team know each other, and what they offer", "[team]") {
  System anna("anna", 1), bert("bert", 2), carl("carl", 3);
  Moment now = kBegin;
  talk({&anna, &bert, &carl}, now, 1s);
  CHECK(anna.others() == Names{"bert", "carl"});
  CHECK(carl.others() == Names{"anna", "bert"});
  REQUIRE(anna.directory.members()[0].offers.size() == 1);
  CHECK(anna.directory.members()[0].offers[0].name() == "pose");
  CHECK(anna.news() ==
        "bert is in the team lab, and offers pose (Teammate)\n"
        "carl is in the team lab, and offers pose (Teammate)\n");
}

TEST_CASE(
    "a system that dies is lost a second later, one that leaves is gone at once, and both may come back",
    "[team]") {
  System anna("anna", 1), bert("bert", 2), carl("carl", 3);
  Moment now = kBegin;
  talk({&anna, &bert, &carl}, now, 1s);
  anna.news();
  talk({&anna, &carl}, now, 800ms);
  CHECK(anna.others() == Names{"bert", "carl"});
  talk({&anna, &carl}, now, 600ms);
  CHECK(anna.others() == Names{"carl"});
  CHECK(anna.news() == "bert is lost from the team lab\n");
  idl::TeamState farewell = carl.directory.state();
  farewell.leaves(true);
  anna.directory.hear(farewell, now);
  anna.directory.hear(farewell, now);  // it is repeated
  CHECK(anna.others().empty());
  CHECK(anna.news() == "carl has left the team lab\n");
  System again("bert", 4);
  talk({&anna, &again, &carl}, now, 2s);
  CHECK(anna.others() == Names{"bert", "carl"});
  CHECK_THAT(anna.news(), !Contains("!"));
}

TEST_CASE("a system that is killed and started again at once is no second one of its name", "[team]") {
  System anna("anna", 1), bert("bert", 2), again("bert", 3);
  Moment now = kBegin;
  talk({&anna, &bert}, now, 1s);
  talk({&anna, &again}, now, 3s);
  CHECK(anna.others() == Names{"bert"});
  CHECK_THAT(anna.news(), !Contains("!"));
}

TEST_CASE("two systems that have taken one name are told of it, and so is a third one", "[team]") {
  System first("anna", 1), second("anna", 2), bert("bert", 3);
  Moment now = kBegin;
  talk({&first, &bert}, now, 1s);
  talk({&first, &second, &bert}, now, 2s);
  CHECK_THAT(first.news(),
             Contains("!another system of the team lab is called anna, too; give one of them another name"));
  CHECK_THAT(second.news(), Contains("!another system of the team lab is called anna, too"));
  CHECK_THAT(bert.news(), Contains("!two systems of the team lab are called anna"));
  CHECK(bert.others() == Names{"anna", "anna"});
  CHECK(bert.directory.members()[0].has_taken_name);
  talk({&first, &second, &bert}, now, 2s);
  CHECK_THAT(bert.news() + first.news() + second.news(), !Contains("!"));  // it is said once
  talk({&first, &bert}, now, 2s);
  REQUIRE(bert.others() == Names{"anna"});
  CHECK_FALSE(bert.directory.members()[0].has_taken_name);
}

TEST_CASE("an offer of another type is refused and told on both sides", "[team]") {
  System anna("anna", 1), bert("bert", 2, 8);
  Moment now = kBegin;
  talk({&anna, &bert}, now, 1s);
  CHECK_THAT(anna.news(), Contains("!bert offers pose to the team as another Teammate than this system has"));
  CHECK_THAT(bert.news(), Contains("!anna offers pose to the team as another Teammate than this system has"));
  CHECK(anna.directory.members()[0].refused == std::set<std::string>{"pose"});
}

TEST_CASE("a system whose graph has changed offers what it has now, and the others are told", "[team]") {
  System anna("anna", 1), bert("bert", 2);
  Moment now = kBegin;
  talk({&anna, &bert}, now, 1s);
  anna.news();
  graph::Team wanted = team_with(7);
  wanted.ports.push_back({"battery", "Battery", 5, true});
  bert.directory.go_over(wanted);
  talk({&anna, &bert}, now, 1s);
  CHECK(anna.news() == "bert offers pose (Teammate), battery (Battery) from now on\n");
}

TEST_CASE("what nobody can be called, or offer, is not believed", "[team]") {
  System anna("anna", 1);
  idl::TeamState state;
  state.run(9);
  for (const char* const name : {"", "bert\nerror orca: all is lost", "b\xC3\xBCrgi"}) {
    state.origin(name);
    anna.directory.hear(state, kBegin);
  }
  state.origin(std::string(65, 'a'));
  anna.directory.hear(state, kBegin);
  state.origin("bert");
  state.offers().resize(65);
  for (auto& offer : state.offers()) offer.name("pose");
  anna.directory.hear(state, kBegin);
  CHECK(anna.others().empty());
  state.offers().resize(1);
  state.offers()[0].type("a b");
  anna.directory.hear(state, kBegin);
  CHECK(anna.others().empty());
  state.offers()[0].type("Teammate");
  anna.directory.hear(state, kBegin);
  CHECK(anna.others() == Names{"bert"});
  for (int i = 0; i < 200; ++i) {
    state.run(100 + i);
    anna.directory.hear(state, kBegin);
  }
  CHECK(anna.others().size() == TeamDirectory::kMostMembers);
}
