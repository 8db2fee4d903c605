// SPDX-License-Identifier: GPL-3.0-or-later
// Batches of runs from outside: the same experiment gives the same bytes, and nothing that was finished is lost.
#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#include "batches.hpp"
#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

// Components that misbehave, each in a run of its own.
std::string misdeeds(const TempFolder& folder, const std::string& limit = "60 s") {
  std::string variants;
  Words deeds{"none", "segfault", "exit", "abort", "hang"};
  if (!kSanitized) deeds.push_back("hoard");  // without a limit of memory it takes that of the machine
  for (const std::string& deed : deeds)
    variants += "<variant name=\"" + deed + "\"><set arg=\"deed\" value=\"" + deed + "\"/></variant>";
  return folder.write("misdeeds.xml",
                      "<experiment name=\"misdeeds\" seeds=\"1\" until=\"10 s\" memory=\"500 MB\" limit=\"" +
                          limit + "\" graph=\"" + system_graph("hooligan.xml") +
                          "\"><set arg=\"plugins\" value=\"" + std::string(ORCA_BINARY_DIR "/tests/plugins") +
                          "\"/><set arg=\"where\" value=\"later\"/>" + variants +
                          "<world name=\"here\"/></experiment>");
}

// The ending of each variant's only run.
std::map<std::string, std::string> endings(const std::string& table) {
  std::map<std::string, std::string> found;
  for (const std::string& line : split_lines(table)) {
    const std::string variant = line.substr(0, line.find(','));
    const std::size_t seed = line.find(',', variant.size() + 1);
    const std::size_t ending = line.find(',', seed + 1) + 1;
    found[variant] = line.substr(ending, line.find(',', ending) - ending);
  }
  return found;
}

// The part of a report that is the same whenever it is made.
std::string before_dates(const std::string& page) {
  const std::size_t dates = page.find("What was declared, and when");
  REQUIRE(dates != std::string::npos);
  return page.substr(0, dates);
}

}  // namespace

TEST_CASE("the same experiment gives the same bytes with one worker and with several, on fiber and baton",
          "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = drive(folder);
  const std::string one = batch(experiment, folder.file("one"), {"--jobs", "1"});
  CHECK(split_lines(one).size() == 9);
  CHECK(batch(experiment, folder.file("three"), {"--jobs", "3"}) == one);
  for (const char* page : {"/report.html", "/report.md"})
    CHECK(before_dates(text_in(folder.file("one") + page)) ==
          before_dates(text_in(folder.file("three") + page)));
  CHECK(batch(experiment, folder.file("baton"), {"--executor", "baton"}) == one);
}

TEST_CASE("the processor time per lap of each component is on the page and beside it", "[system][batch]") {
  const TempFolder folder;
  batch(drive(folder), folder.file("out"));
  const std::string page = text_in(folder.file("out") + "/report.md");
  for (const char* const part : {"## Processor time\n\n| component | ", "\n| avoid | ", "\n| localizer | "})
    CHECK_THAT(page.substr(std::min(page.size(), page.find("## Processor time"))), Contains(part));
  const std::vector<std::string> laps = split_lines(text_in(folder.file("out") + "/laps.csv"));
  CHECK(laps[0] == "variant,world,seed,component,laps,mean,p95,longest");
  CHECK(laps.size() == 1 + 8 * 7);  // eight runs of seven components
  for (std::size_t i = 1; i < laps.size(); ++i) {
    CAPTURE(laps[i]);
    std::size_t at = 0;
    for (int comma = 0; comma < 4; ++comma) at = laps[i].find(',', at) + 1;
    unsigned long count = 0;
    double mean = 0.0;
    double p95 = 0.0;
    double longest = 0.0;
    REQUIRE(std::sscanf(laps[i].c_str() + at, "%lu,%lf,%lf,%lf", &count, &mean, &p95, &longest) == 4);
    CHECK(count > 0);
    CHECK(mean > 0.0);
    CHECK(p95 <= longest);
  }
}

