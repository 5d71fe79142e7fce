#include "studies/horizon/report.hpp"

#include <fmt/format.h>

#include <optional>

namespace carom {

std::string to_string(HorizonEnd end) {
  switch (end) {
    case HorizonEnd::parted:
      return "parted";
    case HorizonEnd::run:
      return "run";
    case HorizonEnd::limit:
      return "limit";
    case HorizonEnd::interrupted:
      return "interrupted";
    case HorizonEnd::stuck:
      return "stuck";
  }
  return "unknown";
}

namespace {

std::string place(double time, double collisions_per_disk) {
  if (!(collisions_per_disk > 0.0)) return fmt::format("t = {:.4g}", time);
  const int decimals = collisions_per_disk < 9.95 ? 1 : 0;
  return fmt::format("t = {:.4g} ({:.{}f} collisions per disk)", time, collisions_per_disk, decimals);
}

/// Returns up to where the trajectory is right for certain, and why the comparison ended there.
std::string why_ended(const Horizon& horizon) {
  const std::string where = place(horizon.time, horizon.collisions_per_disk);
  switch (horizon.ended) {
    case HorizonEnd::parted:
      return "at least until " + where;
    case HorizonEnd::run:
      if (horizon.run_time && horizon.time > *horizon.run_time)
        return fmt::format("to the end of the run and beyond, at least until {}", where);
      return "to the end of the run, " + where;
    case HorizonEnd::limit:
      return fmt::format("at least until {}, where the comparison reached its limit of work", where);
    case HorizonEnd::interrupted:
      return fmt::format("at least until {}, where the comparison was interrupted", where);
    case HorizonEnd::stuck:
      return fmt::format("at least until {}, where jammed disks collided without end", where);
  }
  return "";
}

double cost_of(const HorizonRow& dear, const HorizonRow* cheap) {
  return cheap != nullptr && cheap->seconds > 0.0 ? dear.seconds / cheap->seconds : 0.0;
}

/// Returns a ratio to two digits.
std::string times(double ratio) { return fmt::format("{:.{}f} times", ratio, ratio < 9.95 ? 1 : 0); }

/// Returns the cost of the best precision relative to the same engine in double precision, and to the engine that runs the scene:
/// ", at 25 times the cost". Empty where it was not measured.
std::string price(const Horizon& horizon, const HorizonRow& own, const HorizonRow& best) {
  const double of_own = cost_of(best, &own);
  if (!(of_own > 0.0)) return "";
  if (own.engine != "fast" && own.engine != "general") return fmt::format(", at {} the cost", times(of_own));
  const double of_double = cost_of(best, horizon.row("textbook"));
  return fmt::format(", at {} the cost of the same engine in double precision and {} the cost of the {} engine", times(of_double),
                     times(of_own), own.engine);
}

std::string how_far_the_best(const Horizon& horizon, const HorizonRow& own) {
  if (horizon.rows.empty()) return "";
  const HorizonRow& best = horizon.rows.back();
  if (best.bits <= own.bits) return "";
  const std::string with = precision_name(best.bits);
  if (!best.time) return fmt::format(" With {} it is right {}{}.", with, why_ended(horizon), price(horizon, own, best));
  return fmt::format(" With {} it is right until about {}{}.", with, place(*best.time, best.collisions_per_disk.value_or(0.0)),
                     price(horizon, own, best));
}

}  // namespace

std::string precision_name(int bits) {
  if (bits == 24) return "single precision";
  if (bits == 53) return "double precision";
  return fmt::format("{} bits", bits);
}

std::string sentence_of(const Horizon& horizon) {
  const HorizonRow* own = horizon.row(horizon.engine);
  if (own == nullptr || (horizon.ended == HorizonEnd::interrupted && horizon.time == 0.0))
    return "The comparison was interrupted at its start: the horizon of this trajectory is unknown.";
  const std::string in = fmt::format("{} {}", own->bits == 24 || own->bits == 53 ? "In" : "With", precision_name(own->bits));
  const std::string right = fmt::format("this trajectory is right to {:g} diameters", horizon.tolerance);
  if (!own->time) return fmt::format("{} {} {}.", in, right, why_ended(horizon));
  const std::string until =
      fmt::format("{}{}", own->estimated ? "about " : "", place(*own->time, own->collisions_per_disk.value_or(0.0)));
  std::string text = fmt::format("{} {} until {}", in, right, until);
  if (horizon.run_time && *own->time >= *horizon.run_time)
    text = fmt::format("{} {} to the end of the run, t = {:.4g}, and would be until {}", in, right, *horizon.run_time, until);
  return text + "." + how_far_the_best(horizon, *own);
}

}  // namespace carom
