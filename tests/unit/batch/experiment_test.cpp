// SPDX-License-Identifier: GPL-3.0-or-later
// What an experiment says, and how wrong ones are refused.
#include "orca/batch/experiment.hpp"

#include <catch2/catch.hpp>

#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace orca;
using namespace orca::batch;
using Catch::Contains;

namespace {

constexpr const char* kGood = R"(<experiment name="e" graph="../graphs/g.xml" seeds="1-3" until="60 s">
  <set arg="speed" value="0.5 m/s"/>
  <variant name="a"/>
  <variant name="b" graph="other.xml"><set arg="avoid" value="B"/></variant>
  <world name="w"><set arg="world" file="x.xml"/></world>
  <worlds name="n" arg="world" file="many.csv" numbers="4 6-7"/>
</experiment>)";

Experiment good() {
  xml::Diagnostics diagnostics;
  std::optional<Experiment> experiment = read_experiment(kGood, "/top/sim/e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(experiment);
  return *std::move(experiment);
}

std::string faults_of(const std::string& text) {
  xml::Diagnostics diagnostics;
  CHECK_FALSE(read_experiment(text, "e.xml", diagnostics));
  return diagnostics.text();
}

std::string with(const std::string& attributes, const std::string& inside) {
  return "<experiment name=\"e\" " + attributes + ">" + inside + "</experiment>";
}

constexpr const char* kEnough = "graph=\"g.xml\" seeds=\"1\" until=\"1 s\"";
constexpr const char* kVariantAndWorld = "<variant name=\"a\"/><world name=\"w\"/>";

}  // namespace

TEST_CASE("an experiment is variants, worlds and seeds; paths start at its folder", "[batch]") {
  const Experiment experiment = good();
  CHECK(experiment.seeds == std::vector<std::uint64_t>{1, 2, 3});
  CHECK(experiment.until == 60s);
  REQUIRE(experiment.variants.size() == 2);
  CHECK(experiment.variants[0].graph == "/top/graphs/g.xml");
  CHECK(experiment.variants[1].graph == "/top/sim/other.xml");
  REQUIRE(experiment.worlds.size() == 4);
  CHECK(experiment.worlds[3].name == "n_7");
  CHECK(experiment.worlds[3].settings[0].text() == "world=/top/sim/many.csv#7");
}

TEST_CASE("numbered worlds are a family, and a single one is its own unless it names another", "[batch]") {
  xml::Diagnostics diagnostics;
  const auto experiment = read_experiment(
      R"(<experiment name="e" graph="g.xml" seeds="1" until="1 s"><variant name="a"/>
         <worlds name="posts" arg="world" file="f.xml" numbers="1-2"/><world name="office"/>
         <world name="hall" family="offices"/></experiment>)",
      "e.xml", diagnostics);
  REQUIRE(experiment);
  std::vector<std::string> families;
  for (const World& world : experiment->worlds) families.push_back(world.family);
  CHECK(families == std::vector<std::string>{"posts", "posts", "office", "offices"});
}

TEST_CASE("contrasts are asked instead of all pairs, and may stand before their variants", "[batch]") {
  xml::Diagnostics diagnostics;
  const auto experiment = read_experiment(
      R"(<experiment name="e" graph="g.xml" seeds="1" until="1 s">
         <contrast first="b" second="a" metric="time" claim="not_worse" margin="500 ms"/>
         <contrast first="a" second="b" metric="success" claim="equal" margin="5 %"/>
         <contrast first="a" second="b" metric="way"/>
         <variant name="b"/><variant name="a"/><world name="w"/></experiment>)",
      "e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(experiment);
  const std::vector<Contrast> asked = questions_of(*experiment);
  REQUIRE(asked.size() == 3);
  CHECK(asked[0].text() == "b - a, time: not worse by 500 ms");
  CHECK(asked[0].asked.margin == 0.5);
  CHECK_FALSE(asked[0].asked.more_is_better);
  CHECK(asked[1].text() == "a - b, success: equal within 5 %");
  CHECK(asked[1].asked.margin == 0.05);
  CHECK(asked[1].asked.more_is_better);
  CHECK(asked[2].text() == "a - b, way: difference");
  const std::vector<Contrast> all = questions_of(good());
  REQUIRE(all.size() == 2);  // one pair, in success and in time
  CHECK(all[1].text() == "a - b, time: difference");
}

