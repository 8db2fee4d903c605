// SPDX-License-Identifier: GPL-3.0-or-later
#include "doors/listening.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>

#include "orca/keys/server_certificate.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::view;
using Catch::Contains;
using keys::own_server_certificate;
using keys::read_server_certificate;
using orca::test::TempFolder;

namespace {

constexpr std::int64_t kDay = 86'400;
constexpr std::int64_t kNow = 1'800'000'000;
const std::vector<std::string> kNames{"10.0.0.7", "[fd00::7]", "robot"};

// Writes a file of the user alone.
std::string write_own(const TempFolder& folder, const std::string& name, const std::string& text) {
  std::string path = folder.write(name, text);
  REQUIRE(chmod(path.c_str(), 0600) == 0);
  return path;
}

}  // namespace

TEST_CASE("an address to listen at has a port or none", "[view]") {
  struct Case {
    const char* text;
    const char* address;
    int port;  // -1: none
  };
  for (const Case& each :
       {Case{"10.0.0.7", "10.0.0.7", -1}, Case{"10.0.0.7:8443", "10.0.0.7", 8443},
        Case{"0.0.0.0:0", "0.0.0.0", 0}, Case{"::", "::", -1}, Case{"fd00::7", "fd00::7", -1},
        Case{"[fd00::7]", "fd00::7", -1}, Case{"[fd00::7]:1", "fd00::7", 1}}) {
    INFO(each.text);
    const auto read = parse_listening(each.text);
    REQUIRE(read);
    CHECK(read->address.to_string() == each.address);
    CHECK((read->port ? *read->port : -1) == each.port);
  }
  for (const char* const text : {"", ":8443", "robot:8443", "10.0.0.7:", "10.0.0.7:x", "10.0.0.7:65536",
                                 "10.0.0:1", "10.0.0.7:-1", "[fd00::7]:", "[fd00::7", "10.0.0.7:84 ", "*"}) {
    INFO(text);
    const auto read = parse_listening(text);
    REQUIRE_FALSE(read);
    CHECK(read.error().code == Code::invalid_argument);
  }
}

TEST_CASE("a server is called by its address first, and never by loopback where it listens at all",
          "[view]") {
  CHECK(names_at(boost::asio::ip::make_address("10.0.0.7")).front() == "10.0.0.7");
  CHECK(names_at(boost::asio::ip::make_address("fd00::7")).front() == "[fd00::7]");
  for (const char* const all : {"0.0.0.0", "::"}) {
    const auto names = names_at(boost::asio::ip::make_address(all));
    CHECK_FALSE(names.empty());
    for (const std::string& name : names) {
      CHECK_FALSE(name.starts_with("127."));
      CHECK(name != all);
    }
  }
}

TEST_CASE("a server's own certificate is kept, and made anew before it ends or if it lacks a name",
          "[view]") {
  const TempFolder temp;
  const std::string folder = temp.file("orcaview");
  const auto first = own_server_certificate(folder, kNames, kNow);
  REQUIRE(first);
  CHECK(first->names == kNames);
  CHECK(first->fingerprint.size() == 95);
  struct stat file {};
  REQUIRE(stat((folder + "/certificate.pem").c_str(), &file) == 0);
  CHECK((file.st_mode & 0777U) == 0600U);

  CHECK(own_server_certificate(folder, kNames, kNow + 300 * kDay)->fingerprint == first->fingerprint);
  CHECK(own_server_certificate(folder, {"robot"}, kNow)->fingerprint == first->fingerprint);
  const auto renewed = own_server_certificate(folder, kNames, kNow + 340 * kDay);
  REQUIRE(renewed);
  CHECK(renewed->fingerprint != first->fingerprint);
  const auto early = own_server_certificate(folder, kNames, kNow);  // the clock was wrong before
  REQUIRE(early);
  CHECK(early->fingerprint != renewed->fingerprint);
  const auto moved = own_server_certificate(folder, {"10.0.0.8"}, kNow);
  REQUIRE(moved);
  CHECK(moved->names == std::vector<std::string>{"10.0.0.8"});
}

TEST_CASE("a file of a certificate is proven before it is used", "[view]") {
  const TempFolder temp;
  const std::string folder = temp.file("orcaview");
  const auto one = own_server_certificate(folder, kNames, kNow);
  const auto other = own_server_certificate(temp.file("other"), kNames, kNow);
  REQUIRE(one);
  REQUIRE(other);
  const std::string good = write_own(temp, "good.pem", one->chain + other->chain + one->key);
  const auto read = read_server_certificate(good, kNow);
  REQUIRE(read);
  CHECK(read->fingerprint == one->fingerprint);
  CHECK(read->chain == one->chain + other->chain);
  CHECK_FALSE(read->chain.find("KEY") != std::string::npos);

  CHECK(read_server_certificate(good, kNow - kDay).error().code == Code::failed_precondition);
  CHECK_THAT(read_server_certificate(good, kNow + 366 * kDay).error().text(), Contains("expired"));
  CHECK(read_server_certificate(temp.file("none.pem"), kNow).error().code == Code::not_found);
  const auto wrong = [&](const std::string& text) {
    return read_server_certificate(write_own(temp, "wrong.pem", text), kNow).error().text();
  };
  CHECK_THAT(wrong(one->chain + other->key), Contains("not that of its first certificate"));
  CHECK_THAT(wrong(other->chain + one->chain + one->key), Contains("not that of its first certificate"));
  CHECK_THAT(wrong(one->chain), Contains("no private key"));
  CHECK_THAT(wrong(one->key), Contains("no certificate"));
  CHECK_THAT(wrong(""), Contains("no private key"));
  CHECK_THAT(wrong(one->key.substr(0, 100) + one->chain), Contains("no private key"));
  REQUIRE(chmod(good.c_str(), 0640) == 0);
  CHECK_THAT(read_server_certificate(good, kNow).error().text(), Contains("can be used by others"));

  // What is wrong with a certificate of its own is said, not mended without a word.
  write_own(temp, "orcaview/certificate.pem", "nonsense");
  CHECK_THAT(own_server_certificate(folder, kNames, kNow).error().text(), Contains("remove it"));
}

// OpenSSL asks at the terminal, and without one at the standard input: the child has only that.
TEST_CASE("nobody is asked for the password of a certificate's file", "[view]") {
  const TempFolder temp;
  const auto one = own_server_certificate(temp.file("orcaview"), kNames, kNow);
  REQUIRE(one);
  std::string locked = one->chain;
  locked.insert(locked.find('\n') + 1,
                "Proc-Type: 4,ENCRYPTED\nDEK-Info: AES-128-CBC,000102030405060708090A0B0C0D0E0F\n\n");
  const std::string file = write_own(temp, "locked.pem", one->key + locked);
  int input[2];
  REQUIRE(pipe(input) == 0);
  const pid_t child = fork();
  if (child == 0) {
    char first = 0;
    setsid();
    dup2(input[0], STDIN_FILENO);
    const bool is_refused = !read_server_certificate(file, kNow);
    _exit(is_refused && read(STDIN_FILENO, &first, 1) == 1 && first == 'a' ? 0 : 1);
  }
  REQUIRE(write(input[1], "a password\n", 11) == 11);
  int status = -1;
  REQUIRE(waitpid(child, &status, 0) == child);
  close(input[0]), close(input[1]);
  CHECK(status == 0);
}
