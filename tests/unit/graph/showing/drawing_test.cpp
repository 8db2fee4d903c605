// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures are checked with a reader of our own; with Graphviz itself where it is installed.
#include "orca/graph/print.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <sstream>

#include "loading.hpp"
#include "temp_folder.hpp"

using namespace orca::graph;

namespace {

Graph two_robots() {
  return must_load(Files{{"main.xml",
                          "<graph name='pair' default_profile='sim'><use graph='r.xml' prefix='left'/>"
                          "<use graph='r.xml' prefix='right'/><component name='planner' type='orca.Planner'/>"
                          "<connect from='planner.limits' to='left/base.LimitsQuery'/>"
                          "<profile name='sim'/></graph>"},
                         {"r.xml",
                          "<graph name='r'><hardware name='robot' type='orca.hw.Sim'/>"
                          "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>"
                          "<component name='avoid' type='orca.SonarAvoid'/>"
                          "<component name='fuser' type='orca.MotionCommandFuser'>"
                          "<port name='motion' candidates='avoid'/></component>"
                          "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>"
                          "<connect from='fuser.base' to='base.MotionCommandSend'/></graph>"}});
}

// Reads the part of the DOT language that a digraph of statements in braces needs; anything else throws.
class DotReader {
 public:
  explicit DotReader(const std::string& text) : in_(text) {}

  int nodes = 0;
  int edges = 0;
  int boxes = 0;

  void read() {
    expect("digraph");
    token();
    block();
    if (!token().empty()) throw std::runtime_error("text after the end");
  }

 private:
  void block() {
    expect("{");
    for (std::string word = token(); word != "}"; word = token()) {
      if (word == "subgraph") {
        ++boxes;
        token();
        block();
      } else {
        statement(word);
      }
    }
  }

  void statement(const std::string& first) {
    if (first.empty()) throw std::runtime_error("the text ends in a block");
    std::string next = token();
    if (next == "=") {
      token();
      return expect(";");
    }
    if (next == "->") {
      ++edges;
      token();
      next = token();
    } else if (first != "node") {
      ++nodes;
    }
    if (next != "[") throw std::runtime_error("no attributes: " + next);
    while (next != "]") {
      token();
      expect("=");
      token();
      next = token();
      if (next != "," && next != "]") throw std::runtime_error("bad attributes: " + next);
    }
    expect(";");
  }

  void expect(const std::string& wanted) {
    const std::string found = token();
    if (found != wanted) throw std::runtime_error("expected " + wanted + ", found " + found);
  }

  std::string token() {
    char c = 0;
    if (!(in_ >> c)) return {};
    std::string word(1, c);
    if (c == '"') {
      while (in_.get(c)) {
        word += c;
        if (c == '\\' && in_.get(c))
          word += c;
        else if (c == '"')
          return word;
      }
      throw std::runtime_error("a text is not closed");
    }
    if (c == '-') return word + static_cast<char>(in_.get());
    const auto in_word = [](int next) { return std::isalnum(next) != 0 || next == '_'; };
    if (!in_word(c)) return word;
    while (in_word(in_.peek())) word += static_cast<char>(in_.get());
    return word;
  }