TEST_CASE("an experiment with factors of computing runs each variant with each of them", "[system][batch]") {
  const TempFolder folder;
  std::string text = text_in(drive(folder));
  text.replace(text.find("seeds=\"1 7\""), 11, "seeds=\"1\" computing=\"0 10\"");
  const std::vector<std::string> runs =
      split_lines(batch(folder.write("factors.xml", text), folder.file("out")));
  std::map<std::string, std::string> hashes;  // by variant and world
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const std::size_t seed = runs[i].find(',', runs[i].find(',') + 1);
    const std::size_t reason = runs[i].rfind(',');
    hashes[runs[i].substr(0, seed)] = runs[i].substr(reason - 16, 16);
  }
  CHECK(hashes.size() == 8);
  CHECK(hashes.at("LaserAvoid_x0,harsh") == hashes.at("LaserAvoid_x10,harsh"));  // it takes no time anyway
  CHECK(hashes.at("VfhPlus_x0,harsh") != hashes.at("VfhPlus_x10,harsh"));
}

TEST_CASE("the tables of a batch lie beside its report: what is the same each time, and what never is",
          "[system][batch]") {
  const TempFolder folder;
  const std::string runs = batch(drive(folder), folder.file("out"));
  CHECK(text_in(folder.file("out") + "/runs.csv") == runs);
  const std::vector<std::string> timing = split_lines(text_in(folder.file("out") + "/timing.csv"));
  const std::vector<std::string> results = split_lines(runs);
  REQUIRE(timing.size() == results.size());
  CHECK(timing[0] == "variant,world,seed,wall,cpu");
  for (std::size_t i = 1; i < timing.size(); ++i) {
    const std::size_t key = timing[i].find(',', timing[i].find(',', timing[i].find(',') + 1) + 1) + 1;
    CHECK(timing[i].substr(0, key) == results[i].substr(0, key));
    double wall = 0.0;
    double cpu = 0.0;
    REQUIRE(std::sscanf(timing[i].c_str() + key, "%lf,%lf", &wall, &cpu) == 2);
    CHECK(wall > 0.0);
    CHECK(cpu > 0.0);
  }
}

TEST_CASE("seeds matter, and not where nothing is random", "[system][batch]") {
  const TempFolder folder;
  std::map<std::string, std::string> hash_of;
  for (const std::string& line : split_lines(batch(drive(folder), folder.file("out")))) {
    const std::size_t hash = line.rfind(',', line.rfind(',') - 1) + 1;
    hash_of[line.substr(0, line.find(',', line.find(',', line.find(',') + 1) + 1))] = line.substr(hash, 16);
  }
  CHECK(hash_of["VfhPlus,harsh,1"] != hash_of["VfhPlus,harsh,7"]);
  CHECK(hash_of["VfhPlus,harsh,1"] != hash_of["LaserAvoid,harsh,1"]);
}

TEST_CASE("a run of a batch is that of the deployer", "[system][batch]") {
  const TempFolder folder;
  const std::string table = batch(drive(folder), folder.file("out"));
  const Run alone =
      run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--seed", "7", "--until", "12 s",
                         "--set", "avoid=orca.VfhPlus", "--set", "takes=30 ms", "--set", "realism=harsh"} +
                   virtual_clock());
  REQUIRE(alone.trace_hash());
  bool found = false;
  for (const std::string& line : split_lines(table))
    if (line.starts_with("VfhPlus,harsh,7,")) found = line.find(*alone.trace_hash()) != std::string::npos;
  CHECK(found);
}

