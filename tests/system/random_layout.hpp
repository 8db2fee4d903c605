// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Graphs at random that a running system can go over to, one after the other.
#pragma once

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace orca::test {

/// A talker that tells a teller its number fifty times a second, and pokes it. The talker logs what a teller tells it back.
struct Duo {
  std::string name;       ///< Of the talker; the teller is "NAME_teller".
  std::string talks;      ///< Process of the talker.
  std::string counts;     ///< And of the teller.
  std::string hears{};    ///< Name of the duo whose teller the talker hears; empty: its own.
  bool is_other = false;  ///< The teller is a test.OtherTeller, which says "7:N", not "1:N".
  int step = 1;           ///< Parameter of the teller.
  int queue = 1000;       ///< Of the connection from the talker to the teller.
  bool is_poked = true;   ///< Whether there is a connection for pokes.
  std::string broken{};   ///< Type of the teller instead.

  [[nodiscard]] std::string teller() const { return name + "_teller"; }
  friend bool operator==(const Duo&, const Duo&) = default;
};

/// What a graph says.
///
/// The processes "calm" and "still" stay, and so do the duo "zed" and two nappers in them. The duo "anchor" keeps "main". The
/// other processes come, go and change, and so do the duos in them and in "main". Guests are duos that come and go in "calm"
/// and "still", and change there. So those two processes never have to begin anew.
struct Layout {
  std::map<std::string, std::string> processes{{"front", ""}};  ///< With attributes; without those that stay.
  std::vector<Duo> duos{{"anchor", "main", "main"}, {"one", "main", "front"}, {"zed", "calm", "still"}};
  std::string nap = "0 s";  ///< Parameters of "napper".
  std::string mood = "good";
  int naps_queue = 1000;      ///< Of the connection from "sleeper" to "napper".
  std::string sleep = "0 s";  ///< Parameter of "sleeper".
  std::string more{};         ///< Other elements.

  [[nodiscard]] const Duo* find(const std::string& name) const {
    const auto found = std::ranges::find(duos, name, &Duo::name);
    return found == duos.end() ? nullptr : &*found;
  }
  [[nodiscard]] Duo& duo(const std::string& name) { return *std::ranges::find(duos, name, &Duo::name); }
  /// Returns the version of the teller that a talker hears.
  [[nodiscard]] std::string heard_by(const Duo& duo) const {
    return (duo.hears.empty() ? duo : *find(duo.hears)).is_other ? "7" : "1";
  }
  friend bool operator==(const Layout&, const Layout&) = default;
};

inline std::string element(const std::string& name, const std::string& type, const std::string& process,
                           const std::map<std::string, std::string>& params = {}) {
  std::string text = "<component name=\"" + name + "\" type=\"" + type + "\" autonomous=\"true\"" +
                     (process == "main" ? "" : " process=\"" + process + "\"") + ">";
  for (const auto& [param, value] : params) text += "<param name=\"" + param + "\" value=\"" + value + "\"/>";
  return text + "</component>\n";
}

inline std::string connection(const std::string& from, const std::string& to, int queue = 1000) {
  return "<connect from=\"" + from + "\" to=\"" + to + "\" queue=\"" + std::to_string(queue) + "\"/>\n";
}

/// Returns the text of a graph. On a busy machine a process may be without a beat for a second, and does not hang.
/// @param plugins  the folder of the plugins.
inline std::string text_of(const Layout& layout, const std::string& plugins) {
  const auto process = [](const std::string& name, const std::string& attributes) {
    const bool has_limit = attributes.find("hang_limit") != std::string::npos;
    return "<process name=\"" + name + "\"" + attributes + (has_limit ? "" : " hang_limit=\"3 s\"") + "/>\n";
  };
  std::string text = "<graph name=\"pairs\" version=\"1\" restarts=\"1000\" within=\"100 ms\" plugins=\"" +
                     plugins + "\">\n" + process("main", "") + process("calm", "") + process("still", "");
  for (const auto& [name, attributes] : layout.processes) text += process(name, attributes);
  for (const Duo& duo : layout.duos) {
    const std::string type = duo.is_other ? "test.OtherTeller" : "test.Teller";
    text += element(duo.name, "test.Talker", duo.talks, {{"period", "0.02 s"}}) +
            element(duo.teller(), duo.broken.empty() ? type : duo.broken, duo.counts,
                    {{"step", std::to_string(duo.step)}});
  }
  text += element("napper", "test.Napper", "calm", {{"nap", layout.nap}, {"mood", layout.mood}}) +
          element("sleeper", "test.Napper", "still", {{"nap", layout.sleep}});
  for (const Duo& duo : layout.duos) {
    text +=
        connection(duo.name + ".out", duo.teller() + ".in", duo.queue) +
        connection((duo.hears.empty() ? duo : *layout.find(duo.hears)).teller() + ".out", duo.name + ".back");
    if (duo.is_poked) text += connection(duo.name + ".poke", duo.teller() + ".poke");
  }
  return text + connection("sleeper.out", "napper.back", layout.naps_queue) + layout.more + "</graph>\n";
}

/// A source of layouts that follow on each other.
class LayoutDice {
 public:
  /// @param exchanges  share of the new layouts in which a teller may get another type. It takes seconds to try one.
  LayoutDice(unsigned seed, double exchanges) : random_(seed), exchanges_(exchanges) {}

  /// Returns another layout, with one to five differences.
  Layout next(const Layout& before) {
    Layout layout = before;
    bool may_exchange = share() < exchanges_;
    for (int i = 1 + below(5); i > 0 || layout == before; --i) {
      change(layout, may_exchange);
      repair(layout);
    }
    return layout;
  }

  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  double share() { return static_cast<double>(random_()) / static_cast<double>(std::mt19937::max()); }
  template <class List>
  const auto& one_of(const List& list) {
    return *std::next(list.begin(), below(static_cast<int>(list.size())));
  }

 private:
  void change(Layout& layout, bool& may_exchange) {
    switch (below(11)) {
      case 0: come(layout); break;
      case 1: go(layout); break;
      case 2: process_comes(layout); break;
      case 3: process_goes(layout); break;
      case 4: process_changes(layout); break;
      case 5: move(layout); break;
      case 6: hear(layout); break;
      case 7: any(layout).step = 1 + below(10); break;
      case 8: any(layout).queue = below(2) == 0 ? 1000 : 500; break;
      case 9: any(layout).is_poked = below(3) != 0; break;
      case 10:
        if (may_exchange) any(layout).is_other ^= true;
        may_exchange = false;
        break;
    }
  }

  static bool is_guest(const std::string& name) { return name.starts_with("guest"); }

  std::string process_in(const Layout& layout) {
    const int i = below(1 + static_cast<int>(layout.processes.size()));
    return i == 0 ? "main" : std::next(layout.processes.begin(), i - 1)->first;
  }
  // Returns one that may change.
  Duo& any(Layout& layout) {
    for (;;)
      if (Duo& duo = layout.duos[static_cast<std::size_t>(below(static_cast<int>(layout.duos.size())))];
          duo.name != "zed" && duo.name != "anchor")
        return duo;
  }
  void come(Layout& layout) {
    const std::string name = one_of(std::vector<std::string>{"two", "three", "guest", "guest_two"});
    if (layout.find(name) != nullptr) return;
    const std::string talks = is_guest(name) ? "calm" : process_in(layout);
    const std::string counts = is_guest(name) ? "still" : process_in(layout);
    layout.duos.push_back({name, talks, counts, "", below(2) == 0});
  }
  // One is always there, so that there is something that can change.
  void go(Layout& layout) {
    if (const std::string name = any(layout).name; name != "one")
      std::erase_if(layout.duos, [&](const Duo& duo) { return duo.name == name; });
  }
  void move(Layout& layout) {
    Duo& duo = any(layout);
    if (!is_guest(duo.name)) (below(2) == 0 ? duo.talks : duo.counts) = process_in(layout);
  }
  void hear(Layout& layout) {
    Duo& duo = any(layout);
    const Duo& other = any(layout);
    if (is_guest(duo.name) == is_guest(other.name)) duo.hears = other.name == duo.name ? "" : other.name;
  }
  void process_comes(Layout& layout) { layout.processes.try_emplace(below(2) == 0 ? "rear" : "third", ""); }
  void process_goes(Layout& layout) {
    if (!layout.processes.empty()) layout.processes.erase(one_of(layout.processes).first);
  }
  // None is "temporary": one that is killed would not come back.
  void process_changes(Layout& layout) {
    if (layout.processes.empty()) return;
    const std::string name = one_of(layout.processes).first;
    layout.processes[name] = one_of(std::vector<std::string>{
        "", " spin=\"0.1 ms\"", " executor=\"fiber\"", " hang_limit=\"4 s\"", " restart=\"transient\""});
  }
  // Who was in a process that has gone goes to another one; who has heard one that has gone hears its own teller. The order is
  // that of the names: for one that goes and comes at once nothing changes, also if a file has it at another place.
  static void repair(Layout& layout) {
    std::ranges::sort(layout.duos, {}, &Duo::name);
    for (Duo& duo : layout.duos) {
      for (std::string* const process : {&duo.talks, &duo.counts})
        if (!layout.processes.contains(*process) && !is_permanent(*process)) *process = "main";
      if (layout.find(duo.hears) == nullptr) duo.hears.clear();
    }
  }
  static bool is_permanent(const std::string& process) {
    return process == "main" || process == "calm" || process == "still";
  }

  std::mt19937 random_;
  const double exchanges_;
};

}  // namespace orca::test
