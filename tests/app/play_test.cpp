// carom play: what it writes and says, and what it refuses.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class PlayCommand : public ProgramTest {
 protected:
  PlayCommand() : ProgramTest(fifty_disks) {}
};

TEST_F(PlayCommand, WritesThePlayerOfARunBesideItsFiles) {
  ASSERT_EQ(carom({"run", "gas.toml", "--events", "-q"}).exit_code, 0);
  const Outcome outcome = carom({"play", "gas"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, AllOf(StartsWith("gas/player.html  "), HasSubstr(" kB, an exact replay")));
  EXPECT_THAT(text_of(file("gas/player.html")), StartsWith("<!doctype html>"));
  EXPECT_FALSE(fs::exists(file("gas/player.html.partial")));
  EXPECT_EQ(carom({"play", "gas"}).exit_code, 0);  // a player may be made anew
  EXPECT_EQ(carom({"info", "gas"}).exit_code, 0);
}

TEST_F(PlayCommand, AnotherRunInItsPlaceTakesThePlayerAway) {
  ASSERT_EQ(carom({"run", "gas.toml", "--events", "-q"}).exit_code, 0);
  ASSERT_EQ(carom({"play", "gas"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "-q", "--seed", "2", "--force"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(file("gas/player.html")));
}

TEST_F(PlayCommand, SaysWhenItInterpolates) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  const Outcome outcome = carom({"play", "gas", "-o", "elsewhere.html"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(StartsWith("elsewhere.html  "),
                                 HasSubstr("interpolated between samples: the run kept no event log (carom run --events)")));
}

TEST_F(PlayCommand, RefusesWhatItCannotPlay) {
  refused({"play", "nowhere"}, "nowhere: there is no such directory");
  refused({"play", "gas.toml"}, "gas.toml: this is a file; name the run directory");
  refused({"play", "."}, "no finished run");
  refused({"play"}, "RUN_DIR is missing, the directory that carom run has written");
}

TEST_F(PlayCommand, RefusesPlacesThatAreTakenOrNoPage) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  refused({"play", "gas", "-o", "movie.mp4"}, "-o movie.mp4: the player is an HTML page");
  write_text(file("mine.html"), "<p>mine</p>");
  refused({"play", "gas", "-o", "mine.html"}, "mine.html: this file is there already, and is no player");
  EXPECT_EQ(text_of(file("mine.html")), "<p>mine</p>");
  refused({"play", "gas", "-o", "no/such/place.html"}, "no/such/place.html: cannot write");
}

}  // namespace
}  // namespace carom::test
