// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"
#include "task.hpp"
#include "task_rules.hpp"

namespace orca::tasks {
namespace {

using xml::Attributes;

bool is_leaf(Kind kind) { return kind >= Kind::drive; }

// The kinds that do their steps one after the other, and then something with the result.
bool wraps(Kind kind) { return kind >= Kind::repeat && kind <= Kind::caught; }

/// Reads the steps of one file.
class TaskReader {
 public:
  TaskReader(std::span<const Sight> sights, xml::Reporter& reporter) : sights_(sights), reporter_(reporter) {}

  Task read(const xml::Element& root) {
    const Attributes task(root, kTaskRule, kTaskFile, reporter_);
    task_.name = task.name("name").value_or("");
    (void)task.integer("version");  // its rule allows one
    add({.kind = Kind::sequence, .text = task_.name, .position = root.position()});
    read_children(task, 0);
    return std::move(task_);
  }

 private:
  std::size_t add(Step step) {
    task_.steps.push_back(std::move(step));
    return task_.steps.size() - 1;
  }

  // Reads the steps in an element as children of a step: what is done, then the handlers.
  void read_children(const Attributes& element, std::size_t parent) {
    const auto children = element.children();
    const auto handlers =
        std::ranges::count_if(children, [](const auto& child) { return handles(*child.second); });
    const std::size_t into =
        in_sequence(element, children.size() - static_cast<std::size_t>(handlers), parent);
    std::vector<std::size_t> done;
    std::vector<std::size_t> handling;
    for (const auto& [child, rule] : children) {
      const bool is_handler = handles(*rule);
      (is_handler ? handling : done)
          .push_back(read_step(element.of_child(*child, *rule), *rule, is_handler ? parent : into));
    }
    check_parts(element, task_.steps[parent].kind, done, handling);
    if (into != parent) task_.steps[into].children = std::exchange(done, {into});
    done.insert(done.end(), handling.begin(), handling.end());
    task_.steps[parent].children = std::move(done);
  }

  static bool handles(const xml::ElementRule& rule) {
    const Kind kind = kind_of(rule.name);
    return kind == Kind::on || kind == Kind::caught;
  }

  // Several steps in a Repeat, a Try and the like are a Sequence, which need not be written.
  std::size_t in_sequence(const Attributes& element, std::size_t steps, std::size_t parent) {
    if (!wraps(task_.steps[parent].kind) || steps < 2) return parent;
    return add({.kind = Kind::sequence,
                .text = "Sequence",
                .depth = task_.steps[parent].depth + 1,
                .position = element.element().position()});
  }

  void check_parts(const Attributes& element, Kind kind, const std::vector<std::size_t>& done,
                   const std::vector<std::size_t>& handling) {
    const std::string name = "<" + element.element().name() + ">";
    if (done.empty() && element.element().children().size() == handling.size())
      element.error(codes::kNoSteps, name + " has nothing to do; put steps into it");
    if (kind == Kind::attempt && handling.empty())
      element.error(codes::kHandlers, "<Try> has no <On> and no <Catch>; without them it is not needed");
    if (kind == Kind::parallel) check_parallel(element, done);
  }

  // There is one robot.
  void check_parallel(const Attributes& element, const std::vector<std::size_t>& branches) {
    const auto drivers =
        std::ranges::count_if(branches, [this](std::size_t branch) { return holds(branch, Kind::drive); });
    const auto asking =
        std::ranges::count_if(branches, [this](std::size_t branch) { return holds(branch, Kind::ask); });
    if (asking > 1)
      element.error(codes::kTwoDrivers,
                    "two branches of <Parallel> ask at the same time; an answer would be to both");
    if (drivers > 1)
      element.error(codes::kTwoDrivers, "two branches of <Parallel> drive the one robot at the same time");
    std::set<std::string> changed;
    for (const std::size_t branch : branches)
      for (const std::string& change : changes_in(branch))
        if (!changed.insert(change).second)
          element.error(codes::kTwoDrivers, "two branches of <Parallel> " + change + " at the same time");
    if (const auto need = element.integer("need"); need && *need > static_cast<std::int64_t>(branches.size()))
      element.error_at("need", codes::kBadValue,
                       "there are " + std::to_string(branches.size()) + " branches only");
  }

  [[nodiscard]] bool holds(std::size_t step, Kind kind) const {
    const Step& s = task_.steps[step];
    return s.kind == kind ||
           std::ranges::any_of(s.children, [&](std::size_t child) { return holds(child, kind); });
  }

  // Returns what is changed of other components in a step: "set pilot.max_speed".
  [[nodiscard]] std::set<std::string> changes_in(std::size_t step) const {
    const Step& s = task_.steps[step];
    std::set<std::string> changes;
    if (s.kind == Kind::with) changes.insert("set " + s.component + "." + s.param);
    if (s.kind == Kind::suspend) changes.insert("suspend " + s.component);
    for (const std::size_t child : s.children) changes.merge(changes_in(child));
    return changes;
  }

  [[nodiscard]] bool takes_time(std::size_t step) const {
    const Step& s = task_.steps[step];
    return (is_leaf(s.kind) && s.kind != Kind::say) ||
           std::ranges::any_of(s.children, [this](std::size_t child) { return takes_time(child); });
  }

  std::size_t read_step(const Attributes& e, const xml::ElementRule& rule, std::size_t parent) {
    const Kind kind = kind_of(rule.name);
    const std::size_t index =
        add({.kind = kind, .depth = task_.steps[parent].depth + 1, .position = e.element().position()});
    Step step = std::move(task_.steps[index]);
    read_values(e, step);
    step.text = for_people(e, rule);
    task_.steps[index] = std::move(step);
    if (!is_leaf(kind)) read_children(e, index);
    if (kind == Kind::repeat) check_repeat(e, index);
    return index;
  }

