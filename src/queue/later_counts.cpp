#include "queue/later_counts.hpp"

#include "core/instructions.hpp"

namespace carom {

CAROM_DECLARE_KERNELS(extern const CountLater later_counts;)

CountLater count_later() { return CAROM_CHOSEN_KERNEL(later_counts); }

}  // namespace carom