TEST_CASE("what is wrong with contrasts is reported, each at its place", "[batch]") {
  const std::string faults = faults_of(with(kEnough, std::string(kVariantAndWorld) + R"(<variant name="b"/>
    <contrast first="a" second="c" metric="time"/>
    <contrast first="a" second="a" metric="tme"/>
    <contrast first="a" second="b" metric="time" claim="equal"/>
    <contrast first="a" second="b" metric="time" margin="1 s"/>
    <contrast first="a" second="b" metric="time" claim="equal" margin="1 m"/>
    <contrast first="a" second="b" metric="success" claim="equal" margin="0 %"/>
    <contrast first="a" second="b" metric="success" claim="not_worse" margin="100 %"/>
    <contrast first="a" second="b" metric="success" claim="better" margin="1 %"/>)"));
  CHECK_THAT(faults, Contains("error E014: there is no variant \"c\"; there are a, b"));
  CHECK_THAT(faults, Contains("error E014: a contrast needs two variants"));
  CHECK_THAT(faults,
             Contains("error E005: there is no metric \"tme\"") && Contains("did you mean \"time\"?"));
  CHECK_THAT(faults, Contains("e.xml:4:5: error E014: claims of not_worse and equal need a margin") &&
                         Contains("e.xml:5:5: error E014: claims of not_worse and equal need a margin"));
  CHECK_THAT(faults, Contains("e.xml:6:") && Contains("error E014: ") && Contains("measures"));
  CHECK_THAT(faults, Contains("error E014: a margin is above 0"));
  CHECK_THAT(faults, Contains("error E014: a margin of success is below 100 %"));
  CHECK_THAT(faults, Contains("error E005: ") && Contains("better"));
}

TEST_CASE("each variant meets each world and seed once, and pairs stand together", "[batch]") {
  const Experiment experiment = good();
  REQUIRE(experiment.run_count() == 24);
  std::set<std::tuple<std::size_t, std::size_t, std::uint64_t>> all;
  for (std::size_t i = 0; i < experiment.run_count(); ++i) {
    const Run run = experiment.run(i);
    all.insert({run.variant, run.world, run.seed});
    CHECK(run.variant == i % 2);
    CHECK(experiment.number_of(experiment.variants[run.variant].name, experiment.worlds[run.world].name,
                               run.seed) == i);
  }
  CHECK(all.size() == 24);
  CHECK_FALSE(experiment.number_of("a", "w", 4));
  CHECK_FALSE(experiment.number_of("c", "w", 1));
}

TEST_CASE("the settings of a variant have the last word", "[batch]") {
  CHECK(good().settings_of({1, 0, 1}) ==
        std::vector<std::string>{"speed=0.5 m/s", "world=/top/sim/x.xml", "avoid=B"});
}

TEST_CASE("everything that is wrong with an experiment is reported at once, each at its place", "[batch]") {
  const std::string faults = faults_of(R"(<experiment name="e" seeds="5-1" until="0 s" sedes="1">
  <variant name="a"/>
  <variant name="a" graph="g.xml"/>
  <world name="w"><set arg="x"/></world>
  <worlds name="n" arg="world" file="f" numbers="a"/>
  <wrold name="v"/>
</experiment>)");
  CHECK_THAT(faults, Contains("e.xml:1:29: error E008: ") && Contains("goes down"));
  CHECK_THAT(faults, Contains("error E005: ") && Contains("until"));
  CHECK_THAT(faults, Contains("error E003: ") && Contains("sedes"));
  CHECK_THAT(faults, Contains("e.xml:2:3: error E010: variant \"a\" has no graph"));
  CHECK_THAT(faults, Contains("e.xml:3:18: error E007: there is a variant \"a\" already, at e.xml:2:3"));
  CHECK_THAT(faults, Contains("e.xml:4:19: error E009: <set> needs either a value or a file"));
  CHECK_THAT(faults, Contains("error E008: \"a\" is neither a number nor a range"));
  CHECK_THAT(faults, Contains("error E002: ") && Contains("did you mean \"world\""));
}

TEST_CASE("a variant has the profiles of the experiment, merged in their order, or its own", "[batch]") {
  xml::Diagnostics diagnostics;
  const auto experiment =
      read_experiment(with(std::string(kEnough) + " profile=\"sim odometry\"",
                           "<variant name=\"a\"/><variant name=\"b\" profile=\"sim\"/><variant name=\"c\" "
                           "profile=\"\"/><world name=\"w\"/>"),
                      "e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(experiment);
  CHECK(experiment->variants[0].profiles == std::vector<std::string>{"sim", "odometry"});
  CHECK(experiment->variants[1].profiles == std::vector<std::string>{"sim"});
  CHECK(experiment->variants[2].profiles.empty());
}

TEST_CASE("an experiment says where robots have to be, and a world may say it instead", "[batch]") {
  xml::Diagnostics diagnostics;
  const auto experiment = read_experiment(with(kEnough, R"(<goal x="4.2 m" y="980 cm" radius="0.3 m"/>
    <goal robot="Huey" place="desk" radius="1 m" heading="90 deg" hold="0.5 s"/>
    <variant name="a"/>
    <world name="w"/>
    <worlds name="n" arg="world" file="f" numbers="1-2"><goal place="goal" radius="2 m"/></worlds>)"),
                                          "e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(experiment);
  const std::vector<Goal>& goals = experiment->goals_of({0, 0, 1});
  REQUIRE(goals.size() == 2);
  CHECK(goal_text(goals[0]) == "the robot within 0.3 m of 4.2 9.8");
  CHECK(goals[0].hold == 0s);
  CHECK(goals[1].robot == "Huey");
  CHECK(goals[1].place == "desk");
  CHECK(goals[1].heading.value() == Approx(1.5708).epsilon(1e-4));
  CHECK(goals[1].heading_tolerance == Approx(0.34907).epsilon(1e-4));
  CHECK(goals[1].hold == 500ms);
  REQUIRE(experiment->worlds.size() == 3);
  for (const std::size_t world : {1U, 2U}) {
    REQUIRE(experiment->goals_of({0, world, 1}).size() == 1);
    CHECK(goal_text(experiment->goals_of({0, world, 1})[0]) == "the robot within 2 m of goal");
  }
}

TEST_CASE("a goal has one place, a radius, and a tolerance only of a heading", "[batch]") {
  const auto faults = [](const std::string& goal) {
    return faults_of(with(kEnough, "<goal " + goal + "/>" + kVariantAndWorld));
  };
  const auto no_place = Contains("error E013: <goal> needs either the name of a place, or x and y");
  CHECK_THAT(faults("radius=\"1 m\""), no_place);
  CHECK_THAT(faults("radius=\"1 m\" x=\"1 m\""), no_place);
  CHECK_THAT(faults("radius=\"1 m\" x=\"1 m\" y=\"1 m\" place=\"goal\""), no_place);
  CHECK_THAT(faults("place=\"goal\""), Contains("error E004: ") && Contains("radius"));
  CHECK_THAT(faults("place=\"goal\" radius=\"0 m\""), Contains("error E005: ") && Contains("radius"));
  CHECK_THAT(faults("place=\"goal\" radius=\"1 m\" heading_tolerance=\"5 deg\""),
             Contains("error E013: a tolerance needs the heading"));
}

TEST_CASE("an experiment needs a variant, a world, seeds and a limit of time", "[batch]") {
  CHECK_THAT(faults_of(with(kEnough, "<world name=\"w\"/>")), Contains("needs a <variant>"));
  CHECK_THAT(faults_of(with(kEnough, "<variant name=\"a\"/>")), Contains("needs a <world>"));
  CHECK_THAT(faults_of(with("graph=\"g.xml\"", kVariantAndWorld)), Contains("seeds") && Contains("until"));
}

TEST_CASE("what each element must say is missed by its name, and the rest may be left out", "[batch]") {
  const std::string faults = faults_of(
      "<experiment><set value=\"1\"/><variant graph=\"g.xml\"/><world reference=\"2 "
      "m\"/><worlds/></experiment>");
  const auto misses = [&](const std::string& element, const std::string& attribute) {
    return Contains("<" + element + "> needs the attribute \"" + attribute + "\"");
  };
  for (const char* const attribute : {"name", "seeds", "until"})
    CHECK_THAT(faults, misses("experiment", attribute));
  CHECK_THAT(faults, misses("set", "arg"));
  CHECK_THAT(faults, misses("variant", "name"));
  CHECK_THAT(faults, misses("world", "name"));
  for (const char* const attribute : {"name", "arg", "file"}) CHECK_THAT(faults, misses("worlds", attribute));
  for (const char* const attribute :
       {"version", "metrics", "limit", "memory", "column", "numbers", "references"})
    CHECK_THAT(faults, !Contains("needs the attribute \"" + std::string(attribute) + "\""));
}

TEST_CASE(
    "a run may take 300 s and 8 GB, and is judged by success and time, unless the experiment says otherwise",
    "[batch]") {
  const Experiment experiment = good();
  CHECK(experiment.limit == 300s);
  CHECK(experiment.memory_limit == 8'000'000'000);
  CHECK(experiment.metrics == std::vector<std::string>{"success", "time"});
  xml::Diagnostics diagnostics;
  const auto other = read_experiment(
      with(std::string(kEnough) + " limit=\"2 s\" memory=\"2 GB\" metrics=\"way jerk\"", kVariantAndWorld),
      "e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(other);
  CHECK(other->limit == 2s);
  CHECK(other->memory_limit == 2'000'000'000);
  CHECK(other->metrics == std::vector<std::string>{"way", "jerk"});
}

TEST_CASE("with factors of computing each variant is one for each factor, with the same settings",
          "[batch]") {
  xml::Diagnostics diagnostics;
  const auto experiment =
      read_experiment(with(std::string(kEnough) + " computing=\"0 1 2.5 1\"",
                           "<variant name=\"a\"><set arg=\"x\" value=\"1\"/></variant><variant "
                           "name=\"b\"/><world name=\"w\"/>"),
                      "e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(experiment);
  std::vector<std::pair<std::string, double>> found;
  for (const Variant& variant : experiment->variants) found.emplace_back(variant.name, variant.computing);
  CHECK(found ==
        std::vector<std::pair<std::string, double>>{
            {"a_x0", 0.0}, {"a_x1", 1.0}, {"a_x2.5", 2.5}, {"b_x0", 0.0}, {"b_x1", 1.0}, {"b_x2.5", 2.5}});
  CHECK(experiment->settings_of({2, 0, 1}) == std::vector<std::string>{"x=1"});
  CHECK(good().variants.front().computing == 1.0);
  CHECK_THAT(faults_of(with(std::string(kEnough) + " computing=\"1 -2\"", kVariantAndWorld)),
             Contains("E005") && Contains("-2"));
}

TEST_CASE("a graph is no experiment, and one of another version is not read", "[batch]") {
  CHECK_THAT(faults_of("<graph name=\"g\"/>"), Contains("E001: this is <graph>, not <experiment>"));
  CHECK_THAT(faults_of(with(std::string(kEnough) + " version=\"2\"", kVariantAndWorld)),
             Contains("version \"2\" is not known"));
}

TEST_CASE("more runs than anybody waits for are refused", "[batch]") {
  CHECK_THAT(
      faults_of(with("graph=\"g.xml\" seeds=\"1-1000000\" until=\"1 s\"",
                     "<variant name=\"a\"/><worlds name=\"n\" arg=\"w\" file=\"f\" numbers=\"1-11\"/>")),
      Contains("E011: the experiment has more than 10,000,000 runs"));
}

TEST_CASE("results are known by the same text wherever the experiment's folder lies", "[batch]") {
  Experiment here = good();
  here.settings.push_back({"world", "/top/sim/worlds/x.xml", {}});
  Experiment there = good();
  there.file = "/elsewhere/sim/e.xml";
  there.settings.push_back({"world", "/elsewhere/sim/worlds/x.xml", {}});
  CHECK(identity_of(here) == identity_of(there));
  there.settings.back().value = "/elsewhere/sim/worlds/y.xml";
  CHECK(identity_of(here) != identity_of(there));
}

TEST_CASE("results are known by what may change them", "[batch]") {
  const std::string identity = identity_of(good());
  CHECK(identity == identity_of(good()));
  Experiment more = good();
  more.seeds.push_back(4);
  CHECK(identity_of(more) == identity);
  Experiment longer = good();
  longer.until = 61s;
  CHECK(identity_of(longer) != identity);
  Experiment faster = good();
  faster.settings[0].value = "0.6 m/s";
  CHECK(identity_of(faster) != identity);
}

TEST_CASE("a component fails at one time in all runs of a world, or at one that each seed draws", "[batch]") {
  xml::Diagnostics diagnostics;
  const auto experiment = read_experiment(
      with(kEnough,
           "<variant name=\"a\"/><world name=\"w\"><fail component=\"pilot\" how=\"throw\" at=\"10 s\"/>"
           "<fail component=\"laser\" how=\"silent\" at=\"10 s\" latest=\"20 s\"/></world>"),
      "e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(experiment);
  REQUIRE(experiment->worlds[0].failing.size() == 2);
  const Failing& fixed = experiment->worlds[0].failing[0];
  CHECK(fixed.text() == "pilot=throw@10s");
  CHECK(fixed.time(1) == 10s);
  CHECK(fixed.time(2) == 10s);
  const Failing& drawn = experiment->worlds[0].failing[1];
  CHECK(drawn.text() == "laser=silent@10s..20s");
  std::set<Duration> times;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) times.insert(drawn.time(seed));
  CHECK(times.size() > 90);
  CHECK(*times.begin() < 12s);
  CHECK(*times.begin() >= 10s);
  CHECK(*times.rbegin() > 18s);
  CHECK(*times.rbegin() <= 20s);
  CHECK(drawn.time(7) == drawn.time(7));
}

TEST_CASE("a seed fails at another time in each of many worlds", "[batch]") {
  xml::Diagnostics diagnostics;
  const auto experiment = read_experiment(
      with(kEnough,
           "<variant name=\"a\"/><worlds name=\"w\" arg=\"world\" file=\"w.csv\" numbers=\"1-20\">"
           "<fail component=\"laser\" how=\"silent\" at=\"10 s\" latest=\"20 s\"/></worlds>"),
      "e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(experiment);
  std::set<Duration> times;
  for (const World& world : experiment->worlds) times.insert(world.failing.at(0).time(1));
  CHECK(times.size() == 20);
}

TEST_CASE("what is wrong with failures on purpose is reported, each at its place", "[batch]") {
  const std::string faults = faults_of(with(kEnough,
                                            "<variant name=\"a\"/><world name=\"w\"><fail component=\"p\" "
                                            "how=\"throw\" at=\"10 s\" latest=\"9 s\"/>"
                                            "<fail component=\"p\" how=\"explode\" at=\"1 s\"/></world>"));
  CHECK_THAT(faults, Contains("E016: it must be after the time in at"));
  CHECK_THAT(faults, Contains("E016: \"p\" fails already"));
  CHECK_THAT(faults, Contains("E005: how: \"explode\""));
}
