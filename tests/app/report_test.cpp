// carom report and carom run --report: the same page, and what is refused.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class ReportCommand : public ProgramTest {
 protected:
  ReportCommand() : ProgramTest(fifty_disks + "[observe]\ntemperature = true\nspeeds = true\n") {}
};

TEST_F(ReportCommand, WritesThePageOfARunBesideItsFiles) {
  ASSERT_EQ(carom({"run", "gas.toml", "--events", "-q"}).exit_code, 0);
  const Outcome outcome = carom({"report", "gas"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, AllOf(StartsWith("gas/report.html  "), EndsWith(" MB, with an exact replay\n")));
  EXPECT_THAT(text_of(file("gas/report.html")), StartsWith("<!doctype html>"));
  EXPECT_FALSE(fs::exists(file("gas/report.html.partial")));
  EXPECT_EQ(carom({"report", "gas"}).exit_code, 0);  // a report may be made anew
  EXPECT_EQ(carom({"info", "gas"}).exit_code, 0);
}

TEST_F(ReportCommand, ARunThatIsToldToMakesTheSamePage) {
  const Outcome outcome = carom({"run", "gas.toml", "--report"});
  ASSERT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, HasSubstr(", summary.json, report.html\n"));
  const std::string page = text_of(file("gas/report.html"));
  ASSERT_EQ(carom({"report", "gas", "-o", "again.html"}).exit_code, 0);
  EXPECT_EQ(text_of(file("again.html")), page);
}

TEST_F(ReportCommand, IsOpenedOnce) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  fs::create_directory(file("bin"));
  write_text(file("bin/xdg-open"), "#!/bin/sh\necho \"$1\" >> opened\n");
  fs::permissions(file("bin/xdg-open"), fs::perms::owner_all);
  const std::string path = "PATH=" + file("bin").string() + ":/bin:/usr/bin";
  for (const char* command : {"report", "play"}) {
    EXPECT_EQ(run_program(directory_.path(), {"env", path, CAROM_PROGRAM, command, "gas", "--open", "-q"}).exit_code, 0);
    const std::string opened = text_of(file("opened"));
    EXPECT_EQ(std::count(opened.begin(), opened.end(), '\n'), 1) << opened;
    fs::remove(file("opened"));
  }
}

TEST_F(ReportCommand, ARunOutlivesItsReport) {
  // No file beyond half a megabyte: enough for the run, and not for the page.
  const Outcome outcome =
      run_program(directory_.path(), {"sh", "-c", "ulimit -f 1000; exec \"$0\" run gas.toml --report", CAROM_PROGRAM});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, StartsWith("carom: gas: the run is complete, and its report failed: gas/report.html: cannot write"));
  EXPECT_THAT(outcome.out, HasSubstr(", summary.json\n"));
  EXPECT_TRUE(fs::exists(file("gas/summary.json")));
  EXPECT_FALSE(fs::exists(file("gas/report.html")));
  EXPECT_FALSE(fs::exists(file("gas/report.html.partial")));
}

TEST_F(ReportCommand, AnotherRunInItsPlaceTakesThePageAway) {
  ASSERT_EQ(carom({"run", "gas.toml", "--report", "-q"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "-q", "--seed", "2", "--force"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(file("gas/report.html")));
}

TEST_F(ReportCommand, AlsoOfARunThatKeptNothingButItsSummary) {
  write_text(file("gas.toml"), fifty_disks);
  ASSERT_EQ(carom({"run", "gas.toml", "--no-trajectory", "-q"}).exit_code, 0);
  const Outcome outcome = carom({"report", "gas"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, EndsWith(", no replay: the run kept no samples in a trajectory\n"));
}

TEST_F(ReportCommand, TellsTheHorizonThatTheRunWasAskedFor) {
  const Outcome outcome = carom({"run", "gas.toml", "--verify-horizon", "--report", "--set", "observe={}"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t from = outcome.out.find("In double precision this trajectory");
  ASSERT_NE(from, std::string::npos);
  const std::string sentence = outcome.out.substr(from, outcome.out.find('\n', from) - from);
  EXPECT_THAT(text_of(file("gas/report.html")), AllOf(HasSubstr(sentence), HasSubstr("Horizon of the trajectory")));
}

TEST_F(ReportCommand, AlsoOfFixedSteps) {
  write_text(file("gas.toml"), fifty_disks);
  ASSERT_EQ(carom({"run", "gas.toml", "--method", "naive", "--dt", "0.01", "-q", "--report"}).exit_code, 0);
  EXPECT_THAT(text_of(file("gas/report.html")), HasSubstr("--method naive --dt 0.01"));
  ASSERT_EQ(carom({"run", "gas.toml", "--method", "soft", "--dt", "0.001", "--stiffness", "5000", "-q", "--report", "--force"})
                .exit_code,
            0);
  EXPECT_THAT(text_of(file("gas/report.html")), AllOf(HasSubstr("--method soft --dt 0.001 --stiffness 5000"),
                                                      HasSubstr("method soft, dt = 0.001, stiffness = 5000;")));
}

TEST_F(ReportCommand, RefusesWhatIsNoFinishedRun) {
  refused({"report", "nowhere"}, "nowhere: there is no such directory");
  refused({"report", "gas.toml"}, "gas.toml: this is a file; name the run directory");
  refused({"report", "."}, "no finished run");
  refused({"report"}, "RUN_DIR is missing, the directory that carom run has written");
  fs::create_directory(file("going"));
  write_text(file("going/trajectory.h5md.partial"), "");
  refused({"report", "going"}, "going: this run still goes on");
}

TEST_F(ReportCommand, RefusesDamagedFilesAndWritesNothing) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  const std::string trajectory = text_of(file("gas/trajectory.h5md")), summary = text_of(file("gas/summary.json"));
  write_text(file("gas/trajectory.h5md"), trajectory.substr(0, 3000));
  refused({"report", "gas"}, "gas/trajectory.h5md: HDF5 cannot read this file");
  write_text(file("gas/trajectory.h5md"), trajectory);
  write_text(file("gas/summary.json"), summary.substr(0, 300));
  refused({"report", "gas"}, "gas/summary.json: this is not the summary of a run");
  EXPECT_FALSE(fs::exists(file("gas/report.html")));
}

TEST_F(ReportCommand, RefusesPlacesThatAreTakenOrNoPage) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  refused({"report", "gas", "-o", "report.pdf"}, "-o report.pdf: the report is an HTML page");
  write_text(file("mine.html"), "<p>mine</p>");
  refused({"report", "gas", "-o", "mine.html"}, "mine.html: this file is there already, and is no report");
  EXPECT_EQ(text_of(file("mine.html")), "<p>mine</p>");
  ASSERT_EQ(carom({"play", "gas"}).exit_code, 0);
  refused({"report", "gas", "-o", "gas/player.html"}, "gas/player.html: this file is there already, and is no report");
}

}  // namespace
}  // namespace carom::test
