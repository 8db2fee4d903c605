// SPDX-License-Identifier: GPL-3.0-or-later
// Parse, print, parse gives the same graph, for graphs made at random.
#include "loading.hpp"
#include "orca/base/random.hpp"
#include "orca/graph/print.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

class RandomGraph {
 public:
  explicit RandomGraph(std::uint64_t seed) : random_(seed, "graph", "round trip") {}

  std::string text() {
    const int avoiders = 1 + pick(4);
    late_bound_ = pick(2) == 0;
    std::string result = "<graph name='r" + std::to_string(pick(100)) + "'" +
                         maybe(" plugins='x;/y z;../q$$'") + maybe(" ends='avoid0'") + maybe(supervision()) +
                         ">" + places();
    const std::string base = process();
    result += "<hardware name='robot' type='orca.hw.Sim'>" + maybe(param("world", free_text())) +
              maybe(param("realism", "harsh")) + "</hardware>" +
              "<component name='base' type='orca.RobotBaseServer' hardware='robot'" + base +
              maybe(" period='" + real(0.001, 9) + "'") + ">" +
              maybe("<port name='OdometryPush' as='odom'/>") +
              "</component><component name='fuser' type='orca.MotionCommandFuser'" + process() + ">" +
              maybe("<port name='ClientListSend' disabled='true'/>") + candidates(avoiders) + "</component>" +
              "<component name='planner' type='orca.Planner'/>" +
              connect("planner.limits", "base.LimitsQuery", "") +
              connect("fuser.base", "base.MotionCommandSend",
                      maybe(room()) + maybe(" confirm='" + choice({"accepted", "handled"}) + "'"));
    for (int i = 0; i < avoiders; ++i) result += avoider(i);
    return result + maybe("<group name='all' components='planner, base;avoid0'/>") + "</graph>";
  }

 private:
  // All avoiders may be named at run time, or all are connected.
  std::string candidates(int avoiders) {
    if (!late_bound_) return {};
    std::string names;
    for (int i = avoiders - 1; i >= 0; --i) names += " avoid" + std::to_string(i) + maybe(".motion");
    return "<port name='motion'" + maybe(" as='motion'") + " candidates='" + names + "'/>";
  }
  std::string loading() {
    return " start='on_demand'" + (pick(2) == 0 ? " stay='warm'" : maybe(" idle_time='" + real(0, 9) + "'"));
  }

  std::string supervision() {
    return " strategy='" + choice({"one_for_one", "rest_for_one", "one_for_all"}) + "' restarts='" +
           integer(0, 9) + "' within='" + real(0.1, 99) + "' on_supervisor_loss='" +
           choice({"stop", "continue"}) + "'" + maybe(" machine_wait='" + real(0.1, 99) + "'") +
           maybe(" adoption_wait='" + real(0.1, 99) + "'") + maybe(" record='always'") +
           maybe(" record_space='" + integer(20, 99) + " MB'");
  }

  // Two processes beside "main", on a machine each if there are any.
  std::string places() {
    const bool machines = pick(2) == 0;
    const auto on = [&](const char* name) { return machines ? " machine='" + std::string(name) + "'" : ""; };
    return (machines ? "<machine name='robot'" + maybe(" address='10.0.0.2'") + maybe(" interface='wlan0'") +
                           "/><machine name='laptop'" + maybe(" on_loss='go_on'") +
                           maybe(" loss_limit='3 s'") + maybe(" delay='0.1 s'") + "/>" +
                           "<process name='main'" + on("laptop") + maybe(" priority='1'") + "/>"
                     : "") +
           "<process name='p1'" + on("robot") + maybe(" executor='fiber'") +
           maybe(" spin='" + integer(0, 99) + " us'") + maybe(" processors='3 0,1'") + maybe(" cores='2'") +
           maybe(" delay='3 ms'") + maybe(" text='x'") + "/><process name='p2'" + on("robot") +
           maybe(" priority='" + integer(1, 99) + "'") + maybe(" lock_memory='true'") +
           maybe(" memory='" + integer(1, 4000) + " MiB'") + maybe(" hang_limit='" + real(0.01, 9) + "'") +
           maybe(" restart='" + choice({"permanent", "transient", "temporary"}) + "'") + "/>";
  }
  std::string process() {
    return choice({"", " process=''", " process='main'", " process='p1'", " process='p2'"});
  }
  std::string choice(const std::vector<std::string>& choices) {
    return choices[static_cast<std::size_t>(pick(static_cast<int>(choices.size())))];
  }

