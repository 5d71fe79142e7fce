// Recordings of runs in files and in memory.

#include "pages/recording.hpp"

#include <memory>

namespace carom {

Recording::Recording(const RunReader& run)
    : scene(run.scene()),
      disks(run.disks()),
      species_names(run.species_names()),
      title(run.title()),
      facts(run.facts()),
      Z(run.Z()),
      end(run.end()),
      samples(run.samples()),
      events(run.events()),
      why_no_log(run.has_event_log() ? "" : "the run kept no event log (carom run --events)") {
  const auto reader = std::make_shared<const RunReader>(run);
  sample = [reader](std::uint64_t k) { return reader->sample(k); };
  sample_times = [reader] { return reader->sample_times(); };
  event_log = [reader] { return reader->event_log(); };
}

Recording recording_in_memory(const Scene& scene, const Disks& disks, std::vector<State> samples, std::vector<Event> events) {
  const double begin = samples.front().time;
  Recording recording = recording_in_memory(scene, disks, std::move(samples), "");
  for (Event& event : events) event.time -= begin;
  recording.events = events.size();
  recording.event_log = [log = std::make_shared<const std::vector<Event>>(std::move(events))] { return *log; };
  return recording;
}

Recording recording_in_memory(const Scene& scene, const Disks& disks, std::vector<State> samples, const std::string& why_no_log) {
  const double begin = samples.front().time;
  for (State& state : samples) state.time -= begin;
  Recording recording;
  recording.scene = scene;
  recording.disks = disks;
  for (const Species& species : scene.species) recording.species_names.push_back(species.name);
  recording.title = scene.title;
  recording.end = samples.back().time;
  recording.samples = samples.size();
  recording.why_no_log = why_no_log;
  const auto states = std::make_shared<const std::vector<State>>(std::move(samples));
  recording.sample = [states](std::uint64_t k) { return (*states)[k]; };
  recording.sample_times = [states] {
    std::vector<double> times;
    for (const State& state : *states) times.push_back(state.time);
    return times;
  };
  return recording;
}

}  // namespace carom
