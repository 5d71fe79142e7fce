#define CAROM_INSTRUCTIONS avx512
#include "queue/tournament_kernel.hpp"
