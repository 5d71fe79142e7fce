// Simulations that several processes compute together: how they begin on the other ranks.

#include <carom/ranks.hpp>

#include "core/state_archive.hpp"
#include "parallel/broadcast_stream.hpp"
#include "parallel/packet.hpp"
#include "scene/resolved_effects.hpp"
#include "simulation/parts.hpp"
#include "simulation/start.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

namespace carom {

namespace {

/// What rank 0 has the others do.
enum class Task : std::uint8_t { simulate, end };

std::string bytes_of(Task task) {
  Packet packet;
  packet.put(task);
  return std::move(packet.bytes());
}

/// Has all ranks know whether each of them could begin. Returns the words of the first that could not, on rank 0; on the others
/// any words.
std::string failure_of_all(Ranks& ranks, const std::string& here) {
  const std::vector<std::string> words = ranks.gather(here);
  std::string failure;
  for (std::size_t rank = 0; rank < words.size(); ++rank)
    if (failure.empty() && !words[rank].empty()) failure = fmt::format("process {}: {}", rank, words[rank]);
  ranks.broadcast(failure);
  return failure;
}

}  // namespace

void Simulation::Parts::share_out() {
  std::string task = bytes_of(Task::simulate);
  ranks->broadcast(task);
  {
    detail::BroadcastOutput out(*ranks);
    SavingArchive archive(out);
    const std::optional<Circle>& circle = scene.effects.circle;
    archive(threads.threads, threads.domains, threads.halo, threads.events_per_window, engine_name,
            detail::effects_toml(scene.effects), scene.run.seed, scene.box.lower, scene.box.upper, scene.box.periodic(0),
            scene.box.periodic(1), circle.has_value(), circle ? circle->centre : Eigen::Vector2d::Zero().eval(),
            circle ? circle->radius : 0.0, disks.radius, disks.mass, disks.species, engine->state());
  }
  if (const std::string failure = failure_of_all(*ranks, {}); !failure.empty()) throw std::runtime_error(failure);
  engine->set_ranks(threads, *ranks);
}

/// An engine for the disks as they stand; what else decides how they go on comes when they are shared out.
Simulation Simulation::begin_elsewhere(Ranks& ranks, Threads& threads) {
  std::string engine, effects;
  Scene scene;
  bool periodic[2] = {};
  bool in_circle = false;
  Circle circle;
  Start start;
  {
    detail::BroadcastInput in(ranks);
    LoadingArchive archive(in);
    archive(threads.threads, threads.domains, threads.halo, threads.events_per_window, engine, effects, scene.run.seed,
            scene.box.lower, scene.box.upper, periodic[0], periodic[1], in_circle, circle.centre, circle.radius,
            start.disks.radius, start.disks.mass, start.disks.species, start.state);
  }
  scene.effects = detail::parse_effects(effects);
  for (std::size_t axis = 0; axis < 2; ++axis) scene.box.boundary[axis] = periodic[axis] ? Boundary::periodic : Boundary::walls;
  if (in_circle) put_in_circle(scene.box, scene.effects, circle);
  return begin(scene, std::move(start), engine);
}

void Simulation::serve(Ranks& ranks) {
  for (;;) {
    std::string bytes;
    ranks.broadcast(bytes);
    if (PacketReader(bytes).take<Task>() == Task::end) return;
    std::optional<Simulation> simulation;
    Threads threads;
    std::string failure;
    try {
      simulation.emplace(begin_elsewhere(ranks, threads));
    } catch (const std::bad_alloc&) {
      failure = "there is not enough memory";
    } catch (const std::exception& error) {
      failure = error.what();
    }
    if (failure_of_all(ranks, failure).empty()) simulation->parts_->engine->serve(threads, ranks);
  }
}

void serve_ranks(Ranks& ranks) { Simulation::serve(ranks); }

void dismiss_ranks(Ranks& ranks) {
  std::string bytes = bytes_of(Task::end);
  ranks.broadcast(bytes);
}

}  // namespace carom
