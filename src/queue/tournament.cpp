#include "queue/tournament.hpp"

#include "core/instructions.hpp"

namespace carom {

namespace portable {
extern const TournamentKernel tournament_of_two_levels, tournament_of_three_levels;
}

#if CAROM_HAS_AVX2
namespace avx2 {
extern const TournamentKernel tournament_of_two_levels, tournament_of_three_levels;
}
#else
namespace avx2 = portable;
#endif

#if CAROM_HAS_AVX512
namespace avx512 {
extern const TournamentKernel tournament_of_two_levels, tournament_of_three_levels;
}
#else
namespace avx512 = avx2;
#endif

const TournamentKernel& tournament_kernel(int levels) {
  return levels == 2
             ? chosen_kernel(portable::tournament_of_two_levels, avx2::tournament_of_two_levels, avx512::tournament_of_two_levels)
             : chosen_kernel(portable::tournament_of_three_levels, avx2::tournament_of_three_levels,
                             avx512::tournament_of_three_levels);
}

}  // namespace carom
