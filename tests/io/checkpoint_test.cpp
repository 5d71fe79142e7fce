// Checkpoints: what is read back is what was written, and a file that is not to the last bit what was written is never taken for
// one.

#include "io/checkpoint.hpp"

#include "io/output_error.hpp"
#include "support/child_process.hpp"
#include "support/refusal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <istream>
#include <iterator>
#include <ostream>
#include <random>
#include <string>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

CheckpointFacts facts_at(double time) {
  return {.provenance = {.resolved_scene = "[box]\n",
                         .command_line = "carom run ü.toml",
                         .engine = "fast",
                         .time_step = 0.1,
                         .stiffness = 5000.0},
          .scene_source = "ü.toml",
          .scene_text = "# nothing\n",
          .overrides = {"run.time=2"},
          .time = time,
          .collisions = 18446744073709551615U,
          .finished = true,
          .wall_seconds = 1.5,
          .verify = 7,
          .checkpoint_every = "10min",
          .report = true};
}

State two_disks() {
  State state;
  state.positions = Eigen::Matrix2Xd{{1.0, 2.0}, {3.0, 4.0}};
  state.velocities = -state.positions;
  state.images = Images::Zero(2, 2);
  return state;
}

/// More than one buffer of HDF5's stream, not a multiple of it.
const std::string long_part = [] {
  std::string text;
  for (int i = 0; text.size() < 2'500'000; ++i) text += static_cast<char>(i * 37 % 251);
  return text;
}();

void write(const RunDirectory& directory, double time, const std::string& part) {
  write_checkpoint(directory, facts_at(time), two_disks(),
                   {{"empty", [](std::ostream&) {}}, {"part", [&](std::ostream& out) { out << part; }}});
}

std::string part_of(const Checkpoint& checkpoint, const std::string& name) {
  std::string text;
  checkpoint.read(name, [&](std::istream& in) { text.assign(std::istreambuf_iterator<char>(in), {}); });
  return text;
}

std::string refusal_to_open(const fs::path& directory) {
  return refusal<OutputError>([&] { (void)Checkpoint(directory); });
}

TEST(Checkpoint, WhoseWritingWasBrokenOffLeavesNothing) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path(), false);
  write(directory, 3.25, "first");
  EXPECT_THROW(write_checkpoint(directory, facts_at(4.5), two_disks(), {{"part", [](std::ostream&) { throw 0; }}}), int);
  EXPECT_FALSE(fs::exists(directory.partial_name(checkpoint_name)));
  EXPECT_FALSE(fs::exists(directory.final_name(previous_checkpoint_name)));
  EXPECT_EQ(Checkpoint(temporary.path()).facts().time, 3.25);
}

TEST(Checkpoint, HoldsWhatWasWritten) {
  const TemporaryDirectory temporary;
  write(RunDirectory(temporary.path(), false), 3.25, long_part);
  const Checkpoint checkpoint(temporary.path());
  EXPECT_EQ(checkpoint.damage(), "");
  EXPECT_EQ(part_of(checkpoint, "part"), long_part);
  EXPECT_EQ(part_of(checkpoint, "empty"), "");
  EXPECT_TRUE(checkpoint.has("part"));
  EXPECT_FALSE(checkpoint.has("other"));
  const CheckpointFacts expected = facts_at(3.25), &found = checkpoint.facts();
  EXPECT_EQ(found.provenance.resolved_scene, expected.provenance.resolved_scene);
  EXPECT_EQ(found.provenance.command_line, expected.provenance.command_line);
  EXPECT_EQ(found.provenance.engine, expected.provenance.engine);
  EXPECT_EQ(found.provenance.time_step, expected.provenance.time_step);
  EXPECT_EQ(found.provenance.stiffness, expected.provenance.stiffness);
  EXPECT_EQ(found.scene_source, expected.scene_source);
  EXPECT_EQ(found.scene_text, expected.scene_text);
  EXPECT_EQ(found.overrides, expected.overrides);
  EXPECT_EQ(found.time, expected.time);
  EXPECT_EQ(found.collisions, expected.collisions);
  EXPECT_TRUE(found.finished);
  EXPECT_EQ(found.wall_seconds, expected.wall_seconds);
  EXPECT_EQ(found.verify, expected.verify);
  EXPECT_EQ(found.checkpoint_every, expected.checkpoint_every);
  EXPECT_TRUE(found.report);
}

TEST(Checkpoint, TheLastOneStaysBesideTheNew) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path(), false);
  for (const double time : {1.0, 2.0, 3.0}) write(directory, time, "p");
  EXPECT_EQ(Checkpoint(temporary.path()).facts().time, 3.0);
  EXPECT_EQ(checkpoint_facts(temporary.path() / previous_checkpoint_name).time, 2.0);
  fs::remove(temporary.path() / checkpoint_name);
  EXPECT_EQ(Checkpoint(temporary.path()).facts().time, 2.0);
}

TEST(Checkpoint, OneBitAnywhereIsNoticedAndThePreviousOneTaken) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path(), false);
  write(directory, 1.0, "previous");
  write(directory, 2.0, std::string(3000, 'x'));
  const fs::path path = temporary.path() / checkpoint_name;
  const std::string sound = text_of(path);
  std::mt19937 random(1);
  for (int trial = 0; trial < 600; ++trial) {
    std::string damaged = sound;
    const auto byte = trial < 512 ? static_cast<std::size_t>(trial) : random() % sound.size();  // every byte of the head
    damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << random() % 8));
    write_text(path, damaged);
    ASSERT_NE(checkpoint_damage(path), "") << "byte " << byte;
    if (trial % 100 != 0) continue;
    const Checkpoint taken(temporary.path());
    EXPECT_EQ(taken.facts().time, 1.0);
    EXPECT_THAT(taken.damage(), HasSubstr("checkpoint.h5: "));
  }
}

TEST(Checkpoint, CutAnywhereOrGrownIsNoticed) {
  const TemporaryDirectory temporary;
  write(RunDirectory(temporary.path(), false), 2.0, std::string(3000, 'x'));
  const fs::path path = temporary.path() / checkpoint_name;
  const std::string sound = text_of(path);
  std::mt19937 random(2);
  for (int trial = 0; trial < 300; ++trial) {
    write_text(path, sound.substr(0, random() % sound.size()));
    ASSERT_NE(checkpoint_damage(path), "");
  }
  write_text(path, sound + '\0');
  EXPECT_NE(checkpoint_damage(path), "");
  write_text(path, "");
  EXPECT_THAT(refusal_to_open(temporary.path()), HasSubstr("shorter than any checkpoint"));
}

TEST(Checkpoint, WithoutAnyThereIsASentence) {
  const TemporaryDirectory temporary;
  EXPECT_THAT(refusal_to_open(temporary.path()), HasSubstr("there is no checkpoint from which a run could go on"));
}

TEST(Checkpoint, WhatFailsToBeWrittenLeavesTheOldOnesAlone) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path(), false);
  write(directory, 1.0, "p");
  EXPECT_ANY_THROW(write_checkpoint(directory, facts_at(2.0), two_disks(),
                                    {{"part", [](std::ostream&) { throw OutputError("the disk is full"); }}}));
  EXPECT_EQ(Checkpoint(temporary.path()).facts().time, 1.0);
}

}  // namespace
}  // namespace carom::test