  std::istringstream in_;
};

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("the DOT text has every component, hardware and connection, and sub-graphs as boxes",
          "[graph][drawing]") {
  const std::string text = dot(two_robots(), "sim");
  INFO(text);
  DotReader reader(text);
  REQUIRE_NOTHROW(reader.read());
  CHECK(reader.nodes == 7 + 2);
  CHECK(reader.edges == 2 * 3 + 1 + 2);
  CHECK(reader.boxes == 2);  // and none for the only process
  CHECK(count(text, "label=\"SonarRangeReadingsPush > sonar (3)\"") == 2);
  CHECK(count(text, "style=dashed") == 2);
  CHECK(count(text, "label=\"pair, profile sim\"") == 1);
  CHECK(count(text, "\"robot\\norca.hw.Sim\", shape=cylinder") == 2);
}

// The left robot in a process of its own, on another machine.
Graph robots_apart() {
  Graph graph = two_robots();
  graph.processes = {{.name = "left", .machine = "far"}, {.name = "main", .machine = "near"}};
  graph.hardware[0].process = "left";
  for (std::size_t i = 0; i < 3; ++i) graph.components[i].process = "left";
  graph.edges.front().link = Link::dds;
  return graph;
}

TEST_CASE("the DOT text has a box per process, and in it one per sub-graph", "[graph][drawing]") {
  const std::string text = dot(robots_apart(), "sim");
  INFO(text);
  DotReader reader(text);
  REQUIRE_NOTHROW(reader.read());
  CHECK(reader.nodes == 7 + 2);
  CHECK(reader.edges == 2 * 3 + 1 + 2);
  CHECK(reader.boxes == 2 + 2);
  CHECK(count(text,
              "  subgraph cluster_0 { label=\"process left, machine far\";\n"
              "    subgraph cluster_1 { label=\"left\";\n"
              "      h0 [") == 1);
  CHECK(count(text, "label=\"process main, machine near\"") == 1);
  CHECK(count(text, "(dds)") == 1);
}

TEST_CASE("the Mermaid chart has a box per process, and in it one per sub-graph", "[graph][drawing]") {
  const std::string text = mermaid(robots_apart(), "sim");
  INFO(text);
  CHECK(count(text,
              "  subgraph s0[\"process left, machine far\"]\n"
              "    subgraph s1[\"left\"]\n"
              "      h0[(") == 1);
  CHECK(count(text, "subgraph s") == 4);
  CHECK(count(text, "    end\n  end\n") == 2);
}

TEST_CASE("names with characters that mean something to Graphviz do no harm", "[graph][drawing]") {
  Graph graph = two_robots();
  graph.name = "a \"b\" \\ {c}";
  graph.components[0].type = "evil\"];\\";
  DotReader reader(dot(graph, "x\"y"));
  CHECK_NOTHROW(reader.read());
  CHECK(reader.nodes == 9);
}

TEST_CASE("Graphviz draws the DOT text, where it is installed", "[graph][drawing][tool]") {
  if (std::system("command -v dot >/dev/null") != 0) {
    std::cout << "SKIPPED: there is no dot; apt install graphviz\n";
    return;
  }
  const orca::test::TempFolder folder;
  const std::string file = folder.write("graph.dot", dot(two_robots(), "sim"));
  CHECK(std::system(("dot -Tsvg '" + file + "' > '" + folder.file("graph.svg") + "'").c_str()) == 0);
}

TEST_CASE("the Mermaid chart has the same content, line by line", "[graph][drawing]") {
  const std::string text = mermaid(two_robots(), "sim");
  INFO(text);
  CHECK(text.starts_with("---\ntitle: pair, profile sim\n---\nflowchart LR\n"));
  CHECK(count(text, "<br/>orca.") == 9);
  CHECK(count(text, " --> ") == 2 * 2 + 1 + 2);
  CHECK(count(text, " -. \"motion #gt; motion (candidate)\" .-> ") == 2);
  CHECK(count(text, "  subgraph s") == count(text, "  end\n"));
  CHECK(count(text, "[(\"robot<br/>orca.hw.Sim\")]") == 2);
}

TEST_CASE("an edge of the chart joins nodes that the chart has", "[graph][drawing]") {
  std::istringstream lines(mermaid(two_robots(), ""));
  std::vector<std::string> ids;
  std::vector<std::string> used;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    const std::size_t bracket = first.find('[');
    if (bracket != std::string::npos) ids.push_back(first.substr(0, bracket));
    if (line.find("-> ") == std::string::npos) continue;
    used.push_back(first);
    used.push_back(line.substr(line.rfind(' ') + 1));
  }
  CHECK(used.size() == 18);
  for (const std::string& id : used) CHECK(std::find(ids.begin(), ids.end(), id) != ids.end());
}
