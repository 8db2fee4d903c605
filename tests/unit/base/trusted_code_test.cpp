// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/files/trusted_code.hpp"

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "temp_folder.hpp"

using namespace orca;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

constexpr uid_t kStranger = 65534;

// A folder of this user alone with a file below two folders.
class CodePlace {
 public:
  CodePlace() {
    fs::create_directories(inner());
    chmod(outer().c_str(), 0755);
    chmod(inner().c_str(), 0755);
    (void)root_.write("outer/inner/plugin.so", "bytes");
    chmod(file().c_str(), 0755);
  }
  [[nodiscard]] fs::path root() const { return root_.path(); }
  [[nodiscard]] fs::path outer() const { return root() / "outer"; }
  [[nodiscard]] fs::path inner() const { return outer() / "inner"; }
  [[nodiscard]] std::string file() const { return (inner() / "plugin.so").string(); }

 private:
  const orca::test::TempFolder root_;
};

std::string why_not(const std::string& file) {
  const Status trusted = check_trusted_code(file);
  REQUIRE_FALSE(trusted.ok());
  CHECK(trusted.error().code == Code::failed_precondition);
  return trusted.error().message;
}

}  // namespace

TEST_CASE("code that only this user and root can write is trusted", "[base][trusted_code]") {
  const CodePlace code;
  CHECK(check_trusted_code(code.file()).ok());
  CHECK(check_trusted_code("/bin/sh").ok());
  CHECK(check_trusted_code((code.inner() / "none.so").string()).error().code == Code::not_found);
}

TEST_CASE("code that everybody can write is not trusted, and the error names the remedy",
          "[base][trusted_code]") {
  const CodePlace code;
  for (const std::string& path : {code.file(), code.inner().string(), code.outer().string()}) {
    CAPTURE(path);
    REQUIRE(chmod(path.c_str(), 0777) == 0);
    CHECK_THAT(why_not(code.file()), Contains(path + " can be written to by everybody") &&
                                         Contains("run: chmod go-w ") && Contains(path));
    REQUIRE(chmod(path.c_str(), 0755) == 0);
    CHECK(check_trusted_code(code.file()).ok());
  }
}

TEST_CASE("a folder in which each keeps what is theirs may be open to all, a file may not",
          "[base][trusted_code]") {
  const CodePlace code;
  REQUIRE(chmod(code.outer().c_str(), 01777) == 0);
  CHECK(check_trusted_code(code.file()).ok());
  REQUIRE(chmod(code.file().c_str(), 01777) == 0);
  CHECK_THAT(why_not(code.file()), Contains("everybody"));
}

TEST_CASE("a link is no way to code that others can write", "[base][trusted_code]") {
  const CodePlace code;
  const fs::path link = code.root() / "link.so";
  fs::create_symlink(code.file(), link);
  CHECK(check_trusted_code(link.string()).ok());
  REQUIRE(chmod(code.outer().c_str(), 0777) == 0);
  CHECK_THAT(why_not(link.string()), Contains(code.outer().string() + " can be written"));
}

TEST_CASE("a group may write only if it is the owner's own", "[base][trusted_code]") {
  const CodePlace code;
  REQUIRE(chmod(code.file().c_str(), 0775) == 0);
  const passwd* const self = getpwuid(geteuid());
  const group* const own = self == nullptr ? nullptr : getgrgid(self->pw_gid);
  const bool is_private =
      own != nullptr && std::string(own->gr_name) == self->pw_name && *own->gr_mem == nullptr;
  if (is_private) {
    REQUIRE(chown(code.file().c_str(), geteuid(), own->gr_gid) == 0);
    CHECK(check_trusted_code(code.file()).ok());
  }
  if (geteuid() != 0) {
    WARN("only root can give a file to another group");
    return;
  }
  REQUIRE(chown(code.file().c_str(), 0, kStranger) == 0);
  CHECK_THAT(why_not(code.file()), Contains("by group 65534") && Contains("chmod g-w"));
}

TEST_CASE("code of another user is not trusted", "[base][trusted_code]") {
  if (geteuid() != 0) {
    WARN("only root can give a file to another user");
    return;
  }
  const CodePlace code;
  for (const std::string& path : {code.file(), code.inner().string(), code.outer().string()}) {
    CAPTURE(path);
    REQUIRE(chown(path.c_str(), kStranger, kStranger) == 0);
    CHECK_THAT(why_not(code.file()), Contains(path + " belongs to user 65534") && Contains("sudo chown 0 "));
    REQUIRE(chown(path.c_str(), 0, 0) == 0);
  }
}
