// trajectory.h5md read back through HDF5's C interface: every group, dataset and attribute.

#include "io/h5md_writer.hpp"

#include "io/h5md_reader.hpp"
#include "io/hand_made_run.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <carom/version.hpp>

namespace carom::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// The address sanitizer keeps freed memory for a while, so that the size of the process says nothing.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool memory_is_instrumented = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool memory_is_instrumented = true;
#else
constexpr bool memory_is_instrumented = false;
#endif
#else
constexpr bool memory_is_instrumented = false;
#endif

class H5mdFile : public ::testing::Test {
 protected:
  /// Writes `frames` samples and `events` events, and closes.
  std::filesystem::path write(const Scene& scene, std::uint64_t frames, std::size_t events = 0) {
    const std::filesystem::path path = temporary_.path() / "trajectory.h5md";
    H5mdWriter writer(path, scene, hand_made_disks(scene), provenance());
    for (std::uint64_t k = 0; k < frames; ++k) writer.sample(k, state_at(k, scene), {});
    writer.events(events_up_to(events));
    writer.close();
    return path;
  }

  TemporaryDirectory temporary_;
};

TEST_F(H5mdFile, PositionsVelocitiesAndImagesAreTheSamplesBitForBit) {
  const Scene scene = scene_of(3, 2);
  const H5Reader file(write(scene, 50));
  ASSERT_TRUE(file.opens());
  for (const std::string name : {"/position/value", "/velocity/value", "/image/value"})
    EXPECT_THAT(file.extents(particles + name), ElementsAre(50, 5, 3)) << name;
  EXPECT_TRUE(file.has_type(particles + "/position/value", H5T_IEEE_F64LE));
  EXPECT_TRUE(file.has_type(particles + "/velocity/value", H5T_IEEE_F64LE));
  EXPECT_TRUE(file.has_type(particles + "/image/value", H5T_STD_I32LE));
  const std::vector<double> positions = file.doubles(particles + "/position/value");
  const std::vector<double> velocities = file.doubles(particles + "/velocity/value");
  const std::vector<int> images = file.ints(particles + "/image/value");
  std::size_t at = 0;
  for (std::uint64_t k = 0; k < 50; ++k) {
    const State state = state_at(k, scene);
    for (Eigen::Index i = 0; i < 5; ++i) {
      for (Eigen::Index axis = 0; axis < 2; ++axis, ++at) {
        ASSERT_EQ(positions[at], state.positions(axis, i));
        ASSERT_EQ(velocities[at], state.velocities(axis, i));
        ASSERT_EQ(images[at], state.images(axis, i));
      }
      ASSERT_EQ(positions[at], 0.0);
      ASSERT_EQ(velocities[at], 0.0);
      ASSERT_EQ(images[at], 0);
      ++at;
    }
  }
}

TEST_F(H5mdFile, StepAndTimeAreFullLengthAndOneObjectEverywhere) {
  const Scene scene = scene_of(1, 1);
  const H5Reader file(write(scene, 30));
  EXPECT_TRUE(file.has_type(particles + "/position/step", H5T_STD_I64LE));
  EXPECT_TRUE(file.has_type(particles + "/position/time", H5T_IEEE_F64LE));
  const std::vector<int> steps = file.ints(particles + "/position/step");
  const std::vector<double> times = file.doubles(particles + "/position/time");
  ASSERT_EQ(steps.size(), 30u);
  ASSERT_EQ(times.size(), 30u);
  for (std::size_t k = 0; k < 30; ++k) {
    EXPECT_EQ(steps[k], static_cast<int>(k));
    EXPECT_EQ(times[k], static_cast<double>(k) * 0.1);
  }
  for (const std::string& group : {particles + "/velocity", particles + "/image", particles + "/box/edges",
                                   std::string("/observables/kinetic_energy"), std::string("/observables/temperature")}) {
    EXPECT_TRUE(file.same_object(particles + "/position/step", group + "/step")) << group;
    EXPECT_TRUE(file.same_object(particles + "/position/time", group + "/time")) << group;
  }
}

