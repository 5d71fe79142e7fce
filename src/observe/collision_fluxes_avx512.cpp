#define CAROM_INSTRUCTIONS avx512
#include "observe/collision_fluxes_kernel.hpp"
