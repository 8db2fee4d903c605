// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "batch_door.hpp"

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "answers.hpp"

namespace orca::view {
namespace {

namespace asio = boost::asio;
using apps::ChildProgram;
using nlohmann::json;

constexpr std::chrono::milliseconds kFresh{1000};  // so long a status is good enough
constexpr std::size_t kLongestStatus = std::size_t{8} << 20;
constexpr std::size_t kLongestSaid = 4000;  // [bytes]
constexpr const char* kReportFile = "report.html";

// To make a run again is to run code as the user who has started orcaview.
constexpr Role kWatches = Role::change;
constexpr const char* kTooLittle =
    "to watch a run takes the role change; who has started the page has an address with it";

BatchDoor::Reply refuse(unsigned status, const std::string& why) {
  return {status, text_of({{"error", why}})};
}

// Returns the address of a page in what a deployer has printed; empty: it has not said one yet.
std::string address_in(const std::string& said) {
  const std::size_t begin = said.find("http://127.0.0.1:");
  const std::size_t end = begin == std::string::npos ? begin : said.find('\n', begin);
  return end == std::string::npos ? "" : said.substr(begin, end - begin);
}

// Returns what a program has printed, without the lines with addresses.
std::string without_addresses(const std::string& said) {
  std::string rest;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);)
    if (line.find("token=") == std::string::npos) rest += line + "\n";
  return rest;
}

// Returns what a program has printed next; empty: it has closed its output.
asio::awaitable<std::string> read_some(asio::posix::stream_descriptor& output) {
  std::array<char, 4096> buffer;
  boost::system::error_code error;
  const std::size_t size =
      co_await output.async_read_some(asio::buffer(buffer), asio::redirect_error(asio::use_awaitable, error));
  co_return error ? std::string() : std::string(buffer.data(), size);
}

}  // namespace

asio::awaitable<BatchDoor::Reply> BatchDoor::answer(std::string target, bool is_post, Role role) {
  const std::string path = target.substr(0, target.find('?'));
  if (path == "/batch/watch" && is_post)
    co_return role < kWatches ? refuse(403, kTooLittle) : watch(query_value(target, "run"));
  if (is_post) co_return refuse(404, "there is nothing to post to");
  if (path == std::string("/batch/") + kReportFile) co_return report();
  if (path != "/batch/status") co_return refuse(404, "there is no such page");
  co_await refresh();
  co_return status(role);
}

// The status is that of a second ago if somebody has just asked.
asio::awaitable<void> BatchDoor::refresh() {
  const auto now = std::chrono::steady_clock::now();
  if (is_reading_ || now - read_ < kFresh) co_return;
  is_reading_ = true;
  std::string text;
  int ended = -1;
  if (Result<ChildProgram> program =
          ChildProgram::start({"simbatch", "status", folder_}, ChildProgram::Reads::everything)) {
    asio::posix::stream_descriptor output(loop_, program->output().release());
    for (;;) {
      const std::string more = co_await read_some(output);
      if (more.empty() || text.size() > kLongestStatus) break;
      text += more;
    }
    output.close();
    ended = program->wait();
  }
  json status = read_json(text);
  fault_ = ended == 0 && status.is_object() ? "" : text.empty() ? "simbatch says nothing" : text;
  if (fault_.empty()) status_ = std::move(status);
  read_ = std::chrono::steady_clock::now();
  is_reading_ = false;
}

// Only whoever may begin a run learns the address of its page, which has that role.
BatchDoor::Reply BatchDoor::status(Role role) const {
  json all = status_;
  all["error"] = fault_;
  all["refusal"] = role < kWatches ? kTooLittle : "";
  all["report"] = std::filesystem::exists(std::filesystem::path(folder_) / kReportFile);
  if (watched_)
    all["watched"] = {{"name", watched_->name},
                      {"address", role < kWatches ? "" : watched_->address},
                      {"said", role < kWatches ? without_addresses(watched_->said) : watched_->said},
                      {"ended", watched_->ended}};
  return {200, text_of(all)};
}

BatchDoor::Reply BatchDoor::report() const {
  std::ifstream file(std::filesystem::path(folder_) / kReportFile, std::ios::binary);
  if (!file) return refuse(404, "there is no report yet; simbatch makes it in the end");
  return {200, std::string(std::istreambuf_iterator<char>(file), {}), true};
}

// Returns null if there is none.
json BatchDoor::failed_run(const std::string& number) const {
  for (const json& run : status_.value("failed", json::array()))
    if (run.contains("run") && run["run"].dump() == number) return run;
  return nullptr;
}

// The command is that of simbatch, whose words are quoted for a shell.
BatchDoor::Reply BatchDoor::watch(const std::string& number) {
  const json run = failed_run(number);
  if (!run.contains("watch")) return refuse(404, "there is no such failed run");
  watched_.reset();  // a system of its name cannot run twice
  const std::string name = run.value("variant", "") + " in " + run.value("world", "") + ", seed " +
                           std::to_string(run.value("seed", std::uint64_t{0}));
  const std::string folder = std::filesystem::path(status_.value("file", "")).parent_path().string();
  Result<ChildProgram> program = ChildProgram::start({"/bin/sh", "-c", "exec " + run.value("watch", "")},
                                                     ChildProgram::Reads::everything, folder);
  if (!program) return refuse(500, program.error().text());
  auto next = std::make_shared<Watched>(loop_, name, std::move(program).value());
  watched_ = next;
  asio::co_spawn(loop_, follow(std::move(next)), asio::detached);
  return {200, text_of({{"error", ""}})};
}

asio::awaitable<void> BatchDoor::follow(std::shared_ptr<Watched> watched) {
  const std::weak_ptr<Watched> whether_wanted = watched;
  watched.reset();
  std::string all;
  for (;;) {
    asio::posix::stream_descriptor* output = nullptr;
    if (const auto still = whether_wanted.lock()) output = &still->output;
    if (output == nullptr) co_return;
    const std::string more = co_await read_some(*output);
    const auto still = whether_wanted.lock();
    if (!still) co_return;
    if (more.empty()) co_return still->ended = still->program.wait(), void();
    still->said += more;
    if (still->address.empty()) still->address = address_in(still->said);
    if (still->said.size() > kLongestSaid) still->said.erase(0, still->said.size() - kLongestSaid);
  }
}

}  // namespace orca::view