TEST_F(H5mdFile, TheBoxIsThreeDimensionalWithEdgesForEverySample) {
  const H5Reader file(write(scene_of(1, 1), 4));
  EXPECT_THAT(file.numbers<int>(particles + "/box", "dimension", H5T_NATIVE_INT), ElementsAre(3));
  EXPECT_THAT(file.strings(particles + "/box", "boundary"), ElementsAre("periodic", "none", "none"));
  EXPECT_THAT(file.numbers<double>(particles + "/box", "origin", H5T_NATIVE_DOUBLE), ElementsAre(-1.0, 10.0, -2.0));
  EXPECT_THAT(file.extents(particles + "/box/edges/value"), ElementsAre(4, 3, 3));
  const std::vector<double> edges = file.doubles(particles + "/box/edges/value");
  for (std::size_t k = 0; k < 4; ++k) {
    const std::vector<double> one(edges.begin() + static_cast<std::ptrdiff_t>(9 * k),
                                  edges.begin() + static_cast<std::ptrdiff_t>(9 * k + 9));
    EXPECT_THAT(one, ElementsAre(4.0, 0, 0, 0, 2.5, 0, 0, 0, 4.0));
  }
}

TEST_F(H5mdFile, WhatNoSampleChangesIsStoredOnce) {
  const H5Reader file(write(scene_of(2, 1), 2));
  EXPECT_THAT(file.ints(particles + "/id"), ElementsAre(0, 1, 2));
  EXPECT_THAT(file.ints(particles + "/species"), ElementsAre(0, 0, 1));
  EXPECT_THAT(file.doubles(particles + "/mass"), ElementsAre(2.0, 2.0, 0.1));
  EXPECT_THAT(file.doubles(particles + "/radius"), ElementsAre(0.03, 0.03, 0.01));
}

TEST_F(H5mdFile, UnitsAreStringsThatReadersKnow) {
  const H5Reader file(write(scene_of(1, 0), 1, 1));
  EXPECT_EQ(file.text(particles + "/position/value", "unit"), "Angstrom");
  EXPECT_EQ(file.text(particles + "/velocity/value", "unit"), "Angstrom ps-1");
  EXPECT_EQ(file.text(particles + "/position/time", "unit"), "ps");
  EXPECT_EQ(file.text(particles + "/box/edges/value", "unit"), "Angstrom");
}

TEST_F(H5mdFile, OneGroupOfParticlesAndObservablesInStepWithTheSamples) {
  Scene scene = scene_of(1, 1);
  scene.output.events = true;
  const H5Reader file(write(scene, 3, 7));
  EXPECT_THAT(file.members("/"), ElementsAre("events", "h5md", "observables", "parameters", "particles"));
  EXPECT_THAT(file.members("/particles"), ElementsAre("trajectory"));
  for (const std::string& name : file.members("/observables")) {
    EXPECT_THAT(file.members("/observables/" + name), ElementsAre("step", "time", "value"));
    EXPECT_EQ(file.extents("/observables/" + name + "/value")[0], file.extents(particles + "/position/step")[0]);
  }
}

TEST_F(H5mdFile, ObservablesAreEnergyAndTemperatureOfEachSample) {
  Scene scene = scene_of(2, 0);
  scene.species.pop_back();
  const std::filesystem::path path = temporary_.path() / "trajectory.h5md";
  H5mdWriter writer(path, scene, hand_made_disks(scene), provenance());
  State state = state_at(0, scene);
  state.velocities << 1.0, 0.0, 2.0, -2.0;  // disk 0: (1, 2), disk 1: (0, -2), both of mass 2
  writer.sample(0, state, {});
  writer.close();
  const H5Reader file(path);
  EXPECT_THAT(file.doubles("/observables/kinetic_energy/value"), ElementsAre(9.0));
  // The periodic x axis keeps its momentum, so its common motion (total mass 4, speed 1/2: energy 1/2) is no heat:
  // kT = 2 (9 - 1/2) / (4 - 1)
  EXPECT_THAT(file.doubles("/observables/temperature/value"), ElementsAre(::testing::DoubleEq(17.0 / 3.0)));
}

