#include "pages/playback_source.hpp"

#include <algorithm>
#include <utility>

namespace carom {

Playback::~Playback() = default;

Playback::Playback(const RunReader& run, const PlaybackOptions& options) {
  const std::vector<double> times = run.sample_times();
  begin_ = times.front();
  last_sample_ = times.back();
  ExactRun exact = read_exactly(run, options.most_events, "are kept in memory");
  why_not_ = exact.why_not;
  end_ = last_sample_;
  if (this->exact()) end_ = std::max({run.end(), last_sample_, exact.events.empty() ? 0.0 : exact.events.back().time});
  std::optional<Trails> trails;
  if (options.trail > 0.0) {
    const auto& gravity = run.scene().effects.gravity;
    const bool curved = this->exact() && gravity;
    trails.emplace(run.scene().box, curved ? gravity->acceleration : Eigen::Vector2d::Zero(), options.trail);
    for (std::size_t i = 0; i < run.disks().count(); ++i)
      if (!options.trails_of || run.disks().species[i] == *options.trails_of) trails->follow(i);
  }
  source_ = this->exact() ? detail::exact_source(run, std::move(exact), std::move(trails))
                          : detail::sample_source(run, std::move(trails));
}

const Moment& Playback::at(double time) {
  source_->read(time, moment_);
  return moment_;
}

}  // namespace carom
