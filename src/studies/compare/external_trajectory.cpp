#include "studies/compare/external_trajectory.hpp"

#include "io/json.hpp"
#include "neighbours/disks_at_rest.hpp"
#include "observe/mechanics.hpp"
#include "studies/compare/flown_overlaps.hpp"
#include "studies/distance_table.hpp"
#include "text/numbers.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace carom {

namespace {

void require_start(const Box& box, const State& frame, const State& start, double diameter) {
  if (frame.time != 0.0) return;
  const DistanceAt apart = distance_at(box, frame, start);
  if (apart.largest <= parted_diameters * diameter) return;
  throw std::invalid_argument(fmt::format(
      "the first frame is not the start of this scene: disk {} is at ({:g}, {:g}) and the scene begins with it at ({:g}, {:g}); "
      "begin with what carom run --csv writes at time 0",
      apart.disk, frame.positions(0, apart.disk), frame.positions(1, apart.disk), start.positions(0, apart.disk),
      start.positions(1, apart.disk)));
}

}  // namespace

std::optional<ExternalTrajectory> compare_trajectory(const Scene& scene, const State& start, const std::vector<State>& frames,
                                                     const std::function<bool(double)>& proceed) {
  Simulation exact = make_simulation(scene, start, "textbook-quad");
  const Disks& disks = exact.disks();
  const auto count = static_cast<double>(disks.count());
  ExternalTrajectory result;
  if (count > 0.0) result.diameter = disks.mean_diameter();
  require_start(scene.box, frames.front(), start, result.diameter);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (!proceed(static_cast<double>(k) / static_cast<double>(frames.size()))) return std::nullopt;
    const State& frame = frames[k];
    exact.run_until(frame.time);
    if (exact.time() < frame.time * (1.0 - 1e-12))
      throw std::invalid_argument(
          fmt::format("the exact trajectory ends at t = {:g}, before the frame at t = {:g}", exact.time(), frame.time));
    result.distances.push_back(distance_at(scene.box, frame, exact.state()));
    if (!result.departure && departure({result.distances.back()}, result.diameter)) {
      result.departure = result.distances.back();
      result.departure_collisions = 2.0 * static_cast<double>(exact.totals().pair) / count;
    }
    const double overlap = deepest_overlap(scene.box, disks.radius, frame.positions).relative;
    if (overlap > overlap_tolerance) ++result.overlapping;
    if (overlap > result.deepest_overlap) {
      result.deepest_overlap = overlap;
      result.deepest_time = frame.time;
    }
    if (frame.velocities.cols() == 0) continue;
    const double initial = kinetic_energy(disks, frames.front());
    if (!(initial > 0.0)) continue;
    result.energy_drift = kinetic_energy(disks, frame) / initial - 1.0;
    result.largest_energy_drift = std::max(result.largest_energy_drift.value_or(0.0), std::abs(*result.energy_drift));
  }
  return result;
}

std::string external_trajectory_text(const ExternalTrajectory& of, const Scene& scene, const std::string& file) {
  std::string text =
      fmt::format("{} against exact events (113 bits) from the start of {}\n\n{}\n  distances in mean diameters\n\n", file,
                  scene.source, distance_table(of.distances, of.diameter));
  text += of.departure ? fmt::format("it departs by {:g} diameters at t = {:.6g}, after {:.3g} collisions per disk\n",
                                     parted_diameters, of.departure->time, *of.departure_collisions)
                       : fmt::format("it stays within {:g} diameters in all {}\n", parted_diameters,
                                     counted(of.distances.size(), "frame"));
  text += of.overlapping > 0
              ? fmt::format("disks overlap in {} of {}, by up to {:.2g} of the contact distance (at t = {:.6g})\n",
                            of.overlapping, counted(of.distances.size(), "frame"), of.deepest_overlap, *of.deepest_time)
              : std::string("disks overlap in no frame\n");
  if (of.energy_drift)
    text += fmt::format("energy changes by {:.2g} of its initial value until the last frame, and by {:.2g} at most\n",
                        *of.energy_drift, *of.largest_energy_drift);
  return text;
}

std::string external_trajectory_json(const ExternalTrajectory& of, const Scene& scene, const std::string& file) {
  detail::Json json;
  json["carom"] = detail::build_json();
  json["scene"] = scene.source;
  json["trajectory"] = file;
  json["diameter"] = of.diameter;
  json["departure"] = of.departure ? detail::Json{{"time", of.departure->time}, {"collisions_per_disk", *of.departure_collisions}}
                                   : detail::Json(nullptr);
  json["overlapping_frames"] = of.overlapping;
  json["deepest_overlap"] = of.deepest_overlap;
  json["deepest_overlap_time"] = detail::number(of.deepest_time);
  json["energy_drift"] = detail::number(of.energy_drift);
  json["largest_energy_drift"] = detail::number(of.largest_energy_drift);
  json["distances"] = distances_json(of.distances, of.diameter);
  return json.dump(2, ' ', false, detail::Json::error_handler_t::replace);
}

}  // namespace carom