TEST_CASE("the command in a report makes a run without success again, in the experiment's folder",
          "[system][batch]") {
  const TempFolder folder;
  folder.write("office.xml", text_in(source_file("sim/worlds/office.xml")));
  const std::string experiment =
      folder.write("short.xml", "<experiment name=\"short\" seeds=\"7\" until=\"5 s\" graph=\"" +
                                    source_file("graphs/pioneer_laser_goto.xml") +
                                    "\"><variant name=\"a\"/><world name=\"harsh\"><set arg=\"world\" "
                                    "file=\"office.xml\"/><set arg=\"realism\" "
                                    "value=\"harsh\"/></world></experiment>");
  const std::string table = batch(experiment, folder.file("out"));
  const std::string page = text_in(folder.file("out") + "/report.md");
  CHECK_THAT(page, Contains("a in harsh, seed 7: time_out"));
  const std::size_t begin = page.find("deployer ");
  REQUIRE(begin != std::string::npos);
  const std::string command = page.substr(begin, page.find('\n', begin) - begin);
  Subprocess program(
      Words{"/bin/sh", "-c", "cd " + folder.path().string() + "; " ORCA_BINARY_DIR "/bin/" + command});
  const Run run = finish(program, Seconds(60 * kSlowdown));
  const std::string hash = split_lines(run.out).back();
  REQUIRE(hash.starts_with("trace-hash "));
  CHECK_THAT(table, Contains(hash.substr(11)));
}

TEST_CASE("pages and provenance.json say what made the results, of what, and hold no path of a machine",
          "[system][batch]") {
  const TempFolder folder;
  folder.write("office.xml", text_in(source_file("sim/worlds/office.xml")));
  const std::string experiment = folder.write(
      "short.xml",
      "<experiment name=\"short\" seeds=\"1-3\" until=\"1 s\" graph=\"" +
          source_file("graphs/pioneer_laser_goto.xml") +
          "\"><variant name=\"a\"/><variant name=\"b\"><set arg=\"avoid\" value=\"orca.VfhPlus\"/>"
          "</variant><world name=\"w\"><set arg=\"world\" file=\"office.xml\"/><set "
          "arg=\"realism\" value=\"nominal\"/></world></experiment>");
  (void)batch(experiment, folder.file("out"));
  const std::string json = text_in(folder.file("out") + "/provenance.json");
  const std::string page = text_in(folder.file("out") + "/report.md");
  CHECK_THAT(json, Contains("\"by\": \"orca 0.1.0, ") && Contains("\"since\": \"20"));
  CHECK_THAT(json, Contains("\"seeds\": \"1-3\"") && Contains("\"b\": \"orca.VfhPlus\""));
  CHECK_THAT(json, Contains("\"world=office.xml\"") && Contains("\"program simbatch\": \""));
  CHECK_THAT(page, Contains("| avoid | as in the graph | orca.VfhPlus |") &&
                       Contains("| seeds | 1-3 |\n| realism | nominal |"));
  CHECK_THAT(page, Contains(text_in(experiment)) && Contains("| plugin vfh_plus.so | "));
  for (const std::string& text : {json, page}) CHECK_THAT(text, !Contains(folder.path().string()));
}

TEST_CASE("a report can be made again, and needs results", "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = drive(folder);
  const std::string out = folder.file("out");
  CHECK(run_simbatch({"report", experiment, "--out", out})
            .says("holds no results of a batch: there is no results.sqlite in it"));
  (void)batch(experiment, out);
  const std::string first = text_in(out + "/report.html");
  REQUIRE(std::filesystem::remove(out + "/report.html"));
  const Run again = run_simbatch({"report", experiment, "--out", out});
  CHECK(again.exit_code() == 0);
  CHECK(text_in(out + "/report.html") == first);
}

TEST_CASE("a batch overwrites no files of others, and makes no run before it says so", "[system][batch]") {
  const TempFolder paper;
  const std::string experiment = drive(paper);
  const std::string figure = paper.file("figures/mine.pdf");
  std::filesystem::create_directories(paper.path() / "figures");
  (void)paper.write("figures/mine.pdf", "a figure");
  const Run run = run_simbatch({experiment, "--out", paper.path().string()});
  CHECK(run.exit_code() == 2);
  CHECK(
      run.says("figures: it is there already and would be overwritten, and no results.sqlite beside it says "
               "that it is of a batch; bring that back, or move what is there away, or"));
  CHECK(text_in(figure) == "a figure");
  CHECK_FALSE(std::filesystem::exists(paper.path() / "results.sqlite"));
}