TEST_F(H5mdFile, ProvenanceIsComplete) {
  Scene scene = scene_of(1, 1);
  const H5Reader file(write(scene, 1));
  EXPECT_THAT(file.numbers<int>("/h5md", "version", H5T_NATIVE_INT), ElementsAre(1, 1));
  EXPECT_FALSE(file.text("/h5md/author", "name").empty());
  EXPECT_EQ(file.text("/h5md/creator", "name"), "carom");
  EXPECT_EQ(file.text("/h5md/creator", "version"), build_info().version);
  EXPECT_EQ(file.text("/parameters", "title"), scene.title);
  EXPECT_EQ(file.text("/parameters", "scene"), scene.text);
  EXPECT_EQ(file.text("/parameters", "scene_source"), "hand_made.toml");
  EXPECT_THAT(file.strings("/parameters", "overrides"), ElementsAre("run.seed=18446744073709551615"));
  EXPECT_EQ(file.text("/parameters", "resolved_scene"), provenance().resolved_scene);
  EXPECT_EQ(file.text("/parameters", "command_line"), provenance().command_line);
  EXPECT_EQ(file.text("/parameters", "engine"), "by hand");
  EXPECT_EQ(file.text("/parameters", "version"), build_info().version);
  EXPECT_EQ(file.text("/parameters", "commit"), build_info().commit);
  EXPECT_EQ(file.text("/parameters", "compiler"), build_info().compiler);
  EXPECT_EQ(file.text("/parameters", "flags"), build_info().flags);
  EXPECT_EQ(file.text("/parameters", "positions"), "wrapped");
  EXPECT_THAT(file.text("/parameters", "units"), HasSubstr("reduced"));
  EXPECT_THAT(file.strings("/parameters", "species_names"), ElementsAre("large", "small"));
  EXPECT_THAT(file.numbers<int>("/parameters", "spatial_dimension", H5T_NATIVE_INT), ElementsAre(2));
  EXPECT_THAT(file.numbers<double>("/parameters", "sample_every", H5T_NATIVE_DOUBLE), ElementsAre(0.1));
  EXPECT_THAT(file.numbers<std::uint64_t>("/parameters", "seed", H5T_NATIVE_UINT64),
              ElementsAre(std::numeric_limits<std::uint64_t>::max()));
}

TEST_F(H5mdFile, AVeryLongSceneIsStoredWhole) {
  Scene scene = scene_of(1, 0);
  scene.text.assign(5'000'000, 'x');
  scene.text += "end";
  const H5Reader file(write(scene, 1));
  EXPECT_EQ(file.text("/parameters", "scene"), scene.text);
}

TEST_F(H5mdFile, EventsAreStoredInFullPrecisionAcrossManyChunks) {
  Scene scene = scene_of(5, 4);
  scene.output.events = true;
  constexpr std::size_t count = 20'001;
  const H5Reader file(write(scene, 0, count));
  const std::vector<double> time = file.doubles("/events/time");
  const std::vector<double> remainder = file.doubles("/events/time_remainder");
  const std::vector<int> disk = file.ints("/events/disk");
  const std::vector<int> partner = file.ints("/events/partner");
  EXPECT_THAT(file.extents("/events/velocity"), ElementsAre(count, 2));
  EXPECT_THAT(file.extents("/events/partner_velocity"), ElementsAre(count, 2));
  const std::vector<double> velocity = file.doubles("/events/velocity");
  const std::vector<double> partner_velocity = file.doubles("/events/partner_velocity");
  ASSERT_EQ(time.size(), count);
  ASSERT_EQ(remainder.size(), count);
  ASSERT_EQ(disk.size(), count);
  ASSERT_EQ(partner.size(), count);
  for (std::size_t e = 0; e < count; ++e) {
    const Event event = event_number(e);
    ASSERT_EQ(time[e], event.time);
    ASSERT_EQ(remainder[e], event.time_remainder);
    ASSERT_EQ(disk[e], event.disk);
    ASSERT_EQ(partner[e], event.partner);
    ASSERT_EQ(velocity[2 * e], event.velocity.x());
    ASSERT_EQ(velocity[2 * e + 1], event.velocity.y());
    ASSERT_EQ(partner_velocity[2 * e], event.partner_velocity.x());
    ASSERT_EQ(partner_velocity[2 * e + 1], event.partner_velocity.y());
  }
}

TEST_F(H5mdFile, WithoutEventsThereIsNoSuchGroup) {
  const H5Reader file(write(scene_of(1, 1), 1, 10));
  EXPECT_LE(H5Lexists(file.id(), "/events", H5P_DEFAULT), 0);
}

TEST_F(H5mdFile, WithoutSamplesTheShapesStillTellTheNumberOfDisks) {
  Scene scene = scene_of(4, 3);
  scene.run.sample_every.reset();
  scene.output.events = true;
  const H5Reader file(write(scene, 0, 2));
  EXPECT_THAT(file.extents(particles + "/position/value"), ElementsAre(0, 7, 3));
  EXPECT_THAT(file.extents(particles + "/position/step"), ElementsAre(0));
  EXPECT_THAT(file.extents("/events/time"), ElementsAre(2));
}

