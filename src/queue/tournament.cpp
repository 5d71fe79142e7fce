#include "queue/tournament.hpp"

#include "core/instructions.hpp"

namespace carom {

CAROM_DECLARE_KERNELS(extern const TournamentKernel tournament_of_two_levels, tournament_of_three_levels;)

const TournamentKernel& tournament_kernel(int levels) {
  return levels == 2 ? CAROM_CHOSEN_KERNEL(tournament_of_two_levels) : CAROM_CHOSEN_KERNEL(tournament_of_three_levels);
}

}  // namespace carom