TEST_CASE("metrics that are exchanged after the runs stand on the page as a change", "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = drive(folder);
  const std::string out = folder.file("out");
  const std::string runs = batch(experiment, out);
  CHECK_THAT(text_in(out + "/report.md"), Contains(" UTC | metrics | success, time |") &&
                                              Contains("Nothing was added or exchanged since then."));
  std::string text = text_in(experiment);
  text.replace(text.find("<experiment "), 12, "<experiment metrics=\"clearance\" ");
  (void)folder.write("drive.xml", text);
  const Run again = run_simbatch({"report", folder.file("drive.xml"), "--out", out});
  INFO(again.err);
  CHECK(again.exit_code() == 0);
  CHECK_THAT(text_in(out + "/report.md"), Contains(" UTC | metrics, changed | clearance |"));
  CHECK(exported(out) == runs);
}

TEST_CASE("a run that crashes, exits, hangs or takes all memory is a result and costs no other",
          "[system][batch]") {
  const TempFolder folder;
  const auto ending_of = endings(batch(misdeeds(folder, kSanitized ? "60 s" : "10 s"), folder.file("out")));
  CHECK(ending_of.at("none") == "success");
  CHECK(ending_of.at("segfault") == "crash");
  CHECK(ending_of.at("abort") == "crash");
  CHECK(ending_of.at("exit") == "crash");
  CHECK(ending_of.at("hang") == "failed");  // the runtime names a component that does not come back
  if (!kSanitized)
    CHECK(ending_of.at("hoard") == "success");  // only the component fails, and the graph allows it
}

TEST_CASE("a run that does not end within the limit is killed and counts as hung", "[system][batch]") {
  const TempFolder folder;
  const auto ending_of = endings(batch(misdeeds(folder, "0.5 s"), folder.file("out")));
  CHECK(ending_of.at("hang") == "hang");
}

TEST_CASE("kill -9 loses nothing that was finished, and --resume makes the rest once", "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = drive(folder);
  const std::string whole = batch(experiment, folder.file("whole"));
  const std::string out = folder.file("killed");
  {
    Subprocess program(simbatch({experiment, "--out", out, "--jobs", "1"}));
    const auto has_some = [&] {
      program.send_to_group(SIGSTOP);  // on a busy machine it would end while another program starts to look
      const Run run = run_simbatch({"export", out});
      const bool some = run.exit_code() == 0 && split_lines(run.out).size() > 2;
      if (!some) program.send_to_group(SIGCONT);
      return some;
    };
    while (!has_some()) REQUIRE_FALSE(program.wait(Seconds(0.02)));
    program.send(SIGKILL);
    REQUIRE(program.wait(Seconds(10)));
    CHECK_FALSE(program.group_lives());
  }
  const std::string some = exported(out);
  for (const std::string& line : split_lines(some)) CHECK_THAT(whole, Contains(line));
  const Run again = run_simbatch({experiment, "--out", out});
  CHECK(again.exit_code() == 2);
  CHECK(again.says("holds results already; --resume makes what is missing"));
  CHECK(batch(experiment, out, {"--resume"}) == whole);
}

TEST_CASE("Ctrl-C ends a batch at once, and says how to go on", "[system][batch]") {
  const TempFolder folder;
  Subprocess program(simbatch({misdeeds(folder, "600 s"), "--out", folder.file("out"), "--jobs", "6"}));
  REQUIRE(program.wait_for_output("running", Seconds(20 * kSlowdown)));
  program.send_to_group(SIGINT);
  const Run run = finish(program, Seconds(5));
  CHECK(run.ended);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("stopped; what was finished is kept, --resume goes on"));
  CHECK_FALSE(program.group_lives());
}