TEST_F(H5mdFile, UnwrappedPositionsAreMarked) {
  Scene scene = scene_of(1, 1);
  scene.output.unwrapped = true;
  const H5Reader file(write(scene, 1));
  EXPECT_EQ(file.text("/parameters", "positions"), "unwrapped");
}

TEST_F(H5mdFile, ChunksHoldManySamplesOfFewDisksAndPartsOfASampleOfMany) {
  {
    const H5Reader file(write(scene_of(1, 0), 1));
    EXPECT_THAT(file.chunk(particles + "/position/value"), ElementsAre(1024, 1, 3));
  }
  {
    Scene brief = scene_of(1, 0);
    brief.run.time = 0.5;  // samples 0 .. 5: no chunk need be larger
    const H5Reader file(write(brief, 6));
    EXPECT_THAT(file.chunk(particles + "/position/value"), ElementsAre(6, 1, 3));
  }
  const H5Reader file(write(scene_of(50'000, 0), 1));
  const std::vector<hsize_t> chunk = file.chunk(particles + "/position/value");
  EXPECT_EQ(chunk[0], 1u);
  EXPECT_LE(chunk[1] * 24, hsize_t{1} << 20);
  EXPECT_EQ(chunk[2], 3u);
}

TEST_F(H5mdFile, MoreImagesThanTheFileCanCountAreAnErrorAndNotANumber) {
  const Scene scene = scene_of(1, 0);
  H5mdWriter writer(temporary_.path() / "t.h5md", scene, hand_made_disks(scene), provenance());
  State state = state_at(0, scene);
  state.images(0, 0) = std::int64_t{1} << 31;
  EXPECT_THAT(refusal<OutputError>([&] { writer.sample(0, state, {}); }), HasSubstr("2147483648"));
}

TEST_F(H5mdFile, AFlushMakesEverythingSoFarReadableWhileTheRunGoesOn) {
  const Scene scene = scene_of(3, 2);
  const std::filesystem::path path = temporary_.path() / "t.h5md";
  H5mdWriter writer(path, scene, hand_made_disks(scene), provenance());
  for (std::uint64_t k = 0; k < 10; ++k) writer.sample(k, state_at(k, scene), {});
  EXPECT_EQ(writer.safe_samples(), 0u);
  writer.flush();
  EXPECT_EQ(writer.safe_samples(), 10u);
  for (std::uint64_t k = 10; k < 15; ++k) writer.sample(k, state_at(k, scene), {});
  // another name for the file, because HDF5 would give the open file itself to a reader in the same process
  std::filesystem::copy_file(path, temporary_.path() / "copy.h5md");
  const H5Reader file(temporary_.path() / "copy.h5md");
  ASSERT_TRUE(file.opens());
  EXPECT_THAT(file.extents(particles + "/position/value"), ElementsAre(10, 5, 3));
  EXPECT_EQ(file.doubles(particles + "/velocity/value").back(), 0.0);
}

TEST_F(H5mdFile, AFileThatCannotBeCreatedIsNamed) {
  const Scene scene = scene_of(1, 0);
  EXPECT_THAT(refusal<OutputError>([&] { const H5mdWriter writer("/proc/t.h5md", scene, hand_made_disks(scene), provenance()); }),
              AllOf(HasSubstr("/proc/t.h5md: cannot create it"), HasSubstr("; check the disk")));
}

TEST_F(H5mdFile, MemoryDoesNotGrowWithTheNumberOfSamples) {
  const Scene scene = scene_of(60, 40);
  H5mdWriter writer(temporary_.path() / "t.h5md", scene, hand_made_disks(scene), provenance());
  const auto resident = [] {
    std::size_t total = 0;
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> total >> pages;
    return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  };
  std::size_t before = 0;
  std::size_t most = 0;
  for (std::uint64_t k = 0; k < 10'000; ++k) {
    writer.sample(k, state_at(k, scene), {});
    if (k % 100 == 99) writer.flush();
    if (k == 500) before = resident();
    most = std::max(most, writer.buffered_bytes());
  }
  // At most one chunk of 256 KiB per dataset, in a vector that may have doubled, and the pages of the index between two
  // flushes.
  EXPECT_LT(most, std::size_t{3} << 20);
  // 60 MB went to the file since `before`; HDF5's caches may still fill up.
  if (!memory_is_instrumented) {
    EXPECT_LT(resident(), before + (std::size_t{16} << 20));
  }
  writer.close();
  EXPECT_GT(std::filesystem::file_size(temporary_.path() / "t.h5md"), std::size_t{60'000'000});
}

}  // namespace
}  // namespace carom::test
