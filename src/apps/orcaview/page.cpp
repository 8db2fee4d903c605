// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "page.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

#include "answers.hpp"
#include "layout_file.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/files/own_folder.hpp"
#include "orca/idl/object_type.hpp"

namespace orca::view {
namespace {

using nlohmann::json;

constexpr const char* kTooMany = "too many questions; this page may ask 20 times a second";

// Returns the file that a record of the supervisor names.
std::string file_in(const supervisor::ControlAnswer& answer) {
  const auto* const record = std::get_if<supervisor::RecordAnswer>(&answer);
  return record == nullptr ? "" : json_of(record->record).value("file", "");
}

// A graph that a page has edited is a file for the supervisor, of its own for each question and for its time.
class GraphFile {
 public:
  static Result<std::shared_ptr<GraphFile>> make(const std::string& system, const std::string& text) {
    const Result<OwnFolder> folder = OwnFolder::make();
    if (!folder) return folder.error();
    static std::uint64_t number = 0;
    std::string path = folder->path() + "/" + system + "." + std::to_string(getpid()) + "." +
                       std::to_string(++number) + ".view.xml";
    constexpr mode_t kOwnersOnly = 0600;
    const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kOwnersOnly));
    if (!file || ::write(file.number(), text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      return fail(Code::unavailable, "cannot write " + path);
    return std::shared_ptr<GraphFile>(new GraphFile(std::move(path)));
  }
  ~GraphFile() { ::unlink(path_.c_str()); }
  GraphFile(const GraphFile&) = delete;
  GraphFile& operator=(const GraphFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  explicit GraphFile(std::string path) : path_(std::move(path)) {}
  const std::string path_;
};

}  // namespace

void Page::system_changed(bool is_up) {
  if (!is_up && std::exchange(is_greeted_, true)) return say({{"op", "system"}, {"present", false}});
  is_greeted_ = true;
  using Seconds = std::chrono::duration<double>;
  const Seconds time = std::chrono::system_clock::now().time_since_epoch();
  say({{"op", "hello"},
       {"system", desk().link().system()},
       {"role", to_string(desk().is_recorded() ? Role::observe : role())},
       {"recorded", desk().is_recorded()},
       {"present", is_up},
       {"time", time.count()},
       {"version", ORCA_VERSION}});
}

void Page::time_moved() {
  Session::time_moved();
  say({{"op", "moved"}});
}

void Page::hear(std::uint32_t id, const json& line) { say({{"op", "record"}, {"id", id}, {"record", line}}); }

void Page::take_text(const std::string& text) {
  std::uint32_t id = 0;
  const Result<Wish> wish = read_wish(text, id);
  wish ? carry_out(*wish) : refuse(id, wish.error().message);
}

void Page::take_bytes(const std::string& /*bytes*/) { refuse(0, "a message must be a text, a JSON object"); }

std::optional<Packet> Page::pack(const Frame& frame) { return Packet{object_head(frame), {}, frame.passed}; }

void Page::looking(std::uint32_t id, const std::string& port, const std::string& type) {
  say({{"op", "looking"}, {"id", id}, {"port", port}, {"type", type}});
}

void Page::blind(std::uint32_t id, const Error& why, bool had_seen) {
  say({{"op", had_seen ? "lost" : "refused"}, {"id", id}, {"error", why.text()}});
}

void Page::say_drops(std::uint64_t dropped, std::size_t waiting) {
  say({{"op", "figures"}, {"dropped", dropped}, {"queued", waiting}});
}

std::function<std::shared_ptr<Page>()> Page::finder() {
  return [self = weak_from_this()] { return std::static_pointer_cast<Page>(self.lock()); };
}

void Page::carry_out(const Wish& wish) {
  switch (wish.op) {
    case Wish::Op::ask: return ask(wish);
    case Wish::Op::cancel: return desk().leave_log(*this, wish.id);
    case Wish::Op::layout: return lay_out(wish);
    case Wish::Op::look: return begin_look(wish);
    case Wish::Op::query:
    case Wish::Op::send: return offer(wish);
    case Wish::Op::types: return say_types();
    case Wish::Op::unlook: return look_away(wish.id);
  }
}

void Page::refuse(std::uint32_t id, const std::string& why) {
  say({{"op", "answer"}, {"id", id}, {"ok", false}, {"error", why}});
}

void Page::ask(const Wish& wish) {
  supervisor::Ask ask = for_it({wish.command, wish.words, !wish.as_text});
  if (ask.command == "line") return refuse(wish.id, "a page looks at a port with the op look");
  if (!wish.graph.empty() && ask.command != "apply" && ask.command != "diff")
    return refuse(wish.id, "a graph goes with apply and diff only");
  if (wish.streams && ask.command == "log") return desk().follow_log(*this, wish.id);
  if (wish.streams) return refuse(wish.id, "only the log can be followed");
  if (std::ranges::find(ask.words, "--follow") != ask.words.end())
    return refuse(wish.id, "for what has no end, ask with \"stream\": true");
  std::shared_ptr<GraphFile> file;
  if (!wish.graph.empty()) {
    const Result<std::shared_ptr<GraphFile>> made = GraphFile::make(desk().link().system(), wish.graph);
    if (!made) return refuse(wish.id, made.error().text());
    file = *made;
    ask.words.insert(ask.words.begin(), file->path());
  }
  if (!may_ask()) return refuse(wish.id, kTooMany);
  const auto parts = std::make_shared<AnswerInParts>(wish.id);
  desk().link().ask(
      std::move(ask), [parts](const supervisor::ControlAnswer& answer) { parts->take(answer); },
      [parts, file, find = finder()](const Status& outcome) {
        if (const auto page = find()) page->say(parts->finish(outcome));
      });
}

void Page::begin_look(const Wish& wish) {
  const Status begun = look(wish.id, wish.port, wish.rate);
  if (!begun.ok()) say({{"op", "refused"}, {"id", wish.id}, {"error", begun.error().message}});
}

// The layout lies beside the graph, whose place the supervisor knows. Beside no file nothing is kept.
void Page::lay_out(const Wish& wish) {
  if (desk().is_recorded() && wish.layout.empty()) return say_layout(wish.id, "{}", "");
  if (!may_ask()) return refuse(wish.id, kTooMany);
  const auto file = std::make_shared<std::string>();
  supervisor::Ask ask = for_it({"file", {}, true});
  if (!wish.layout.empty()) ask.words = {"--keep"};
  desk().link().ask(
      std::move(ask), [file](const supervisor::ControlAnswer& answer) { *file += file_in(answer); },
      [file, wish, find = finder()](const Status& outcome) {
        const auto page = find();
        if (page && !outcome.ok()) page->refuse(wish.id, outcome.error().text());
        if (page && outcome.ok()) page->take_graph_file(*file, wish);
      });
}

void Page::take_graph_file(const std::string& file, const Wish& wish) {
  if (file.empty() && wish.layout.empty()) return say_layout(wish.id, "{}", "");
  if (file.empty()) return refuse(wish.id, "this system does not say in which file its graph is");
  if (!wish.layout.empty())
    if (const Status kept = keep_layout(file, wish.layout); !kept.ok())
      return refuse(wish.id, kept.error().text());
  const Result<std::string> layout = read_layout(file);
  if (!layout) return refuse(wish.id, layout.error().text());
  say_layout(wish.id, *layout, layout_file_of(file));
}

void Page::say_layout(std::uint32_t id, const std::string& layout, const std::string& file) {
  say({{"op", "answer"}, {"id", id}, {"ok", true}, {"error", ""}, {"text", layout}, {"file", file}});
}

void Page::offer(const Wish& wish) {
  if (!desk().ports().reaches(wish.port, wish.xml, asker()) && !may_ask()) return refuse(wish.id, kTooMany);
  desk().ports().offer(wish.port, wish.xml, asker(),
                       [find = finder(), id = wish.id](const Result<supervisor::OfferOutcome>& outcome) {
                         if (const auto page = find()) page->take_outcome(id, outcome);
                       });
}

void Page::take_outcome(std::uint32_t id, const Result<supervisor::OfferOutcome>& outcome) {
  if (!outcome) return refuse(id, outcome.error().text());
  if (!outcome->outcome.ok()) return refuse(id, outcome->outcome.error().text());
  json answer{{"op", "answer"}, {"id", id}, {"ok", true}, {"error", ""}};
  if (!outcome->type.empty()) {
    answer["type"] = outcome->type;
    const auto* const first = reinterpret_cast<const char*>(outcome->object.data());
    say_bytes(reply_head(id) + std::string(first, outcome->object.size()));
  }
  say(answer);
}

void Page::say_types() {
  json types = json::object();
  for (const ObjectType* const type : object_types())
    types[std::string(type->name)] = {
        {"parent", type->parent == nullptr ? "" : std::string(type->parent->name)},
        {"layout", std::string(type->layout)}};
  say({{"op", "types"}, {"types", std::move(types)}});
}

}  // namespace orca::view
