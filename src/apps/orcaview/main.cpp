// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "common/command_line.hpp"
#include "common/manual.hpp"
#include "common/output.hpp"
#include "doors/listening.hpp"
#include "orca/base/files/own_folder.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/base/text.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "replay/playback.hpp"
#include "tapping/object_learning.hpp"
#include "view_server.hpp"

// after view_server.hpp, which includes what Boost.Asio lacks
#include <boost/asio/signal_set.hpp>

namespace orca::view {
namespace {

constexpr std::string_view kDetails =
    "  orcaview                              of the system that runs\n"
    "  orcaview scout_goto                   of this one, as soon as it runs\n"
    "  deployer graphs/scout_goto.xml --view starts one beside the system\n"
    "  orcaview --batch office.batch         how far simbatch is, its report, and its failed runs\n"
    "  orcaview run.mcap                     of a recording, which is played\n"
    "\n"
    "Open the first address that it prints in a browser. Whoever knows it may change everything; with the "
    "second\n"
    "one, people may operate the robot, with the third one only observe it. All hold until orcaview ends. "
    "They are also\n"
    "in the file GRAPH.PORT.view beside the system's socket, which only you can read. If orcaview ends, "
    "nothing else notices.\n"
    "\n"
    "With --listen there are three more addresses, for other machines, and the SHA-256 of the certificate: "
    "compare it\n"
    "with the one that the browser shows when it warns of a certificate that it does not know.\n";

const apps::Program& program() {
  static const apps::Program all{
      .name = "orcaview",
      .usage = "[SYSTEM] [options]",
      .text = "a page in the browser that shows a running system, and commands it",
      .details = kDetails,
      .arguments = {{"SYSTEM|FILE.mcap", apps::Names::system, true}},
      .options = {{"--port", "N", "of the address (default: 8080, or any that is free if somebody has it)",
                   false, "Options", 0, 65535},
                  {"--listen", "ADDRESS[:PORT]",
                   "also an address for other machines, encrypted by TLS; 0.0.0.0: all of this machine "
                   "(port: 8443, or any that is free if somebody has it)"},
                  {"--tls", "DIR",
                   "folder with certificate.pem, which holds certificate and key for --listen (default: one "
                   "of its own, "
                   "which it makes once)"},
                  {"--system", "NAME", "the same as SYSTEM"},
                  {"--batch", "DIR", "show a folder of simbatch, and no system"},
                  {"--plugins", "FOLDER",
                   "where the libraries of object types of a recording lie that are not Orca's own", true},
                  {"--web", "FOLDER", "the page's files (default: those that came with orcaview)"}},
      .exits = {"0 ended by a signal",
                "1 the address is in use, or the page's files or the certificate are missing",
                "2 the command line is wrong", "3 no system runs, and none is named"},
      .notes =
          "\nSYSTEM is the name of a graph, or a recording. It need not run yet; when it ends, the page "
          "waits for the next "
          "one.\n"};
  return all;
}

enum class ExitCode { ended = 0, refused = 1, usage = 2, no_system = 3 };

ExitCode report(const Error& error, ExitCode code) {
  std::fprintf(stderr, "orcaview: %s\n", error.text().c_str());
  return code;
}

// Returns the name of the system to show, or the exit status after a report.
std::variant<std::string, ExitCode> system_of(const apps::Call& call) {
  if (!call.words.empty()) return call.words.front();
  if (const auto name = call.text("--system")) return *name;
  const Result<std::vector<std::string>> running = supervisor::running_systems();
  if (!running) return report(running.error(), ExitCode::no_system);
  if (running->size() == 1) return running->front();
  if (running->empty())
    return report(
        fail(Code::not_found,
             "no system runs; start one with deployer, or name the one to wait for: orcaview SYSTEM"),
        ExitCode::no_system);
  return report(fail(Code::invalid_argument, "several systems run: " + listed(*running) +
                                                 "; choose one: orcaview " + running->front()),
                ExitCode::usage);
}

std::string web_folder(const apps::Call& call) {
  const std::optional<std::string> folder = call.text("--web");
  return folder ? *folder : own_file("web");
}

// The addresses, in a file that only this user can read.
class AddressFile {
 public:
  static Result<AddressFile> write(const std::string& name, const std::string& text) {
    const Result<OwnFolder> folder = OwnFolder::make();
    if (!folder) return folder.error();
    const std::string path = folder->path() + "/" + name;
    constexpr mode_t kOwnersOnly = 0600;
    ::unlink(path.c_str());
    const Descriptor file(
        ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, kOwnersOnly));
    if (!file || ::write(file.number(), text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      return fail(Code::unavailable, "cannot write the addresses to " + path);
    return AddressFile(path);
  }
  AddressFile(AddressFile&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  AddressFile& operator=(AddressFile&&) = delete;
  ~AddressFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }

 private:
  explicit AddressFile(std::string path) : path_(std::move(path)) {}
  std::string path_;
};

// Returns the addresses of a page, a line for each role.
std::string addresses_of(const std::string& server, const Tokens& tokens, const std::string& page) {
  std::string lines;
  for (const Role role : Tokens::kRoles) lines += server + page + "#token=" + tokens.of(role) + "\n";
  return lines;
}

// Listens for other machines if that is wished, and returns what to print of it.
std::variant<std::string, ExitCode> listen_far(const apps::Call& call, ViewServer& server,
                                               const Tokens& tokens, const std::string& page) {
  const std::optional<std::string> wish = call.text("--listen");
  const std::optional<std::string> folder = call.text("--tls");
  if (!wish && !folder) return std::string();
  if (!wish) return report(fail(Code::invalid_argument, "--tls is for --listen ADDRESS"), ExitCode::usage);
  const Result<Listening> there = parse_listening(*wish);
  if (!there) return report(there.error(), ExitCode::usage);
  const Result<keys::ServerCertificate> certificate = certificate_for(*there, folder);
  if (!certificate) return report(certificate.error(), ExitCode::refused);
  if (const Status listens = server.listen(*there, *certificate); !listens.ok())
    return report(listens.error(), ExitCode::refused);
  return addresses_of(server.far_address(), tokens, page) +
         "SHA-256 of the certificate: " + certificate->fingerprint + "\n";
}

/// The event loop. What waits in it - connections, above all - uses the desk and the server, so it goes before they do.
class Loop final : public boost::asio::io_context {
 public:
  Loop() : io_context(1) {}
  /// Drops all that waits.
  void clear() { shutdown(); }
};

// A lack of memory or descriptors ends what needs them; everything else goes on.
void run_contained(Loop& loop) {
  try {
    loop.run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "orcaview: %s\n", error.what());
  }
}

// Listens, says where, and serves until a signal.
ExitCode serve(
    const apps::Call& call, const std::string& name, const std::string& page, Loop& loop, ViewServer& server,
    const Tokens& tokens, const std::function<void()>& begin, const std::function<void()>& end = [] {}) {
  constexpr std::uint16_t kDefaultPort = 8080;
  const std::optional<std::uint64_t> wanted = call.count("--port");
  Status listens = server.listen(wanted ? static_cast<std::uint16_t>(*wanted) : kDefaultPort);
  if (!wanted && !listens.ok()) listens = server.listen(0);
  if (!listens.ok()) return report(listens.error(), ExitCode::refused);
  const std::variant<std::string, ExitCode> far = listen_far(call, server, tokens, page);
  if (const auto* const code = std::get_if<ExitCode>(&far)) return *code;
  const std::string addresses =
      addresses_of("http://127.0.0.1:" + std::to_string(server.port()) + "/", tokens, page) +
      std::get<std::string>(far);
  const Result<AddressFile> file =
      AddressFile::write(name + "." + std::to_string(server.port()) + ".view", addresses);
  if (!file) return report(file.error(), ExitCode::refused);
  // Before anybody reads the addresses, who may end it at once.
  boost::asio::signal_set stops(loop, SIGINT, SIGTERM);
  stops.async_wait([&](const boost::system::error_code&, int) { loop.stop(); });
  std::printf("%s", addresses.c_str());
  std::fflush(stdout);

  begin();
  while (!loop.stopped()) run_contained(loop);
  end();
  loop.clear();
  return ExitCode::ended;
}

bool is_recording(const std::string& word) { return word.ends_with(".mcap"); }

ExitCode show_recording(const apps::Call& call, const Tokens& tokens, const WebFiles& files) {
  orcactl::learn_objects_in_folders(call);
  Result<RecordedSystem> recording = RecordedSystem::open(call.words.front());
  if (!recording)
    return report(recording.error(),
                  recording.error().code == Code::invalid_argument ? ExitCode::usage : ExitCode::refused);
  const std::string name = recording->name();
  Loop loop;
  std::optional<Playback> playback;
  Desk desk(
      loop.get_executor(), name, [&] { return playback->connect(); }, true);
  playback.emplace(loop.get_executor(), *std::move(recording), [&desk] { desk.begin_anew(); });
  ViewServer server(loop, tokens, files);
  server.show(desk);
  return serve(
      call, name, "", loop, server, tokens, [&] { desk.start(); }, [&] { playback.reset(); });
}

ExitCode show_system(const apps::Call& call, const Tokens& tokens, const WebFiles& files) {
  const std::variant<std::string, ExitCode> system = system_of(call);
  if (const auto* const code = std::get_if<ExitCode>(&system)) return *code;
  const std::string& name = std::get<std::string>(system);
  Loop loop;
  Desk desk(
      loop.get_executor(), name,
      [&name] {
        if (Result<Descriptor> asked = supervisor::connect_to_system(name))
          orcactl::learn_objects(std::move(asked).value());
        return supervisor::connect_to_system(name);
      },
      false);
  ViewServer server(loop, tokens, files);
  server.show(desk);
  return serve(call, name, "", loop, server, tokens, [&] { desk.start(); });
}

ExitCode show_batch(const apps::Call& call, const Tokens& tokens, const WebFiles& files) {
  const std::filesystem::path folder =
      std::filesystem::absolute(call.text("--batch").value_or("")).lexically_normal();
  if (!std::filesystem::exists(folder / "results.sqlite"))
    return report(fail(Code::not_found, "there are no results of simbatch", folder.string()),
                  ExitCode::refused);
  Loop loop;
  BatchDoor batch(loop.get_executor(), folder.string());
  ViewServer server(loop, tokens, files);
  server.show(batch);
  return serve(call, "batch", "batch.html", loop, server, tokens, [] {});
}

ExitCode run(const apps::Call& call) {
  if (!call.words.empty() && call.has("--system"))
    return report(fail(Code::invalid_argument, "two systems are named: " + call.words.front() +
                                                   " and --system " + *call.text("--system")),
                  ExitCode::usage);
  const WebFiles files(web_folder(call));
  if (!files.find("/"))
    return report(fail(Code::not_found, "the page's files are missing: " + web_folder(call) +
                                            "/index.html; name their folder with --web"),
                  ExitCode::refused);
  const Result<Tokens> tokens = Tokens::draw();
  if (!tokens) return report(tokens.error(), ExitCode::refused);
  if (!call.words.empty() && is_recording(call.words.front())) return show_recording(call, *tokens, files);
  return call.has("--batch") ? show_batch(call, *tokens, files) : show_system(call, *tokens, files);
}

ExitCode act(const std::vector<std::string>& words) {
  const apps::Call call = apps::parse(program(), words);
  if (!call.problems.empty())
    return report(fail(Code::invalid_argument, call.problems.front().message), ExitCode::usage);
  const std::optional<std::string> answer = apps::answer(program(), call);
  if (!answer) return run(call);
  std::fputs(answer->c_str(), stdout);
  return ExitCode::ended;
}

}  // namespace
}  // namespace orca::view

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  return static_cast<int>(orca::view::act({argv + 1, argv + argc}));
}