TEST_CASE("everything that is wrong with an experiment and its graphs is said before anything runs",
          "[system][batch]") {
  const TempFolder folder;
  const std::string experiment =
      folder.write("e.xml", R"(<experiment name="e" seeds="1" until="1 s" graph=")" +
                                source_file("graphs/pioneer_laser_goto.xml") + R"(">
  <variant name="a"><set arg="avoid" value="orca.LazerAvoid"/></variant>
  <variant name="b"><set arg="avoit" value="x"/></variant>
  <world name="w"/>
</experiment>)");
  const Run run = run_simbatch({experiment, "--out", folder.file("out")});
  CHECK(run.exit_code() == 2);
  CHECK(run.says("orca.LazerAvoid"));
  CHECK(run.says("(variant a, world w)"));
  CHECK(run.says("avoit"));
  CHECK_FALSE(std::filesystem::exists(folder.file("out")));
  CHECK(run_simbatch({folder.file("none.xml")}).exit_code() == 2);
}

TEST_CASE("a component that fails on purpose fails at the time of its seed, and its name is checked",
          "[system][batch]") {
  const TempFolder folder;
  const auto experiment = [&](const std::string& component) {
    return folder.write(component + ".xml",
                        R"(<experiment name="e" seeds="1-2" until="5 s" graph=")" +
                            source_file("graphs/pioneer_laser_goto.xml") +
                            R"("><variant name="a"/><world name="w"><fail component=")" + component +
                            R"(" how="throw" at="1 s" latest="3 s"/></world></experiment>)");
  };
  const Run wrong = run_simbatch({experiment("avoit"), "--check"});
  INFO(wrong.err);
  CHECK(wrong.exit_code() == 2);
  CHECK(wrong.says("E016: <fail>: the graph has no component \"avoit\""));

  const std::string table = batch(experiment("avoid"), folder.file("out"));
  const std::map<std::string, std::string> ending = endings(table);
  CHECK(ending.at("a") == "failed");
  const std::string page = text_in(folder.file("out") + "/report.md");
  const std::size_t begin = page.find("deployer ");
  REQUIRE(begin != std::string::npos);
  const std::string command = page.substr(begin, page.find('\n', begin) - begin);
  CHECK_THAT(command, Contains("--fail avoid=throw@"));
  Subprocess program(
      Words{"/bin/sh", "-c", "cd " + folder.path().string() + "; " ORCA_BINARY_DIR "/bin/" + command});
  const std::string hash = split_lines(finish(program, Seconds(60 * kSlowdown)).out).back();
  REQUIRE(hash.starts_with("trace-hash "));
  CHECK_THAT(table, Contains(hash.substr(11)));
}

TEST_CASE("an experiment without a world, or with a setting without a value, is checked as far as it goes",
          "[system][batch]") {
  const TempFolder folder;
  const std::string head = R"(<experiment name="e" seeds="1" until="1 s" graph=")" +
                           source_file("graphs/pioneer_laser_goto.xml") + R"(">)";
  const std::string wrong = R"(<variant name="b"><set arg="avoit" value="x"/></variant>)";
  const Run no_world = run_simbatch({folder.write("e.xml", head + wrong + "</experiment>"), "--check"});
  INFO(no_world.err);
  CHECK(no_world.exit_code() == 2);
  CHECK(no_world.says("E004"));
  CHECK(no_world.says("avoit"));
  const Run no_value =
      run_simbatch({folder.write("e.xml", head + R"(<variant name="a"><set arg="avoid"/></variant>)" + wrong +
                                              R"(<world name="w"/></experiment>)"),
                    "--check"});
  INFO(no_value.err);
  CHECK(no_value.exit_code() == 2);
  CHECK(no_value.says("E009"));
  CHECK(no_value.says("avoit"));
}

