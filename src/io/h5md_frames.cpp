// Samples as H5MD 1.1, in the shape that MDAnalysis 2.4 reads: three dimensions, a box as thick as it is long, so that no search
// for neighbours meets the images of a disk above and below it, edges for every sample, steps and times in full and hard-linked
// everywhere, units that it knows. The links also keep the file small.

#include "io/h5md_frames.hpp"

#include "io/h5md_parts.hpp"
#include "observe/geometry.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <string>
#include <vector>

namespace carom::detail {

namespace {

const std::string length_unit = "Angstrom";
const std::string time_unit = "ps";
const std::string velocity_unit = "Angstrom ps-1";

std::string boundary_name(const Box& box, int axis) { return box.periodic(axis) ? "periodic" : "none"; }

}  // namespace

struct H5mdFrames::Groups {
  explicit Groups(hid_t file)
      : particles(create_group(file, "particles")),
        trajectory(create_group(particles.get(), "trajectory")),
        box(create_group(trajectory.get(), "box")),
        edges(create_group(box.get(), "edges")),
        position(create_group(trajectory.get(), "position")),
        velocity(create_group(trajectory.get(), "velocity")),
        image(create_group(trajectory.get(), "image")) {}

  Hdf5Id particles, trajectory, box, edges, position, velocity, image;
};

H5mdFrames::H5mdFrames(hid_t file, const Scene& scene, const Disks& disks) : H5mdFrames(file, Groups(file), scene, disks) {}

H5mdFrames::H5mdFrames(hid_t file, const Groups& groups, const Scene& scene, const Disks& disks)
    : box_(scene.box),
      step_(groups.position.get(), "step", frame_layout(scene, sizeof(std::int64_t), {})),
      time_(groups.position.get(), "time", frame_layout(scene, sizeof(double), {})),
      position_(groups.position.get(), "value", frame_layout(scene, sizeof(double), {disks.count(), 3})),
      velocity_(groups.velocity.get(), "value", frame_layout(scene, sizeof(double), {disks.count(), 3})),
      image_(groups.image.get(), "value", frame_layout(scene, sizeof(std::int32_t), {disks.count(), 3})),
      edges_(groups.edges.get(), "value", frame_layout(scene, sizeof(double), {3, 3})),
      observables_(file, scene, disks) {
  for (const std::string group : {"velocity", "image", "box/edges"}) link_steps_and_times(file, "particles/trajectory/" + group);
  write_attribute(time_.id(), "unit", time_unit);
  write_attribute(position_.id(), "unit", length_unit);
  write_attribute(velocity_.id(), "unit", velocity_unit);
  write_attribute(edges_.id(), "unit", length_unit);

  write_attribute(groups.box.get(), "dimension", std::int64_t{3});
  write_attribute(groups.box.get(), "boundary", std::vector<std::string>{boundary_name(box_, 0), boundary_name(box_, 1), "none"});
  // H5MD 1.1 has no place for it, and its readers take the box to begin at zero.
  write_attribute(groups.box.get(), "origin", std::array{box_.lower.x(), box_.lower.y(), -0.5 * box_.lengths().maxCoeff()});

  std::vector<std::int32_t> ids(disks.count());
  std::iota(ids.begin(), ids.end(), 0);
  write_fixed(groups.trajectory.get(), "id", ids);
  write_fixed(groups.trajectory.get(), "species", disks.species);
  write_fixed(groups.trajectory.get(), "mass", disks.mass);
  write_fixed(groups.trajectory.get(), "radius", disks.radius);
}

void H5mdFrames::append(std::uint64_t k, const Disks& disks, const State& state, const Totals& totals,
                        const Eigen::Matrix2Xd& positions) {
  step_.add(static_cast<std::int64_t>(k));
  time_.add(state.time);
  observables_.append(disks, state, totals);
  const Eigen::Vector2d lengths = box_of(box_, state).lengths();
  const auto edges = edges_.add_row();
  edges[0] = lengths.x();
  edges[3] = tilt_of(lengths, state);
  edges[4] = lengths.y();
  edges[8] = lengths.maxCoeff();

  const auto position = position_.add_row();
  const auto velocity = velocity_.add_row();
  const auto image = image_.add_row();
  std::size_t at = 0;
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i, at += 3) {
    for (int axis = 0; axis < 2; ++axis) {
      const std::size_t place = at + static_cast<std::size_t>(axis);
      position[place] = positions(axis, i);
      velocity[place] = state.velocities(axis, i);
      const auto narrow = static_cast<std::int32_t>(state.images(axis, i));
      if (narrow != state.images(axis, i))
        throw Hdf5Error(
            fmt::format("disk {} has gone {} times through the box, more than the file's 32-bit image flags can "
                        "count; end the run earlier",
                        i, state.images(axis, i)));
      image[place] = narrow;
    }
  }
}

void H5mdFrames::write() {
  step_.write();
  image_.write();
  observables_.write();
  for (auto* column : {&time_, &position_, &velocity_, &edges_}) column->write();
}

void H5mdFrames::close() {
  step_.close();
  image_.close();
  observables_.close();
  for (auto* column : {&time_, &position_, &velocity_, &edges_}) column->close();
}

std::size_t H5mdFrames::buffered_bytes() const {
  std::size_t bytes = step_.buffered_bytes() + image_.buffered_bytes() + observables_.buffered_bytes();
  for (const auto* column : {&time_, &position_, &velocity_, &edges_}) bytes += column->buffered_bytes();
  return bytes;
}

}  // namespace carom::detail