  std::string avoider(int i) {
    const std::string name = "avoid" + std::to_string(i);
    const bool by_stamps = pick(3) == 0;
    return "<component name='" + name + "' type='orca.SonarAvoid'" + process() +
           maybe(" priority='" + integer(-100, 100) + "'") +
           (pick(2) == 0 ? loading() : maybe(" autonomous='true'")) + maybe(" start_after='base fuser'") +
           maybe(" may_fail='true'") + maybe(" watchable='true'") + maybe(" restore='last'") +
           maybe(" takes='" + real(0, 9) + "'") + (by_stamps ? stamps() : maybe(trigger())) + ">" +
           maybe("<property name='range' value='" + real(0, 9) + " m'/>") +
           maybe("<property name='room' value=\"'4 m'\"/>") + maybe(param("stop_distance", real(0.05, 5.0))) +
           maybe(param("sector", integer(0, 180) + " deg")) + maybe(param("gain", real(0.0, 1e6))) +
           maybe(param("samples", integer(1, 64))) + maybe(param("verbose", "true")) +
           maybe(param("mode", "turn")) + maybe(param("label", free_text())) +
           maybe(param("map", free_text())) + maybe(param("zones", "a; b $$ c ;d&amp;e")) + "</component>" +
           connect("base.SonarRangeReadingsPush", name + ".sonar",
                   (by_stamps ? queue(2) : maybe(queue(1))) + maybe(" interval='" + real(0, 10) + "'") +
                       maybe(" deadline='" + real(10, 20) + "'") +
                       maybe(" drop_limit='" + choice({"any", "0", "30"}) + "'")) +
           (late_bound_ ? ""
                        : connect(name + ".motion", "fuser.motion",
                                  pick(2) == 0 ? " queue='latest'"
                                               : maybe(" queue='2' overflow='block'" + block_limit())));
  }

  std::string trigger() {
    if (pick(2) == 0) return " period='" + integer(1, 5000) + " ms'";
    return " on='sonar odometry'" + maybe(pick(2) == 0 ? " fuse='all'" : " fuse='any'") +
           maybe(" at_least_every='" + real(0.001, 9) + "'");
  }
  std::string stamps() {
    return " on='odometry sonar' fuse='stamps'" + maybe(" within='" + integer(0, 100) + " ms'") +
           maybe(" at_least_every='" + real(0.001, 9) + "'");
  }

  std::string queue(int least) {
    return " queue='" + integer(least, 100) + "' overflow='" +
           (pick(2) == 0 ? "drop_oldest" : "drop_newest") + "'";
  }
  std::string room() {
    return " queue='" + integer(1, 100) + "' overflow='" + (pick(2) == 0 ? "refuse" : "block") + "'";
  }
  std::string block_limit() { return maybe(" block_limit='" + integer(1, 5000) + " ms'"); }
  static std::string connect(const std::string& from, const std::string& to, const std::string& policy) {
    return "<connect from='" + from + "' to='" + to + "'" + policy + "/>";
  }
  static std::string param(const std::string& name, const std::string& value) {
    return "<param name='" + name + "' value=\"" + value + "\"/>";
  }
  // Returns a text of characters that XML or the graph treats specially.
  std::string free_text() {
    static const std::string kAlphabet = "ab /.<>&\"'\n\t;${}äx";
    std::string text;
    for (int i = pick(12); i > 0; --i) {
      const char c = kAlphabet[static_cast<std::size_t>(pick(static_cast<int>(kAlphabet.size())))];
      if (static_cast<unsigned char>(c) < 0x80) text += c == '$' ? "$$" : std::string(1, c);
    }
    return xml::escaped(text);
  }
  std::string maybe(const std::string& text) { return pick(2) == 0 ? text : ""; }
  std::string real(double low, double high) { return xml::number_text(random_.uniform(low, high)); }
  std::string integer(int low, int high) { return std::to_string(low + pick(high - low + 1)); }
  int pick(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }

  RandomStream random_;
  bool late_bound_ = false;
};

}  // namespace

TEST_CASE("parse, print, parse is the identity", "[graph][property]") {
  for (std::uint64_t seed = 1; seed <= orca::test::part_of<std::uint64_t>(400); ++seed) {
    const std::string text = RandomGraph(seed).text();
    INFO("seed " << seed);
    const Graph first = must_load(text, kAnyLink, "/srv/graphs/random.xml");
    const std::string printed = print(first);
    INFO(printed);
    const Graph second = must_load(printed, kAnyLink, "/elsewhere/printed.xml");
    REQUIRE(first == second);
    REQUIRE(print(second) == printed);
  }
}

TEST_CASE("a printed graph has its profile merged and its arguments replaced", "[graph][print]") {
  const Graph graph = must_load(
      "<graph name='g' default_profile='sim'><arg name='d' default='190 mm'/>"
      "<component name='avoid' type='orca.Label'><param name='label' value='${d}'/></component>"
      "<profile name='sim'><component name='loc' type='orca.Localizer' period='50 ms'/></profile></graph>");
  CHECK(print(graph) ==
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<graph name=\"g\" version=\"1\" expanded=\"true\" default_profile=\"sim\">\n"
        "  <profile name=\"sim\"/>\n"
        "  <component name=\"avoid\" type=\"orca.Label\">\n"
        "    <param name=\"label\" value=\"190 mm\"/>\n"
        "  </component>\n"
        "  <component name=\"loc\" type=\"orca.Localizer\" period=\"0.05 s\"/>\n"
        "</graph>\n");
  CHECK(must_load(print(graph)) == graph);
}

TEST_CASE("any damage to a graph ends in a graph or in errors", "[graph][property]") {
  RandomStream random(1, "graph", "damage");
  for (std::uint64_t seed = 1; seed <= orca::test::part_of<std::uint64_t>(60); ++seed) {
    const std::string good = RandomGraph(seed).text();
    for (int run = 0; run < 40; ++run) {
      std::string bad = good;
      const std::size_t from = random() % bad.size();
      const std::size_t to = random() % bad.size();
      bad.replace(from, 1 + random() % 12, bad.substr(to, random() % 12));
      CHECK_NOTHROW(said_about(bad));
    }
  }
}
