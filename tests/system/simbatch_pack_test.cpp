// SPDX-License-Identifier: GPL-3.0-or-later
// Archives of batches: they repeat elsewhere to the last byte, and what is damaged or evil in them is named before anything runs.
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <string>

#include "batches.hpp"
#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

// Runs a shell's commands in a folder.
Run in_folder(const fs::path& folder, const std::string& commands) {
  Subprocess program(Words{"/bin/sh", "-ec", "cd \"$1\"; " + commands, "sh", folder.string()});
  return finish(program, Seconds(120));
}

const std::string kProgram = ORCA_BINARY_DIR "/bin/simbatch";

// A copy of what an experiment reads, with one that drives through an office and a generated world. It names all files from its folder on.
fs::path clone(const TempFolder& folder) {
  const fs::path root = folder.path() / "clone";
  for (const char* const part : {"graphs", "sim/worlds", "sim/robots", "sim/experiments"}) {
    fs::create_directories(root / part);
    fs::copy(source_file(part), root / part, fs::copy_options::recursive);
  }
  std::ofstream(root / "sim/experiments/drive.xml")
      << R"(<experiment name="drive" seeds="1-2" until="6 s" graph="to_goal/goto.xml">
  <variant name="LaserAvoid"><set arg="avoid" value="orca.LaserAvoid"/></variant>
  <variant name="Dwa"><set arg="avoid" value="orca.Dwa"/></variant>
  <worlds name="doors" arg="world" file="to_goal/doors.xml" references="lengths.csv"/>
</experiment>)";
  std::ofstream(root / "sim/experiments/lengths.csv") << "world,reference\n1,5.5\n2,6.5\n";
  return root;
}

// A pack of a batch, as a file in a folder of its own, whose origin is gone.
fs::path packed(const TempFolder& folder) {
  const fs::path root = clone(folder);
  const Run made = in_folder(
      root, kProgram + " sim/experiments/drive.xml && " + kProgram + " pack sim/experiments/drive.xml");
  INFO(made.err);
  REQUIRE(made.exit_code() == 0);
  CHECK(made.says("pack: drive.batch/drive.pack.tar.gz"));
  const fs::path elsewhere = folder.path() / "elsewhere";
  fs::create_directories(elsewhere);
  fs::rename(root / "drive.batch/drive.pack.tar.gz", elsewhere / "drive.pack.tar.gz");
  fs::remove_all(root);
  return elsewhere;
}

// Repeats a pack after its content was changed by the commands of a shell, which work in the folder of the unpacked archive.
Run repeated_after(const fs::path& elsewhere, const std::string& commands) {
  const Run changed =
      in_folder(elsewhere, "mkdir content; tar -xzf drive.pack.tar.gz -C content; cd content; " + commands +
                               "; tar -czf ../changed.pack.tar.gz *");
  INFO(changed.err);
  REQUIRE(changed.exit_code() == 0);
  return in_folder(elsewhere, kProgram + " repeat changed.pack.tar.gz");
}

// Repeats an archive that GNU tar makes of a folder `content`, and returns why that is refused.
std::string refusal(const TempFolder& folder, const std::string& commands) {
  const Run made = in_folder(folder.path(), "rm -rf content *.gz; mkdir content; cd content; " + commands);
  INFO(made.err);
  REQUIRE(made.exit_code() == 0);
  const Run run = in_folder(folder.path(), kProgram + " repeat evil.pack.tar.gz");
  CHECK(run.exit_code() == 2);
  CHECK_FALSE(fs::exists(folder.file("evil.repeat")));
  return run.err;
}

}  // namespace

TEST_CASE("a pack repeats byte for byte in another folder, by one command, when its origin is gone",
          "[system][batch]") {
  const TempFolder folder;
  const fs::path elsewhere = packed(folder);
  const Run run = in_folder(elsewhere, kProgram + " repeat drive.pack.tar.gz");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("the same: all 8 runs, byte for byte"));
  CHECK_FALSE(run.says("not built as for the pack"));
  CHECK_THAT(text_in(elsewhere / "drive.repeat/provenance.json"), Contains("\"made\": ["));
  CHECK(text_in(elsewhere / "drive.repeat/runs.csv") == exported(elsewhere / "drive.repeat/batch"));
  const Run again = in_folder(elsewhere, kProgram + " repeat drive.pack.tar.gz");
  CHECK(again.exit_code() == 2);
  CHECK(again.says("--resume goes on in it, --out DIR takes another folder"));
  CHECK(in_folder(elsewhere, kProgram + " repeat drive.pack.tar.gz --resume").exit_code() == 0);
}

