// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "ports.hpp"

#include <utility>

#include "access.hpp"
#include "offering.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::view {
namespace {

using supervisor::LineAnswer;

constexpr std::size_t kMostCounters = 16;
constexpr std::size_t kMostWaiting = 256;  // answers of one port

supervisor::Ask line_to(const std::string& port, const std::vector<std::string>& options) {
  supervisor::Ask ask{"line", {port}, false};
  ask.words.insert(ask.words.end(), options.begin(), options.end());
  return ask;
}

// Asks for a line, and passes it on; nothing if there is none.
void open_line(SystemLink& link, supervisor::Ask ask,
               std::function<void(Result<std::shared_ptr<LineAnswer>>)> opened) {
  auto line = std::make_shared<std::shared_ptr<LineAnswer>>();
  link.ask(
      std::move(ask),
      [line](supervisor::ControlAnswer answer) {
        if (auto* const found = std::get_if<LineAnswer>(&answer))
          *line = std::make_shared<LineAnswer>(std::move(*found));
      },
      [line, opened = std::move(opened)](const Status& outcome) {
        if (!outcome.ok()) return opened(outcome.error());
        if (!*line) return opened(fail(Code::internal, "the supervisor has sent no line"));
        opened(std::move(*line));
      });
}

Error no_descriptors() { return fail(Code::unavailable, "there are no descriptors left"); }

}  // namespace

Ports::~Ports() {
  for (const auto& [port, view] : views_)
    if (view->wire) view->wire->close();
  for (const auto& [port, counter] : counters_)
    if (counter->wire) counter->wire->close();
}

void Ports::look(const std::string& port, Onlooker& onlooker) {
  const auto found = views_.find(port);
  if (found == views_.end()) {
    views_.emplace(port, std::make_shared<View>()).first->second->onlookers.push_back(&onlooker);
    return open_view(port);
  }
  found->second->onlookers.push_back(&onlooker);
  if (!found->second->type.empty()) onlooker.looking(found->second->type);
}

void Ports::look_away(const std::string& port, Onlooker& onlooker) {
  const auto found = views_.find(port);
  if (found == views_.end()) return;
  std::erase(found->second->onlookers, &onlooker);
  if (!found->second->onlookers.empty()) return;
  if (found->second->wire) found->second->wire->close();
  views_.erase(found);
}

void Ports::look_anew() {
  for (auto& [port, view] : views_) {
    if (view->wire) view->wire->close();
    const auto fresh = std::make_shared<View>();
    fresh->onlookers = view->onlookers;
    view = fresh;
  }
  std::vector<std::string> ports;
  for (const auto& [port, view] : views_) ports.push_back(port);
  for (const std::string& port : ports) open_view(port);
}

void Ports::open_view(const std::string& port) {
  open_line(link_, line_to(port, {"--tap", "--objects"}),
            [this, port, meant = std::weak_ptr(views_.at(port))](Result<std::shared_ptr<LineAnswer>> line) {
              const std::shared_ptr<View> view = meant.lock();
              if (!view) return;  // nobody looks any more
              if (!line) return end_view(port, line.error());
              view->type = (*line)->type;
              view->wire = Wire::make(loop_, std::move((*line)->line));
              if (!view->wire) return end_view(port, no_descriptors());
              view->wire->start(
                  [this, raw = view.get()](supervisor::Message message) { take(*raw, std::move(message)); },
                  [this, port](const Error& why) { end_view(port, why); });
              for (Onlooker* const one : std::vector(view->onlookers)) one->looking(view->type);
            });
}

void Ports::take(View& view, supervisor::Message message) {
  Result<supervisor::LineWord> word = supervisor::decode_line_word(std::move(message));
  if (!word) return;
  auto* const passed = std::get_if<supervisor::Tapped>(&*word);
  if (passed == nullptr) return;
  const auto shared = std::make_shared<const supervisor::Tapped>(std::move(*passed));
  for (Onlooker* const one : std::vector(view.onlookers)) one->see(shared);
}

void Ports::end_view(const std::string& port, const Error& why) {
  const auto view = views_.extract(port);
  if (!view) return;
  if (view.mapped()->wire) view.mapped()->wire->close();
  for (Onlooker* const one : view.mapped()->onlookers) one->blind(why, !view.mapped()->type.empty());
}

