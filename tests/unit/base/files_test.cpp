// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "orca/base/files/kept_file.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/base/input_file.hpp"
#include "orca/base/output_file.hpp"
#include "temp_folder.hpp"

using namespace orca;
using Catch::Contains;
using orca::test::TempFolder;

namespace {

constexpr std::size_t kPlenty = 1'000'000;

void put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

std::string content(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string make_pipe(const std::string& path) {
  REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  return path;
}

// Closes standard input for its lifetime, as a program is started by some supervisors: the next file that is
// opened gets the descriptor 0.
class WithoutStandardInput {
 public:
  WithoutStandardInput() : kept_(dup(STDIN_FILENO)) { close(STDIN_FILENO); }
  ~WithoutStandardInput() {
    dup2(kept_, STDIN_FILENO);
    close(kept_);
  }
  WithoutStandardInput(const WithoutStandardInput&) = delete;
  WithoutStandardInput& operator=(const WithoutStandardInput&) = delete;

 private:
  const int kept_;
};

bool is_open(int fd) { return fcntl(fd, F_GETFD) >= 0; }

std::string refusal(const std::string& path) {
  OutputFile file("the report");
  const Status opened = file.open(path);
  REQUIRE_FALSE(opened.ok());
  return opened.error().text();
}

}  // namespace

TEST_CASE("an input file is read whole, or up to the limit", "[base][files]") {
  const TempFolder folder;
  put(folder.file("a"), std::string(200'000, 'x'));
  CHECK(read_input_file(folder.file("a"), kPlenty).value().size() == 200'000);
  CHECK(read_input_file(folder.file("a"), 70'000).value().size() == 70'000);
}

TEST_CASE("what cannot be read is an error with the system's reason", "[base][files]") {
  const TempFolder folder;
  const auto missing = read_input_file(folder.file("a"), kPlenty);
  REQUIRE_FALSE(missing);
  CHECK(missing.error().code == Code::not_found);
  CHECK(missing.error().message == "No such file or directory");
  const auto is_folder = read_input_file(folder.file(""), kPlenty);
  REQUIRE_FALSE(is_folder);
  CHECK(is_folder.error().message == "Is a directory");
}

TEST_CASE("a pipe that nobody writes to is an error at once, not a wait", "[base][files]") {
  const TempFolder folder;
  const auto read = read_input_file(make_pipe(folder.file("pipe")), kPlenty);
  REQUIRE_FALSE(read);
  CHECK_THAT(read.error().message, Contains("nobody writes"));
}

TEST_CASE("a pipe is read until its writer closes it", "[base][files]") {
  int fds[2];
  REQUIRE(pipe(fds) == 0);
  std::thread writer([end = fds[1]] {
    for (const char c : {'a', 'b'}) {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      if (write(end, &c, 1) != 1) break;
    }
    close(end);
  });
  const auto read = read_input_file("/dev/fd/" + std::to_string(fds[0]), kPlenty);
  writer.join();
  close(fds[0]);
  REQUIRE(read);
  CHECK(*read == "ab");
}

TEST_CASE("a pipe that its writer holds open is given up after 5 s", "[base][files]") {
  int fds[2];
  REQUIRE(pipe(fds) == 0);
  const auto start = std::chrono::steady_clock::now();
  const auto read = read_input_file("/dev/fd/" + std::to_string(fds[0]), kPlenty);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(7));
  REQUIRE_FALSE(read);
  CHECK(read.error().code == Code::deadline_exceeded);
  for (const int fd : fds) close(fd);
}

TEST_CASE("an output file replaces the old text and keeps long texts whole", "[base][files]") {
  const TempFolder folder;
  put(folder.file("a"), "an old text");
  OutputFile file("the report");
  REQUIRE(file.open(folder.file("a")).ok());
  CHECK(content(folder.file("a")) == "an old text");
  std::string all;
  for (int i = 0; i < 30'000; ++i) {
    const std::string line = std::to_string(i) + "\n";
    file.write(line);
    all += line;
  }
  REQUIRE(file.close().ok());
  CHECK(content(folder.file("a")) == all);
}

TEST_CASE("without a text, an old file stays as it is and a new one is removed", "[base][files]") {
  const TempFolder folder;
  put(folder.file("old"), "an old text");
  for (const char* name : {"old", "new"}) {
    OutputFile file("the report");
    REQUIRE(file.open(folder.file(name)).ok());
    REQUIRE(file.close().ok());
  }
  CHECK(content(folder.file("old")) == "an old text");
  CHECK_FALSE(std::filesystem::exists(folder.file("new")));
}

TEST_CASE("a device that is full is an error when the file is closed, with the reason", "[base][files]") {
  OutputFile file("the report");
  REQUIRE(file.open("/dev/full").ok());
  file.write("text");
  const Status closed = file.close();
  REQUIRE_FALSE(closed.ok());
  CHECK(closed.error().text() == "/dev/full: cannot write the report: No space left on device");
}

TEST_CASE("a first failure in the middle is not forgotten", "[base][files]") {
  OutputFile file("the report");
  REQUIRE(file.open("/dev/full").ok());
  for (int i = 0; i < 3; ++i) file.write(std::string(70'000, 'x'));
  CHECK_FALSE(file.close().ok());
}

TEST_CASE("where standard input is closed, a file is read through descriptor 0 as through any other",
          "[base][files]") {
  const TempFolder folder;
  put(folder.file("a"), "text");
  const WithoutStandardInput without;
  const auto read = read_input_file(folder.file("a"), kPlenty);
  const bool left_open = is_open(STDIN_FILENO);
  REQUIRE(read);
  CHECK(*read == "text");
  CHECK_FALSE(left_open);
}

TEST_CASE("where standard input is closed, a file is written through descriptor 0 as through any other",
          "[base][files]") {
  const TempFolder folder;
  const WithoutStandardInput without;
  OutputFile file("the report");
  REQUIRE(file.open(folder.file("a")).ok());
  CHECK(is_open(STDIN_FILENO));
  file.write("text");
  CHECK(file.close().ok());
  CHECK_FALSE(is_open(STDIN_FILENO));
  CHECK(content(folder.file("a")) == "text");
  OutputFile unused("the report");
  REQUIRE(unused.open(folder.file("b")).ok());
  CHECK(unused.close().ok());
  CHECK_FALSE(std::filesystem::exists(folder.file("b")));
}

TEST_CASE("an output file that cannot be opened says why", "[base][files]") {
  const TempFolder folder;
  CHECK_THAT(refusal(folder.file("no/such")), Contains("cannot write the report: No such file or directory"));
  CHECK_THAT(refusal(folder.file("")), Contains("Is a directory"));
  CHECK_THAT(refusal(make_pipe(folder.file("pipe"))), Contains("nobody reads this pipe"));
}

TEST_CASE("an output file overwrites no input, by whatever name", "[base][files]") {
  const TempFolder folder;
  put(folder.file("input"), "precious");
  REQUIRE(read_input_file(folder.file("input"), kPlenty));
  std::filesystem::create_symlink("input", folder.file("link"));
  std::filesystem::create_hard_link(folder.file("input"), folder.file("twin"));
  for (const char* name : {"input", "link", "twin"})
    CHECK_THAT(refusal(folder.file(name)), Contains("the report would overwrite a file that has been read"));
  CHECK(content(folder.file("input")) == "precious");
  CHECK(has_been_read(folder.file("link")));
  CHECK_FALSE(has_been_read(folder.file("other")));
}

TEST_CASE("a file that will be read later is no output either", "[base][files]") {
  const TempFolder folder;
  put(folder.file("later"), "precious");
  remember_input_file(folder.file("later"));
  CHECK_THAT(refusal(folder.file("later")), Contains("would overwrite a file that the graph names"));
  CHECK_FALSE(has_been_read(folder.file("later")));
}

TEST_CASE("what was read and what will be read are known inputs, each once and without links",
          "[base][files]") {
  const TempFolder folder;
  put(folder.file("input"), "x");
  std::filesystem::create_symlink("input", folder.file("link"));
  for (const char* name : {"link", "input"}) REQUIRE(read_input_file(folder.file(name), kPlenty));
  remember_input_file(folder.file("later"));
  const std::vector<std::string> known = known_input_files();
  CHECK(std::ranges::count(known, std::filesystem::canonical(folder.file("input")).string()) == 1);
  CHECK(std::ranges::count(known, (std::filesystem::canonical(folder.path()) / "later").string()) == 1);
  CHECK(std::ranges::count(known, folder.file("link")) == 0);
  CHECK(std::ranges::is_sorted(known));
}

TEST_CASE("an input that was replaced stays protected, the old one's place on the disk does not",
          "[base][files]") {
  const TempFolder folder;
  put(folder.file("input"), "old");
  REQUIRE(read_input_file(folder.file("input"), kPlenty));
  std::filesystem::rename(folder.file("input"), folder.file("moved"));
  put(folder.file("input"), "new");
  CHECK_THAT(refusal(folder.file("input")), Contains("would overwrite"));
  OutputFile file("the report");
  CHECK(file.open(folder.file("moved")).ok());
}

TEST_CASE("two output files at once are two files", "[base][files]") {
  const TempFolder folder;
  OutputFile first("the trace");
  REQUIRE(first.open(folder.file("a")).ok());
  CHECK_THAT(refusal(folder.file("a")), Contains("the report would overwrite the trace"));
  first.write("text");
  REQUIRE(first.close().ok());
  OutputFile second("the report");
  CHECK(second.open(folder.file("a")).ok());
}

namespace {

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

TEST_CASE("a kept file returns what was written last, and keeps what was there before if that is wanted",
          "[base][files]") {
  const TempFolder folder;
  const KeptFile file(folder.file("kept"), "thing", true);
  const auto kept_in = [](const KeptFile& one) { return one.read().value().value(); };
  CHECK_FALSE(file.read().value().has_value());
  const auto first = bytes_of(std::string("one\n\0two", 8));
  REQUIRE(file.write(first).ok());
  CHECK(kept_in(file) == first);
  CHECK_FALSE(std::filesystem::exists(folder.file("kept.old")));
  put(folder.file("kept.new"), "of a run that was killed");
  REQUIRE(file.write({}).ok());
  CHECK(kept_in(file).empty());
  CHECK(kept_in(KeptFile(folder.file("kept.old"), "thing")) == first);
  CHECK_FALSE(std::filesystem::exists(folder.file("kept.new")));
}

TEST_CASE("a kept file that is damaged, or of another kind, is refused", "[base][files]") {
  const TempFolder folder;
  const KeptFile file(folder.file("kept"), "thing");
  REQUIRE(file.write(bytes_of("what is kept")).ok());
  CHECK_THAT(KeptFile(folder.file("kept"), "other").read().error().message, Contains("keeps a other"));
  const std::string whole = content(folder.file("kept"));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    put(folder.file("kept"), whole.substr(0, length));
    CHECK(file.read().error().code == Code::data_loss);
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string spoilt = whole;
    spoilt[i] = static_cast<char>(spoilt[i] ^ 1);
    put(folder.file("kept"), spoilt);
    CHECK(file.read().error().code == Code::data_loss);
  }
}

TEST_CASE("where a kept file cannot be written, what was kept is still there", "[base][files]") {
  const TempFolder folder;
  const KeptFile file(folder.file("kept"), "thing");
  const auto before = bytes_of("before");
  REQUIRE(file.write(before).ok());
  REQUIRE(mkdir(folder.file("kept.new").c_str(), 0700) == 0);  // where the draft would be
  CHECK(file.write(bytes_of("after")).error().code == Code::unavailable);
  CHECK(file.read().value() == before);
}

TEST_CASE("a file that a user names goes before Orca's own of that name", "[base][files]") {
  const TempFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const std::string own = own_file("web/index.html");
  CHECK(std::filesystem::exists(own));
  CHECK(or_own_file("web/index.html") == own);
  CHECK(or_own_file("web/missing.html") == "web/missing.html");
  std::filesystem::create_directory("web");
  put("web/index.html", "");
  CHECK(or_own_file("web/index.html") == "web/index.html");
  CHECK(or_own_file(folder.file("web/index.html")) == folder.file("web/index.html"));
  std::filesystem::current_path(before);
}