  void check_repeat(const Attributes& e, std::size_t index) {
    if (e.has("times") && e.has("for"))
      e.error_at("for", codes::kHandlers, "a <Repeat> ends after so many times, or after a time; not both");
    if (!e.has("times") && !e.has("for") && !takes_time(index))
      e.error(codes::kNeverEnds,
              "this repeats without an end what takes no time; add times, for, or a <Wait>");
  }

  void read_values(const Attributes& e, Step& step) {
    switch (step.kind) {
      case Kind::parallel: step.count = count(e, "need"); break;
      case Kind::repeat:
        step.count = count(e, "times"), step.time = e.number_or("for", 0.0).value_or(0.0);
        break;
      case Kind::retry: step.count = count(e, "attempts"); break;
      case Kind::timeout: step.time = e.number("after").value_or(0.0); break;
      case Kind::with: read_setting(e, step); break;
      case Kind::suspend: read_suspended(e, step); break;
      case Kind::on: read_handler(e, step), read_condition(e, step); break;
      case Kind::caught: read_handler(e, step), read_reason(e, step); break;
      case Kind::drive: read_drive(e, step); break;
      case Kind::wait: step.time = e.number("for").value_or(0.0); break;
      case Kind::say: step.words = e.text("text").value_or(""); break;
      case Kind::ask:
        step.words = e.text("text").value_or(""), step.time = e.number("within").value_or(0.0);
        break;
      case Kind::check: read_condition(e, step), step.time = e.number_or("within", 0.0).value_or(0.0); break;
      default: break;
    }
  }

  // Returns the start tag as it is written, without its signs: "Drive to=kitchen".
  static std::string for_people(const Attributes& e, const xml::ElementRule& rule) {
    std::string text(rule.name);
    for (const auto& [name, attribute] : e.matched())
      text += " " + std::string(name) + "=" + attribute->value;
    return text;
  }

  static std::uint32_t count(const Attributes& e, const char* attribute) {
    return e.has(attribute) ? static_cast<std::uint32_t>(e.integer(attribute).value_or(1)) : 0;
  }

  static void read_setting(const Attributes& e, Step& step) {
    step.words = e.text("to").value_or("");
    const std::string what = e.text("set").value_or("");
    const std::size_t dot = what.rfind('.');
    if (dot == std::string::npos || dot == 0 || dot + 1 == what.size()) {
      if (e.has("set"))
        e.error_at(
            "set", codes::kBadValue,
            in_quotes(what) + " names no parameter; write COMPONENT.PARAM, for example pilot.max_speed");
      return;
    }
    step.component = what.substr(0, dot);
    step.param = what.substr(dot + 1);
  }

  static void read_suspended(const Attributes& e, Step& step) {
    step.component = e.text("component").value_or("");
    if (step.component.empty() && e.has("component"))
      e.error_at("component", codes::kBadValue, "\"\" names no component; write its name in the graph");
  }

  static void read_handler(const Attributes& e, Step& step) {
    const std::string then = e.choice("then").value_or("fail");
    step.then = then == "resume"  ? Then::resume
                : then == "again" ? Then::again
                : then == "done"  ? Then::done
                                  : Then::fail;
  }

  static void read_reason(const Attributes& e, Step& step) {
    step.words = e.choice("reason").value_or("any");
    std::ranges::replace(step.words, '_', ' ');
    if (step.words == "any") step.words.clear();
    step.count = std::max<std::uint32_t>(count(e, "times"), 1);
  }

  void read_condition(const Attributes& e, Step& step) const {
    const std::optional<std::string> text = e.text("when");
    if (!text) return;
    Result<Condition> condition = parse_condition(*text, sights_);
    if (condition) {
      step.condition = std::move(condition).value();
    } else {
      e.error_at("when", codes::kCondition, condition.error().message);
    }
  }

  static void read_drive(const Attributes& e, Step& step) {
    step.time = e.number_or("within", 0.0).value_or(0.0);
    const std::optional<std::string> text = e.text("to");
    if (!text) return;
    Result<go::Trip> trip = go::parse_trip(*text);
    if (trip) {
      step.trip = std::move(trip).value();
    } else {
      e.error_at("to", codes::kPlace, trip.error().message);
    }
  }

  std::span<const Sight> sights_;
  xml::Reporter& reporter_;
  Task task_;
};

std::optional<Task> read_document(const std::optional<xml::Document>& document, std::span<const Sight> sights,
                                  xml::Diagnostics& diagnostics) {
  if (!document) return std::nullopt;
  xml::Reporter reporter(diagnostics);
  const xml::Element& root = document->root;
  if (root.name() != kTaskRule.name) {
    reporter.error(codes::kWrongRoot, root.position(),
                   "this is <" + root.name() + ">, not <task>; a graph is run with deployer");
    return std::nullopt;
  }
  return TaskReader(sights, reporter).read(root);
}

}  // namespace

std::optional<Task> read_task(const std::string& path, std::span<const Sight> sights,
                              xml::Diagnostics& diagnostics) {
  return read_document(xml::read_file(path, diagnostics), sights, diagnostics);
}

std::optional<Task> read_task_text(std::string_view text, const std::string& file_name,
                                   std::span<const Sight> sights, xml::Diagnostics& diagnostics) {
  return read_document(xml::read_text(text, file_name, diagnostics), sights, diagnostics);
}

}  // namespace orca::tasks
