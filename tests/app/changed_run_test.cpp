// carom run --changes, and carom playground.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class ChangedRun : public ProgramTest {
 protected:
  ChangedRun() : ProgramTest(fifty_disks) {
    write_text(file("none.toml"), "");
    write_text(file("some.toml"),
               "[[changes]]\ntime = 0.5\nset = [\"collision.restitution=0.9\"]\n"
               "[[changes]]\ntime = 1.0\nremove_disk = 7\n");
  }
  nlohmann::json json_of(const std::vector<std::string>& arguments) {
    const Outcome outcome = carom(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }
};

TEST_F(ChangedRun, WithoutChangesEndsAsTheRunItself) {
  const auto run = json_of({"run", "gas.toml", "--json"});
  const auto same = json_of({"run", "gas.toml", "--changes", "none.toml", "--json"});
  EXPECT_EQ(same["state_hash"], run["state_hash"]);
}

TEST_F(ChangedRun, MakesTheChangesAndSaysHowItEnded) {
  const Outcome outcome = carom({"run", "gas.toml", "--changes", "some.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("gas.toml with 2 changes of some.toml"), HasSubstr("of 49 disks"), HasSubstr("state hash")));
  EXPECT_FALSE(fs::exists(file("gas")));
  const auto summary = json_of({"run", "gas.toml", "--changes", "some.toml", "--json"});
  EXPECT_EQ(summary["changes_made"], 2);
  EXPECT_EQ(summary["disks"], 49);
  EXPECT_THAT(outcome.out, HasSubstr(summary["state_hash"].get<std::string>()));
}

TEST_F(ChangedRun, WritesSamplesOfHoweverManyDisksThereAre) {
  ASSERT_EQ(carom({"run", "gas.toml", "--changes", "some.toml", "--csv", "-q"}).exit_code, 0);
  const std::string samples = text_of(file("gas/samples.csv"));
  EXPECT_THAT(samples, AllOf(HasSubstr("\n0.5,49,"), Not(HasSubstr("\n1.5,49,")), HasSubstr("\n2.0,48,")));
}

TEST_F(ChangedRun, NamesWhatItLeavesOut) {
  write_text(file("late.toml"), "[[changes]]\ntime = 1e6\nremove_disk = 7\n");
  const Outcome outcome =
      carom({"run", "gas.toml", "--changes", "late.toml", "--set", "run.collisions=9", "--set", "observe.speeds=true"});
  EXPECT_THAT(outcome.out, HasSubstr("left out    run.collisions, [observe], 1 change after the end\n"));
  EXPECT_TRUE(json_of({"run", "gas.toml", "--changes", "some.toml", "--json"})["left_out"].empty());
}

TEST_F(ChangedRun, LeavesNothingOfARunWhoseChangesAreWrong) {
  write_text(file("wrong.toml"), "[[changes]]\ntime = 1\nremove_disk = 50\n");
  refused({"run", "gas.toml", "--changes", "wrong.toml", "--csv"}, "there is no disk 50");
  EXPECT_FALSE(fs::exists(file("gas")));
}

TEST_F(ChangedRun, RefusesWrongListsAndOptionsOfOtherRuns) {
  write_text(file("wrong.toml"), "[[changes]]\ntime = 1\nremove_disk = 50\n");
  refused({"run", "gas.toml", "--changes", "wrong.toml"}, "wrong.toml: the change at time 1 cannot be made: there is no disk 50");
  refused({"run", "gas.toml", "--changes", "nowhere.toml"}, "nowhere.toml");
  refused({"run", "gas.toml", "--changes", "some.toml", "--report"}, "--changes and --report do not go together");
  refused({"run", "gas.toml", "--changes", "some.toml", "--csv", "--unwrapped"}, "--changes and --unwrapped");
  refused({"run", "gas.toml", "--changes", "some.toml", "--method", "naive"}, "--changes and --method");
  for (const std::string option : {"--dt", "--stiffness", "--pace"})
    refused({"run", "gas.toml", "--changes", "some.toml", option, "2"}, "--changes and " + option + " do not go together");
}

TEST_F(ChangedRun, RefusesWhatCannotBeComputedUntilTheNextChangeOrTheEnd) {
  const std::string walls = "box.boundary=\"walls\"";
  const std::string wild = "[[changes]]\ntime = 0.5\nset = [\"gravity.acceleration=[0, 1e40]\"]\n";
  write_text(file("wild.toml"), wild);
  const Outcome refusal = carom({"run", "gas.toml", "--changes", "wild.toml", "--set", walls});
  EXPECT_EQ(refusal.exit_code, 2);
  EXPECT_THAT(refusal.err, AllOf(HasSubstr("wild.toml: the change at time 0.5 cannot be made: gravity.acceleration"),
                                 HasSubstr("more than 2^53 times cannot be computed")));
  write_text(file("brief.toml"), wild + "[[changes]]\ntime = 0.5\nset = [\"gravity.acceleration=[0, 0]\"]\n");
  const Outcome brief = carom({"run", "gas.toml", "--changes", "brief.toml", "-q", "--set", walls});
  EXPECT_EQ(brief.exit_code, 0) << brief.err;
}

/// A program that is installed, with a page in the place of the built one.
class PlaygroundCommand : public ProgramTest {
 protected:
  PlaygroundCommand() : ProgramTest("title = \"A <gas>\"\n\n" + fifty_disks) {
    fs::create_directories(file("bin"));
    fs::copy_file(CAROM_PROGRAM, file("bin/carom"));
  }
  Outcome playground(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {file("bin/carom").string(), "playground"});
    return run_program(directory_.path(), arguments);
  }
  void install_page() {
    fs::create_directories(file("share/carom"));
    write_text(file("share/carom/playground.html"),
               "<!doctype html>\n<meta name=\"generator\" content=\"carom playground\">\n"
               "<script type=\"application/json\" id=\"ownScenes\">[]</script>\n");
  }
};

TEST_F(PlaygroundCommand, WritesThePageWithTheScenesGiven) {
  install_page();
  const Outcome outcome = playground({"gas.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(StartsWith("playground.html  "), HasSubstr("1 scene of yours first")));
  const std::string page = text_of(file("playground.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("id=\"ownScenes\">[{\"title\":\"A \\u003cgas>\""), HasSubstr("count = 50"),
                          HasSubstr("}]</script>")));
  EXPECT_EQ(playground({}).exit_code, 0);  // a playground may be made anew
  EXPECT_THAT(text_of(file("playground.html")), HasSubstr("id=\"ownScenes\">[]</script>"));
}

TEST_F(PlaygroundCommand, PutsStartFilesIntoThePage) {
  install_page();
  write_text(file("start.csv"), "x,y,vx,vy\n1,2,0.5,0\n3,4,0,0.25\n");
  write_text(file("own.toml"),
             "box = { x = [0, 10], y = [0, 10], boundary = \"walls\" }\ncollision = { rule = \"specular\" }\nrun = { time = 1 }\n"
             "[[disks]]\nradius = 0.5\nmass = 1\npositions = { file = \"start.csv\" }\n");
  EXPECT_EQ(playground({"own.toml"}).exit_code, 0);
  EXPECT_THAT(text_of(file("playground.html")), AllOf(HasSubstr("0.25"), Not(HasSubstr("start.csv"))));
}

TEST_F(PlaygroundCommand, SaysWhatToDoWhereThePageIsNotBuilt) {
  const Outcome outcome = playground({});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("carom: the page of the playground is not built; ./bootstrap playground"));
  EXPECT_FALSE(fs::exists(file("playground.html")));
}

TEST_F(PlaygroundCommand, OpensThePageWhereItIsAsked) {
  install_page();
  write_text(file("bin/xdg-open"), "#!/bin/sh\necho \"$1\" > opened\n");
  fs::permissions(file("bin/xdg-open"), fs::perms::owner_all);
  const std::string program = file("bin/carom").string();
  const std::string path = "PATH=" + file("bin").string() + ":/bin:/usr/bin";
  EXPECT_EQ(run_program(directory_.path(), {"env", path, program, "playground", "--open"}).exit_code, 0);
  EXPECT_EQ(text_of(file("opened")), fs::canonical(file("playground.html")).string() + "\n");
  write_text(file("bin/xdg-open"), "#!/bin/sh\nexit 3\n");
  const Outcome outcome = run_program(directory_.path(), {"env", path, program, "playground", "--open"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("no browser could be started by xdg-open; open "));
}

TEST_F(PlaygroundCommand, RefusesWrongScenesAndPlaces) {
  install_page();
  EXPECT_EQ(playground({"nowhere.toml"}).exit_code, 2);
  EXPECT_EQ(playground({"-o", "gas.toml"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(file("playground.html")));
}

}  // namespace
}  // namespace carom::test
