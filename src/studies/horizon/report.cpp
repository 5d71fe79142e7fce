#include "studies/horizon/report.hpp"

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

}  // namespace carom
