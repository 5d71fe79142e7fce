#define CAROM_INSTRUCTIONS avx2
#include "queue/tournament_kernel.hpp"
