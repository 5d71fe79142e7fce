#include "studies/diff/text.hpp"

#include "io/json.hpp"
#include "scene/walls.hpp"
#include "studies/distance_table.hpp"
#include "text/numbers.hpp"
#include "text/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace carom {

namespace {

using detail::Json;
using detail::number;

std::string partners(const Event& event) {
  if (event.partner >= 0) return fmt::format("disks {} and {}", event.disk, event.partner);
  if (event.partner <= first_obstacle) return fmt::format("disk {} and obstacle {}", event.disk, first_obstacle - event.partner);
  return fmt::format("disk {} and the {} wall", event.disk, wall_names[static_cast<std::size_t>(wall_left - event.partner)]);
}

std::string verdict(const RunDifference& of) {
  const std::string both = fmt::format("{} and {}", of.names[0], of.names[1]);
  const bool hashed = !of.state_hash[0].empty() && !of.state_hash[1].empty();
  if (of.same())
    return fmt::format("{} are the same run: {}all {} are equal to the last bit\n", both,
                       hashed ? fmt::format("state hash {}, and ", of.state_hash[0]) : "", counted(of.samples[0], "sample"));
  std::string why;
  if (hashed && of.state_hash[0] != of.state_hash[1])
    why = fmt::format("state hash {} against {}; ", of.state_hash[0], of.state_hash[1]);
  if (of.samples[0] != of.samples[1]) why += fmt::format("{} against {}; ", of.samples[0], counted(of.samples[1], "sample"));
  return fmt::format("{} differ: {}{} equal to the last bit\n", both, why,
                     of.equal_samples == 0   ? "not even the first sample is"
                     : of.equal_samples == 1 ? "the first sample is"
                                             : fmt::format("the first {} samples are", of.equal_samples));
}

std::string distances_at_samples(const RunDifference& of) {
  return fmt::format("{}\n  distances in mean diameters, at {} of {} common sample times\n",
                     distance_table(of.distances, of.diameter), std::min(of.distances.size(), most_distance_rows),
                     of.distances.size());
}

std::string log_sentence(const RunDifference& of) {
  if (!of.log) {
    const std::string who = !of.has_events[0] && !of.has_events[1] ? "neither run" : of.names[of.has_events[0] ? 1 : 0];
    return fmt::format("collisions: not compared; {} has {} event log (carom run --events)\n", who,
                       who == "neither run" ? "an" : "no");
  }
  if (!of.log->first) return fmt::format("collisions: all {} that both have are of the same disks\n", grouped(of.log->equal));
  const std::array<Numbered, 2>& first = *of.log->first;
  const std::string text = "the first collision that differs:\n";
  TerminalTable table("lrrl");
  for (std::size_t r = 0; r < 2; ++r)
    table.add({of.names[r], "no. " + grouped(first[r].number), fmt::format("t = {:.10g}", first[r].event.time),
               partners(first[r].event)});
  return text + table.text();
}

std::string overlap_sentence(const RunDifference& of) {
  std::string text = "deepest overlap at the samples, in contact distances:\n";
  TerminalTable table("lrl");
  for (std::size_t r = 0; r < 2; ++r) {
    const SampledOverlap& deepest = of.overlap[r];
    if (deepest.relative > 0.0) {
      table.add({of.names[r], fmt::format("{:.2g}", deepest.relative),
                 fmt::format("disks {} and {} at t = {:.6g}", deepest.first, deepest.second, deepest.time)});
    } else {
      table.add({of.names[r], "none", ""});
    }
  }
  return text + table.text();
}

Json event_json(const Numbered& one) {
  const Event& event = one.event;
  return {{"number", one.number}, {"time", number(event.time)}, {"disk", event.disk}, {"partner", event.partner}};
}

}  // namespace

std::string diff_text(const RunDifference& of) {
  const std::optional<DistanceAt> parted = departure(of.distances, of.diameter);
  const std::string when =
      parted ? fmt::format("the rms distance first exceeds {:g} diameters at t = {:.6g}\n", parted_diameters, parted->time)
             : fmt::format("the rms distance never exceeds {:g} diameters\n", parted_diameters);
  return fmt::format("{}\n{}\n{}{}{}", verdict(of), distances_at_samples(of), when, log_sentence(of), overlap_sentence(of));
}

std::string diff_json(const RunDifference& of) {
  Json json;
  json["carom"] = detail::build_json();
  json["same"] = of.same();
  for (std::size_t r = 0; r < 2; ++r) {
    const SampledOverlap& deepest = of.overlap[r];
    const bool overlaps = deepest.relative > 0.0;
    json["runs"].push_back({{"path", of.names[r]},
                            {"state_hash", of.state_hash[r].empty() ? Json(nullptr) : Json(of.state_hash[r])},
                            {"samples", of.samples[r]},
                            {"deepest_overlap", number(deepest.relative)},
                            {"deepest_overlap_time", overlaps ? number(deepest.time) : Json(nullptr)},
                            {"deepest_overlap_disks", overlaps ? Json::array({deepest.first, deepest.second}) : Json(nullptr)}});
  }
  json["equal_samples"] = of.equal_samples;
  json["diameter"] = number(of.diameter);
  const std::optional<DistanceAt> parted = departure(of.distances, of.diameter);
  json["parted_at"] = parted ? number(parted->time) : Json(nullptr);
  json["distances"] = distances_json(of.distances, of.diameter);
  json["equal_collisions"] = of.log ? Json(of.log->equal) : Json(nullptr);
  json["first_different_collision"] = nullptr;
  if (of.log && of.log->first) {
    const std::array<Numbered, 2>& first = *of.log->first;
    json["first_different_collision"] = Json::array({event_json(first[0]), event_json(first[1])});
  }
  // A path need not be UTF-8, and JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace carom