TEST_CASE("files behind links are packed, also behind links in the folder to which a link leads",
          "[system][batch]") {
  const TempFolder folder;
  const fs::path root = clone(folder);
  const fs::path share = folder.path() / "share", own = folder.path() / "own";
  for (const fs::path& made : {share, own}) fs::create_directories(made);
  for (const char* const part : {"graphs", "sim"}) fs::create_symlink(root / part, share / part);
  fs::create_symlink(share, own / "orca");
  fs::copy(root / "sim/experiments/lengths.csv", share / "lengths.csv");
  fs::create_symlink(share / "lengths.csv", own / "lengths.csv");
  std::ofstream(own / "linked.xml")
      << R"(<experiment name="linked" seeds="1" until="6 s" graph="orca/sim/experiments/to_goal/goto.xml">
  <variant name="Dwa"><set arg="avoid" value="orca.Dwa"/></variant>
  <worlds name="doors" arg="world" file="orca/sim/experiments/to_goal/doors.xml" references="lengths.csv"/>
</experiment>)";
  const Run made = in_folder(own, kProgram + " linked.xml && " + kProgram +
                                      " pack linked.xml && mv linked.batch/linked.pack.tar.gz ..");
  INFO(made.err);
  REQUIRE(made.exit_code() == 0);
  for (const fs::path& gone : {root, share, own}) fs::remove_all(gone);
  const Run run = in_folder(folder.path(), kProgram + " repeat linked.pack.tar.gz");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("the same: all 2 runs, byte for byte"));
}

TEST_CASE("two packs of the same results are the same archive", "[system][batch]") {
  const TempFolder folder;
  const fs::path root = clone(folder);
  const std::string pack = kProgram + " pack sim/experiments/drive.xml";
  const Run run = in_folder(root, kProgram + " sim/experiments/drive.xml; " + pack +
                                      "; cp drive.batch/drive.pack.tar.gz first; " + pack +
                                      "; cmp first drive.batch/drive.pack.tar.gz");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_FALSE(fs::exists(root / "drive.batch/drive.pack"));
}

TEST_CASE("a number that was changed in a pack's results is found by the repetition", "[system][batch]") {
  const TempFolder folder;
  const Run run = repeated_after(packed(folder), "sed -i '3s/,2,/,3,/' runs.csv");
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.out, Contains("not the same: line 3 of runs.csv is\n  Dwa,doors_1,3,"));
  CHECK_THAT(run.out, Contains("in the pack and now\n  Dwa,doors_1,2,"));
}

TEST_CASE("a file that was changed in a pack is named, and nothing runs", "[system][batch]") {
  const TempFolder folder;
  const Run run =
      repeated_after(packed(folder), "echo '<!-- -->' >> files/sim/experiments/to_goal/doors.xml");
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("files/sim/experiments/to_goal/doors.xml\" is not the file that was packed"));
}

TEST_CASE("programs that were built otherwise are named before the runs, which decide", "[system][batch]") {
  const TempFolder folder;
  const Run run =
      repeated_after(packed(folder), "sed -i 's/^[0-9]* plugin goto.so/1 plugin goto.so/' contents.txt");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("note: not built as for the pack: plugin goto.so; the results show whether it matters"));
  CHECK_THAT(run.out, Contains("the same: all 8 runs"));
}

TEST_CASE("nothing is unpacked of an archive with evil paths, links or too many bytes", "[system][batch]") {
  const TempFolder folder;
  const std::string outside = folder.file("outside");
  CHECK_THAT(
      refusal(folder, "echo x > ../outside; tar -P -czf ../evil.pack.tar.gz ../outside; rm ../outside"),
      Contains("nothing is unpacked: \"../outside\" leads out of the archive's folder"));
  CHECK_FALSE(fs::exists(outside));
  CHECK_THAT(
      refusal(folder, "echo x > ../outside; tar -P -czf ../evil.pack.tar.gz " + outside + "; rm ../outside"),
      Contains("\"" + outside + "\" leads out"));
  CHECK_FALSE(fs::exists(outside));
  CHECK_THAT(
      refusal(folder, "echo x > a; tar --transform='s,a,b/../../outside,' -P -czf ../evil.pack.tar.gz a"),
      Contains("\"b/../../outside\" leads out"));
  CHECK_THAT(refusal(folder, "ln -s /etc files; tar -czf ../evil.pack.tar.gz files"),
             Contains("files -> /etc\" is neither a file nor a folder"));
  CHECK_THAT(refusal(folder, "echo x > a; ln a b; tar -czf ../evil.pack.tar.gz a b"),
             Contains("b link to a\" is neither a file nor a folder"));
  CHECK_THAT(refusal(folder, "truncate -s 5G big; tar -S -czf ../evil.pack.tar.gz big"),
             Contains("\"big\" is more than an archive of 4 GB and 100,000 files holds"));
  CHECK_THAT(refusal(folder, "echo x > a; tar -cf t a; tar -rf t a; gzip <t >../evil.pack.tar.gz"),
             Contains("\"a\" is there twice"));
  CHECK_THAT(refusal(folder, "echo this is no archive > ../evil.pack.tar.gz"),
             Contains("cannot be unpacked"));
  CHECK_THAT(refusal(folder, "echo x > a; tar -czf ../evil.pack.tar.gz a"),
             Contains("holds no pack of this version of simbatch"));
}

TEST_CASE("an experiment with an absolute path, or without all its runs, is not packed", "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = drive(folder);
  const std::string out = folder.file("out");
  REQUIRE(run_simbatch({experiment, "--out", out, "--shard", "1/2"}).exit_code() == 0);
  const Run half = run_simbatch({"pack", experiment, "--out", out});
  CHECK(half.exit_code() == 2);
  CHECK(half.says("4 of 8 runs are missing; --resume makes them"));
  (void)batch(experiment, out, {"--resume"});
  const Run run = run_simbatch({"pack", experiment, "--out", out});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("pioneer_laser_goto.xml\" is named by an absolute path"));
  CHECK_FALSE(fs::exists(out + "/drive.pack.tar.gz"));
}
