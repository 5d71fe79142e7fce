#pragma once
// Tells the caller of make_simulation() by the clock how far the placing of disks has come.

#include "simulation/proceed_watch.hpp"

#include <carom/simulation.hpp>

#include <cstdint>
#include <functional>
#include <utility>

namespace carom::detail {

/// Calls a PlacingHook some twenty times a second, for work that is done in many passes. What the hook throws leaves pass().
class PlacingWatch {
 public:
  /// `fraction` returns how much of the placing is done, from 0 to 1. An empty hook is never called.
  PlacingWatch(PlacingHook hook, std::function<double()> fraction) {
    if (hook)
      tell_ = [hook = std::move(hook), fraction = std::move(fraction)] {
        hook(fraction());
        return true;
      };
  }
  PlacingWatch(const PlacingWatch&) = delete;
  PlacingWatch& operator=(const PlacingWatch&) = delete;

  /// Returns how many passes may be made before they have to be counted.
  [[nodiscard]] std::uint64_t passes() const { return watch_.events(); }

  /// Counts passes that have been made, and calls the hook where it is time.
  void pass(std::uint64_t made = 1) {
    made_ += made;
    if (made_ < watch_.events()) return;
    made_ = 0;
    (void)watch_.stopped();
  }

 private:
  std::function<bool()> tell_;
  ProceedWatch watch_{tell_};
  std::uint64_t made_ = 0;
};

}  // namespace carom::detail
