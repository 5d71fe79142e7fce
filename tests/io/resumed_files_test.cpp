// Files of a run that goes on: what was written after the moment at which they were saved is gone, and then written again.

#include "io/h5md_writer.hpp"
#include "io/run_writer.hpp"
#include "io/text_file.hpp"

#include "io/h5md_reader.hpp"
#include "io/hand_made_run.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::vector<std::string> datasets = {"/particles/trajectory/position/value",
                                           "/particles/trajectory/position/time",
                                           "/particles/trajectory/velocity/value",
                                           "/particles/trajectory/image/value",
                                           "/observables/kinetic_energy/value",
                                           "/events/time",
                                           "/events/disk",
                                           "/events/velocity"};

void write_part(H5mdWriter& writer, const Scene& scene, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t k = from; k < to; ++k) {
    writer.sample(k, state_at(k, scene), {});
    writer.events(events_up_to(40));
  }
}

void expect_same_data(const fs::path& a, const fs::path& b) {
  const H5Reader one(a), other(b);
  ASSERT_TRUE(one.opens());
  ASSERT_TRUE(other.opens());
  for (const std::string& name : datasets) {
    EXPECT_EQ(one.extents(name), other.extents(name)) << name;
    EXPECT_EQ(one.doubles(name), other.doubles(name)) << name;
  }
}

class ResumedTrajectory : public ::testing::Test {
 protected:
  ResumedTrajectory() {
    scene.output.events = true;
    H5mdWriter writer(whole, scene, all_disks, provenance());
    write_part(writer, scene, 0, 1500);
    writer.close();
  }

  const TemporaryDirectory temporary;
  const fs::path whole = temporary.path() / "whole.h5md", path = temporary.path() / "t.h5md";
  Scene scene = scene_of(3, 3);
  const Disks all_disks = hand_made_disks(scene);
};

TEST_F(ResumedTrajectory, IsCutBackAndGoesOn) {
  for (const std::uint64_t saved_at : {0U, 1U, 700U, 1499U}) {
    std::stringstream saved;
    {
      H5mdWriter writer(path, scene, all_disks, provenance());
      write_part(writer, scene, 0, saved_at);
      writer.save(saved);
      write_part(writer, scene, 9000, 9900);  // what never was to happen
      writer.flush();
    }
    H5mdWriter writer(path, scene, all_disks, provenance(), saved);
    write_part(writer, scene, saved_at, 1500);
    writer.close();
    expect_same_data(whole, path);
  }
}

TEST_F(ResumedTrajectory, WhateverHasBecomeOfItsIndexMeanwhile) {
  std::stringstream saved;
  {
    H5mdWriter writer(path, scene, all_disks, provenance());
    write_part(writer, scene, 0, 700);
    writer.save(saved);
    write_part(writer, scene, 9000, 9900);
  }
  // As after a power cut in the middle of a flush: the index, which is everything that HDF5 finds its way by, is lost.
  std::string content = text_of(path);
  content.replace(0, 4096, std::string(4096, '?'));
  write_text(path, content);
  ASSERT_FALSE(H5Reader(path).opens());
  H5mdWriter writer(path, scene, all_disks, provenance(), saved);
  write_part(writer, scene, 700, 1500);
  writer.close();
  expect_same_data(whole, path);
}

TEST_F(ResumedTrajectory, OneThatWasCutIsRefused) {
  std::stringstream saved;
  {
    H5mdWriter writer(path, scene, all_disks, provenance());
    write_part(writer, scene, 0, 700);
    writer.save(saved);
  }
  fs::resize_file(path, 5000);
  EXPECT_THAT(refusal<OutputError>([&] { const H5mdWriter writer(path, scene, all_disks, provenance(), saved); }),
              HasSubstr("the file has 5000 bytes and must have "));
}

TEST(ResumedText, KeepsItsFirstBytesAndNoMore) {
  const TemporaryDirectory temporary;
  const fs::path path = temporary.path() / "t.csv";
  write_text(path, "one\ntwo\nthree\n");
  detail::TextFile file(path, 8);
  file.buffer() += "2b\n";
  file.close();
  EXPECT_EQ(file.written(), 11U);
  EXPECT_EQ(text_of(path), "one\ntwo\n2b\n");
}

TEST(ResumedDirectory, TakesBackWhatGrowsAndRemovesWhatTellsOfAnEnd) {
  const TemporaryDirectory temporary;
  for (const char* name :
       {"trajectory.h5md", "samples.csv", "observe_speeds.csv", "report.html", "summary.json", "checkpoint.h5", "mine.txt"})
    write_text(temporary.path() / name, name);
  RunDirectory::reopen(temporary.path()).take_back();
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(temporary.path())) names.push_back(entry.path().filename().string());
  EXPECT_THAT(names,
              ::testing::UnorderedElementsAre("trajectory.h5md.partial", "samples.csv.partial", "checkpoint.h5", "mine.txt"));
}

TEST(RunDirectoryLock, IsTakenOnceAndGivenBack) {
  const TemporaryDirectory temporary;
  {
    const RunDirectory first(temporary.path(), false);
    const RunDirectory copy = first;  // NOLINT: the lock is shared
    EXPECT_THROW((void)RunDirectory::reopen(temporary.path()), OutputError);
    EXPECT_THROW((void)RunDirectory(temporary.path(), true), OutputError);
  }
  EXPECT_NO_THROW((void)RunDirectory::reopen(temporary.path()));
}

}  // namespace
}  // namespace carom::test