TEST_CASE("the shipped experiments have no errors", "[system][batch]") {
  for (const auto& [name, size] : {std::pair{"avoid_office", "13 variants, 4 worlds, 10 seeds: 520 runs"},
                                   std::pair{"dead_ends", "8 variants, 40 worlds, 1 seed: 320 runs"},
                                   std::pair{"posts_and_offices", "6 variants, 80 worlds, 1 seed: 480 runs"},
                                   std::pair{"tour", "3 variants, 8 worlds, 10 seeds: 240 runs"},
                                   std::pair{"fetch", "2 variants, 9 worlds, 10 seeds: 180 runs"},
                                   std::pair{"deliver", "2 variants, 7 worlds, 7 seeds: 98 runs"},
                                   std::pair{"map_office", "1 variant, 7 worlds, 7 seeds: 49 runs"},
                                   std::pair{"patrol", "2 variants, 7 worlds, 7 seeds: 98 runs"},
                                   std::pair{"scout_tour", "2 variants, 7 worlds, 10 seeds: 140 runs"},
                                   std::pair{"doors", "6 variants, 6 worlds, 20 seeds: 720 runs"},
                                   std::pair{"sway", "6 variants, 1 world, 20 seeds: 120 runs"},
                                   std::pair{"lost", "3 variants, 21 worlds, 10 seeds: 630 runs"},
                                   std::pair{"meeting", "4 variants, 2 worlds, 20 seeds: 160 runs"},
                                   std::pair{"people", "6 variants, 3 worlds, 12 seeds: 216 runs"},
                                   std::pair{"radio", "4 variants, 1 world, 10 seeds: 40 runs"},
                                   std::pair{"showroom", "6 variants, 2 worlds, 10 seeds: 120 runs"},
                                   std::pair{"sonar_physics", "5 variants, 4 worlds, 20 seeds: 400 runs"},
                                   std::pair{"turret", "2 variants, 10 worlds, 4 seeds: 80 runs"},
                                   std::pair{"computing", "6 variants, 40 worlds, 1 seed: 240 runs"},
                                   std::pair{"emulated_office", "4 variants, 2 worlds, 20 seeds: 160 runs"},
                                   std::pair{"surprises", "5 variants, 2 worlds, 20 seeds: 200 runs"}}) {
    const Run run = run_simbatch({source_file("sim/experiments/" + std::string(name) + ".xml"), "--check"});
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.says(size));
  }
}

TEST_CASE("a graph that changes on the way is refused, not run without its change", "[system][batch]") {
  const TempFolder folder;
  const Run run = run_simbatch(
      {folder.write("e.xml",
                    "<experiment name=\"e\" version=\"1\" graph=\"" +
                        source_file("sim/experiments/vfh_on_the_way.xml") +
                        "\" profile=\"sim\" seeds=\"1\" until=\"1 s\"><variant name=\"a\"/></experiment>"),
       "--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("vfh_on_the_way.xml:10:3: error G074: <change>: simbatch does not carry out changes"));
}

TEST_CASE("wrong words are refused with what there is", "[system][batch]") {
  CHECK(run_simbatch({}).exit_code() == 2);
  const Run unknown = run_simbatch({"e.xml", "--job", "2"});
  CHECK(unknown.exit_code() == 2);
  CHECK(unknown.says("unknown option \"--job\"; did you mean \"--jobs\"?"));
  CHECK(run_simbatch({"e.xml", "--jobs", "0"}).says("--jobs expects an integer from 1 to 1024, not \"0\""));
  CHECK(run_simbatch({"e.xml", "--jobs"}).says("--jobs expects a value"));
  CHECK(run_simbatch({"e.xml", "--out", ""}).says("--out expects a folder, not \"\""));
  CHECK(run_simbatch({"export", "."}).says("holds no results of a batch"));
  for (const char* shard : {"0/2", "3/2", "2", "1/x", "1/2/3", ""})
    CHECK(run_simbatch({"e.xml", "--shard", shard}).says("--shard takes I/N, part I of N parts"));
  CHECK(run_simbatch({"join", "a"}).says("join needs one folder for all"));
  CHECK(run_simbatch({"diff", "."}).says("diff needs AFTER"));
  CHECK(run_simbatch({"diff", ".", "."}).exit_code() == 2);
  CHECK(run_simbatch({"diff", "a", "b", "c"}).says("diff does not know what to do with \"c\""));
  const Run help = run_simbatch({"--help"});
  CHECK(help.exit_code() == 0);
  CHECK_THAT(help.out, Contains("--resume"));
}