void Ports::offer(const std::string& port, const std::string& xml, const Asker& asker, Answered answered) {
  const bool is_question = only_asks(xml);
  const CounterKey key = key_for(port, xml, asker);
  when_open(key, [this, key, xml, is_question, answered = std::move(answered)](const Status& opened) {
    if (!opened.ok()) return answered(opened.error());
    Counter& counter = *counters_.at(key);
    if (is_question && !counter.answers)
      return answered(fail(Code::invalid_argument, key.first + " answers no questions"));
    hand_in(counter, xml, answered);
  });
}

bool Ports::reaches(const std::string& port, const std::string& xml, const Asker& asker) const {
  return counters_.contains(key_for(port, xml, asker));
}

Ports::CounterKey Ports::key_for(const std::string& port, const std::string& xml, const Asker& asker) {
  return {port, only_asks(xml) ? Asker{} : asker};
}

void Ports::when_open(const CounterKey& key, std::function<void(const Status&)> then) {
  const auto found = counters_.find(key);
  if (found != counters_.end() && found->second->wire) return then(ok());
  if (found != counters_.end()) return found->second->opened.push_back(std::move(then));
  close_idle_counters();
  const auto counter = counters_.emplace(key, std::make_shared<Counter>()).first->second;
  counter->opened.push_back(std::move(then));
  supervisor::Ask line_for_it = line_to(key.first, {});
  line_for_it.most = key.second.most;
  line_for_it.via = key.second.via;
  open_line(link_, std::move(line_for_it), [this, key, counter](Result<std::shared_ptr<LineAnswer>> line) {
    const auto waiting = std::exchange(counter->opened, {});
    if (line) {
      counter->type = (*line)->type;
      counter->answers = !(*line)->reply.empty();
      counter->wire = Wire::make(loop_, std::move((*line)->line));
      if (!counter->wire) line = no_descriptors();
    }
    if (line) {
      counter->wire->start(
          [counter = counter.get()](supervisor::Message message) {
            const auto asked = counter->waiting.extract(message.request);
            Result<supervisor::LineWord> word = supervisor::decode_line_word(std::move(message));
            auto* const outcome = word ? std::get_if<supervisor::OfferOutcome>(&*word) : nullptr;
            if (asked && outcome != nullptr) asked.mapped()(std::move(*outcome));
          },
          [this, key](const Error& why) { end_counter(key, why); });
    } else {
      counters_.erase(key);
    }
    for (const auto& one : waiting) one(line ? ok() : Status(line.error()));
  });
}

// A process has a limited number of lines, which others need, too.
void Ports::close_idle_counters() {
  if (counters_.size() < kMostCounters) return;
  for (auto counter = counters_.begin(); counter != counters_.end();) {
    const bool is_idle = counter->second->wire && counter->second->waiting.empty();
    if (is_idle) counter->second->wire->close();
    counter = is_idle ? counters_.erase(counter) : std::next(counter);
  }
}

void Ports::hand_in(Counter& counter, const std::string& xml, Answered answered) {
  if (counter.waiting.size() >= kMostWaiting)
    return answered(fail(Code::unavailable, "too many objects wait for an answer"));
  xml::Diagnostics problems;
  const Result<ObjectLoan> object = orcactl::object_from(xml, "XML", counter.type, problems);
  if (!object) return answered(fail(object.error().code, problems.text() + object.error().message));
  supervisor::Offer offer{std::string(object->type().name), {}};
  object->type().serialize(object->get(), offer.object);
  const std::uint64_t request = ++last_request_;
  counter.waiting.emplace(request, answered);
  const Status sent = counter.wire->post(supervisor::encode(supervisor::LineWord(std::move(offer)), request));
  if (sent.ok()) return;
  counter.waiting.erase(request);
  answered(sent.error());
}

void Ports::end_counter(const CounterKey& key, const Error& why) {
  const auto counter = counters_.extract(key);
  if (!counter) return;
  const Error ended = fail(Code::unavailable, "the process of " + key.first + " has ended: " + why.message);
  for (const auto& [request, answered] : counter.mapped()->waiting) answered(ended);
}

}  // namespace orca::view
